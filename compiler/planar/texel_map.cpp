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

void TexelMapper::collect(std::span<const SubEdge> sub_edges, std::span<const std::uint32_t> chosen, SweepGraph& out) {
    out.nodes.clear(), out.edges.clear();
    for (std::uint32_t s : chosen) {
        out.nodes.push_back(sub_edges[s].n0);
        out.nodes.push_back(sub_edges[s].n1);
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
    for (std::uint32_t s : chosen) {
        const std::uint32_t a = index(sub_edges[s].n0), b = index(sub_edges[s].n1);
        out.edges.push_back({s, std::min(a, b), std::max(a, b), a < b});
    }
}

bool TexelMapper::analyse(std::uint32_t i, std::uint32_t j, const Windings& corner, TexelMap& out) {
    out.i = i, out.j = j;
    out.frame = {2 * static_cast<HalfStep>(i), 2 * static_cast<HalfStep>(j)};
    out.sub_edges = map_.sub_edges(i, j);
    all_.resize(out.sub_edges.size());
    std::iota(all_.begin(), all_.end(), 0u);
    collect(out.sub_edges, all_, out.graph);
    if (!sweep_.run(out.sub_edges, out.graph, {}, out.frame, out.sweep)) return false;
    stats_.trapezoids += out.sweep.trapezoids.size();
    return assign_results(corner, out);
}

/// Winding numbers from face to face across the edges.
bool TexelMapper::assign_results(const Windings& corner, TexelMap& out) {
    const SweepResult& s = out.sweep;
    const std::size_t n = s.faces.size();
    std::vector<std::vector<std::pair<std::uint32_t, std::int32_t>>> next(n); // face → (portion, +1 left to right)
    for (std::uint32_t p = 0; p < s.portions.size(); ++p) {
        next[s.face(s.portions[p].left)].emplace_back(p, 1);
        next[s.face(s.portions[p].right)].emplace_back(p, -1);
    }
    std::vector<Windings> windings(n);
    std::vector<bool> known(n, false);
    out.results.assign(n, 0);
    std::vector<std::uint32_t> queue{s.face(s.first_face)};
    known[queue[0]] = true;
    windings[queue[0]] = corner;
    for (std::size_t q = 0; q < queue.size(); ++q) {
        const std::uint32_t face = queue[q];
        out.results[face] = lookup_(windings[face]);
        for (const auto& [p, direction] : next[face]) {
            const Portion& portion = s.portions[p];
            const std::uint32_t to = s.face(direction > 0 ? portion.right : portion.left);
            if (known[to]) continue;
            const SweepEdge& edge = out.graph.edges[portion.edge];
            const SubEdge& sub = out.sub_edges[edge.sub];
            const std::int32_t sign = edge.down ? direction : -direction;
            windings[to] = windings[face];
            for (const Contribution& c : map_.contributions_of(sub))
                add_winding(windings[to], c.shape, sign * c.winding);
            known[to] = true;
            queue.push_back(to);
        }
    }
    stats_.regions += queue.size();
    bool complete = true;
    for (std::uint32_t f = 0; f < n; ++f) {
        complete = complete && known[s.face(f)];
        out.results[f] = out.results[s.face(f)];
    }
    return complete;
}

} // namespace fetexc
