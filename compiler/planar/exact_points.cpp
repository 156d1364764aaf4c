// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/exact_points.h"

namespace fetexc {
namespace {

const Interval& along(const Vertex& v, Axis axis) { return axis == Axis::X ? v.x : v.y; }
Fixed along(const FixedPoint& p, Axis axis) { return axis == Axis::X ? p.x : p.y; }

int sign_of(Fixed v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }

Polynomial derivative(const Polynomial& p) {
    Polynomial out;
    for (std::size_t i = 1; i < p.size(); ++i)
        out.push_back(p[i] * static_cast<unsigned long>(i));
    return out;
}

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

/// The resultant has a root for every branch that passes: where another is within the enclosure, a narrower one.
AlgebraicNumber crossing_parameter(const ArcSet& set, const Vertex& v, std::uint32_t curve, const Interval& t) {
    AlgebraicNumber out{eliminate(set.curves[curve], set.curves[v.a == curve ? v.b : v.a]), mpq_class(t.lo),
                        mpq_class(t.hi)};
    if (out.polynomial.size() == 2) return out;
    if (const auto narrow = narrowed(set, v)) {
        const RationalRange& r = v.a == curve ? narrow->s : narrow->t;
        out.lo = r.lo, out.hi = r.hi;
    }
    return out;
}

} // namespace

Fixed fixed_from(double v) {
    // Planar coordinates are below 2^44: in two exact steps, because the whole doesn't fit a double's integer range.
    const double whole = std::floor(v);
    return (static_cast<Fixed>(static_cast<std::int64_t>(whole)) << budget::kFixedBits) +
           static_cast<Fixed>(std::ldexp(v - whole, budget::kFixedBits));
}

FixedPoint fixed_point(const ArcSet& set, const Vertex& v) {
    if (v.integral) return fixed(v.point);
    std::optional<FixedPoint> p;
    if (const auto narrow = narrowed(set, v))
        p = fixed_contact(set.curves[v.a], *narrow);
    else if (v.a != kNone && v.b == kNone)
        p = fixed_extremum(set.curves[v.a], v.s);
    return p ? *p : FixedPoint{fixed_from(v.x.mid()), fixed_from(v.y.mid())};
}

int compare_coordinates(const ArcSet& set, const Vertex& a, const Vertex& b, Axis axis) {
    if (const int c = compare(along(a, axis), along(b, axis)); c != 0) return c;
    if (a.integral && b.integral) return 0;
    return sign_of(along(fixed_point(set, a), axis) - along(fixed_point(set, b), axis));
}

std::optional<int> side_of_level(const ArcSet& set, const Vertex& a, Axis axis, std::int64_t v) {
    const auto level = static_cast<double>(v);
    if (const int c = compare(along(a, axis), Interval(level)); c != 0) return c;
    if (along(a, axis).lo == along(a, axis).hi) return 0;
    // Rounding errs by half a unit; beyond a few the sign is certain.
    const Fixed difference = along(fixed_point(set, a), axis) - (static_cast<Fixed>(v) << budget::kFixedBits);
    if (difference > 4 || difference < -4) return sign_of(difference);
    const AlgebraicNumber t = parameter_of(set, a, a.a, a.s);
    return sign_at(minus(power_basis(set.curves[a.a], axis), to_mpz(v)), t);
}

std::optional<int> side_of_level(const Curve& c, Axis axis, std::int64_t level, const Interval& t, std::int64_t v) {
    const Axis other = axis == Axis::X ? Axis::Y : Axis::X;
    if (c.along(other).magnitude == 0) return sign_of(c.along(other).origin - v);
    if (const std::optional<FixedPoint> p = fixed_level(c, axis, level, t)) {
        const Fixed difference = along(*p, other) - (static_cast<Fixed>(v) << budget::kFixedBits);
        if (difference > 4 || difference < -4) return sign_of(difference);
    }
    return sign_at(minus(power_basis(c, other), to_mpz(v)),
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
    return compare_numbers(parameter_of(set, a, arc.curve, ta), parameter_of(set, b, arc.curve, tb));
}

} // namespace fetexc
