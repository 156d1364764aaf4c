// SPDX-License-Identifier: GPL-3.0-or-later
/// Where a cell's point is sought from.
#pragma once

#include "compiler/silmap/cell_drawing.h"

namespace fetexc {

/// In the corner of the drawing with the most edges, of those with two the sharpest; without one in the point of the
/// edges that is nearest to their middle.
fetex::SilmapPoint seed_of(const CellDrawing& drawing);

} // namespace fetexc
