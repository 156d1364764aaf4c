// SPDX-License-Identifier: GPL-3.0-or-later
/// Connected parts of the picture in which no texel has its middle: nothing of them is shown.
#pragma once

#include <optional>
#include <vector>

#include "compiler/planar/reachability.h"
#include "compiler/silmap/silmap_cells.h"
#include "compiler/union_find.h"

namespace fetexc {

/// One row of cells, from left to right. middle: a texel has its middle in the cell's corner.
class PartsRow {
  public:
    PartsRow(const PlanarMap& map, std::uint32_t row) : reach_(map, row) {}
    void add_empty(ResultId result, bool middle);
    void add_cell(const TexelMap& cell, bool middle);

  private:
    friend class PartsFinder;
    void see(std::uint32_t vertex) {
        if (seen_.size() <= vertex) seen_.resize(vertex + 1, false);
        seen_[vertex] = true;
    }
    ReachabilityRow reach_;
    std::vector<bool> seen_; ///< by vertex; what is missing isn't
    UnionFind joined_;
    std::vector<std::uint32_t> number_, region_of_face_;
    std::vector<ResultId> region_result_;
};

struct LostParts {
    std::uint64_t count = 0;    ///< of at least budget::kSilmapLostPart
    double largest = 0;         ///< square texels, about
    std::uint32_t i = 0, j = 0; ///< its first cell
};

/// lent: texels with a result that isn't that of their middle; they show what has it in the cells around. None: the map
/// contradicts itself.
std::optional<LostParts> lost_parts(const PlanarMap& map, std::vector<PartsRow>& rows, const SilmapCells& cells,
                                    std::span<const std::uint32_t> lent, unsigned threads);

} // namespace fetexc
