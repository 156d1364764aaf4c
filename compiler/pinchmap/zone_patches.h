// SPDX-License-Identifier: GPL-3.0-or-later
/// Places where zones differ.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "compiler/pinchmap/zone_mask.h"

namespace fetexc {

/// Sets of clusters.
struct ZonePatches {
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> of; ///< each cluster's, row by row; kNone: in none
    std::uint32_t count = 0;
};

/// Clusters that differ between two masks of one size, in sets that are farther than two clusters from each other. What
/// SPEC 8.1 asks of a cluster depends on 3 × 3: if both masks are valid, so is any that has some of the sets from one
/// and the others from the other.
ZonePatches patches_between(const ZoneMask& a, const ZoneMask& b);

} // namespace fetexc
