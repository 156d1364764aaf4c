// SPDX-License-Identifier: GPL-3.0-or-later
/// The only translation unit that compiles CGAL's algebraic kernel.
#include <CGAL/Algebraic_kernel_d_1.h>
#include <CGAL/CORE_arithmetic_kernel.h>
#include <CGAL/Polynomial.h>

#include <mutex>

#include "compiler/geometry/polynomial.h"

namespace fetexc {
namespace {

using Integer = CORE::BigInt;
using Kernel = CGAL::Algebraic_kernel_d_1<Integer>;

mpq_class to_mpq(const Kernel::Bound& b) { return mpq_class(b.get_mp()); }

Kernel::Bound to_bound(double v) { return Kernel::Bound(v); }

} // namespace

std::vector<std::pair<mpq_class, mpq_class>> isolate_roots(const Polynomial& p, double lo, double hi, int bits) {
    std::vector<std::pair<mpq_class, mpq_class>> out;
    if (p.size() < 2) return out;
    // CORE's memory pools and the kernel's caches are not thread-safe; calls are rare.
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    std::vector<Integer> coefficients;
    coefficients.reserve(p.size());
    for (const mpz_class& c : p)
        coefficients.emplace_back(Integer(c.get_mpz_t()));
    Kernel kernel;
    const Kernel::Polynomial_1 square_free =
        kernel.make_square_free_1_object()(Kernel::Polynomial_1(coefficients.begin(), coefficients.end()));
    std::vector<Kernel::Algebraic_real_1> roots;
    kernel.solve_1_object()(square_free, true, to_bound(lo), to_bound(hi), std::back_inserter(roots));
    const auto approximate = kernel.approximate_absolute_1_object();
    for (const auto& root : roots) {
        const auto bounds = approximate(root, bits);
        out.emplace_back(to_mpq(bounds.first), to_mpq(bounds.second));
    }
    return out;
}

} // namespace fetexc
