// SPDX-License-Identifier: GPL-3.0-or-later
/// Zones of an image from features drawn over it, open ones too (Tarini and Cignoni 2005, §6.2, §6.3).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/bilevel/silhouette.h"
#include "compiler/raster/feature_scene.h"
#include "formats/pinchmap.h"

namespace fetexc {

/// A line in the features' frame.
struct ClosingLine {
    CanvasPoint from, to;
};

struct FeatureZones {
    Silhouette silhouette;
    std::vector<ClosingLine> closing; ///< edges of the silhouette, about, that no feature is
};

/// Every feature is an edge between two zones: above is what an odd number of closed curves encloses. An open one is
/// closed first: outside the canvas if it ends there on both sides, else around a strip of three clusters beside it, on
/// its outer side. width, height: clusters. Errors: 3001, 3002, 3004, those of silhouette_of.
Result<FeatureZones> feature_zones(const FeatureCurves& features, std::uint32_t width, std::uint32_t height,
                                   unsigned threads);

/// Scales the directions of active texels by strengths: 0 on closing lines, 1 from two clusters away on, evenly
/// between. So a feature starts smoothly at an open end, and where it was closed nothing is pinched. size: of the
/// features' frame. Returns the texels below 1.
std::uint64_t taper(std::span<const ClosingLine> closing, const FeatureCurves& frame, std::uint32_t width,
                    std::uint32_t height, std::vector<fetex::PinchmapTexel>& map);

} // namespace fetexc
