// SPDX-License-Identifier: GPL-3.0-or-later
/// Where an image's transitions are soft, so that its pinchmap shouldn't cut (Tarini and Cignoni 2005, §7.2 step 5).
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/bilevel/silhouette.h"
#include "compiler/raster/image.h"
#include "formats/pinchmap.h"

namespace fetexc {

/// Scales the directions of active texels by strengths: 1 where the image's alpha goes from one side of the outline to
/// the other within 3 pixels, 0 from 6 on, evenly between. Between texels strengths are interpolated, so a
/// discontinuity tapers (§6.2). Images whose alpha doesn't vary have none that is soft. Returns the texels below 1.
std::uint64_t soften(const RasterImage& image, const Silhouette& silhouette, std::uint32_t width, std::uint32_t height,
                     std::vector<fetex::PinchmapTexel>& map);

} // namespace fetexc
