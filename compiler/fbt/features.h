// SPDX-License-Identifier: GPL-3.0-or-later
/// From the faces and edges of one texel to bands of ordered simple features (FBT §3.2, §4.5).
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/planar/texel_map.h"

namespace fetexc {

/// One edge of a simple feature in chain order; forward: runs with growing t.
struct FeatureStep {
    std::uint32_t sub = 0; ///< index into the texel's sub-edges
    bool forward = true;
};

/// A chain that splits its band into two. The region of `inside` lies where a ray in direction `ray` meets the chain an
/// odd number of times.
struct SimpleFeature {
    std::vector<FeatureStep> steps;
    std::uint32_t ray = 0;                 ///< fetex::kFbtRay…
    std::uint32_t inside = 0, outside = 0; ///< band faces
};

struct Band {
    double y0 = 0, y1 = 0;               ///< planar space
    std::vector<SimpleFeature> features; ///< in the order of the region test
    std::vector<std::uint32_t> regions;  ///< region of each feature's inside, then of what is left
};

struct TexelFeatures {
    std::vector<Band> bands;                   ///< empty: no visible edge
    std::vector<std::uint32_t> region_of_face; ///< first sweep's face → region
    std::vector<ResultId> region_result;
    std::uint32_t corner_region = 0; ///< holds the texel's corner (i,j)
    std::uint64_t edges_visible = 0, edges_invisible = 0;
};

/// Drops edges with the same visible result on both sides, cuts at the junctions of the rest, chains, directs and
/// orders them. False: the chains don't form a tree of regions (an internal contradiction, reported by the caller).
bool build_features(const PlanarMap& map, TexelMapper& mapper, const TexelMap& texel, TexelFeatures& out);

} // namespace fetexc
