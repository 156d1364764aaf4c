// SPDX-License-Identifier: GPL-3.0-or-later
/// Pairs of overlapping boxes, by CGAL's box_self_intersection_d (kept in its own translation unit).
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace fetexc {

struct BoxItem {
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    std::uint32_t id = 0;
};

/// (smaller id, larger id), ascending. Closed boxes: touching counts.
std::vector<std::pair<std::uint32_t, std::uint32_t>> overlapping_pairs(const std::vector<BoxItem>& items);

} // namespace fetexc
