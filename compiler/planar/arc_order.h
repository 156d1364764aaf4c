// SPDX-License-Identifier: GPL-3.0-or-later
/// The vertices along an arc in their exact order, and which of them are one point. A point where several curves meet
/// shows up on each of them as several contacts at one parameter: comparing along arcs finds every coincidence.
#pragma once

#include <optional>
#include <vector>

#include "compiler/planar/arcs.h"
#include "compiler/union_find.h"

namespace fetexc {

struct OnArc {
    std::uint32_t vertex = 0;
    Interval t;
};

class ArcOrder {
  public:
    ArcOrder(const ArcSet& set, PlanarStats& stats) : set_(set), stats_(stats), same_(set.vertices.size()) {}

    /// Sorts the vertices on an arc (its ends among them) and unites those at one parameter; one entry of each remains.
    void sort(const Arc& arc, std::vector<OnArc>& entries);

    /// Representatives: valid when all arcs are sorted. The smallest vertex of each set.
    [[nodiscard]] std::uint32_t representative(std::uint32_t vertex) { return same_.find(vertex); }
    /// A vertex that could not be compared with another, or that lies beyond its arc's ends.
    [[nodiscard]] const std::optional<std::uint32_t>& conflict() const { return conflict_; }

  private:
    int compare(const Arc& arc, const OnArc& p, const OnArc& q);
    void place(const Arc& arc, std::size_t cluster, const OnArc& entry);

    const ArcSet& set_;
    PlanarStats& stats_;
    UnionFind same_;
    std::vector<OnArc> sorted_;
    std::optional<std::uint32_t> conflict_;
};

} // namespace fetexc
