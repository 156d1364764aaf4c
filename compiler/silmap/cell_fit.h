// SPDX-License-Identifier: GPL-3.0-or-later
/// Points of cells where the least area is wrong.
#pragma once

#include "compiler/silmap/silmap_cells.h"
#include "formats/silmap.h"

namespace fetexc {

struct FitCounts {
    std::uint64_t rounds = 0, positions = 0;
};

/// Moves points from step to step where that lowers the wrong area of the cell and its neighbours; thorough: until no
/// step does, and beyond that where one cell weighs. Same result for any thread count. Precondition: link_cells.
FitCounts fit_points(SilmapCells& cells, fetex::SilmapCellFormat format, bool thorough, unsigned threads);

/// What isn't thorough, by samples of the cells (cell_samples.h): as good where cells are crowded, in half the time; of
/// pictures that points could show nearly exactly, it leaves more. Precondition: join_cells. Leaves cells as link_cells
/// does.
FitCounts fit_points_by_samples(SilmapCells& cells, fetex::SilmapCellFormat format, unsigned threads,
                                double& wrong_area_seed);

/// Of all cells, square texels.
double wrong_area_of(const SilmapCells& cells);

} // namespace fetexc
