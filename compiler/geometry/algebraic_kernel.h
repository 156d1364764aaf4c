// SPDX-License-Identifier: GPL-3.0-or-later
/// CGAL's Algebraic_kernel_d_1, for what brackets of roots leave open: multiple roots, equal numbers. A tenth of a
/// millisecond to milliseconds a call, one at a time. Used inside geometry/ only.
#pragma once

#include "compiler/geometry/polynomial.h"

namespace fetexc::kernel {

/// As the functions of the same names in polynomial.h.
std::vector<std::pair<mpq_class, mpq_class>> isolate_roots(const Polynomial& p, const mpq_class& lo,
                                                           const mpq_class& hi, int bits);
std::optional<int> compare_numbers(const AlgebraicNumber& a, const AlgebraicNumber& b);
std::optional<int> sign_at(const Polynomial& q, const AlgebraicNumber& a);

/// The same roots, each once.
Polynomial square_free_part(const Polynomial& p);

} // namespace fetexc::kernel
