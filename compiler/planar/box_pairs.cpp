// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/box_pairs.h"

#include <CGAL/Box_intersection_d/Box_with_handle_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <numeric>

namespace fetexc {
namespace {

using Box =
    CGAL::Box_intersection_d::Box_with_handle_d<double, 2, const BoxItem*, CGAL::Box_intersection_d::ID_EXPLICIT>;
using Boxes = std::vector<Box>;

/// Collects pairs and hands them on in batches.
class Batches {
  public:
    explicit Batches(const std::function<void(std::span<const IdPair>)>& visit) : visit_(visit) {}

    void add(const Box& a, const Box& b) {
        const std::uint32_t i = a.handle()->id, j = b.handle()->id;
        pairs_.emplace_back(std::min(i, j), std::max(i, j));
        if (pairs_.size() == kBatch) flush();
    }

    void flush() {
        if (pairs_.empty()) return;
        sort();
        visit_(sorted_);
        pairs_.clear();
    }

  private:
    static constexpr std::size_t kBatch = 1 << 18;

    /// Into buckets by the first id, then each bucket.
    void sort() {
        start_.clear();
        for (const auto& [i, j] : pairs_) {
            if (start_.size() < i + std::size_t{2}) start_.resize(i + std::size_t{2}, 0);
            ++start_[i + 1];
        }
        std::partial_sum(start_.begin(), start_.end(), start_.begin());
        sorted_.resize(pairs_.size());
        next_ = start_;
        for (const IdPair& p : pairs_)
            sorted_[next_[p.first]++] = p;
        for (std::size_t i = 0; i + 1 < start_.size(); ++i)
            std::sort(sorted_.begin() + start_[i], sorted_.begin() + start_[i + 1]);
    }

    const std::function<void(std::span<const IdPair>)>& visit_;
    std::vector<IdPair> pairs_, sorted_;
    std::vector<std::uint32_t> start_, next_;
};

Boxes boxes_of(std::span<const BoxItem> items) {
    Boxes boxes;
    boxes.reserve(items.size());
    for (const BoxItem& item : items) {
        double lo[2] = {item.x0, item.y0}, hi[2] = {item.x1, item.y1};
        boxes.emplace_back(lo, hi, &item);
    }
    return boxes;
}

/// The boxes that meet the hull of others.
Boxes near(std::span<const BoxItem> items, std::span<const BoxItem> others) {
    BoxItem hull = others.front();
    for (const BoxItem& o : others) {
        hull.x0 = std::min(hull.x0, o.x0), hull.x1 = std::max(hull.x1, o.x1);
        hull.y0 = std::min(hull.y0, o.y0), hull.y1 = std::max(hull.y1, o.y1);
    }
    Boxes boxes = boxes_of(items);
    std::erase_if(boxes, [&](const Box& b) {
        return b.max_coord(0) < hull.x0 || b.min_coord(0) > hull.x1 || b.max_coord(1) < hull.y0 ||
               b.min_coord(1) > hull.y1;
    });
    return boxes;
}

} // namespace

void visit_overlapping_pairs(std::vector<BoxItem> items, const std::function<void(std::span<const IdPair>)>& visit) {
    std::stable_sort(items.begin(), items.end(), [](const BoxItem& a, const BoxItem& b) { return a.fan < b.fan; });
    Batches batches(visit);
    const auto add = [&](const Box& a, const Box& b) { batches.add(a, b); };
    std::span<const BoxItem> rest = items;
    while (!rest.empty() && rest.front().fan != kNoFan) { // each fan with all that come after it
        const auto end = std::find_if(rest.begin(), rest.end(), [&](const BoxItem& b) { return b.fan != rest[0].fan; });
        const std::span<const BoxItem> fan(rest.begin(), end);
        rest = {end, rest.end()};
        Boxes inside = boxes_of(fan), others = near(rest, fan);
        CGAL::box_intersection_d(inside.begin(), inside.end(), others.begin(), others.end(), add);
    }
    Boxes boxes = boxes_of(rest);
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), add);
    batches.flush();
}

} // namespace fetexc
