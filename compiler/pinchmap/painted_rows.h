// SPDX-License-Identifier: GPL-3.0-or-later
/// The colours of a drawing along rows of points, for textures whose samples are fitted to them.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "compiler/bilevel/silhouette.h"
#include "compiler/raster/image.h"
#include "compiler/result.h"
#include "compiler/scene/scene.h"

namespace fetexc {

/// A point's colour, premultiplied.
struct PaintedPoint {
    Rgba color;
    bool clean = true; ///< false: a pixel at an edge, which mixes the colours of its sides
};

/// columns × rows points in the middles of equal rectangles of the canvas.
struct PointGrid {
    std::uint32_t columns = 0, rows = 0;
};

/// Sets the points of a row. Any thread.
using RowPainter = std::function<void(std::uint32_t row, std::span<PaintedPoint> points)>;

/// Each point has the exact colour there. The scene must outlive the painter. Errors: those of visible_edges.
Result<RowPainter> scene_painter(const Scene& scene, PointGrid grid, unsigned threads);

/// Each point has its pixel's colour; not clean: pixels beside or on the silhouette's outline. The image must outlive
/// the painter.
RowPainter image_painter(const RasterImage& image, const Silhouette& silhouette, PointGrid grid);

} // namespace fetexc
