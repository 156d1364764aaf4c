// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "compiler/silmap/cell_truth.h"
#include "compiler/silmap/link_area.h"

namespace fetexc {

/// Square cells: of a result in a cell, all but what is connected inside the cell with one of a set of corners.
double area_apart_from(const CellTruth& truth, ResultId result, std::uint32_t corners);

} // namespace fetexc
