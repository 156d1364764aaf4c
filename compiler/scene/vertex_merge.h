// SPDX-License-Identifier: GPL-3.0-or-later
/// Merging of end points closer than budget::kMergeDistance: deterministic leader clustering over a hash grid.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "compiler/scene/scene.h"

namespace fetexc {

struct LatticePointHash {
    std::size_t operator()(const LatticePoint& p) const noexcept;
};

/// Add every end point once per joint, in input order; run(); then ask for leaders. Points used by several joints
/// become leaders before lone ones, so borders that are already shared exactly do not move.
class VertexMerge {
  public:
    /// points: how many there will be, about.
    explicit VertexMerge(std::size_t points);
    VertexMerge(const VertexMerge&) = delete; // order_ points into vertices_
    VertexMerge& operator=(const VertexMerge&) = delete;
    void add(LatticePoint p);
    void run();
    /// Where an added point goes: itself or the nearest leader closer than the merge distance.
    [[nodiscard]] LatticePoint leader(LatticePoint p) const { return vertices_.at(p).leader; }
    /// Joints that move.
    [[nodiscard]] std::uint64_t merged() const { return merged_; }

  private:
    struct Vertex {
        std::uint64_t uses = 0;
        LatticePoint leader;
    };
    using Vertices = std::unordered_map<LatticePoint, Vertex, LatticePointHash>;
    void settle(LatticePoint p, Vertex& vertex);

    Vertices vertices_;
    std::vector<Vertices::value_type*> order_; ///< distinct points in input order; a hash map's nodes stay in place
    struct Leader {
        LatticePoint point;
        std::uint32_t next = kNone; ///< in the same cell
    };
    struct Chain {
        std::uint32_t first = kNone, last = kNone;
    };
    void add_leader(LatticePoint p);
    std::vector<Leader> leaders_;
    std::unordered_map<LatticePoint, Chain, LatticePointHash> leaders_in_cell_;
    std::uint64_t merged_ = 0;
};

} // namespace fetexc
