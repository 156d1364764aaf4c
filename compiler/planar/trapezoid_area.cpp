// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/trapezoid_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fetexc {
namespace {

using Real = long double;

/// Control values relative to the texel's corner: differences of integers below 2^45, exact.
struct Local {
    int degree = 1;
    std::array<Real, 4> v{};
    [[nodiscard]] Real at(Real t) const {
        std::array<Real, 4> p = v;
        for (int n = degree; n > 0; --n) {
            for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i)
                p[i] += t * (p[i + 1] - p[i]);
        }
        return p[0];
    }
    [[nodiscard]] Local derivative() const {
        Local d;
        d.degree = std::max(1, degree - 1);
        for (std::size_t i = 0; i < static_cast<std::size_t>(degree); ++i)
            d.v[i] = static_cast<Real>(degree) * (v[i + 1] - v[i]);
        if (degree == 1) d.v[1] = d.v[0];
        return d;
    }
};

Local local(const Curve& c, Axis axis, std::int64_t origin) {
    Local out;
    out.degree = c.degree;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(c.degree); ++i)
        out.v[i] = static_cast<Real>((axis == Axis::X ? c.p[i].x : c.p[i].y) - origin);
    return out;
}

/// On a stretch where the values are monotone: Newton steps, kept in a bracket.
Real parameter_at(const Local& c, const Local& slope, const Interval& range, Real v) {
    constexpr int kSteps = 80;
    Real lo = range.lo, hi = range.hi, t = (lo + hi) / 2;
    const bool rises = c.at(lo) < c.at(hi);
    std::array<Real, 3> last{}; ///< t, lo and hi when the step before began
    for (int k = 0; k < kSteps; ++k) {
        const std::array<Real, 3> now{t, lo, hi};
        const Real off = c.at(t) - v, step = off / slope.at(t);
        ((off < 0) == rises ? lo : hi) = t;
        Real next = t - step;
        if (!(next > lo && next < hi)) next = (lo + hi) / 2;
        if (next == t || std::fabs(next - t) <= std::numeric_limits<Real>::epsilon() * t) return next;
        // Two values may take turns for ever: what the last step would end on is known.
        if (last == std::array{next, lo, hi}) return (kSteps - k) % 2 != 0 ? next : t;
        last = now, t = next;
    }
    return t;
}

const Curve& curve_of(const PlanarMap& map, const TexelMap& texel, std::uint32_t edge) {
    return *map.stretch_of(texel.sub_edges[texel.graph.edges[edge].sub]).curve;
}

} // namespace

TrapezoidAreas::TrapezoidAreas(const PlanarMap& map, const TexelMap& texel)
    : map_(map), texel_(texel), x0_(map.grid().px * texel.i), y0_(map.grid().py * texel.j),
      width_(static_cast<Real>(map.grid().px)), height_(static_cast<Real>(map.grid().py)),
      meetings_(texel.graph.edges.size()) {}

Real TrapezoidAreas::level(std::uint32_t node, bool top) const {
    if (node == kNone) return top ? 0 : height_;
    return static_cast<Real>(map_.node(texel_.graph.nodes[node]).y) - static_cast<Real>(y0_);
}

Real TrapezoidAreas::level_error(std::uint32_t node) const {
    if (node == kNone) return 0;
    return static_cast<Real>(map_.node(texel_.graph.nodes[node]).y_range.width());
}

/// ∫ x dy between two levels: a polynomial of degree 5 in the parameter at most, so three Gauss points are exact.
Real TrapezoidAreas::side_integral(std::uint32_t edge, bool right, Real y0, Real y1) {
    if (edge == kNone) return right ? width_ * (y1 - y0) : 0;
    const Stretch s = map_.stretch_of(texel_.sub_edges[texel_.graph.edges[edge].sub]);
    const Local x = local(*s.curve, Axis::X, x0_), y = local(*s.curve, Axis::Y, y0_), dy = y.derivative();
    const auto parameter = [&](Real level) {
        auto& [last, before] = meetings_[edge];
        if (before.level == level) return before.parameter;
        if (last.level != level) {
            before = last;
            last = {level, parameter_at(y, dy, s.range, level)};
        }
        return last.parameter;
    };
    const Real t0 = parameter(y0), t1 = parameter(y1);
    const Real half = (t1 - t0) / 2, middle = (t0 + t1) / 2, reach = std::sqrt(static_cast<Real>(0.6L)) * half;
    Real sum = 8 * x.at(middle) * dy.at(middle);
    for (const Real t : {middle - reach, middle + reach})
        sum += 5 * x.at(t) * dy.at(t);
    return half * sum / 9;
}

/// An error of x counts over the height, one of y and of the derivative over widths (budget::kAreaWidths).
Real TrapezoidAreas::side_error(std::uint32_t edge, Real height) const {
    if (edge == kNone) return 0;
    const Curve& c = curve_of(map_, texel_, edge);
    Real magnitude = 0;
    for (const auto& [axis, origin] : {std::pair(Axis::X, x0_), std::pair(Axis::Y, y0_)}) {
        const Local l = local(c, axis, origin);
        for (std::size_t i = 0; i <= static_cast<std::size_t>(c.degree); ++i)
            magnitude = std::max(magnitude, std::fabs(l.v[i]));
    }
    return budget::kAreaEvaluationSteps * std::numeric_limits<Real>::epsilon() * magnitude *
           (height + budget::kAreaWidths * width_);
}

/// A level is a double inside its enclosure, so it errs by the enclosure's width (and one rounding of the subtraction).
/// The result is rounded to double, and once more when it is added up.
BoundedArea TrapezoidAreas::of(const Trapezoid& t) {
    const Real y0 = level(t.top_node, true), y1 = level(t.bottom_node, false), height = std::fabs(y1 - y0);
    const Real area = side_integral(t.right, true, y0, y1) - side_integral(t.left, false, y0, y1);
    const Real levels = level_error(t.top_node) + level_error(t.bottom_node) +
                        4 * std::numeric_limits<double>::epsilon() * std::numeric_limits<double>::epsilon() * height_;
    const Real error = side_error(t.left, height) + side_error(t.right, height) + 2 * levels * width_;
    return {static_cast<double>(area),
            static_cast<double>(error) + budget::kAreaRounding * static_cast<double>(width_ * height_)};
}

} // namespace fetexc
