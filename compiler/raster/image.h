// SPDX-License-Identifier: GPL-3.0-or-later
/// An image as the compiler takes it (FBT §4.1).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "compiler/scene/scene.h"

namespace fetexc {

inline constexpr std::uint32_t kMaxImageSide = 16384;
inline constexpr std::uint64_t kMaxImagePixels = std::uint64_t{1} << 26;

/// Pixel (x,y) covers [x,x+1)×[y,y+1), y down; its value is that of its centre. Channels R, G, B, A: sRGB-encoded,
/// premultiplied, 65535 = 1.
struct RasterImage {
    std::uint32_t width = 0, height = 0; ///< 1 … kMaxImageSide
    std::vector<std::uint16_t> rgba;     ///< rows from the top, 4·width·height

    [[nodiscard]] Rgba at(std::uint32_t x, std::uint32_t y) const {
        const std::uint16_t* p = rgba.data() + 4 * (std::size_t{y} * width + x);
        return {p[0] / 65535.0, p[1] / 65535.0, p[2] / 65535.0, p[3] / 65535.0};
    }
};

} // namespace fetexc
