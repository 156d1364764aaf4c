// SPDX-License-Identifier: GPL-3.0-or-later
/// Paints as functions of a canvas point.
#pragma once

#include <optional>

#include "compiler/scene/scene.h"

namespace fetexc {

/// Premultiplied colour of a paint. Gradients interpolate straight colours (SVG 2 §14.2), then premultiply. At a hard
/// edge (equal offsets) the later stop's colour holds at and after the offset. Transparent where a radial gradient is
/// undefined.
[[nodiscard]] Rgba paint_color(const Paint& paint, CanvasPoint p);

/// The premultiplied colour if it is the same at every point.
[[nodiscard]] std::optional<Rgba> constant_color(const Paint& paint);

/// Alpha 1 at every point; may be falsely negative (rasters always are).
[[nodiscard]] bool paint_is_opaque(const Paint& paint);

/// Alpha 0 at every point; may be falsely negative.
[[nodiscard]] bool paint_is_invisible(const Paint& paint);

} // namespace fetexc
