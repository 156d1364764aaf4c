// SPDX-License-Identifier: GPL-3.0-or-later
/// A planar map walked texel by texel, and the edges of its texels with different results on their sides.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "compiler/diagnostics.h"
#include "compiler/parallel.h"
#include "compiler/planar/planar_map.h"
#include "compiler/planar/texel_map.h"

namespace fetexc {

/// Width units: x right, y down; the canvas is [0,1] × [0, height / width]. Distances are Euclidean in them.
struct WidthPoint {
    double x = 0, y = 0;
};

/// Part of a curve inside the canvas with different results on its sides, monotone in x and y, following the curve
/// with growing t. Neighbouring parts share their end points bit for bit. What runs along the border of the canvas is
/// no edge.
struct VisibleEdge {
    int degree = 1;
    std::array<WidthPoint, 4> p{};
    ResultId left = 0, right = 0; ///< left: towards (y', −x'), which is left on the screen when moving up
};

/// Rows in parallel, each from left to right: empty(i, j, result) for a texel without edges, full(texel) for another.
/// False: the map contradicts itself somewhere.
template <class Empty, class Full>
bool for_each_texel(const PlanarMap& map, const Scene& scene, Compositor& compositor, unsigned threads,
                    const Empty& empty, const Full& full) {
    std::vector<char> good(map.grid().height, 1);
    parallel_for(map.grid().height, threads, [&](std::size_t row) {
        const auto j = static_cast<std::uint32_t>(row);
        PlanarStats stats;
        TexelMapper mapper(map, scene, compositor, stats);
        TexelMap texel;
        map.along_row(j, [&](std::uint32_t i, const Windings& corner) {
            if (i == map.grid().width || good[j] == 0) return;
            if (map.sub_edges(i, j).empty())
                empty(i, j, mapper.lookup()(corner));
            else if (mapper.analyse(i, j, corner, texel))
                full(static_cast<const TexelMap&>(texel));
            else
                good[j] = 0;
        });
    });
    return std::find(good.begin(), good.end(), 0) == good.end();
}

/// The planar map at a size that no edge on the lattice can run along a line of: see visible_edges.cpp. somewhere, if
/// not null, gets a result of the canvas: the only one where there are no edges.
Result<std::vector<VisibleEdge>> visible_edges(const Scene& scene, Compositor& compositor, unsigned threads,
                                               ResultId* somewhere = nullptr);

[[nodiscard]] Error inconsistent_map();

} // namespace fetexc
