// SPDX-License-Identifier: GPL-3.0-or-later
/// Where an image's transitions are soft, so that its pinchmap shouldn't cut (Tarini and Cignoni 2005, §7.2 step 5).
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/bilevel/silhouette.h"
#include "compiler/raster/image.h"
#include "formats/pinchmap.h"

namespace fetexc {

struct SoftEdges {
    std::uint64_t texels = 0; ///< with a strength below 1
    double widest = 0;        ///< pixels from side to side around a texel, at most
    double u = 0, v = 0;      ///< 0 … 1: where
};

/// Scales the directions of active texels by strengths: 1 where the image's colours go from one side of the outline to
/// the other within 3 pixels, 0 from 6 on, evenly between. Between texels strengths are interpolated, so a
/// discontinuity tapers (§6.2). Across the outline's pieces the way is how far colours range, in the direction in which
/// they change fastest, over how fast they do; around a texel the mean of the pieces, by their contrast. (The paper
/// asks whether alpha is far from 0 and 1; this asks any colours, at any contrast.) Where they don't change strengths
/// stay.
SoftEdges soften(const RasterImage& image, const Silhouette& silhouette, std::uint32_t width, std::uint32_t height,
                 std::vector<fetex::PinchmapTexel>& map);

} // namespace fetexc
