// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/box_pairs.h"

#include <CGAL/Box_intersection_d/Box_with_handle_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>

namespace fetexc {

std::vector<std::pair<std::uint32_t, std::uint32_t>> overlapping_pairs(const std::vector<BoxItem>& items) {
    using Box =
        CGAL::Box_intersection_d::Box_with_handle_d<double, 2, const BoxItem*, CGAL::Box_intersection_d::ID_EXPLICIT>;
    std::vector<Box> boxes;
    boxes.reserve(items.size());
    for (const BoxItem& item : items) {
        double lo[2] = {item.x0, item.y0}, hi[2] = {item.x1, item.y1};
        boxes.emplace_back(lo, hi, &item);
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
        const std::uint32_t i = a.handle()->id, j = b.handle()->id;
        pairs.emplace_back(std::min(i, j), std::max(i, j));
    });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

} // namespace fetexc
