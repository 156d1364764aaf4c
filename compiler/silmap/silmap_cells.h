// SPDX-License-Identifier: GPL-3.0-or-later
/// The results in the middles of texels, and the cells between them that show or hold more than one.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "compiler/compile.h"
#include "compiler/parallel.h"
#include "compiler/planar/planar_map.h"
#include "compiler/silmap/link_area.h"

namespace fetexc {

/// A link across which a neighbour's point is the own one, a cell further: at the border of the canvas.
inline constexpr std::uint32_t kOwnPoint = kNone - 1;

/// From a cell to its neighbour, by link.
inline constexpr std::array<fetex::SilmapPoint, 4> kToNeighbour{{{-1, 0}, {0, -1}, {1, 0}, {0, 1}}};

/// What fits ask of neighbours, up to the point, is one line of a processor's cache.
struct alignas(64) SilmapCellData {
    std::uint32_t i = 0, j = 0;
    std::uint32_t boundaries = 0; ///< set of links
    /// By link, where it is a boundary: index of the cell, or kOwnPoint.
    std::array<std::uint32_t, 4> neighbours{kNone, kNone, kNone, kNone};
    std::uint32_t x = 0, y = 0; ///< the point in steps
    double wrong = 0;           ///< of `shown`: of the cell's part in the canvas, square cells
    ShownCell shown;
    std::array<double, 4> right{}; ///< of `shown`: link_area
    std::uint32_t first_slab = 0, slabs = 0;
    std::uint32_t edges_across = 0; ///< of each side, by link a byte: visible edges that end there, at most 255
    std::uint32_t corners = 0;      ///< of the drawing, inside
    bool plain = false;             ///< no edges inside
    bool joined = false; ///< of features: faces that are one around a feature's end: what shows of which isn't wrong
    /// Of features alone: the cell's faces at its corners, and the set of links that are boundaries.
    std::array<ResultId, 4> faces{};
    std::uint32_t apart = 0;
};

struct SilmapCells {
    std::uint32_t width = 0, height = 0;   ///< texels
    bool of_features = false;              ///< results are those of faces, a cell's own; none of texels
    std::vector<ResultId> results;         ///< width·height: in the middles of texels
    std::vector<ResultId> left, top;       ///< height + 1 and width + 1: in the corner of the border cells
    UnwrittenVector<SilmapCellData> cells; ///< with edges or boundaries, row by row
    std::vector<std::uint32_t> row_start;
    std::vector<TruthSlabs> truth; ///< by row

    /// Of a corner of cell (i,j); texels repeat beyond the border.
    [[nodiscard]] ResultId corner(std::uint32_t i, std::uint32_t j, std::uint32_t corner) const;
    /// Of a cell without edges.
    [[nodiscard]] ResultId inside(std::uint32_t i, std::uint32_t j) const;
    /// The part of a cell inside the canvas.
    [[nodiscard]] fetex::SilmapBox box(std::uint32_t i, std::uint32_t j) const {
        return {i == 0 ? 0.5 : 0, j == 0 ? 0.5 : 0, i == width ? 0.5 : 1, j == height ? 0.5 : 1};
    }
    /// Null: it shows and holds one result.
    [[nodiscard]] const SilmapCellData* find(std::uint32_t i, std::uint32_t j) const;
    [[nodiscard]] CellTruth truth_of(const SilmapCellData& c) const {
        return {truth[c.j], std::span(truth[c.j].slabs).subspan(c.first_slab, c.slabs), box(c.i, c.j)};
    }
    /// Of what it shows: areas right by link, and the area that is wrong.
    void measure(SilmapCellData& c) const;
};

/// Corners' results, boundaries and neighbours from the results of texels. Points stay.
void join_cells(SilmapCells& cells, unsigned threads);
/// Exits, and wrong areas.
void measure_cells(SilmapCells& cells, unsigned threads);
/// Both.
void link_cells(SilmapCells& cells, unsigned threads);

/// The same of one cell, after a texel at a corner of it has got another result.
void relink_cell(SilmapCells& cells, SilmapCellData& c);

/// Where the neighbour's point is, in the cell's frame. Precondition: the link is a boundary.
fetex::SilmapPoint point_across(const SilmapCells& cells, const SilmapCellData& c, const fetex::SilmapPoint& point,
                                std::uint32_t link);

/// Where its links leave the cell with a point at `point`.
std::array<double, 4> exits_of(const SilmapCells& cells, const SilmapCellData& c, const fetex::SilmapPoint& point);

} // namespace fetexc
