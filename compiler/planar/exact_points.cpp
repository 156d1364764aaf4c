// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/exact_points.h"

#include "compiler/geometry/orientation.h"

namespace fetexc {
namespace {

const Interval& along(const Vertex& v, Axis axis) { return axis == Axis::X ? v.x : v.y; }
Fixed along(const FixedPoint& p, Axis axis) { return axis == Axis::X ? p.x : p.y; }

/// The derivative whose sign changes over t.
Polynomial extremum_polynomial(const Curve& c, const Interval& t) {
    for (const Axis axis : {Axis::X, Axis::Y}) {
        const Polynomial d = derivative(power_basis(c, axis));
        if (sgn(evaluate(d, mpq_class(t.lo))) * sgn(evaluate(d, mpq_class(t.hi))) <= 0 && !d.empty()) return d;
    }
    return {};
}

/// The curve passes p at one parameter within t: the coordinate that takes p's value only there.
Polynomial through_point(const Curve& c, IntPoint p, const Interval& t) {
    const bool x_first = c.x.magnitude >= c.y.magnitude;
    const Polynomial x = minus(power_basis(c, Axis::X), to_mpz(p.x)), y = minus(power_basis(c, Axis::Y), to_mpz(p.y));
    const Polynomial &first = x_first ? x : y, &second = x_first ? y : x;
    if (first.size() == 2 || second.empty()) return first;
    return isolate_roots(first, mpq_class(t.lo), mpq_class(t.hi), 1).size() == 1 ? first : second;
}

/// A crossing's parameters.
std::optional<NarrowContact> narrowed(const ArcSet& set, const Vertex& v) {
    if (v.narrow) return *v.narrow;
    if (v.a == kNone || v.b == kNone) return {};
    return narrow_contact(set.curves[v.a], set.curves[v.b], {v.s, v.t});
}

/// The resultant has a root for every branch that passes: where another is within the enclosure, a narrower one. Of two
/// curves on one support, which have no resultant, only the double point is a crossing.
AlgebraicNumber crossing_parameter(const ArcSet& set, const Vertex& v, std::uint32_t curve, const Interval& t) {
    AlgebraicNumber out{eliminate(set.curves[curve], set.curves[v.a == curve ? v.b : v.a]), mpq_class(t.lo),
                        mpq_class(t.hi)};
    if (out.polynomial.empty()) out.polynomial = double_point_polynomial(set.curves[curve]);
    if (out.polynomial.size() == 2) return out;
    if (const auto narrow = narrowed(set, v)) {
        const RationalRange& r = v.a == curve ? narrow->s : narrow->t;
        out.lo = r.lo, out.hi = r.hi;
    }
    return out;
}

// --- lines: parameters are ratios of integers below 2^91

struct Ratio {
    Fixed numerator = 0, denominator = 1; ///< denominator > 0
};

Ratio positive(Fixed n, Fixed d) { return d < 0 ? Ratio{-n, -d} : Ratio{n, d}; }

/// Parameter of a vertex on a line, when it is an integer point or a crossing with another line.
std::optional<Ratio> ratio_on_line(const ArcSet& set, const Vertex& v, std::uint32_t curve) {
    const Curve& c = set.curves[curve];
    if (c.degree != 1) return {};
    if (v.integral) {
        const bool x = c.x.magnitude >= c.y.magnitude;
        return x ? positive(v.point.x - c.p[0].x, c.p[1].x - c.p[0].x)
                 : positive(v.point.y - c.p[0].y, c.p[1].y - c.p[0].y);
    }
    if (v.b == kNone) return {};
    const Curve& other = set.curves[v.a == curve ? v.b : v.a];
    if (other.degree != 1) return {};
    const Fixed from = cross(other.p[0], other.p[1], c.p[0]), to = cross(other.p[0], other.p[1], c.p[1]);
    return positive(from, from - to);
}

/// As side_of_level, for a line that isn't on a level itself.
int side_of_line(const Curve& line, Axis axis, std::int64_t level, std::int64_t v) {
    const IntPoint at = axis == Axis::X ? IntPoint{level, v} : IntPoint{v, level};
    const int turn = sign_of(cross(line.p[0], line.p[1], at));
    const bool rising = axis == Axis::X ? line.p[1].x > line.p[0].x : line.p[1].y > line.p[0].y;
    return rising == (axis == Axis::X) ? -turn : turn;
}

int compare(const Ratio& a, const Ratio& b) {
    if (a.denominator == b.denominator) return sign_of(a.numerator - b.numerator);
    return cmp(to_integer(a.numerator) * to_integer(b.denominator),
               to_integer(b.numerator) * to_integer(a.denominator));
}

} // namespace

std::optional<FixedPoint> fixed_point(const ArcSet& set, const Vertex& v) {
    if (v.integral) return fixed(v.point);
    if (const auto narrow = narrowed(set, v)) return fixed_contact(set.curves[v.a], *narrow);
    return v.a != kNone && v.b == kNone ? fixed_extremum(set.curves[v.a], v.s) : std::nullopt;
}

int certain_sign(Fixed difference) {
    return difference > budget::kFixedCertain ? 1 : difference < -budget::kFixedCertain ? -1 : 0;
}

AlgebraicCoordinate algebraic_coordinate(const ArcSet& set, const Vertex& v, Axis axis) {
    AlgebraicCoordinate out;
    out.axis = axis;
    if (v.integral) {
        out.level = axis == Axis::X ? v.point.x : v.point.y;
        return out;
    }
    // On the curve along which the coordinate is simpler; a level or upright line knows it.
    const bool on_b =
        v.b != kNone && power_basis(set.curves[v.b], axis).size() < power_basis(set.curves[v.a], axis).size();
    out.curve = &set.curves[on_b ? v.b : v.a];
    if (out.curve->along(axis).magnitude == 0) {
        out.level = out.curve->along(axis).origin;
        return out;
    }
    out.parameter = parameter_of(set, v, on_b ? v.b : v.a, on_b ? v.t : v.s);
    return out;
}

std::optional<int> compare_coordinates(const ArcSet& set, const Vertex& a, const Vertex& b, Axis axis) {
    if (const int c = compare(along(a, axis), along(b, axis)); c != 0) return c;
    if (a.integral && b.integral) return 0;
    const std::optional<FixedPoint> p = fixed_point(set, a), q = fixed_point(set, b);
    if (p && q) {
        if (const int c = certain_sign(along(*p, axis) - along(*q, axis)); c != 0) return c;
    }
    return compare(algebraic_coordinate(set, a, axis), algebraic_coordinate(set, b, axis));
}

std::optional<int> side_of_level(const ArcSet& set, const Vertex& a, Axis axis, std::int64_t v) {
    const auto level = static_cast<double>(v);
    if (const int c = compare(along(a, axis), Interval(level)); c != 0) return c;
    if (along(a, axis).lo == along(a, axis).hi) return 0;
    if (const std::optional<FixedPoint> p = fixed_point(set, a)) {
        if (const int c = certain_sign(along(*p, axis) - (static_cast<Fixed>(v) << budget::kFixedBits)); c != 0)
            return c;
    }
    const AlgebraicNumber t = parameter_of(set, a, a.a, a.s);
    return sign_at(minus(power_basis(set.curves[a.a], axis), to_mpz(v)), t);
}

std::optional<int> side_of_level(const Curve& c, Axis axis, std::int64_t level, const Interval& t, std::int64_t v) {
    const Axis across = other(axis);
    if (c.along(across).magnitude == 0) return sign_of(c.along(across).origin - v);
    if (c.degree == 1) return side_of_line(c, axis, level, v);
    if (const std::optional<FixedPoint> p = whole_level(c, axis, level, t))
        return sign_of(along(*p, across) - (static_cast<Fixed>(v) << budget::kFixedBits));
    if (const std::optional<FixedPoint> p = fixed_level(c, axis, level, t)) {
        if (const int side = certain_sign(along(*p, across) - (static_cast<Fixed>(v) << budget::kFixedBits)); side != 0)
            return side;
    }
    return sign_at(minus(power_basis(c, across), to_mpz(v)),
                   {minus(power_basis(c, axis), to_mpz(level)), mpq_class(t.lo), mpq_class(t.hi)});
}

AlgebraicNumber parameter_of(const ArcSet& set, const Vertex& v, std::uint32_t curve, const Interval& t) {
    const Curve& c = set.curves[curve];
    AlgebraicNumber out{{}, mpq_class(t.lo), mpq_class(t.hi)};
    if (v.integral)
        out.polynomial = through_point(c, v.point, t);
    else if (v.b == kNone)
        out.polynomial = extremum_polynomial(c, t);
    else if (v.a == v.b)
        out.polynomial = double_point_polynomial(c);
    else
        return crossing_parameter(set, v, curve, t);
    return out;
}

std::optional<int> compare_along(const ArcSet& set, const Arc& arc, const Vertex& a, const Interval& ta,
                                 const Vertex& b, const Interval& tb, std::uint64_t& exact_comparisons) {
    if (const int c = compare(ta, tb); c != 0) return c;
    if (const int c = compare(a.x, b.x); c != 0) return arc.x_increasing ? c : -c;
    if (const int c = compare(a.y, b.y); c != 0) return arc.y_increasing ? c : -c;
    ++exact_comparisons;
    const std::optional<Ratio> ra = ratio_on_line(set, a, arc.curve), rb = ratio_on_line(set, b, arc.curve);
    if (ra && rb) return compare(*ra, *rb);
    return compare_numbers(parameter_of(set, a, arc.curve, ta), parameter_of(set, b, arc.curve, tb));
}

} // namespace fetexc
