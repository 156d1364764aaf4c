// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/texel_plane.h"

#include <algorithm>
#include <tuple>

namespace fetexc {
namespace {

/// Position along x where the stretch passes a level.
Interval x_at(const Stretch& s, double y) {
    const Interval t = parameter_at(*s.curve, Axis::Y, s.range, s.y_increasing, y);
    return value_over(*s.curve, Axis::X, t);
}

} // namespace

TexelPlane::TexelPlane(const PlanarMap& map, NodeOrder& order, PlanarStats& stats, std::span<const SubEdge> sub_edges,
                       const SweepGraph& graph, TexelFrame frame)
    : map_(map), order_(order), stats_(stats), sub_edges_(sub_edges), graph_(graph), edges_(graph.edges),
      frame_(frame) {
    place_points();
    add_edges();
    for (const TexelSide s : {TexelSide::Left, TexelSide::Right, TexelSide::Top, TexelSide::Bottom})
        add_side(s);
}

void TexelPlane::place_points() {
    const auto n = static_cast<std::uint32_t>(graph_.nodes.size());
    const auto rank = [&](HalfStep h, HalfStep first_side, std::uint32_t inside) {
        return h == first_side ? 0 : h == first_side + 2 ? n + 1 : inside + 1;
    };
    for (std::uint32_t k = 0; k < n; ++k) {
        const GridNode& node = map_.node(graph_.nodes[k]);
        const NodeRank& r = graph_.ranks[k];
        points_.push_back({rank(node.hx, frame_.left, r.x), rank(node.hy, frame_.top, r.y), k, kNone});
    }
    for (const std::uint32_t x : {0u, n + 1}) {
        for (const std::uint32_t y : {0u, n + 1}) {
            const bool there =
                std::any_of(points_.begin(), points_.begin() + n, [&](const Point& p) { return p.x == x && p.y == y; });
            if (!there) points_.push_back({x, y, kNone, kNone});
        }
    }
    std::sort(points_.begin(), points_.end(),
              [](const Point& p, const Point& q) { return std::tie(p.y, p.x) < std::tie(q.y, q.x); });
    for (std::size_t k = 0; k + 1 < points_.size(); ++k) {
        if (points_[k].x == points_[k + 1].x && points_[k].y == points_[k + 1].y) throw UndecidedPlane{};
    }
}

void TexelPlane::add_edges() {
    point_of_node_.resize(graph_.nodes.size());
    for (std::uint32_t k = 0; k < points_.size(); ++k) {
        if (points_[k].node != kNone) point_of_node_[points_[k].node] = {k};
    }
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
        const PlaneArc arc{e, point_of_node_[edges_[e].top], point_of_node_[edges_[e].bottom]};
        arcs_.push_back(arc);
        for (const PlanePoint p : {arc.min, arc.max}) {
            std::uint32_t& piece = points_[p.id].piece;
            if (piece == kNone || is_vertical(arcs_[piece])) piece = e;
        }
    }
}

void TexelPlane::add_side(TexelSide s) {
    const auto far = static_cast<std::uint32_t>(graph_.nodes.size() + 1);
    const auto on_side = [&](const Point& p) {
        return s == TexelSide::Left    ? p.x == 0
               : s == TexelSide::Right ? p.x == far
                                       : p.y == (s == TexelSide::Top ? 0 : far);
    };
    const auto k = static_cast<std::size_t>(s);
    side_start_[k] = static_cast<std::uint32_t>(arcs_.size());
    PlanePoint last;
    for (std::uint32_t p = 0; p < points_.size(); ++p) {
        if (!on_side(points_[p])) continue;
        if (last.id != kNone) arcs_.push_back({static_cast<std::uint32_t>(arcs_.size()), last, {p}});
        last = {p};
    }
    side_end_[k] = static_cast<std::uint32_t>(arcs_.size());
}

Stretch TexelPlane::stretch_of(const PlaneArc& c) const { return map_.stretch_of(sub_edges_[edges_[c.piece].sub]); }

