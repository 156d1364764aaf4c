// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/texel_map.h"

#include <algorithm>
#include <numeric>

namespace fetexc {

ResultId ResultLookup::operator()(const Windings& w) {
    inside_.clear();
    for (const Contribution& c : w) {
        if (scene_.shapes[c.shape].rule == FillRule::NonZero || (c.winding & 1) != 0) inside_.push_back(c.shape);
    }
    if (!any_ || inside_ != last_inside_) {
        last_ = compositor_.resolve(inside_);
        last_inside_ = inside_;
        any_ = true;
    }
    return last_;
}

void TexelMapper::collect(std::span<const SubEdge> sub_edges, SweepGraph& out) {
    out.nodes.clear(), out.edges.clear();
    for (const SubEdge& s : sub_edges) {
        out.nodes.push_back(s.n0);
        out.nodes.push_back(s.n1);
    }
    order_.sort(out.nodes);
    order_.rank(out.nodes, out.ranks);
    index_.clear();
    for (std::uint32_t k = 0; k < out.nodes.size(); ++k)
        index_.emplace_back(out.nodes[k], k);
    std::sort(index_.begin(), index_.end());
    const auto index = [&](std::uint32_t n) {
        return std::lower_bound(index_.begin(), index_.end(), std::pair(n, 0u))->second;
    };
    for (std::uint32_t s = 0; s < sub_edges.size(); ++s) {
        const std::uint32_t a = index(sub_edges[s].n0), b = index(sub_edges[s].n1);
        out.edges.push_back({s, std::min(a, b), std::max(a, b), a < b});
    }
}

bool TexelMapper::analyse(std::uint32_t i, std::uint32_t j, const Windings& corner, TexelMap& out) {
    out.i = i, out.j = j;
    out.frame = {2 * static_cast<HalfStep>(i), 2 * static_cast<HalfStep>(j)};
    out.sub_edges = map_.sub_edges(i, j);
    collect(out.sub_edges, out.graph);
    const bool done = skip_.direct_sweep ? sweep_.run(out.sub_edges, out.graph, {}, out.frame, out.sweep)
                                         : arrangement_.run(out.sub_edges, out.graph, out.frame, out.sweep);
    if (!done || order_.undecided()) return false;
    stats_.trapezoids += out.sweep.trapezoids.size();
    return assign_results(corner, out);
}

namespace {

/// On a side of the texel, not in a corner.
bool on_one_side(const GridNode& n) { return n.hx % 2 == 0 ? n.hy % 2 != 0 : n.hy % 2 == 0; }

} // namespace

bool TexelMapper::analyse_lone(std::uint32_t i, std::uint32_t j, const Windings& corner, LoneEdge& out) {
    const std::span<const SubEdge> sub_edges = map_.sub_edges(i, j);
    if (sub_edges.size() != 1 || !skip_.direct_sweep || faces_apart_) return false;
    const SubEdge& sub = sub_edges.front();
    const GridNode &p = map_.node(sub.n0), &q = map_.node(sub.n1);
    if (!on_one_side(p) || !on_one_side(q)) return false;
    int order = order_.compare(sub.n0, sub.n1, Axis::Y);
    if (order == 0) order = order_.compare(sub.n0, sub.n1, Axis::X);
    if (order == 0 || order_.undecided()) return false;
    out = {i, j, &sub, order < 0 ? sub.n0 : sub.n1, order < 0 ? sub.n1 : sub.n0, order < 0};
    // The corner is left of what starts on the top or on the right, above and right of what starts on the left.
    const GridNode& top = map_.node(out.top);
    const bool corner_right = top.hx == 2 * static_cast<HalfStep>(i);
    beyond_ = corner;
    add_windings(beyond_, map_.contributions_of(sub), out.down == corner_right ? -1 : 1);
    (corner_right ? out.right : out.left) = lookup_(corner);
    (corner_right ? out.left : out.right) = lookup_(beyond_);
    constexpr std::uint64_t trapezoids = 4, regions = 2; // as the sweep counts them
    stats_.trapezoids += trapezoids, stats_.regions += regions;
    return true;
}

/// For each face the portions along it (CSR).
void TexelMapper::list_portions_of_faces(const SweepResult& s) {
    portion_start_.assign(s.faces.size() + 1, 0);
    for (const Portion& p : s.portions)
        ++portion_start_[s.face(p.left)], ++portion_start_[s.face(p.right)];
    std::partial_sum(portion_start_.begin(), portion_start_.end(), portion_start_.begin());
    portion_of_face_.resize(2 * s.portions.size());
    for (auto p = static_cast<std::uint32_t>(s.portions.size()); p-- > 0;) {
        portion_of_face_[--portion_start_[s.face(s.portions[p].right)]] = {p, -1};
        portion_of_face_[--portion_start_[s.face(s.portions[p].left)]] = {p, 1};
    }
}

/// Winding numbers from face to face across the edges.
bool TexelMapper::assign_results(const Windings& corner, TexelMap& out) {
    const SweepResult& s = out.sweep;
    const std::size_t n = s.faces.size();
    list_portions_of_faces(s);
    if (windings_.size() < n) windings_.resize(n);
    known_.assign(n, false);
    out.results.assign(n, 0);
    queue_.assign(1, s.face(s.first_face));
    known_[queue_[0]] = true;
    windings_[queue_[0]] = corner;
    for (std::size_t q = 0; q < queue_.size(); ++q) {
        const std::uint32_t face = queue_[q];
        out.results[face] = faces_apart_ ? face : lookup_(windings_[face]);
        for (std::uint32_t k = portion_start_[face]; k < portion_start_[face + 1]; ++k) {
            const auto& [p, direction] = portion_of_face_[k];
            const Portion& portion = s.portions[p];
            const std::uint32_t to = s.face(direction > 0 ? portion.right : portion.left);
            if (known_[to]) continue;
            const SweepEdge& edge = out.graph.edges[portion.edge];
            const SubEdge& sub = out.sub_edges[edge.sub];
            const std::int32_t sign = edge.down ? direction : -direction;
            windings_[to] = windings_[face];
            add_windings(windings_[to], map_.contributions_of(sub), sign);
            known_[to] = true;
            queue_.push_back(to);
        }
    }
    stats_.regions += queue_.size();
    bool complete = true;
    for (std::uint32_t f = 0; f < n; ++f) {
        complete = complete && known_[s.face(f)];
        out.results[f] = out.results[s.face(f)];
    }
    return complete;
}

} // namespace fetexc
