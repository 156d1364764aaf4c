// SPDX-License-Identifier: GPL-3.0-or-later
/// Distances and their gradients at the corners of a texture's texels (Parilov and Zorin 2008, §4, rasterisation of the
/// distance field and its gradient). Frame: texels, x right, y down.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/feature_curves/texture_segments.h"
#include "formats/feature_curves.h"

namespace fetexc {

struct DistanceGradient {
    double x = 0, y = 0;
    friend bool operator==(const DistanceGradient&, const DistanceGradient&) = default;
};

/// Both arrays: (width+1)·(height+1), row by row.
struct DistanceMap {
    std::uint32_t width = 0, height = 0; ///< texels
    double limit = 0;                    ///< texels: where curves are as far or farther, this is the distance
    std::vector<double> distances;
    /// From the nearest point of any curve towards the corner, of length 1; smoothed, of at most 1; 0 at the limit. At
    /// a corner that lies on a curve: at right angles to it, towards the side that the corner counts as.
    std::vector<DistanceGradient> gradients;
    /// If the texture has several: of the nearest curve, there of the end that is nearer; at the limit that of the
    /// nearest corner beside, if one is below it.
    std::vector<std::uint8_t> profiles;
};

/// Exact but for rounding (straight segments) and budget::kDistanceAccuracy (others). limit > 0, texels; threads: 0:
/// all; never changes a bit.
DistanceMap distance_map(const TextureSegments& segments, double limit, unsigned threads);

/// Constrained Laplacian smoothing (§4): in each iteration every gradient moves half the way to the mean of those at
/// the corners next to its own, left, right, above and below, but not to those across a point of a curve, nor to those
/// at the limit. Distances stay.
void smooth_gradients(DistanceMap& map, const fetex::FeatureCurvesTexture& texture, std::uint32_t iterations,
                      unsigned threads);

/// The paper's number of iterations.
inline constexpr std::uint32_t kGradientIterations = 10;

} // namespace fetexc
