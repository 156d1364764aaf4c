// SPDX-License-Identifier: GPL-3.0-or-later
/// Connected parts of the picture in which no texel has its middle: nothing of them is shown.
///
/// A region of a cell is shown if it holds one of its corners and the texel there has its colour. Nearly all do; only
/// the others are followed from cell to cell.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "compiler/planar/facing.h"
#include "compiler/planar/texel_map.h"
#include "compiler/silmap/silmap_cells.h"
#include "compiler/union_find.h"

namespace fetexc {

/// The regions of one row of cells with visible edges, from left to right, and the stretches of their sides.
class PartsRow {
  public:
    void add(const PlanarMap& map, const TexelMap& cell);
    void add(const PlanarMap& map, const LoneEdge& edge);

  private:
    friend class PartsFinder;
    struct Region {
        ResultId result = 0;
        std::uint32_t cell = 0;    ///< index
        std::uint32_t corners = 0; ///< set of the cell's corners that it holds
    };
    struct Cell {
        std::uint32_t i = 0;
        std::uint32_t first_region = 0, regions = 0;
        std::array<std::uint32_t, 5> parts{}; ///< where those of each TexelSide begin; vertex: region of the row
        bool lost = false;                    ///< a region isn't shown here
    };
    Cell& new_cell(std::uint32_t i);
    std::uint32_t new_region(ResultId result);
    void add_side(TexelSide side, std::span<const LinePart> parts);
    [[nodiscard]] std::span<const LinePart> parts_of(const Cell& c, TexelSide side) const {
        const auto k = static_cast<std::size_t>(side);
        return std::span(parts_).subspan(c.parts[k], c.parts[k + 1] - c.parts[k]);
    }
    [[nodiscard]] const Cell* find(std::uint32_t i) const;

    std::vector<Cell> cells_;
    std::vector<Region> regions_;
    std::vector<LinePart> parts_;
    std::vector<std::uint8_t> shown_; ///< by region
    // scratch
    UnionFind joined_;
    std::vector<std::uint32_t> region_of_face_;
    std::vector<LinePart> side_;
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
