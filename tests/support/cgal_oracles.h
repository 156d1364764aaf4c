// SPDX-License-Identifier: GPL-3.0-or-later
/// CGAL's own exact machinery as an oracle: it shares no code and no number type with the compiler. Slow (milliseconds
/// to minutes), and it throws, crashes or hangs on some input: see forked.h.
#pragma once

#include <optional>

#include "compiler/geometry/curve.h"
#include "tests/support/subdivision.h"

namespace fetexc::test {

/// Arr_conic_traits_2 (CORE::Expr). Lines, and quadratics whose control points are not collinear; |coordinates| ≤ 2^12.
[[nodiscard]] Subdivision conic_subdivision(std::span<const Path> paths);

/// Arr_Bezier_curve_traits_2 (CORE::Expr behind rational bounds). Segments of any degree.
[[nodiscard]] Subdivision bezier_subdivision(std::span<const Path> paths);

/// The same without the places, for timing: processor time of inserting the curves.
struct InsertionTiming {
    double seconds = 0;
    std::size_t vertices = 0, edges = 0, faces = 0;
};
[[nodiscard]] InsertionTiming time_bezier_insertion(std::span<const Path> paths);

struct ParameterPoint {
    Interval s, t;
};

/// All real solutions of A(s) = B(t) within the ranges, by Algebraic_kernel_d_2. None when there are infinitely many,
/// or when one coordinate is the same constant on both.
[[nodiscard]] std::optional<std::vector<ParameterPoint>> common_points(const Curve& a, const Interval& s_range,
                                                                       const Curve& b, const Interval& t_range);

} // namespace fetexc::test
