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

void TexelMapper::collect(std::span<const SubEdge> sub_edges, std::span<const std::uint32_t> chosen,
                          std::vector<std::uint32_t>& nodes, std::vector<SweepEdge>& edges) const {
    nodes.clear(), edges.clear();
    for (std::uint32_t s : chosen) {
        nodes.push_back(sub_edges[s].n0);
        nodes.push_back(sub_edges[s].n1);
    }
    const auto order = [&](std::uint32_t a, std::uint32_t b) {
        const GridNode &p = map_.node(a), &q = map_.node(b);
        return before(p, q) || (!before(q, p) && a < b);
    };
    std::sort(nodes.begin(), nodes.end(), order);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    const auto index = [&](std::uint32_t n) {
        return static_cast<std::uint32_t>(std::lower_bound(nodes.begin(), nodes.end(), n, order) - nodes.begin());
    };
    for (std::uint32_t s : chosen) {
        const std::uint32_t a = index(sub_edges[s].n0), b = index(sub_edges[s].n1);
        edges.push_back({s, std::min(a, b), std::max(a, b)});
    }
}

bool TexelMapper::analyse(std::uint32_t i, std::uint32_t j, const Windings& corner, TexelMap& out) {
    out.i = i, out.j = j;
    out.frame = {2 * static_cast<HalfStep>(i), 2 * static_cast<HalfStep>(j)};
    out.sub_edges = map_.sub_edges(i, j);
    all_.resize(out.sub_edges.size());
    std::iota(all_.begin(), all_.end(), 0u);
    collect(out.sub_edges, all_, out.nodes, out.edges);
    if (!sweep_.run(out.sub_edges, out.nodes, out.edges, {}, out.frame, out.sweep)) return false;
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
            const SubEdge& sub = out.sub_edges[out.edges[portion.edge].sub];
            const std::int32_t sign = direction * map_.sweep_sign(sub);
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
