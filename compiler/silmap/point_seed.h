// SPDX-License-Identifier: GPL-3.0-or-later
/// Where a cell's point is sought from.
#pragma once

#include "compiler/silmap/cell_drawing.h"

namespace fetexc {

struct CellSteps {
    std::uint32_t x = 0, y = 0;
};

/// In the corner of the drawing with the most edges, of those with two the sharpest. Without one and with one edge
/// through the cell, where the edge passes a step nearly exactly, not far from its middle; a bent one is passed on its
/// outer side, by as much as halves the area beside its chords. Else in the point of the edges nearest to their middle.
/// on_edge: steps; how near to an edge is near enough not to look farther.
CellSteps seed_of(const CellDrawing& drawing, fetex::SilmapCellFormat format, double on_edge);

} // namespace fetexc
