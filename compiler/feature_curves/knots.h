// SPDX-License-Identifier: GPL-3.0-or-later
/// What lines do around vertices inside a texel. A *knot* is what hangs together there: vertices, the lines between
/// them that don't leave the texel, and the *arms* that do.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/feature_curves/grid_walk.h"
#include "compiler/feature_curves/transformations.h"
#include "compiler/union_find.h"

namespace fetexc {

/// A vertex in its texel, local 0 … 1.
struct KnotVertex {
    std::uint32_t vertex = 0;
    fetex::FeaturePoint at;
    /// Edges of the texel that it lies on, exactly.
    EdgeSet on = 0;
};

struct KnotArm {
    std::uint32_t vertex = 0;
    fetex::FeatureEdge edge{};
    double position = 0;
};

/// A line between two vertices of a knot, or an arm.
struct KnotLine {
    std::uint32_t vertex = 0, other = kNone; ///< other: kNone for an arm
    fetex::FeatureEdge edge{};               ///< of an arm
    fetex::FeaturePoint from, to;
    fetex::FeaturePoint leaves, arrives; ///< tangents at both vertices; an arm's second is nothing
    bool straight = true;
    std::uint8_t profile = 0; ///< its number
};

struct Knot {
    std::uint32_t i = 0, j = 0;
    std::span<const KnotVertex> vertices; ///< by number
    std::span<const KnotArm> arms;
    std::span<const KnotLine> lines;
};

/// A point of an edge through which a knot is joined to others.
struct KnotEnd {
    fetex::FeatureEdge edge{};
    double position = 0;
};

/// How a knot is to be shown.
struct KnotShape {
    EdgeSet edges = 0;         ///< that it is joined to
    SegmentSet segments = 0;   ///< to insert, at most two: they join all of `edges`
    std::vector<KnotEnd> ends; ///< beyond its arms: points of the boundary that vertices lie on
    bool hub = false;          ///< three edges: the segments meet on the edge `hub_edge`
    fetex::FeatureEdge hub_edge{};
};

/// For each vertex the edge through which the knot is joined to others right where the vertex lies, so that the vertex
/// moves as the edge's point does; FeatureEdge{} if there is none.
std::vector<fetex::FeatureEdge> ends_of(const Knot& knot, const KnotShape& shape);

/// Index of a vertex in the knot's.
std::size_t index_in(const Knot& knot, std::uint32_t vertex);

/// Two edges are joined by a segment, four by the crossing, three by two segments that meet on one of
/// them: that from which the knot's lines are the least away. Vertices on the boundary that would be cut off become
/// ends there (a curve may touch an edge and go back, or end on it).
KnotShape shape_of(const Knot& knot);

} // namespace fetexc
