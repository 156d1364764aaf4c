// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/global_arrangement.h"

#include <CGAL/Arrangement_2.h>

#include <algorithm>

#include "compiler/planar/box_pairs.h"
#include "compiler/planar/filtered_arc_traits.h"

namespace fetexc::test {
namespace {

using Traits = FilteredArcTraits<GlobalPlane>;
using CgalArrangement = CGAL::Arrangement_2<Traits>;

struct Bounds {
    Interval x, y;
};

Bounds bounds_of(const ArcSet& set, const Arc& a) {
    const Vertex &p = set.vertices[a.v0], &q = set.vertices[a.v1];
    return {hull(p.x, q.x), hull(p.y, q.y)};
}

/// The curves' parameter ranges on one support have more than an end in common.
bool overlap(const SupportMap& map) {
    return std::min(map.start.mid(), map.end.mid()) < 1 && std::max(map.start.mid(), map.end.mid()) > 0;
}

std::vector<SharedSupport> shared_supports(const Scene& scene, const Grid& grid) {
    PlanarStats stats;
    const ArcSet set = prepare_arcs(scene, grid, {}, stats);
    std::vector<BoxItem> items;
    for (std::uint32_t k = 0; k < set.arcs.size(); ++k) {
        const Bounds b = bounds_of(set, set.arcs[k]);
        if (set.curves[set.arcs[k].curve].degree > 1) items.push_back({b.x.lo, b.y.lo, b.x.hi, b.y.hi, k, kNoFan});
    }
    std::vector<SharedSupport> shared;
    const auto test = [&](const IdPair& pair) {
        const auto [a, b] = std::minmax({set.arcs[pair.first].curve, set.arcs[pair.second].curve});
        SupportMap map;
        if (a != b && same_support(set.curves[a], set.curves[b], map) && overlap(map)) shared.push_back({a, b});
    };
    const BoxPairs boxes(items);
    for (std::size_t part = 0; part < boxes.parts(); ++part)
        boxes.visit(part, [&](std::span<const IdPair> pairs) { std::for_each(pairs.begin(), pairs.end(), test); });
    std::sort(shared.begin(), shared.end());
    shared.erase(std::unique(shared.begin(), shared.end()), shared.end());
    return shared;
}

} // namespace

bool reaches_canvas(const ArcSet& set, const Arc& arc, const Grid& grid) {
    const Bounds b = bounds_of(set, arc);
    return b.x.hi >= 0 && b.x.lo <= static_cast<double>(grid.right()) && b.y.hi >= 0 &&
           b.y.lo <= static_cast<double>(grid.bottom());
}

GlobalArrangement arrange_globally(const Scene& scene, const Grid& grid) {
    PlanarStats stats;
    const std::vector<SharedSupport> shared = shared_supports(scene, grid);
    const ArcSet set = prepare_arcs(scene, grid, shared, stats);
    GlobalPlane plane(set);
    GlobalArrangement out;
    try {
        std::vector<PlaneArc> arcs;
        for (std::uint32_t k = 0; k < set.arcs.size(); ++k) {
            if (reaches_canvas(set, set.arcs[k], grid)) arcs.push_back(plane.arc(k));
        }
        const Traits traits(plane);
        CgalArrangement arrangement(&traits);
        CGAL::insert(arrangement, arcs.begin(), arcs.end());
        std::vector<CgalArrangement::Vertex_const_handle> vertices;
        for (auto v = arrangement.vertices_begin(); v != arrangement.vertices_end(); ++v)
            vertices.push_back(v);
        std::sort(vertices.begin(), vertices.end(),
                  [&](const auto& p, const auto& q) { return plane.compare(p->point(), q->point()) < 0; });
        for (const auto& v : vertices)
            out.vertices.push_back({plane.vertex(v->point()).x, plane.vertex(v->point()).y, v->degree()});
        out.edges = arrangement.number_of_edges(), out.faces = arrangement.number_of_faces();
    } catch (const UndecidedGlobally& u) {
        out.undecided = std::string(u.question) + " at " + std::to_string(u.x) + ", " + std::to_string(u.y);
    }
    out.counts = plane.counts();
    return out;
}

} // namespace fetexc::test
