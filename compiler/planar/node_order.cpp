// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/node_order.h"

#include <algorithm>
#include <numeric>

#include "compiler/planar/exact_points.h"

namespace fetexc {
namespace {

mpq_class to_rational(Fixed v) {
    mpq_class out(to_integer(v));
    mpq_div_2exp(out.get_mpq_t(), out.get_mpq_t(), budget::kFixedBits);
    return out;
}

} // namespace

const std::optional<FixedPoint>& NodeOrder::fixed(std::uint32_t node) {
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
    const std::optional<FixedPoint> s = fixed(a), t = fixed(b);
    const int c = s && t ? certain_sign(axis == Axis::X ? s->x - t->x : s->y - t->y) : 0;
    return c != 0 ? c : compare_exactly(a, b, axis);
}

int NodeOrder::compare_exactly(std::uint32_t a, std::uint32_t b, Axis axis) {
    if (a > b) return -compare_exactly(b, a, axis);
    const auto [it, fresh] = compared_.try_emplace({a, b, axis}, 0);
    if (!fresh) return it->second;
    ++stats_.exact_comparisons;
    const AlgebraicCoordinate p = map_.algebraic(a, axis), q = map_.algebraic(b, axis);
    const std::optional<int> c = fetexc::compare(p, q);
    if (!c) undecided_ = true;
    if (c && *c != 0) separate(a, b, p, q);
    return it->second = c.value_or(0);
}

/// Finer coordinates for two different ones, so that the middle between them lies between the true ones.
void NodeOrder::separate(std::uint32_t a, std::uint32_t b, const AlgebraicCoordinate& p, const AlgebraicCoordinate& q) {
    for (int bits = budget::kCoordinateBits; bits <= budget::kRefineBitsLimit; bits *= 2) {
        const std::optional<RationalRange> u = narrowed(p, bits), v = narrowed(q, bits);
        if (!u || !v) break;
        const mpq_class gap = u->lo > v->hi ? mpq_class(u->lo - v->hi) : mpq_class(v->lo - u->hi);
        if (gap <= (u->hi - u->lo) + (v->hi - v->lo)) continue;
        for (const auto& [node, range] : {std::pair(a, u), std::pair(b, v)}) {
            Fine& fine = fine_[{node, p.axis}];
            if (fine.bits < bits) fine = {bits, (range->lo + range->hi) / 2};
        }
        return;
    }
    undecided_ = true;
}

mpq_class NodeOrder::coordinate(std::uint32_t node, Axis axis) {
    if (const auto it = fine_.find({node, axis}); it != fine_.end()) return it->second.value;
    if (const std::optional<FixedPoint>& p = fixed(node)) return to_rational(axis == Axis::X ? p->x : p->y);
    const GridNode& n = map_.node(node);
    return mpq_class(axis == Axis::X ? n.x : n.y);
}

/// The enclosures of nodes without finer coordinates may be as wide as their distance: the middle of what lies between.
mpq_class NodeOrder::level_between(std::uint32_t a, std::uint32_t b, Axis axis) {
    const auto range = [&](std::uint32_t n) { return axis == Axis::X ? map_.node(n).x_range : map_.node(n).y_range; };
    const Interval u = range(a), v = range(b);
    if (u.hi < v.lo) return (mpq_class(u.hi) + mpq_class(v.lo)) / 2;
    return (coordinate(a, axis) + coordinate(b, axis)) / 2;
}

bool NodeOrder::before(std::uint32_t a, std::uint32_t b) {
    if (const int c = compare(a, b, Axis::Y); c != 0) return c < 0;
    if (const int c = compare(a, b, Axis::X); c != 0) return c < 0;
    return a < b;
}

void NodeOrder::sort(std::vector<std::uint32_t>& nodes) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    // Stable: memory-safe also where an undecided comparison makes this no order (E4001 follows).
    std::stable_sort(nodes.begin(), nodes.end(), [&](std::uint32_t a, std::uint32_t b) { return before(a, b); });
}

void NodeOrder::rank(std::span<const std::uint32_t> nodes, std::vector<NodeRank>& ranks) {
    ranks.assign(nodes.size(), {});
    for (std::size_t k = 1; k < nodes.size(); ++k)
        ranks[k].y = ranks[k - 1].y + (compare(nodes[k - 1], nodes[k], Axis::Y) != 0 ? 1 : 0);
    by_x_.resize(nodes.size());
    std::iota(by_x_.begin(), by_x_.end(), 0u);
    std::stable_sort(by_x_.begin(), by_x_.end(), [&](std::uint32_t a, std::uint32_t b) {
        const int c = compare(nodes[a], nodes[b], Axis::X);
        return c != 0 ? c < 0 : a < b;
    });
    for (std::size_t k = 1; k < nodes.size(); ++k) {
        ranks[by_x_[k]].x =
            ranks[by_x_[k - 1]].x + (compare(nodes[by_x_[k - 1]], nodes[by_x_[k]], Axis::X) != 0 ? 1 : 0);
    }
}

} // namespace fetexc
