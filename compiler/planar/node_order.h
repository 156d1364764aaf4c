// SPDX-License-Identifier: GPL-3.0-or-later
/// The nodes of a texel in exact order: by their enclosures, else by coordinates of 72 binary places, else as
/// algebraic numbers. After this, the sweep compares ranks, not coordinates.
#pragma once

#include <map>
#include <span>
#include <tuple>
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
    NodeOrder(const PlanarMap& map, PlanarStats& stats) : map_(map), stats_(stats) {}

    /// Sorts and removes duplicates: down, then right (the order of the sweep).
    void sort(std::vector<std::uint32_t>& nodes);
    /// Ranks of sorted nodes.
    void rank(std::span<const std::uint32_t> nodes, std::vector<NodeRank>& ranks);
    /// Sign of the difference of a coordinate.
    int compare(std::uint32_t a, std::uint32_t b, Axis axis);
    /// Some comparison found no answer (and gave "equal").
    [[nodiscard]] bool undecided() const { return undecided_; }
    /// A level strictly between the nodes' coordinates, of which a's is known to be smaller.
    mpq_class level_between(std::uint32_t a, std::uint32_t b, Axis axis);
    /// Coordinate of a node, as narrow as comparisons needed it.
    mpq_class coordinate(std::uint32_t node, Axis axis);

  private:
    bool before(std::uint32_t a, std::uint32_t b);
    const std::optional<FixedPoint>& fixed(std::uint32_t node);
    int compare_exactly(std::uint32_t a, std::uint32_t b, Axis axis);
    void separate(std::uint32_t a, std::uint32_t b, const AlgebraicCoordinate& p, const AlgebraicCoordinate& q);

    const PlanarMap& map_;
    PlanarStats& stats_;
    std::unordered_map<std::uint32_t, std::optional<FixedPoint>> fixed_; ///< remembered
    struct Fine {
        int bits = 0;
        mpq_class value;
    };
    std::map<std::pair<std::uint32_t, Axis>, Fine> fine_; ///< where those don't do
    std::map<std::tuple<std::uint32_t, std::uint32_t, Axis>, int> compared_;
    bool undecided_ = false;
    std::vector<std::uint32_t> by_x_;
};

} // namespace fetexc
