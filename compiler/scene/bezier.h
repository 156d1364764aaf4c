// SPDX-License-Identifier: GPL-3.0-or-later
/// Bezier helpers in double precision, used by guard-box clipping and the ground truth. Frame: whatever the caller's
/// is.
#pragma once

#include <array>
#include <span>

#include "compiler/scene/scene_builder.h"

namespace fetexc::bezier {

enum class Axis { X, Y };

/// Parameters found in (0,1), ascending.
struct Parameters {
    int count = 0;
    std::array<double, 2> t{};
    [[nodiscard]] std::span<const double> all() const& { return {t.data(), static_cast<std::size_t>(count)}; }
    std::span<const double> all() const&& = delete; ///< would dangle
};

[[nodiscard]] inline double coordinate(CanvasPoint p, Axis axis) { return axis == Axis::X ? p.x : p.y; }

/// De Casteljau: exact at t = 0 and 1, no overflow where the control points themselves are representable.
[[nodiscard]] CanvasPoint point_at(const CanvasSegment& s, double t);
[[nodiscard]] double value_at(const CanvasSegment& s, Axis axis, double t);

/// The part over [t0,t1]. Its end points equal point_at(t0) and point_at(t1) bit for bit, so neighbouring parts join.
[[nodiscard]] CanvasSegment part(const CanvasSegment& s, double t0, double t1);

/// Interior parameters where the coordinate's derivative vanishes. Splitting there gives monotone parts.
[[nodiscard]] Parameters extrema(const CanvasSegment& s, Axis axis);

/// Root of coordinate(t) = target on [t0,t1], where the coordinate is monotone and the target lies between its end
/// values.
[[nodiscard]] double solve_monotone(const CanvasSegment& s, Axis axis, double target, double t0, double t1);

[[nodiscard]] CanvasSegment to_double(const Segment& s);

} // namespace fetexc::bezier
