// SPDX-License-Identifier: GPL-3.0-or-later
/// Pairs of overlapping boxes, by CGAL's box_intersection_d (kept in its own translation unit).
#pragma once

#include <cstddef>
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

/// Every pair of boxes that overlap (closed boxes: touching counts), in parts that different threads may visit: a fan
/// with everything but itself, or a vertical strip with the pairs whose second box, from left to right, begins in it.
class BoxPairs {
  public:
    /// A batch of pairs, ascending. Which pairs come together is CGAL's choice.
    using Visitor = std::function<void(std::span<const IdPair>)>;

    explicit BoxPairs(std::vector<BoxItem> items);
    [[nodiscard]] std::size_t parts() const { return fans_.size() + strips_.size(); }
    /// Batch by batch: memory stays linear in the boxes.
    void visit(std::size_t part, const Visitor& visitor) const;

  private:
    /// Boxes of items_, by number.
    struct Strip {
        std::vector<std::uint32_t> begin_here, reach_here; ///< the latter begin in strips before
    };
    struct Fan {
        std::size_t first = 0, end = 0; ///< in items_
    };

    void cut_into_strips(std::size_t first);

    std::vector<BoxItem> items_; ///< by fan, those without one last
    std::vector<Fan> fans_;
    std::vector<Strip> strips_;
};

} // namespace fetexc
