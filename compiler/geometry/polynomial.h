// SPDX-License-Identifier: GPL-3.0-or-later
/// Dense integer polynomials (GMP), just enough for resultants; used inside geometry/ only.
#pragma once

#include <gmpxx.h>

#include <array>
#include <optional>
#include <vector>

#include "compiler/geometry/exact.h"

namespace fetexc {

using Polynomial = std::vector<mpz_class>; ///< coefficient of t^i at index i; empty = 0

Polynomial trimmed(Polynomial p);
Polynomial operator+(const Polynomial& a, const Polynomial& b);
Polynomial operator-(const Polynomial& a, const Polynomial& b);
Polynomial operator*(const Polynomial& a, const Polynomial& b);

Polynomial derivative(const Polynomial& p);

/// p − v.
Polynomial minus(Polynomial p, const mpz_class& v);

mpz_class to_mpz(std::int64_t v);

/// Coefficients of t^i of one coordinate (absolute), below 2^48.
std::array<std::int64_t, 4> power_coefficients(const Curve& c, Axis axis);
/// The same as a polynomial, trimmed.
Polynomial power_basis(const Curve& c, Axis axis);

/// R(s): vanishes exactly where A(s) lies on the algebraic curve of B (Bezout resultant). Empty when A lies on it
/// entirely.
Polynomial eliminate(const Curve& a, const Curve& b);

mpq_class evaluate(const Polynomial& p, const mpq_class& t);
/// Enclosure of the values over a range: in the middle, plus a bound of the derivative times half the width.
RationalRange evaluate_over(const Polynomial& p, const RationalRange& t);
/// Rounded outwards.
Interval to_interval(const RationalRange& v);

/// Isolating rational ranges, no wider than 2^-bits, of the distinct real roots of p within [lo, hi], ascending.
std::vector<std::pair<mpq_class, mpq_class>> isolate_roots(const Polynomial& p, const mpq_class& lo,
                                                           const mpq_class& hi, int bits);
/// The same for all real roots.
std::vector<std::pair<mpq_class, mpq_class>> isolate_roots(const Polynomial& p, int bits);

/// A number known exactly: the only root of the polynomial within [lo, hi].
struct AlgebraicNumber {
    Polynomial polynomial;
    mpq_class lo, hi;
};

/// −1, 0, +1 for a < b, a = b, a > b, exact. None: an interval doesn't hold exactly one root.
std::optional<int> compare_numbers(const AlgebraicNumber& a, const AlgebraicNumber& b);

/// Sign of q at the number, exact. None as above.
std::optional<int> sign_at(const Polynomial& q, const AlgebraicNumber& a);

} // namespace fetexc
