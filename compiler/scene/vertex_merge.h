// SPDX-License-Identifier: GPL-3.0-or-later
/// Merging of end points closer than budget::kMergeDistance: deterministic leader clustering over a hash grid.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/flat_index.h"
#include "compiler/scene/scene.h"

namespace fetexc {

/// Add every end point once per joint, in input order; run(); then ask for leaders. Points used by several joints
/// become leaders before lone ones, so borders that are already shared exactly do not move. Fewer than kNone joints,
/// all within kLatticeLimit.
class VertexMerge {
  public:
    /// points: how many there will be, about.
    explicit VertexMerge(std::size_t points);
    /// The point's number; equal points have one.
    std::uint32_t add(LatticePoint p);
    void run();
    /// Where a point goes, both by number: to itself, or to the nearest leader closer than the merge distance.
    [[nodiscard]] std::uint32_t leader(std::uint32_t point) const { return vertices_[point].leader; }
    [[nodiscard]] LatticePoint at(std::uint32_t point) const { return vertices_[point].at; }
    /// Joints that move.
    [[nodiscard]] std::uint64_t merged() const { return merged_; }

  private:
    struct Vertex {
        LatticePoint at;
        std::uint32_t uses = 0;
        std::uint32_t leader = kNone;
        std::uint32_t next = kNone; ///< of a leader: the next in its cell, the first after the last
    };
    void settle(std::uint32_t point);
    void add_leader(std::uint32_t point);

    /// Coordinates fit 32 bits: one number holds both.
    struct Hash {
        std::size_t operator()(std::uint64_t packed) const { return static_cast<std::size_t>(mixed_bits(packed)); }
    };
    std::vector<Vertex> vertices_; ///< distinct points in input order
    FlatIndex<std::uint64_t, Hash> numbers_;
    FlatIndex<std::uint64_t, Hash> last_in_cell_; ///< cell → the leader last added there
    std::uint64_t merged_ = 0;
};

} // namespace fetexc
