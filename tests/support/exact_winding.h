// SPDX-License-Identifier: GPL-3.0-or-later
/// Winding numbers in integer arithmetic, independent of the compiler: subdivision at the middle, and nothing but
/// comparisons of integers. Frame: planar space (planar/grid.h).
#pragma once

#include <gmpxx.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compiler/planar/grid.h"
#include "compiler/scene/scene.h"

namespace fetexc::test {

/// Coordinates of an exact point are multiples of 2^-kPointBits.
inline constexpr int kPointBits = 240;

struct ExactPoint {
    mpz_class x, y; ///< times 2^kPointBits; odd, so that no curve's dyadic point up to depth kPointBits/3 hits them
};

/// A Bezier segment with control points in planar space.
struct PlanarCurve {
    int degree = 1;
    std::array<std::int64_t, 4> x{}, y{};
};

[[nodiscard]] PlanarCurve planar_curve(const Segment& segment, const Grid& grid);

/// Crossings of the curve with the ray from the point to the left, downward ones counted +1, upward ones −1. None: the
/// point is on the curve, or nearer to it than 2^-kPointBits/3 of its size.
[[nodiscard]] std::optional<int> crossings_left_of(const PlanarCurve& curve, const ExactPoint& point);

/// Winding number of a shape around the point: +1 right of a contour that runs down.
[[nodiscard]] std::optional<int> winding_at(std::span<const PlanarCurve> contour, const ExactPoint& point);

/// Enclosure of the x coordinate at which a curve passes y within a parameter range in which both coordinates are
/// monotone. None: it doesn't pass there, as far as the range shows.
struct ExactRange {
    mpz_class lo, hi; ///< times 2^kPointBits
};
[[nodiscard]] std::optional<ExactRange> position_at(const PlanarCurve& curve, double t0, double t1, const mpz_class& y);

/// −∮ x dy of closed contours: the sum of area times winding number over the plane. Exact.
[[nodiscard]] mpq_class winding_area(std::span<const PlanarCurve> contour);

} // namespace fetexc::test
