// SPDX-License-Identifier: GPL-3.0-or-later
/// The last part of a fit: parts that show and shouldn't, or should and don't.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/bilevel/discrete_fit.h"
#include "compiler/bilevel/threshold_cells.h"

namespace fetexc {

/// Changes single bytes so that fewer parts are invented, or more of those that are lost show, each by whichever change
/// gets the least area wrong if that is no more than budget::kWorthAPart. fine: for the areas. Returns the changes.
std::uint64_t mend_parts(const ThresholdCells& fine, const ScannedOutline& rows,
                         std::span<const OutlineSegment> outline, MidGreys greys, std::vector<std::uint8_t>& values);

} // namespace fetexc
