// SPDX-License-Identifier: GPL-3.0-or-later
/// What the error measures judge: anything with a colour at every point, magnified without limit. Assets, bitmaps and
/// the alternatives of `bench` are all asked in the same way.
#pragma once

#include <cstdint>
#include <string>

#include "compiler/compile.h"
#include "compiler/scene/scene.h"

namespace fetexc::measure {

/// Texture space: u right, v down, [0,1]² over the canvas.
struct TexturePoint {
    double u = 0, v = 0;
};

/// Const members are thread-safe.
class Picture {
  public:
    virtual ~Picture() = default;
    /// What a sampler shows at the point: premultiplied sRGB, 0…1. Outside [0,1]²: the border's colour.
    [[nodiscard]] virtual Rgba at(TexturePoint p) const = 0;
    /// The unit of "texels" in figures.
    [[nodiscard]] virtual GridSize texels() const = 0;
    /// Bytes of the textures on a GPU.
    [[nodiscard]] virtual std::uint64_t gpu_bytes() const = 0;
};

} // namespace fetexc::measure
