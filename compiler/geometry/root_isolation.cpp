// SPDX-License-Identifier: GPL-3.0-or-later
/// The only translation unit that compiles CGAL's algebraic kernel.
#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/CORE_arithmetic_kernel.h>
#include <CGAL/Polynomial.h>

#include <mutex>

#include "compiler/geometry/algebraic_kernel.h"

namespace fetexc::kernel {
namespace {

using Integer = CORE::BigInt;
using Kernel = CGAL::Algebraic_kernel_d_1<Integer>;

mpq_class to_mpq(const Kernel::Bound& b) { return mpq_class(b.get_mp()); }

Kernel::Bound to_bound(const mpq_class& v) { return Kernel::Bound(v.get_mpq_t()); }

// CORE's memory pools and the kernel's caches are not thread-safe; calls are rare.
std::mutex mutex;

Kernel::Polynomial_1 to_polynomial(const Polynomial& p) {
    std::vector<Integer> coefficients;
    coefficients.reserve(p.size());
    for (const mpz_class& c : p)
        coefficients.emplace_back(Integer(c.get_mpz_t()));
    return {coefficients.begin(), coefficients.end()};
}

using Roots = std::vector<Kernel::Algebraic_real_1>;

Roots solve(const Kernel& kernel, const Polynomial& p, const mpq_class& lo, const mpq_class& hi) {
    const Kernel::Polynomial_1 square_free = kernel.make_square_free_1_object()(to_polynomial(p));
    Roots roots;
    kernel.solve_1_object()(square_free, true, to_bound(lo), to_bound(hi), std::back_inserter(roots));
    return roots;
}

} // namespace

std::vector<std::pair<mpq_class, mpq_class>> isolate_roots(const Polynomial& p, const mpq_class& lo,
                                                           const mpq_class& hi, int bits) {
    const std::lock_guard lock(mutex);
    const Kernel kernel;
    const auto narrow = kernel.approximate_absolute_1_object();
    std::vector<std::pair<mpq_class, mpq_class>> out;
    for (const auto& root : solve(kernel, p, lo, hi)) {
        const auto bounds = narrow(root, bits);
        out.emplace_back(to_mpq(bounds.first), to_mpq(bounds.second));
    }
    return out;
}

Polynomial square_free_part(const Polynomial& p) {
    const std::lock_guard lock(mutex);
    const Kernel kernel;
    const Kernel::Polynomial_1 q = kernel.make_square_free_1_object()(to_polynomial(p));
    Polynomial out;
    for (int i = 0; i <= q.degree(); ++i)
        out.emplace_back(q[i].get_mp());
    return out;
}

std::optional<int> compare_numbers(const AlgebraicNumber& a, const AlgebraicNumber& b) {
    const std::lock_guard lock(mutex);
    const Kernel kernel;
    const auto ra = solve(kernel, a.polynomial, a.lo, a.hi), rb = solve(kernel, b.polynomial, b.lo, b.hi);
    if (ra.size() != 1 || rb.size() != 1) return {};
    return static_cast<int>(kernel.compare_1_object()(ra[0], rb[0]));
}

std::optional<int> sign_at(const Polynomial& q, const AlgebraicNumber& a) {
    const std::lock_guard lock(mutex);
    const Kernel kernel;
    const auto roots = solve(kernel, a.polynomial, a.lo, a.hi);
    if (roots.size() != 1) return {};
    return static_cast<int>(kernel.sign_at_1_object()(to_polynomial(q), roots[0]));
}

} // namespace fetexc::kernel
