// SPDX-License-Identifier: GPL-3.0-or-later
/// One `Arrangement_2` of a whole scene, on our filtered traits (tests/support/global_plane): CGAL's sweep line finds
/// the crossings. The oracle of planar/arrangement.
#pragma once

#include <string>
#include <vector>

#include "compiler/planar/arcs.h"
#include "tests/support/global_plane.h"

namespace fetexc::test {

struct GlobalVertex {
    Interval x, y;
    std::size_t degree = 0;
};

struct GlobalArrangement {
    std::vector<GlobalVertex> vertices; ///< by x, then y
    std::size_t edges = 0, faces = 0;   ///< the unbounded face counts
    GlobalPlane::Counts counts;
    std::string undecided; ///< empty: all is decided
};

/// Arcs as prepare_arcs gives them, curves on one support joined; those off the canvas are left out.
GlobalArrangement arrange_globally(const Scene& scene, const Grid& grid);

/// Some part of the arc may lie on the canvas.
bool reaches_canvas(const ArcSet& set, const Arc& arc, const Grid& grid);

} // namespace fetexc::test
