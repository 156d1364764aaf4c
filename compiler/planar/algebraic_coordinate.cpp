// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/algebraic_coordinate.h"

#include <CGAL/CORE_arithmetic_kernel.h>
#include <CGAL/Polynomial.h>

#include <array>
#include <mutex>

namespace fetexc {
namespace {

using Integer = CORE::BigInt;
using Univariate = CGAL::Polynomial<Integer>;
using Bivariate = CGAL::Polynomial<Univariate>;

// As in geometry/root_isolation: CORE's memory pools are not thread-safe; calls are rare.
std::mutex mutex;

Integer to_integer(const mpz_class& v) { return Integer(v.get_mpz_t()); }

/// Vanishes at x(s) for every root s of r: the resultant of r(s) and x(s) − x.
Polynomial image(const Polynomial& r, const Polynomial& x) {
    const std::lock_guard lock(mutex);
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

AlgebraicNumber rational_number(const mpq_class& value) { return {{-value.get_num(), value.get_den()}, value, value}; }

/// The number to 2^-bits.
std::optional<RationalRange> narrowed(const AlgebraicNumber& n, int bits) {
    if (n.polynomial.size() < 2) return {};
    if (n.polynomial.size() == 2) {
        mpq_class root(-n.polynomial[0], n.polynomial[1]);
        root.canonicalize();
        return RationalRange{root, root};
    }
    const auto roots = isolate_roots(n.polynomial, n.lo, n.hi, bits);
    if (roots.size() != 1) return {};
    return RationalRange{roots[0].first, roots[0].second};
}

std::optional<AlgebraicNumber> number_of(const AlgebraicCoordinate& c) {
    if (c.level) return rational_number(mpq_class(to_mpz(*c.level)));
    const Polynomial along = power_basis(*c.curve, c.axis);
    if (along.size() < 2) return rational_number(evaluate(along, 0));
    const auto t = narrowed(c.parameter, budget::kCoordinateBits);
    if (!t) return {};
    const RationalRange range = evaluate_over(along, *t);
    if (c.parameter.polynomial.size() == 2) return rational_number(range.lo);
    return AlgebraicNumber{image(c.parameter.polynomial, along), range.lo, range.hi};
}

std::optional<int> against_level(const AlgebraicCoordinate& c, std::int64_t level) {
    return sign_at(minus(power_basis(*c.curve, c.axis), to_mpz(level)), c.parameter);
}

/// p(1 − t).
Polynomial reversed(Polynomial p) {
    for (std::size_t i = 0; i + 1 < p.size(); ++i) {
        for (std::size_t k = p.size() - 1; k-- > i;)
            p[k] += p[k + 1];
    }
    for (std::size_t i = 1; i < p.size(); i += 2)
        p[i] = -p[i];
    return p;
}

/// One coordinate polynomial, run through either way, at one parameter: what nearly all equal coordinates are, and much
/// cheaper to tell than that of two images.
bool mirrored(const AlgebraicCoordinate& a, const AlgebraicCoordinate& b) {
    const Polynomial p = power_basis(*a.curve, a.axis), q = power_basis(*b.curve, b.axis);
    const AlgebraicNumber& t = b.parameter;
    if (p == q && compare_numbers(a.parameter, t) == 0) return true;
    return p == reversed(q) && compare_numbers(a.parameter, {reversed(t.polynomial), 1 - t.hi, 1 - t.lo}) == 0;
}

} // namespace

std::optional<int> compare(const AlgebraicCoordinate& a, const AlgebraicCoordinate& b) {
    if (a.level && b.level) return *a.level < *b.level ? -1 : *a.level > *b.level ? 1 : 0;
    if (b.level) return against_level(a, *b.level);
    if (a.level) {
        const std::optional<int> c = against_level(b, *a.level);
        return c ? std::optional(-*c) : std::nullopt;
    }
    if (mirrored(a, b)) return 0;
    const std::optional<AlgebraicNumber> p = number_of(a), q = number_of(b);
    return p && q ? compare_numbers(*p, *q) : std::nullopt;
}

std::optional<RationalRange> narrowed(const AlgebraicCoordinate& c, int bits) {
    if (c.level) return RationalRange{mpq_class(to_mpz(*c.level)), mpq_class(to_mpz(*c.level))};
    const auto t = narrowed(c.parameter, bits);
    if (!t) return {};
    return evaluate_over(power_basis(*c.curve, c.axis), *t);
}

} // namespace fetexc
