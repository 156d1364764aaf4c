// SPDX-License-Identifier: GPL-3.0-or-later
/// Features from the image itself (FBT §4.1), through Potrace.
#pragma once

#include "compiler/raster/feature_scene.h"
#include "compiler/raster/image.h"

namespace fetexc {

struct TraceOptions {
    double contrast = 0.1;   ///< least difference of a channel, 0…1, across a feature
    std::uint32_t speck = 4; ///< pixels: outlines around less are left out
};

/// Edges of the image in its own pixels: runs along which a channel changes by at least the contrast within three
/// pixels, and what continues them at half of it. Runs end where the edge fades. Error 1104.
Result<FeatureCurves> trace_features(const RasterImage& image, const TraceOptions& options);

} // namespace fetexc
