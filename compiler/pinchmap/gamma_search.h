// SPDX-License-Identifier: GPL-3.0-or-later
/// The way out of the local minima in which fits of γ end (Tarini and Cignoni 2005, §7.2 step 4).
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/bilevel/contour_fit.h"
#include "compiler/bilevel/threshold_cells.h"
#include "compiler/bilevel/value_levels.h"

namespace fetexc {

/// The paper's rounds with exact areas instead of pixels: 2 × 2 texels somewhere near the outline are perturbed, the
/// 4 × 4 around them fitted again one by one, and all is undone unless less is wrong. So many rounds a texel. Places
/// and perturbations are random numbers, the same in every run and for any number of threads (0: all): bands of rows
/// take turns, those that are far enough from each other at once. The trace gets the wrong area once for each round a
/// texel. Returns the numbers tried.
std::uint64_t search_stored(const ThresholdCells& cells, const ValueLevels& levels, std::uint32_t rounds,
                            unsigned threads, std::vector<std::uint16_t>& stored, FitTrace& trace);

} // namespace fetexc
