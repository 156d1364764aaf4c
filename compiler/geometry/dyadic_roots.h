// SPDX-License-Identifier: GPL-3.0-or-later
/// Real roots of integer polynomials in integer arithmetic: parameters are dyadic numbers value·2^-bits; roots are
/// isolated by Descartes' rule of signs in Bernstein form and narrowed by Newton steps that exact signs check. Used
/// inside geometry/ only.
#pragma once

#include <optional>
#include <vector>

#include "compiler/geometry/polynomial.h"

namespace fetexc {

/// Truncated below 2^-bits.
mpz_class to_dyadic(double t, int bits);
/// v·2^-bits, rounded towards zero.
double to_double(const mpz_class& v, int bits);

/// p(value·2^-bits)·2^(scale·bits), exact; degree ≤ scale.
mpz_class evaluate_dyadic(const Polynomial& p, const mpz_class& value, int bits, std::size_t scale);

/// One root between lo and hi, in units of 2^-bits, where p changes its sign; the ends may be other roots. Or lo = hi:
/// the root itself.
struct RootBracket {
    mpz_class lo, hi;
    int bits = 0;
    int sign_before = 0; ///< of p between lo and the root
};

RationalRange rational_range(const RootBracket& root);

/// Narrows to one unit of 2^-bits, or to the root.
void narrow(RootBracket& root, const Polynomial& p, int bits);

/// The roots within [lo, hi], ascending. None: an end isn't dyadic, or two roots were still together after so many
/// halvings, as multiple roots always are.
std::optional<std::vector<RootBracket>> bracket_roots(const Polynomial& p, const mpq_class& lo, const mpq_class& hi,
                                                      int halvings);

/// A power of two beyond all real roots.
mpz_class root_bound(const Polynomial& p);

/// Decided modulo a prime: false may be wrong.
bool certainly_square_free(const Polynomial& p);

/// The greatest, without a common divisor of its coefficients; neither is 0.
Polynomial common_factor(const Polynomial& a, const Polynomial& b);

} // namespace fetexc
