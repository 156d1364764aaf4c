// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/geometry/curve.h"
#include "compiler/geometry/orientation.h"

#include <cstdlib>

namespace fetexc {
namespace {

Coordinate coordinate(const Curve& c, Axis axis) {
    Coordinate out;
    const auto get = [&](std::size_t i) { return axis == Axis::X ? c.p[i].x : c.p[i].y; };
    out.origin = get(0);
    for (std::size_t i = 0; i <= static_cast<std::size_t>(c.degree); ++i) {
        out.local[i] = static_cast<double>(get(i) - out.origin);
        out.magnitude = std::max(out.magnitude, std::fabs(out.local[i]));
    }
    return out;
}

/// A cubic whose leading coefficient vanishes, and whose quadratic control point is an integer point.
bool reduce_cubic(Curve& c) {
    const auto lead = [](std::int64_t a, std::int64_t b, std::int64_t d, std::int64_t e) {
        return e - 3 * d + 3 * b - a;
    };
    if (lead(c.p[0].x, c.p[1].x, c.p[2].x, c.p[3].x) != 0 || lead(c.p[0].y, c.p[1].y, c.p[2].y, c.p[3].y) != 0)
        return false;
    const std::int64_t qx = 3 * c.p[1].x - c.p[0].x, qy = 3 * c.p[1].y - c.p[0].y;
    if (qx % 2 != 0 || qy % 2 != 0) return false;
    c.p = {c.p[0], IntPoint{qx / 2, qy / 2}, c.p[3], IntPoint{}};
    c.degree = 2;
    return true;
}

double lerp(double a, double b, double t) { return a + t * (b - a); }

double casteljau(const std::array<double, 4>& v, int degree, double t) {
    switch (degree) {
    case 0:
        return v[0];
    case 1:
        return lerp(v[0], v[1], t);
    case 2:
        return lerp(lerp(v[0], v[1], t), lerp(v[1], v[2], t), t);
    default:
        const double q0 = lerp(v[0], v[1], t), q1 = lerp(v[1], v[2], t), q2 = lerp(v[2], v[3], t);
        return lerp(lerp(q0, q1, t), lerp(q1, q2, t), t);
    }
}

std::array<double, 4> hodograph(const Coordinate& c, int degree) {
    const double n = degree;
    return {n * (c.local[1] - c.local[0]), n * (c.local[2] - c.local[1]), n * (c.local[3] - c.local[2]), 0};
}

/// As lerp; u = 1 is exact, so that a zero handle at the end stays exactly zero.
double end_exact(double a, double b, double u) { return u == 1 ? b : lerp(a, b, u); }

/// Polar form at (t0 … t0, t1 … t1), for each number of t1.
std::array<double, 4> blossom_stretch(const std::array<double, 4>& v, int degree, double t0, double t1) {
    if (t0 == 0 && t1 == 1) return v;
    const auto f = end_exact;
    switch (degree) {
    case 0:
        return v;
    case 1:
        return {f(v[0], v[1], t0), f(v[0], v[1], t1), 0, 0};
    case 2: {
        const double a0 = f(v[0], v[1], t0), a1 = f(v[1], v[2], t0);
        return {f(a0, a1, t0), f(a0, a1, t1), f(f(v[0], v[1], t1), f(v[1], v[2], t1), t1), 0};
    }
    default: {
        const double a0 = f(v[0], v[1], t0), a1 = f(v[1], v[2], t0), a2 = f(v[2], v[3], t0);
        const double b0 = f(v[0], v[1], t1), b1 = f(v[1], v[2], t1), b2 = f(v[2], v[3], t1);
        const double a00 = f(a0, a1, t0), a01 = f(a1, a2, t0);
        return {f(a00, a01, t0), f(a00, a01, t1), f(f(a0, a1, t1), f(a1, a2, t1), t1),
                f(f(b0, b1, t1), f(b1, b2, t1), t1)};
    }
    }
}

/// Bracketed Newton from the secant: double approximation of the root in [lo,hi] of the increasing (after `sign`)
/// coordinate.
double newton_root(const Coordinate& c, int degree, double lo, double hi, double sign, double target) {
    const std::array<double, 4> slope = hodograph(c, degree);
    const auto value = [&](double t) { return (casteljau(c.local, degree, t) - target) * sign; };
    const double at_lo = value(lo), at_hi = value(hi);
    if (!(at_lo < 0)) return lo;
    if (!(at_hi > 0)) return hi;
    const double settled = budget::kNewtonStop * (hi - lo);
    double t = lo + (hi - lo) * (at_lo / (at_lo - at_hi));
    for (int k = 0; k < 64; ++k) {
        const double f = value(t);
        if (f == 0) return t;
        (f > 0 ? hi : lo) = t;
        const double df = casteljau(slope, degree - 1, t) * sign;
        double next = df > 0 ? t - f / df : lo - 1;
        if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
        if (std::fabs(next - t) <= std::max(settled, budget::kUnitRoundoff * std::fabs(t))) return next;
        t = next;
    }
    return t;
}

} // namespace

Curve make_curve(int degree, const std::array<IntPoint, 4>& p) {
    Curve c;
    c.degree = degree;
    c.p = p;
    if (c.degree == 3) reduce_cubic(c);
    if (c.degree >= 2 && is_collinear(c)) {
        c.p = {c.first(), c.last(), IntPoint{}, IntPoint{}};
        c.degree = 1;
    }
    c.x = coordinate(c, Axis::X);
    c.y = coordinate(c, Axis::Y);
    return c;
}

bool is_collinear(const Curve& c) {
    IntPoint far = c.p[0];
    for (int i = 1; i <= c.degree; ++i) {
        if (c.p[static_cast<std::size_t>(i)] != c.p[0]) far = c.p[static_cast<std::size_t>(i)];
    }
    for (int i = 1; i <= c.degree; ++i) {
        if (cross(c.p[0], far, c.p[static_cast<std::size_t>(i)]) != 0) return false;
    }
    return true;
}

Interval value_at(const Curve& c, Axis axis, double t) {
    const Coordinate& k = c.along(axis);
    if (k.magnitude == 0) return static_cast<double>(k.origin); // level or upright: exact
    const double v = casteljau(k.local, c.degree, t), error = budget::kEvaluationError * k.magnitude;
    const double sum = static_cast<double>(k.origin) + v;
    return {widen_down(sum) - error, widen_up(sum) + error};
}

Interval derivative_over(const Curve& c, Axis axis, const Interval& t) {
    const Coordinate& k = c.along(axis);
    const std::array<double, 4> d = blossom_stretch(hodograph(k, c.degree), c.degree - 1, t.lo, t.hi);
    Interval out(d[0], d[0]);
    for (int i = 1; i < c.degree; ++i)
        out = hull(out, Interval(d[i]));
    const double error = 2 * budget::kEvaluationError * 2 * c.degree * k.magnitude;
    return {out.lo - error, out.hi + error};
}

Interval value_over(const Curve& c, Axis axis, const Interval& t) {
    if (t.lo == t.hi || c.along(axis).magnitude == 0) return value_at(c, axis, t.lo);
    const double m = t.mid();
    return value_at(c, axis, m) + derivative_over(c, axis, t) * Interval(widen_down(t.lo - m), widen_up(t.hi - m));
}

double value_double(const Curve& c, Axis axis, double t) {
    const Coordinate& k = c.along(axis);
    return static_cast<double>(k.origin) + casteljau(k.local, c.degree, t);
}

double local_double(const Curve& c, Axis axis, double t) { return casteljau(c.along(axis).local, c.degree, t); }

double derivative_double(const Curve& c, Axis axis, double t) {
    return casteljau(hodograph(c.along(axis), c.degree), c.degree - 1, t);
}

Interval parameter_at(const Curve& c, Axis axis, const Interval& range, bool increasing, double v) {
    const Coordinate& k = c.along(axis);
    const double sign = increasing ? 1 : -1, target = v - static_cast<double>(k.origin);
    const double t = newton_root(k, c.degree, range.lo, range.hi, sign, target);
    const double slope = std::fabs(derivative_double(c, axis, t)),
                 noise = 2 * budget::kEvaluationError * (k.magnitude + std::fabs(target));
    // Where the slope vanishes the noise of a simple root says nothing: start small, the loop below finds how far to
    // go.
    const double widest = range.width() * budget::kFirstWidening;
    double delta = std::max(2 * budget::kUnitRoundoff * std::fabs(t), slope * widest > noise ? noise / slope : widest);
    delta = std::max(delta, budget::kUnderflowGuard);
    const auto bound = [&](double side) {
        for (double d = delta;; d *= 4) {
            const double u = t + side * d;
            if (!(u > range.lo && u < range.hi)) return side < 0 ? range.lo : range.hi;
            if ((value_at(c, axis, u) - Interval(v)).sign() * sign * side > 0) return u;
        }
    };
    return {bound(-1), bound(1)};
}

std::array<double, 4> stretch(const Curve& c, Axis axis, double t0, double t1) {
    return blossom_stretch(c.along(axis).local, c.degree, t0, t1);
}

} // namespace fetexc
