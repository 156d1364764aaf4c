// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/geometry/monotone.h"
#include "compiler/geometry/orientation.h"

#include <gmpxx.h>

#include <cmath>

namespace fetexc {
namespace {

/// q(t) = a·t² + 2b·t + c: the derivative up to a positive factor, exact.
struct Derivative {
    std::int64_t a = 0, b = 0, c = 0;
};

Derivative derivative(const Curve& curve, Axis axis) {
    const auto p = [&](std::size_t i) { return axis == Axis::X ? curve.p[i].x : curve.p[i].y; };
    if (curve.degree < 2) return {};
    const std::int64_t d0 = p(1) - p(0), d1 = p(2) - p(1);
    // Degree 2: q = d0 + t(d1 − d0); doubled so that 2b is exact.
    if (curve.degree == 2) return {0, d1 - d0, 2 * d0};
    const std::int64_t d2 = p(3) - p(2);
    return {d0 - 2 * d1 + d2, d1 - d0, d0};
}

int exact_sign(const Derivative& q, double t) { return quadratic_sign(q.a, q.b, q.c, t); }

// Differences of control points are integers below 2^45, so q has integer coefficients a, 2b, c with |a| < 2^47, |b| <
// 2^46, |c| < 2^45 and, where it has two roots, a discriminant b² − a·c ≥ 1: they are 2·√1/|a| > 2^-46 apart, and a
// root in (0,1) stays |c|/(|c| + max(|a|, |2b|)) > 2^-48 away from 0, by symmetry also from 1. Enclosures are a few
// roundings wide, so two of one axis never meet, nor one and an end.

/// Smallest enclosure around an approximate root whose ends show the sign change; none when the change can't be seen in
/// doubles.
bool enclose(const Derivative& q, double root, std::vector<Interval>& out) {
    for (double delta = budget::kUnitRoundoff; delta < 1; delta *= 4) {
        const double lo = std::max(0.0, root - delta), hi = std::min(1.0, root + delta);
        const int s0 = exact_sign(q, lo), s1 = exact_sign(q, hi);
        if (s0 != 0 && s1 != 0 && s0 != s1) {
            out.emplace_back(lo, hi);
            return true;
        }
    }
    return false;
}

/// Approximate roots in (0,1); their number is exact.
std::vector<double> approximate_roots(const Derivative& q) {
    const long double a = q.a, b = q.b, c = q.c;
    const int s0 = sign_of(q.c), s1 = sign_of(static_cast<Int128>(q.a) + 2 * static_cast<Int128>(q.b) + q.c);
    if (q.a == 0) return s0 * s1 < 0 ? std::vector{static_cast<double>(-c / (2 * b))} : std::vector<double>{};
    if (s0 == 0) {
        const Int128 at1 = static_cast<Int128>(q.a) + 2 * static_cast<Int128>(q.b);
        return sign_of(q.b) * sign_of(at1) < 0 ? std::vector{static_cast<double>(-2 * b / a)} : std::vector<double>{};
    }
    if (s1 == 0) {
        return sign_of(q.c) * sign_of(static_cast<Int128>(q.a) - q.c) > 0 ? std::vector{static_cast<double>(c / a)}
                                                                          : std::vector<double>{};
    }
    const Int128 discriminant = static_cast<Int128>(q.b) * q.b - static_cast<Int128>(q.a) * q.c;
    if (discriminant <= 0) return {};
    const long double root = std::sqrt(static_cast<long double>(discriminant));
    const long double w = -(b + (b > 0 ? root : -root)); // citardauq: no cancellation
    const double r1 = static_cast<double>(w / a), r2 = static_cast<double>(c / w);
    if (s0 * s1 < 0) return {r1 > 0 && r1 < 1 ? r1 : r2};
    const bool vertex_inside = sign_of(q.b) * sign_of(static_cast<Int128>(q.a) + q.b) < 0;
    if (sign_of(q.a) != s0 || !vertex_inside) return {};
    return {std::min(r1, r2), std::max(r1, r2)};
}

/// Resultant of both: 0. (With a root in common: where the curve has its cusp.)
bool have_common_root(const Derivative& p, const Derivative& q) {
    const auto minor = [](std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) { // a·d − b·c
        return mpz_class(mpz_class(static_cast<long>(a)) * static_cast<long>(d) -
                         mpz_class(static_cast<long>(b)) * static_cast<long>(c));
    };
    if (p.a == 0 && q.a == 0) return minor(p.b, p.c, q.b, q.c) == 0; // linear: the resultant below is 0 at infinity
    const mpz_class ac = minor(p.a, p.c, q.a, q.c);
    return ac * ac == 4 * minor(p.a, p.b, q.a, q.b) * minor(p.b, p.c, q.b, q.c);
}

void add_extrema(const Curve& c, Axis axis, std::vector<Interval>& out) {
    const Derivative q = derivative(c, axis);
    std::vector<Interval> found;
    for (double root : approximate_roots(q))
        enclose(q, root, found);
    out.insert(out.end(), found.begin(), found.end());
}

} // namespace

int quadratic_sign(std::int64_t a, std::int64_t b, std::int64_t c, double t) {
    // t = m·2^-k: the sign of (a·m + 2b·2^k)·m + c·2^2k. The first factor stays below 2^112; the product is taken in
    // two parts, high·2^64 + low.
    int exponent = 0;
    const double fraction = std::frexp(t, &exponent);
    const int k = 53 - exponent;
    if (!(t > 0) || k < 32 || k > 63) {
        const mpq_class u(t);
        return sgn(mpq_class((u * static_cast<long>(a) + 2 * static_cast<long>(b)) * u + static_cast<long>(c)));
    }
    using Unsigned = unsigned __int128;
    const auto m = static_cast<std::uint64_t>(std::ldexp(fraction, 53));
    const Int128 factor =
        static_cast<Int128>(a) * static_cast<Int128>(m) + static_cast<Int128>(2 * b) * (Int128{1} << k);
    const Unsigned size = factor < 0 ? -static_cast<Unsigned>(factor) : static_cast<Unsigned>(factor);
    const Unsigned lower = static_cast<Unsigned>(static_cast<std::uint64_t>(size)) * m;
    const auto high = static_cast<Int128>((size >> 64) * m + (lower >> 64));
    const bool low = static_cast<std::uint64_t>(lower) != 0;
    const Int128 rest = static_cast<Int128>(c) * (Int128{1} << (2 * k - 64));
    const Int128 sum = factor < 0 ? rest - high : rest + high;
    if (factor < 0) return sum != 0 ? sign_of(sum) : (low ? -1 : 0);
    return sum < 0 ? -1 : (sum > 0 || low ? 1 : 0);
}

std::vector<Interval> extrema(const Curve& c, std::uint64_t* near_cusps) {
    std::vector<Interval> all;
    if (c.degree < 2) return all;
    add_extrema(c, Axis::X, all);
    add_extrema(c, Axis::Y, all);
    std::sort(all.begin(), all.end(), [](const Interval& a, const Interval& b) { return a.mid() < b.mid(); });
    std::vector<Interval> out;
    for (const Interval& t : all) {
        if (!out.empty() && out.back().overlaps(t)) {
            out.back() = hull(out.back(), t);
            if (near_cusps != nullptr && !have_common_root(derivative(c, Axis::X), derivative(c, Axis::Y)))
                ++*near_cusps;
        } else {
            out.push_back(t);
        }
    }
    return out;
}

} // namespace fetexc
