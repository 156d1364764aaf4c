// SPDX-License-Identifier: GPL-3.0-or-later
/// Zones that single moves, each of which has to pay, don't find.
#pragma once

#include <cstdint>

#include "compiler/pinchmap/zone_mask.h"

namespace fetexc {

/// Simulated annealing of a valid mask by what its corners cost: rectangles of 1 to 3 clusters a side, near corners
/// that cost much, go to one side; clusters that break a constraint on the way have a price, which rises. The mask
/// becomes the cheapest valid one met, which may be what it was. Random numbers from `seed`: the same in every run.
/// Precondition: truth has costs.
void search_zones(ZoneMask& mask, const ZoneTruth& truth, std::uint64_t seed);

} // namespace fetexc
