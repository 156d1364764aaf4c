// SPDX-License-Identifier: GPL-3.0-or-later
/// Canvas space to lattice space (scene.h states both frames).
#pragma once

#include <algorithm>

#include "compiler/result.h"
#include "compiler/scene/scene_builder.h"

namespace fetexc {

/// lattice = canvas · (sx, sy); the canvas maps exactly onto [0,lattice_w]×[0,lattice_h].
struct LatticeScale {
    double sx = 1, sy = 1;
};

/// Larger side 2^26 steps, the other by aspect (at least 1). Error kSceneExtentInvalid unless both are finite and > 0.
Result<Extent> make_extent(double width, double height);

[[nodiscard]] LatticeScale lattice_scale(const Extent& extent);

/// Canvas point of a lattice-space position.
[[nodiscard]] CanvasPoint to_canvas(const Extent& extent, double x, double y);

/// Scaled control points, still in double. A coordinate that overflows saturates at ±1e300 (the input itself is
/// finite).
[[nodiscard]] inline CanvasSegment to_lattice_space(const CanvasSegment& s, LatticeScale scale) {
    const double most = 1e300; // keeps differences of saturated coordinates finite in double
    const auto scaled = [most](double v, double by) { return std::clamp(v * by, -most, most); };
    CanvasSegment out;
    out.degree = s.degree;
    for (int i = 0; i <= s.degree; ++i)
        out.p[i] = {scaled(s.p[i].x, scale.sx), scaled(s.p[i].y, scale.sy)};
    return out;
}

/// Nearest lattice point; halves round away from zero. The point must lie within ±kLatticeLimit.
[[nodiscard]] inline LatticePoint snap(CanvasPoint p) {
    const auto nearest = [](double v) { // std::llround, inlined
        const auto whole = static_cast<std::int64_t>(v);
        const double rest = v - static_cast<double>(whole); // exact
        return whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
    };
    return {nearest(p.x), nearest(p.y)};
}

} // namespace fetexc
