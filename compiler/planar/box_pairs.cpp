// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/box_pairs.h"

#include <CGAL/Box_intersection_d/Box_with_handle_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>

namespace fetexc {
namespace {

using Box =
    CGAL::Box_intersection_d::Box_with_handle_d<double, 2, const BoxItem*, CGAL::Box_intersection_d::ID_EXPLICIT>;
using Boxes = std::vector<Box>;

/// Collects pairs and hands them on in batches.
class Batches {
  public:
    explicit Batches(const BoxPairs::Visitor& visit) : visit_(visit) {}

    void add(const Box& a, const Box& b) {
        const std::uint32_t i = a.handle()->id, j = b.handle()->id;
        pairs_.emplace_back(std::min(i, j), std::max(i, j));
        if (pairs_.size() == kBatch) flush();
    }

    void flush() {
        if (pairs_.empty()) return;
        std::sort(pairs_.begin(), pairs_.end());
        visit_(pairs_);
        pairs_.clear();
    }

  private:
    static constexpr std::size_t kBatch = 1 << 14;

    const BoxPairs::Visitor& visit_;
    std::vector<IdPair> pairs_;
};

Box box_of(const BoxItem& item) {
    double lo[2] = {item.x0, item.y0}, hi[2] = {item.x1, item.y1};
    return {lo, hi, &item};
}

Boxes boxes_of(std::span<const BoxItem> items) {
    Boxes boxes;
    boxes.reserve(items.size());
    for (const BoxItem& item : items)
        boxes.push_back(box_of(item));
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

Boxes boxes_of(const std::vector<BoxItem>& items, const std::vector<std::uint32_t>& which) {
    Boxes boxes;
    boxes.reserve(which.size());
    for (std::uint32_t k : which)
        boxes.push_back(box_of(items[k]));
    return boxes;
}

/// Left ends of strips that about as many boxes begin in, by a sample; the first strip has none.
std::vector<double> strip_borders(std::span<const BoxItem> items, std::size_t strips) {
    const std::size_t step = std::max<std::size_t>(1, items.size() / (16 * strips));
    std::vector<double> sample, borders;
    for (std::size_t k = 0; k < items.size(); k += step)
        sample.push_back(items[k].x0);
    std::sort(sample.begin(), sample.end());
    for (std::size_t k = 1; k < strips; ++k)
        borders.push_back(sample[k * sample.size() / strips]);
    return borders;
}

/// The strip in which an abscissa lies.
std::size_t strip_at(const std::vector<double>& borders, double x) {
    return static_cast<std::size_t>(std::upper_bound(borders.begin(), borders.end(), x) - borders.begin());
}

} // namespace

BoxPairs::BoxPairs(std::vector<BoxItem> items) : items_(std::move(items)) {
    std::stable_sort(items_.begin(), items_.end(), [](const BoxItem& a, const BoxItem& b) { return a.fan < b.fan; });
    std::size_t first = 0;
    while (first < items_.size() && items_[first].fan != kNoFan) {
        std::size_t end = first + 1;
        while (end < items_.size() && items_[end].fan == items_[first].fan)
            ++end;
        fans_.push_back({first, end});
        first = end;
    }
    cut_into_strips(first);
}

/// Long boxes reach many strips; there are so many strips that boxes reach one more on average, at most.
void BoxPairs::cut_into_strips(std::size_t first) {
    constexpr std::size_t max_strips = 128, boxes_a_strip = 192;
    const std::span<const BoxItem> rest = std::span(items_).subspan(first);
    std::vector<double> borders;
    for (std::size_t strips = std::clamp<std::size_t>(rest.size() / boxes_a_strip, 1, max_strips);; strips /= 2) {
        borders = strip_borders(rest, strips);
        std::size_t reached = 0;
        for (const BoxItem& b : rest)
            reached += strip_at(borders, b.x1) - strip_at(borders, b.x0);
        if (reached <= rest.size()) break;
    }
    strips_.resize(borders.size() + 1);
    for (std::size_t k = 0; k < rest.size(); ++k) {
        const std::size_t begin = strip_at(borders, rest[k].x0), last = strip_at(borders, rest[k].x1);
        strips_[begin].begin_here.push_back(static_cast<std::uint32_t>(first + k));
        for (std::size_t s = begin + 1; s <= last; ++s)
            strips_[s].reach_here.push_back(static_cast<std::uint32_t>(first + k));
    }
}

void BoxPairs::visit(std::size_t part, const Visitor& visitor) const {
    Batches batches(visitor);
    const auto add = [&](const Box& a, const Box& b) { batches.add(a, b); };
    if (part < fans_.size()) {
        const std::span<const BoxItem> all = items_;
        const Fan& fan = fans_[part];
        Boxes inside = boxes_of(all.subspan(fan.first, fan.end - fan.first));
        Boxes others = near(all.subspan(fan.end), all.subspan(fan.first, fan.end - fan.first));
        CGAL::box_intersection_d(inside.begin(), inside.end(), others.begin(), others.end(), add);
    } else {
        const Strip& strip = strips_[part - fans_.size()];
        Boxes begin = boxes_of(items_, strip.begin_here), reach = boxes_of(items_, strip.reach_here);
        CGAL::box_intersection_d(begin.begin(), begin.end(), reach.begin(), reach.end(), add);
        CGAL::box_self_intersection_d(begin.begin(), begin.end(), add);
    }
    batches.flush();
}

} // namespace fetexc
