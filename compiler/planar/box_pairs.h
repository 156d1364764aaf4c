// SPDX-License-Identifier: GPL-3.0-or-later
/// Pairs of overlapping boxes, by CGAL's box_intersection_d (kept in its own translation unit).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace fetexc {

inline constexpr std::uint32_t kNoFan = 0xFFFFFFFF;

struct BoxItem {
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    std::uint32_t id = 0;
    std::uint32_t fan = kNoFan; ///< pairs inside a fan are left out
};

using IdPair = std::pair<std::uint32_t, std::uint32_t>; ///< smaller id first

/// Every pair of boxes that overlap (closed boxes: touching counts), batch by batch: memory stays linear in the boxes.
/// A batch is ascending, but which pairs come together is CGAL's choice and differs from run to run.
void visit_overlapping_pairs(std::vector<BoxItem> items, const std::function<void(std::span<const IdPair>)>& visit);

} // namespace fetexc
