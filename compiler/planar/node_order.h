// SPDX-License-Identifier: GPL-3.0-or-later
/// The nodes of a texel in exact order: by their enclosures, else by coordinates of 72 binary places. After this, the
/// sweep compares ranks, not coordinates.
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "compiler/planar/planar_map.h"

namespace fetexc {

/// Position among a texel's nodes along each axis; equal coordinates have equal ranks.
struct NodeRank {
    std::uint32_t x = 0, y = 0;
};

class NodeOrder {
  public:
    explicit NodeOrder(const PlanarMap& map) : map_(map) {}

    /// Sorts and removes duplicates: down, then right (the order of the sweep).
    void sort(std::vector<std::uint32_t>& nodes);
    /// Ranks of sorted nodes.
    void rank(std::span<const std::uint32_t> nodes, std::vector<NodeRank>& ranks);
    /// Sign of the difference of a coordinate.
    int compare(std::uint32_t a, std::uint32_t b, Axis axis);
    /// Coordinate of a node, as narrow as comparisons needed it.
    mpq_class coordinate(std::uint32_t node, Axis axis);

  private:
    bool before(std::uint32_t a, std::uint32_t b);
    const FixedPoint& fixed(std::uint32_t node);
    int compare_finely(std::uint32_t a, std::uint32_t b, Axis axis);

    const PlanarMap& map_;
    std::unordered_map<std::uint32_t, FixedPoint> fixed_; ///< remembered
    std::unordered_map<std::uint32_t, RationalPoint> fine_;
    std::vector<std::uint32_t> by_x_;
};

} // namespace fetexc
