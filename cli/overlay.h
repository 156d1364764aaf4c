// SPDX-License-Identifier: GPL-3.0-or-later
/// What a texture is made of, drawn over its picture.
#pragma once

#include "formats/feature_curves.h"
#include "formats/pinchmap.h"
#include "formats/silmap.h"
#include "runtime_glsl/host/image.h"

namespace fetexc::cli {

/// Boundaries, the points they join, and where there is room the other links of the cells with boundaries, the cells'
/// sides and the texels' colours, as in the paper's Fig. 1 (E). The image shows the view.
void draw_overlay(const fetex::SilmapTexture& texture, const fetex::View& view, fetex::Image& image);

/// Discontinuities, and where there is room the active texels of the map, which way they pinch, and the clusters.
void draw_overlay(const fetex::PinchmapTexture& texture, const fetex::View& view, fetex::Image& image);

/// Feature curves and their points on the texels' edges, and where there is room the texels' sides.
void draw_overlay(const fetex::FeatureCurvesTexture& texture, const fetex::View& view, fetex::Image& image);

} // namespace fetexc::cli
