// SPDX-License-Identifier: GPL-3.0-or-later
/// Horizontal trapezoid decomposition of one texel by CGAL (DESIGN §5.5): `Arrangement_2` finds the faces, `decompose`
/// the trapezoids. The same answer as planar/sweep, by other means and many times slower: its check in tests, and what
/// SkipRules::direct_sweep switches to.
#pragma once

#include "compiler/planar/sweep.h"

namespace fetexc {

class TexelArrangement {
  public:
    TexelArrangement(const PlanarMap& map, NodeOrder& order, PlanarStats& stats)
        : map_(map), order_(order), stats_(stats) {}

    /// What Sweep::run gives without cuts, except: parts of sides without length and trapezoids in a corner without
    /// extent are left out, faces are numbered another way. False: something stayed open, or the edges cross.
    bool run(std::span<const SubEdge> sub_edges, const SweepGraph& graph, TexelFrame frame, SweepResult& out);

  private:
    const PlanarMap& map_;
    NodeOrder& order_;
    PlanarStats& stats_;
};

} // namespace fetexc
