// SPDX-License-Identifier: GPL-3.0-or-later
/// Insertion of curves into the grid (Parilov and Zorin 2008, §4; steps 2 and 3 of README.md), but for what happens
/// around their vertices.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "compiler/feature_curves/edge_points.h"
#include "compiler/feature_curves/grid_walk.h"
#include "compiler/feature_curves/lattice_curves.h"
#include "compiler/feature_curves/snapping.h"

namespace fetexc {

/// Where a curve leaves the texel of its first vertex, and comes into that of its last. FeatureEdge{}: it doesn't, or
/// the texel isn't on the canvas.
struct CurveArms {
    std::array<fetex::FeatureEdge, 2> edge{};
    std::array<double, 2> position{};
};

/// As in SnapStats.
struct InsertionCounts {
    std::uint64_t crossings = 0, segments = 0, folded = 0;
    void add(const InsertionCounts& c) { crossings += c.crossings, segments += c.segments, folded += c.folded; }
};

struct InsertedCurves {
    std::vector<SnappedTexel> texels; ///< row by row
    EdgePoints points;
    EdgeDirections directions; ///< empty if everything is straight
    EdgeProfiles profiles;     ///< empty if all are 0
    std::vector<CurveArms> arms;
    InsertionCounts counts;
};

/// Curves in their order, in each texel and on each edge. Lines are inserted in bands of rows, so that the memory of a
/// band's edges stays close to the processor, by `threads` threads (0: all), with the same result for any number.
/// tangents: whether there are to be directions; then there is one band.
InsertedCurves insert_curves(const LatticeCurves& curves, const Grid& grid, bool tangents, unsigned threads);

/// Inserts one of the six segments in a texel, by the table.
inline void insert_segment(SnappedTexel& texel, std::uint32_t segment) {
    texel.segments = kTransformations[texel.segments][segment];
    texel.inserted = static_cast<SegmentSet>(texel.inserted | 1u << segment);
}

inline PlanarPoint planar_point(const Grid& grid, const LatticePoint& p) { return {p.x * grid.kx, p.y * grid.ky}; }
/// Of a vertex.
inline PlanarPoint planar_point(const LatticeCurves& curves, const Grid& grid, std::uint32_t vertex) {
    return planar_point(grid, curves.vertices[vertex]);
}

} // namespace fetexc
