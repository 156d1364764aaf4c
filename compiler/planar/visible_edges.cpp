// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/visible_edges.h"

#include <algorithm>
#include <numeric>

namespace fetexc {
namespace {

constexpr std::uint32_t kCells = 127; ///< on the longer side

/// The planar map keeps edges along grid lines apart from its texels. Level and upright edges lie on the lattice: with
/// a number of cells that has no divisor in common with the lattice's, no line but the canvas's border does.
std::uint32_t cells_for(std::int64_t lattice, std::int64_t longer) {
    auto n = static_cast<std::int64_t>(static_cast<double>(kCells) * static_cast<double>(lattice) /
                                       static_cast<double>(longer));
    for (n = std::max<std::int64_t>(n, 1); std::gcd(n, lattice) != 1;)
        ++n;
    return static_cast<std::uint32_t>(n);
}

class EdgeWriter {
  public:
    EdgeWriter(const PlanarMap& map, double height)
        : map_(map), sx_(1 / static_cast<double>(map.grid().right())),
          sy_(height / static_cast<double>(map.grid().bottom())) {}

    void write(const TexelMap& texel, std::vector<VisibleEdge>& out) const {
        for (const Portion& p : texel.sweep.portions) {
            const ResultId left = texel.left_result(p), right = texel.right_result(p);
            if (left == right) continue;
            const SweepEdge& e = texel.graph.edges[p.edge];
            VisibleEdge edge = shape_of(texel.sub_edges[e.sub]);
            // A portion's left is the side of smaller x: right of what runs down.
            edge.left = e.down ? right : left, edge.right = e.down ? left : right;
            out.push_back(edge);
        }
    }

  private:
    [[nodiscard]] VisibleEdge shape_of(const SubEdge& sub) const {
        const Curve& c = *map_.stretch_of(sub).curve;
        const std::array<double, 4> x = stretch(c, Axis::X, sub.range.lo, sub.range.hi),
                                    y = stretch(c, Axis::Y, sub.range.lo, sub.range.hi);
        VisibleEdge edge;
        edge.degree = c.degree;
        const auto n = static_cast<std::size_t>(c.degree);
        for (std::size_t i = 1; i < n; ++i) {
            edge.p[i] = {(static_cast<double>(c.x.origin) + x[i]) * sx_,
                         (static_cast<double>(c.y.origin) + y[i]) * sy_};
        }
        edge.p[0] = place_of(map_.node(sub.n0)), edge.p[n] = place_of(map_.node(sub.n1));
        return edge;
    }

    [[nodiscard]] WidthPoint place_of(const GridNode& n) const { return {n.x * sx_, n.y * sy_}; }

    const PlanarMap& map_;
    double sx_, sy_; ///< planar to width units
};

} // namespace

Error inconsistent_map() {
    return {ErrorClass::Runtime, diag::kPlanarInconsistent,
            "the planar map contradicts itself; please report this file", ""};
}

Result<std::vector<VisibleEdge>> visible_edges(const Scene& scene, Compositor& compositor, unsigned threads,
                                               ResultId* somewhere) {
    const Extent& e = scene.extent;
    const std::int64_t longer = std::max(e.lattice_w, e.lattice_h);
    const Grid grid = make_grid(e, cells_for(e.lattice_w, longer), cells_for(e.lattice_h, longer));
    PlanarStats stats;
    const Result<PlanarMap> map = PlanarMap::build(scene, grid, threads, stats);
    if (!map) return map.error();
    const EdgeWriter writer(map.value(), e.height / e.width);
    std::vector<std::vector<VisibleEdge>> rows(grid.height);
    std::vector<ResultId> of_row(grid.height);
    const bool good = for_each_texel(
        map.value(), scene, compositor, threads, [&](std::uint32_t, std::uint32_t j, ResultId r) { of_row[j] = r; },
        [&](const TexelMap& texel) {
            writer.write(texel, rows[texel.j]);
            if (!texel.sweep.portions.empty()) of_row[texel.j] = texel.left_result(texel.sweep.portions.front());
        });
    if (!good) return inconsistent_map();
    if (somewhere != nullptr) *somewhere = of_row.front();
    std::vector<VisibleEdge> edges;
    for (const std::vector<VisibleEdge>& row : rows)
        edges.insert(edges.end(), row.begin(), row.end());
    return edges;
}

} // namespace fetexc
