// SPDX-License-Identifier: GPL-3.0-or-later
/// From the planar map to the cells of a silhouette map.
#pragma once

#include <optional>
#include <vector>

#include "compiler/silmap/feature_cells.h"
#include "compiler/silmap/lost_parts.h"
#include "compiler/silmap/silmap_cells.h"

namespace fetexc {

/// Cells with edges, visible or not.
std::uint64_t cells_with_edges(const PlanarMap& map);

struct ReadCells {
    SilmapCells cells;
    std::vector<PartsRow> parts; ///< by row
};

struct CellReading {
    fetex::SilmapCellFormat format;
    double chord = 0;   ///< cells; what chords may miss edges by
    double on_edge = 0; ///< steps; seeds as near to an edge are as good as on it
};

/// map: of make_cell_grid. Points are seeds (point_seed.h); corners, links and areas aren't there yet (link_cells).
/// near: with the cells next to those with edges. None: the map contradicts itself.
std::optional<ReadCells> read_cells(const PlanarMap& map, const Scene& scene, Compositor& compositor,
                                    const CellReading& how, bool near, unsigned threads, const SkipRules& skip,
                                    PlanarStats& stats);

/// The same of features over an image (feature_scene): each face of a cell is a result of its own.
std::optional<SilmapCells> read_feature_cells(const PlanarMap& map, const Scene& features, const CellReading& how,
                                              unsigned threads, const SkipRules& skip, PlanarStats& stats);

} // namespace fetexc
