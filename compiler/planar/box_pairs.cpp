// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/box_pairs.h"

#include <CGAL/Box_intersection_d/Box_with_handle_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <numeric>

namespace fetexc {
namespace {

using IdPairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Sorted: into buckets by the first id, then each bucket.
IdPairs in_order(const IdPairs& pairs) {
    std::vector<std::uint32_t> start;
    for (const auto& [i, j] : pairs) {
        if (start.size() < i + std::size_t{2}) start.resize(i + std::size_t{2}, 0);
        ++start[i + 1];
    }
    std::partial_sum(start.begin(), start.end(), start.begin());
    IdPairs out(pairs.size());
    std::vector<std::uint32_t> next = start;
    for (const auto& p : pairs)
        out[next[p.first]++] = p;
    for (std::size_t i = 0; i + 1 < start.size(); ++i)
        std::sort(out.begin() + start[i], out.begin() + start[i + 1]);
    return out;
}

} // namespace

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
    return in_order(pairs);
}

} // namespace fetexc
