// SPDX-License-Identifier: GPL-3.0-or-later
/// Base maps: an image resampled to the corners of a texture's texels (Parilov and Zorin 2008, §3).
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/raster/image.h"
#include "formats/feature_curves.h"

namespace fetexc {

/// What an image holds.
enum class BaseImageKind {
    Color,
    Normal, ///< (n + 1) / 2 in R, G, B; z out of the picture
    Height, ///< in R
};

struct BaseImage {
    const RasterImage* image = nullptr;
    BaseImageKind kind = BaseImageKind::Color;
    bool y_up = true;        ///< of normals: as glTF and OpenGL have it; else down
    double height_scale = 1; ///< of heights: what 1 stands for, in texels
};

struct NormalVector {
    double x = 0, y = 0, z = 1; ///< x right, y down, z out of the texture
};

/// Means over a texel around each corner, or over a pixel where pixels are larger, of the part that the image has.
/// (width+1)·(height+1), row by row. threads: 0: all; never changes a bit.
std::vector<Rgba> corner_colors(const RasterImage& image, std::uint32_t width, std::uint32_t height, unsigned threads);

/// Unit normals at the corners. Of heights: of the bilinear surface through the corners' heights, by differences across
/// two texels (one at the border). Precondition: the image isn't one of colours.
std::vector<NormalVector> corner_normals(const BaseImage& base, std::uint32_t width, std::uint32_t height,
                                         unsigned threads);

} // namespace fetexc
