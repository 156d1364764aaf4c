// SPDX-License-Identifier: GPL-3.0-or-later
/// Where a fit begins: distances to the outline; of several channels each to some of its runs between corners, so that
/// at a corner two straight contours meet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/bilevel/threshold_cells.h"
#include "compiler/bilevel/value_levels.h"

namespace fetexc {

/// For each segment the set of channels that follow it: bit c set for channel c.
///
/// The outline falls into runs between corners (turns of more than budget::kCornerTurn). For the median each run takes
/// two of the three channels, neighbours different pairs, so that they share one (Chlumsky 2015, section 3.3); for min
/// and max one channel each, alternating, where the corner is one that the rule sharpens, and both where it isn't.
///
/// window: texels over which an outline of pixels turns (budget::kCornerTurnOfPixels); 0: at a point.
std::vector<std::uint8_t> assign_channels(std::span<const OutlineSegment> outline, fetex::BilevelRule rule,
                                          double window);

/// Signed distances of texel centres, within `reach` texels, to the nearest segment of each channel, prolonged beyond
/// the run's ends, 1/2 on it, 0 and 1 at the reach; rounded to bytes. All texels of the texture.
std::vector<std::uint8_t> seed_values(const ThresholdCells& cells, const ScannedOutline& scanned,
                                      std::span<const OutlineSegment> outline, double reach, double window);

/// The same, stored otherwise and wherever the texels stand.
std::vector<std::uint16_t> seed_stored(const ThresholdCells& cells, const ScannedOutline& scanned,
                                       std::span<const OutlineSegment> outline, double reach, double window,
                                       const ValueLevels& levels);

} // namespace fetexc
