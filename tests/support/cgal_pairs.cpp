// SPDX-License-Identifier: GPL-3.0-or-later
#undef NDEBUG // CGAL's assertions stay on in an oracle
#include <CGAL/Algebraic_kernel_d_2.h>
#include <CGAL/CORE_arithmetic_kernel.h>

#include "tests/support/cgal_oracles.h"

namespace fetexc::test {
namespace {

using Integer = CORE::BigInt;
using Kernel = CGAL::Algebraic_kernel_d_2<Integer>;
using Polynomial1 = Kernel::Polynomial_1;
using Polynomial2 = Kernel::Polynomial_2;

/// Power basis of one coordinate.
std::array<std::int64_t, 4> power(const Curve& c, Axis axis) {
    const auto v = [&](std::size_t i) { return axis == Axis::X ? c.p[i].x : c.p[i].y; };
    if (c.degree == 1) return {v(0), v(1) - v(0), 0, 0};
    if (c.degree == 2) return {v(0), 2 * (v(1) - v(0)), v(2) - 2 * v(1) + v(0), 0};
    return {v(0), 3 * (v(1) - v(0)), 3 * (v(2) - 2 * v(1) + v(0)), v(3) - 3 * v(2) + 3 * v(1) - v(0)};
}

/// A(s) − B(t) along one axis: a polynomial in t whose coefficients are polynomials in s.
Polynomial2 difference(const Curve& a, const Curve& b, Axis axis) {
    const std::array<std::int64_t, 4> pa = power(a, axis), pb = power(b, axis);
    const auto integer = [](std::int64_t v) { return Integer(static_cast<long>(v)); };
    std::vector<Integer> constant;
    for (const std::int64_t v : pa)
        constant.push_back(integer(v));
    constant[0] -= integer(pb[0]);
    std::vector<Polynomial1> in_t{Polynomial1(constant.begin(), constant.end())};
    for (std::size_t i = 1; i < 4; ++i)
        in_t.emplace_back(integer(-pb[i]));
    return {in_t.begin(), in_t.end()};
}

bool is_constant(const Polynomial2& p) { return CGAL::total_degree(p) <= 0; }

Interval enclosure(const std::pair<Kernel::Bound, Kernel::Bound>& b) {
    return {widen_down(mpq_class(b.first.get_mp()).get_d()), widen_up(mpq_class(b.second.get_mp()).get_d())};
}

} // namespace

std::optional<std::vector<ParameterPoint>> common_points(const Curve& a, const Interval& s_range, const Curve& b,
                                                         const Interval& t_range) {
    const Kernel kernel;
    Polynomial2 f = difference(a, b, Axis::X), g = difference(a, b, Axis::Y);
    if (CGAL::is_zero(f) || CGAL::is_zero(g)) return {};
    if (is_constant(f) || is_constant(g)) return std::vector<ParameterPoint>{};
    if (!kernel.is_coprime_2_object()(f, g)) return {};
    f = kernel.make_square_free_2_object()(f), g = kernel.make_square_free_2_object()(g);
    std::vector<std::pair<Kernel::Algebraic_real_2, unsigned>> roots;
    kernel.solve_2_object()(f, g, std::back_inserter(roots));
    constexpr int bits = 100;
    std::vector<ParameterPoint> out;
    for (const auto& [root, multiplicity] : roots) {
        const ParameterPoint p{enclosure(kernel.approximate_absolute_x_2_object()(root, bits)),
                               enclosure(kernel.approximate_absolute_y_2_object()(root, bits))};
        if (p.s.overlaps(s_range) && p.t.overlaps(t_range)) out.push_back(p);
    }
    return out;
}

} // namespace fetexc::test
