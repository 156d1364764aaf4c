// SPDX-License-Identifier: GPL-3.0-or-later
/// Texels that take the result of a region beside their middle: where a feature is thinner than texels, most middles
/// miss it.
#pragma once

#include "compiler/silmap/silmap_cells.h"
#include "formats/silmap.h"

namespace fetexc {

/// Gives texels the result of a neighbour, and moves the points around them, where that lowers the wrong area. cells:
/// with those around every cell with edges. Returns the texels that have another result than in their middle,
/// ascending.
std::vector<std::uint32_t> lend_results(SilmapCells& cells, fetex::SilmapCellFormat format, std::uint64_t& tried);

} // namespace fetexc