int TexelPlane::compare_at(PlanePoint p, const PlaneArc& c) {
    if (p == c.min || p == c.max) return 0;
    const Point &at = point(p), &a = point(c.min), &b = point(c.max);
    const auto [left, right] = std::minmax(a.x, b.x);
    if (at.x < left || (at.x == left && left < right)) return -1;
    if (at.x > right || (at.x == right && left < right)) return 1;
    if (left == right || a.y == b.y || at.node == kNone) throw UndecidedPlane{}; // on the piece, but not at its end
    if (at.y == a.y) return sign(at.x, a.x);
    if (at.y == b.y) return sign(at.x, b.x);
    return compare_inside(p, c);
}

/// The point lies within the edge's box. It isn't on the edge: what ends there doesn't cross it, so any level that the
/// two have in common decides.
int TexelPlane::compare_inside(PlanePoint p, const PlaneArc& c) {
    const GridNode& node = map_.node(map_node(p));
    const Stretch s = stretch_of(c);
    const Interval x = hull(x_at(s, node.y_range.lo), x_at(s, node.y_range.hi));
    if (const int side = fetexc::compare(node.x_range, x); side != 0) return side;
    const PlaneArc& e = arcs_[point(p).piece];
    if (!is_vertical(e)) {
        if (e.min == p) return order_between(e, c, p, point(e.max).y <= point(c.max).y ? e.max : c.max);
        return order_between(e, c, point(e.min).y >= point(c.min).y ? e.min : c.min, p);
    }
    ++stats_.exact_comparisons;
    const mpq_class middle =
        (order_.coordinate(map_node(e.min), Axis::X) + order_.coordinate(map_node(e.max), Axis::X)) / 2;
    const int side = -compare_position_exact(s, Axis::Y, order_.coordinate(map_node(p), Axis::Y), middle);
    if (side == 0) throw UndecidedPlane{};
    return side;
}

int TexelPlane::compare_after(const PlaneArc& a, const PlaneArc& b, PlanePoint p) {
    if (a.piece == b.piece) return 0;
    // A level edge counts as falling slightly to the right, so it is the last one.
    if (is_vertical(a) != is_vertical(b)) return is_vertical(a) ? 1 : -1;
    return compare_beside(a, b, p, a.max, b.max);
}

int TexelPlane::compare_before(const PlaneArc& a, const PlaneArc& b, PlanePoint p) {
    if (a.piece == b.piece) return 0;
    if (is_vertical(a) != is_vertical(b)) return is_vertical(a) ? -1 : 1;
    return compare_beside(a, b, p, a.min, b.min);
}

int TexelPlane::compare_beside(const PlaneArc& a, const PlaneArc& b, PlanePoint common, PlanePoint end_a,
                               PlanePoint end_b) {
    const std::uint32_t x = point(common).x, xa = point(end_a).x, xb = point(end_b).x;
    if (is_vertical(a)) throw UndecidedPlane{}; // both are
    if (xa <= x && x <= xb && xa < xb) return -1;
    if (xb <= x && x <= xa && xb < xa) return 1;
    if (!is_edge(a.piece) || !is_edge(b.piece)) throw UndecidedPlane{};
    const bool down = common.id < end_a.id;
    if (down) return order_between(a, b, common, point(end_a).y <= point(end_b).y ? end_a : end_b);
    return order_between(a, b, point(end_a).y >= point(end_b).y ? end_a : end_b, common);
}

/// Sign of a − b on a level strictly between two points; two edges that don't meet there.
int TexelPlane::order_between(const PlaneArc& a, const PlaneArc& b, PlanePoint from, PlanePoint to) {
    const Stretch sa = stretch_of(a), sb = stretch_of(b);
    const double lo = map_.node(map_node(from)).y_range.hi, hi = map_.node(map_node(to)).y_range.lo;
    const double level = 0.5 * (lo + hi);
    if (lo < level && level < hi) {
        if (const int c = fetexc::compare(x_at(sa, level), x_at(sb, level)); c != 0) return c;
    }
    ++stats_.exact_comparisons;
    const mpq_class exact = order_.level_between(map_node(from), map_node(to), Axis::Y);
    const int c = compare_positions_exact(sa, sb, Axis::Y, exact);
    if (c == 0) throw UndecidedPlane{};
    return c;
}

} // namespace fetexc
