// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/trapezoid_point.h"

#include <cmath>

namespace fetexc::test {
namespace {

mpz_class scaled(double v) {
    mpz_class out;
    mpz_set_d(out.get_mpz_t(), std::ldexp(v, kPointBits)); // a dyadic number: exact below 2^1024
    return out;
}

mpz_class from_fixed(Fixed v) {
    const mpz_class high = static_cast<long>(v >> 64), low = static_cast<unsigned long>(v);
    return ((high << 64) + low) << (kPointBits - budget::kFixedBits);
}

struct Levels {
    mpz_class lo, hi;
};

/// Enclosure of a node's y; the texel's side without a node.
Levels levels_of(const PlanarMap& map, const TexelMap& texel, std::uint32_t node, bool top, bool finely) {
    if (node == kNone) {
        const std::int64_t y = map.grid().py * (static_cast<std::int64_t>(texel.j) + (top ? 0 : 1));
        const mpz_class v = mpz_class(static_cast<long>(y)) << kPointBits;
        return {v, v};
    }
    const std::uint32_t n = texel.graph.nodes[node];
    const Interval& y = map.node(n).y_range;
    if (!finely || y.lo == y.hi) return {scaled(y.lo), scaled(y.hi)};
    const std::optional<FixedPoint> fixed = map.fixed(n);
    if (!fixed) return {scaled(y.lo), scaled(y.hi)};
    const mpz_class v = from_fixed(fixed->y), slack = mpz_class(8) << (kPointBits - budget::kFixedBits);
    return {v - slack, v + slack};
}

/// A random odd number strictly between.
std::optional<mpz_class> between(const mpz_class& lo, const mpz_class& hi, Random& random) {
    const mpz_class gap = hi - lo;
    if (gap < (mpz_class(1) << 40)) return {};
    mpz_class v = lo + gap * static_cast<unsigned long>(random.integer(1, (1 << 20) - 1)) / (1ul << 20);
    if (mpz_even_p(v.get_mpz_t())) v += 1;
    return v;
}

/// Where a side passes y; the texel's side without an edge.
std::optional<ExactRange> side_at(const PlanarMap& map, const TexelMap& texel, std::uint32_t edge, bool right,
                                  const mpz_class& y) {
    if (edge == kNone) {
        const std::int64_t x = map.grid().px * (static_cast<std::int64_t>(texel.i) + (right ? 1 : 0));
        const mpz_class v = mpz_class(static_cast<long>(x)) << kPointBits;
        return ExactRange{v, v};
    }
    const Stretch s = map.stretch_of(texel.sub_edges[texel.graph.edges[edge].sub]);
    PlanarCurve curve;
    curve.degree = s.curve->degree;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(curve.degree); ++i)
        curve.x[i] = s.curve->p[i].x, curve.y[i] = s.curve->p[i].y;
    return position_at(curve, s.range.lo, s.range.hi, y);
}

} // namespace

TrapezoidPoint point_in(const PlanarMap& map, const TexelMap& texel, const Trapezoid& t, Random& random) {
    std::optional<mpz_class> y;
    for (const bool finely : {false, true}) {
        if (y) break;
        const Levels top = levels_of(map, texel, t.top_node, true, finely),
                     bottom = levels_of(map, texel, t.bottom_node, false, finely);
        y = between(top.hi, bottom.lo, random);
    }
    if (!y) return {};
    const std::optional<ExactRange> left = side_at(map, texel, t.left, false, *y),
                                    right = side_at(map, texel, t.right, true, *y);
    if (!left || !right) return {};
    if (left->lo > right->hi) return {{}, true};
    const std::optional<mpz_class> x = between(left->hi, right->lo, random);
    if (!x) return {};
    return {ExactPoint{*x, *y}, false};
}

} // namespace fetexc::test
