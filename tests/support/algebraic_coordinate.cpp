// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/algebraic_coordinate.h"

#include <CGAL/CORE_arithmetic_kernel.h>
#include <CGAL/Polynomial.h>

namespace fetexc::test {
namespace {

using Integer = CORE::BigInt;
using Univariate = CGAL::Polynomial<Integer>;
using Bivariate = CGAL::Polynomial<Univariate>;

Integer to_integer(const mpz_class& v) { return Integer(v.get_mpz_t()); }

/// Vanishes at x(s) for every root s of r: the resultant of r(s) and x(s) − x.
Polynomial image(const Polynomial& r, const Polynomial& x) {
    std::vector<Univariate> a, b;
    for (const mpz_class& c : r)
        a.emplace_back(to_integer(c));
    for (const mpz_class& c : x)
        b.emplace_back(to_integer(c));
    const std::array<Integer, 2> first{to_integer(x[0]), Integer(-1)};
    b[0] = Univariate(first.begin(), first.end());
    const Univariate s = CGAL::resultant(Bivariate(a.begin(), a.end()), Bivariate(b.begin(), b.end()));
    Polynomial out;
    for (int k = 0; k <= s.degree(); ++k)
        out.emplace_back(s[k].get_mp());
    return trimmed(out);
}

/// The only root, in [0,1] or just beside it.
std::optional<RationalRange> enclosed(const AlgebraicNumber& n, int bits) {
    const auto roots = isolate_roots(n.polynomial, n.lo, n.hi, bits);
    if (roots.size() != 1) return {};
    return RationalRange{roots[0].first, roots[0].second};
}

RationalRange values_over(const Polynomial& p, const RationalRange& t) {
    mpq_class slope = 0;
    for (std::size_t k = 1; k < p.size(); ++k)
        slope += 2 * static_cast<unsigned long>(k) * abs(p[k]); // |t| ≤ 5/4
    const mpq_class reach = slope * (t.hi - t.lo), middle = evaluate(p, (t.lo + t.hi) / 2);
    return {middle - reach, middle + reach};
}

Polynomial linear(const mpq_class& root) { return {-root.get_num(), root.get_den()}; }

} // namespace

std::optional<RationalBox> box_of(const ArcSet& set, const Vertex& v, int bits) {
    if (v.integral) {
        const mpq_class x(to_mpz(v.point.x)), y(to_mpz(v.point.y));
        return RationalBox{{x, x}, {y, y}};
    }
    const Curve& c = set.curves[v.a];
    const auto t = enclosed(parameter_of(set, v, v.a, v.s), bits);
    if (!t) return {};
    return RationalBox{values_over(power_basis(c, Axis::X), *t), values_over(power_basis(c, Axis::Y), *t)};
}

std::optional<AlgebraicNumber> coordinate_of(const ArcSet& set, const Vertex& v, Axis axis) {
    if (v.integral) {
        const mpq_class value(to_mpz(axis == Axis::X ? v.point.x : v.point.y));
        return AlgebraicNumber{linear(value), value, value};
    }
    // On the curve along which the coordinate is simpler.
    Polynomial along = power_basis(set.curves[v.a], axis);
    bool on_b = false;
    if (v.b != kNone) {
        const Polynomial along_b = power_basis(set.curves[v.b], axis);
        on_b = along_b.size() < along.size();
        if (on_b) along = along_b;
    }
    const auto rational = [](const mpq_class& value) { return AlgebraicNumber{linear(value), value, value}; };
    if (along.size() < 2) return rational(evaluate(along, 0));
    const AlgebraicNumber s = parameter_of(set, v, on_b ? v.b : v.a, on_b ? v.t : v.s);
    if (s.polynomial.size() < 2) return {};
    if (s.polynomial.size() == 2) {
        mpq_class root(-s.polynomial[0], s.polynomial[1]);
        root.canonicalize();
        return rational(evaluate(along, root));
    }
    const auto t = enclosed(s, 256);
    if (!t) return {};
    const RationalRange range = values_over(along, *t);
    return AlgebraicNumber{image(s.polynomial, along), range.lo, range.hi};
}

} // namespace fetexc::test
