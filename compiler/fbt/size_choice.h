// SPDX-License-Identifier: GPL-3.0-or-later
/// The size of the grid, chosen (FBT §4.1: more texels make lookups cheaper, fewer make the texture smaller).
#pragma once

#include "formats/fbt.h"

namespace fetexc {

/// What a lookup costs on average over the texture, in reads: the texel, steps over bands, runs, and pieces considered
/// (FBT §6.3). Measured at 64 × 64 evenly spread points.
double lookup_cost(const fetex::FbtTexture& texture);

} // namespace fetexc
