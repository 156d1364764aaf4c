// SPDX-License-Identifier: GPL-3.0-or-later
/// Mean colours over the cells of a grid, by exact areas. In: a planar map; out: sums over blocks of its texels.
#pragma once

#include <vector>

#include "compiler/compile.h"
#include "compiler/planar/planar_map.h"
#include "compiler/scene/compositor.h"

namespace fetexc {

/// Mean colours of a picture of width×height pixels, premultiplied sRGB, row-major.
struct MeanPicture {
    std::uint32_t width = 0, height = 0;
    std::vector<Rgba> colors;
};

/// Means over blocks of `columns` × `rows` texels of the map, which must divide its grid. Solid regions by the areas of
/// their trapezoids (budget::kAreaRounding); others by Gauss points, to budget::kMeanTolerance. The same for any number
/// of threads. False: the map contradicts itself.
bool block_means(const PlanarMap& map, const Scene& scene, Compositor& compositor, std::uint32_t columns,
                 std::uint32_t rows, unsigned threads, MeanPicture& out, MipStats& stats);

/// The same over blocks of another picture's pixels.
MeanPicture block_means(const MeanPicture& fine, std::uint32_t columns, std::uint32_t rows, unsigned threads);

} // namespace fetexc
