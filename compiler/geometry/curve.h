// SPDX-License-Identifier: GPL-3.0-or-later
/// Bezier curves of degree 1…3 with integer control points, and their certified evaluation.
///
/// Frame: planar space = lattice space times an integer per axis, so that all grid lines are integers (planar/grid.h).
/// |control point| ≤ 2^43, so every control point is exact in a double.
#pragma once

#include <array>
#include <cstdint>

#include "compiler/geometry/interval.h"

namespace fetexc {

struct IntPoint {
    std::int64_t x = 0, y = 0;
    friend bool operator==(const IntPoint&, const IntPoint&) = default;
    friend auto operator<=>(const IntPoint&, const IntPoint&) = default;
};

enum class Axis : std::uint8_t { X, Y };
inline Axis other(Axis axis) { return axis == Axis::X ? Axis::Y : Axis::X; }

/// One coordinate of a curve: control values relative to the first one, which is exact and kept apart.
struct Coordinate {
    std::int64_t origin = 0;
    std::array<double, 4> local{}; ///< exact: differences of integers below 2^44
    double magnitude = 0;          ///< max |local|
};

struct Curve {
    int degree = 1; ///< 1…3, reduced: never a disguised lower degree when built by make_curve
    std::array<IntPoint, 4> p{};
    Coordinate x, y;

    [[nodiscard]] const Coordinate& along(Axis axis) const { return axis == Axis::X ? x : y; }
    [[nodiscard]] IntPoint first() const { return p[0]; }
    [[nodiscard]] IntPoint last() const { return p[static_cast<std::size_t>(degree)]; }
};

/// Exact degree reduction: cubic → quadratic when the control points stay integers; anything collinear → the line
/// between its end points (what it runs beyond them it runs twice, in opposite directions, so no winding number
/// changes).
Curve make_curve(int degree, const std::array<IntPoint, 4>& p);

/// Exact: all control points on one line.
bool is_collinear(const Curve& c);

/// Value at an exact parameter, |t| ≤ 2.
Interval value_at(const Curve& c, Axis axis, double t);
/// Enclosure of the values over a (narrow) parameter interval, by the mean value form.
Interval value_over(const Curve& c, Axis axis, const Interval& t);
/// Enclosure of the derivative over a parameter interval, by the hull of its control values.
Interval derivative_over(const Curve& c, Axis axis, const Interval& t);
/// Plain double evaluation (Newton steps; not certified).
double value_double(const Curve& c, Axis axis, double t);
double derivative_double(const Curve& c, Axis axis, double t);
/// As value_double, relative to the curve's origin (no rounding to the absolute position).
double local_double(const Curve& c, Axis axis, double t);

/// Parameter of a monotone stretch [range.lo, range.hi] at which the coordinate equals v: an enclosure inside the
/// range. The caller guarantees that the coordinate is monotone there and that v lies between the values at the ends
/// (up to their enclosures).
Interval parameter_at(const Curve& c, Axis axis, const Interval& range, bool increasing, double v);

/// Control values of the stretch [t0,t1] (blossom), relative to the curve's origin, in double; error ≤
/// 2·kEvaluationError·magnitude.
std::array<double, 4> stretch(const Curve& c, Axis axis, double t0, double t1);

} // namespace fetexc
