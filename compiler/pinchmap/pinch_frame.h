// SPDX-License-Identifier: GPL-3.0-or-later
/// What of a pinchmap follows from its zones: du, dv, k (Tarini and Cignoni 2005, §5.1, §7.2 step 3).
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/pinchmap/zone_mask.h"
#include "formats/pinchmap.h"

namespace fetexc {

/// (width+1)·(height+1) map texels, row by row; gamma 0, strength 1: straights with one component of the direction,
/// turns with two, crosses with none, for they can't favour a line (SPEC 8.1). Precondition: the mask is valid.
std::vector<fetex::PinchmapTexel> pinch_frame(const ZoneMask& mask);

} // namespace fetexc
