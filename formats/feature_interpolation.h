// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Interpolation in a texel with feature curves (SPEC.md, section 9.2). Internal to formats/.
///
/// Frame: the texel's, local 0 … 1. Corners: bit 0 east, bit 1 south; sets have 1 << corner for each.
#pragma once

#include <array>

#include "formats/feature_curve_geometry.h"

namespace fetex {

inline constexpr std::uint32_t kFeatureCorners = 4, kFeatureAllCorners = 15;

/// What a texel has, but for its maps.
struct FeatureTexel {
    FeatureSegmentList segments;
    std::array<FeatureQuadratic, 2> curves; ///< of segments
    std::array<double, 4> positions{};      ///< of the edges' points, by feature_edge_index
    std::uint32_t open = 0;                 ///< feature_open_edges
};

/// Where a point lies, and what that means for the maps.
struct FeatureRegion {
    std::uint32_t corners = kFeatureAllCorners; ///< the set of those it reaches
    /// Those on the other side of each segment, and how much the second one's count: the nearer, the more.
    std::array<std::uint32_t, 2> across = {kFeatureAllCorners, kFeatureAllCorners};
    double second = 0;
    double distance = 0;
    /// How near to each segment: 1 on it, 0 on the edges that it doesn't end on; and where along it, from its first
    /// edge, 0, to its second, 1.
    std::array<double, 2> nearness{}, along{};
};
FeatureRegion feature_region(const FeatureTexel& texel, const std::array<double, 4>& distances, FeaturePoint p);

/// Bilinear weights of a set of corners, not empty: those of the others are 0, they add up to 1.
std::array<double, 4> feature_bilinear(std::uint32_t corners, FeaturePoint p);

/// Weights of the corners at a point that reaches a set of them: not negative, they add up to 1.
std::array<double, 4> feature_weights(const FeatureTexel& texel, std::uint32_t corners, FeaturePoint p);

/// How much the profiles of a texel's corners and of its edges' points count at a point: not negative, they add up to
/// 1.
struct FeatureProfileWeights {
    std::array<double, 4> corners{}, edges{}; ///< edges: by feature_edge_index
};
FeatureProfileWeights feature_profile_weights(const FeatureTexel& texel, const FeatureRegion& region, FeaturePoint p);

} // namespace fetex
