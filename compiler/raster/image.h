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
/// premultiplied, 65535 = 1: numbers of 16 bits are exact. None is negative, alpha is at most 1; colours may exceed
/// alpha, and 1, if the samples are to be halves.
struct RasterImage {
    std::uint32_t width = 0, height = 0; ///< 1 … kMaxImageSide
    std::vector<float> rgba;             ///< rows from the top, 4·width·height

    [[nodiscard]] Rgba at(std::uint32_t x, std::uint32_t y) const {
        const float* p = rgba.data() + 4 * (std::size_t{y} * width + x);
        const auto channel = [&](int k) { return static_cast<double>(p[k]) / 65535; };
        return {channel(0), channel(1), channel(2), channel(3)};
    }
};

} // namespace fetexc
