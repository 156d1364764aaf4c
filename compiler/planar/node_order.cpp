// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/node_order.h"

#include <algorithm>
#include <numeric>

namespace fetexc {
namespace {

mpq_class to_rational(Fixed v) {
    mpz_class high = static_cast<long>(v >> 64), low = static_cast<unsigned long>(v);
    mpz_mul_2exp(high.get_mpz_t(), high.get_mpz_t(), 64);
    mpq_class out(high + low);
    mpq_div_2exp(out.get_mpq_t(), out.get_mpq_t(), budget::kFixedBits);
    return out;
}

} // namespace

const FixedPoint& NodeOrder::fixed(std::uint32_t node) {
    const auto it = fixed_.find(node);
    return it != fixed_.end() ? it->second : fixed_.emplace(node, map_.fixed(node)).first->second;
}

int NodeOrder::compare(std::uint32_t a, std::uint32_t b, Axis axis) {
    if (a == b) return 0;
    const GridNode &p = map_.node(a), &q = map_.node(b);
    const HalfStep hp = axis == Axis::X ? p.hx : p.hy, hq = axis == Axis::X ? q.hx : q.hy;
    if (hp != hq) return hp < hq ? -1 : 1;
    if (hp >= 0 && hp % 2 == 0) return 0; // on one grid line
    const Interval &u = axis == Axis::X ? p.x_range : p.y_range, &v = axis == Axis::X ? q.x_range : q.y_range;
    if (const int c = fetexc::compare(u, v); c != 0) return c;
    if (u.lo == u.hi && v.lo == v.hi) return 0;
    const FixedPoint s = fixed(a), t = fixed(b);
    if (s.x == t.x && s.y == t.y) return compare_finely(a, b, axis);
    const Fixed d = axis == Axis::X ? s.x - t.x : s.y - t.y;
    return d < 0 ? -1 : d > 0 ? 1 : 0;
}

/// Two crossings that are different points (else they were one node), nearer than 2^-kFixedBits to each other.
int NodeOrder::compare_finely(std::uint32_t a, std::uint32_t b, Axis axis) {
    const auto p = map_.rational(a, budget::kFineParameterBits), q = map_.rational(b, budget::kFineParameterBits);
    if (!p || !q) return 0;
    fine_[a] = *p, fine_[b] = *q;
    return axis == Axis::X ? cmp(p->x, q->x) : cmp(p->y, q->y);
}

mpq_class NodeOrder::coordinate(std::uint32_t node, Axis axis) {
    if (const auto it = fine_.find(node); it != fine_.end()) return axis == Axis::X ? it->second.x : it->second.y;
    const FixedPoint& p = fixed(node);
    return to_rational(axis == Axis::X ? p.x : p.y);
}

bool NodeOrder::before(std::uint32_t a, std::uint32_t b) {
    if (const int c = compare(a, b, Axis::Y); c != 0) return c < 0;
    if (const int c = compare(a, b, Axis::X); c != 0) return c < 0;
    return a < b;
}

void NodeOrder::sort(std::vector<std::uint32_t>& nodes) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    std::sort(nodes.begin(), nodes.end(), [&](std::uint32_t a, std::uint32_t b) { return before(a, b); });
}

void NodeOrder::rank(std::span<const std::uint32_t> nodes, std::vector<NodeRank>& ranks) {
    ranks.assign(nodes.size(), {});
    for (std::size_t k = 1; k < nodes.size(); ++k)
        ranks[k].y = ranks[k - 1].y + (compare(nodes[k - 1], nodes[k], Axis::Y) != 0 ? 1 : 0);
    by_x_.resize(nodes.size());
    std::iota(by_x_.begin(), by_x_.end(), 0u);
    std::sort(by_x_.begin(), by_x_.end(), [&](std::uint32_t a, std::uint32_t b) {
        const int c = compare(nodes[a], nodes[b], Axis::X);
        return c != 0 ? c < 0 : a < b;
    });
    for (std::size_t k = 1; k < nodes.size(); ++k) {
        ranks[by_x_[k]].x =
            ranks[by_x_[k - 1]].x + (compare(nodes[by_x_[k - 1]], nodes[by_x_[k]], Axis::X) != 0 ? 1 : 0);
    }
}

} // namespace fetexc
