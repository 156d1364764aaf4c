// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace fetexc::measure {

/// Bilinear interpolation along one axis: the two texels whose centres lie around a point, the edge repeated.
struct TexelWeights {
    /// position: 0…1 over the texture.
    TexelWeights(double position, std::uint32_t size) {
        const double last = size - 1.0, at = std::clamp(position * size - 0.5, 0.0, last), base = std::floor(at);
        index[0] = static_cast<std::uint32_t>(base);
        index[1] = std::min(index[0] + 1, size - 1);
        offset = at - base;
    }

    std::uint32_t index[2] = {};
    double offset = 0; ///< 0: on the first texel's centre
};

/// The texel that a point lies in.
inline std::uint32_t nearest_texel(double position, std::uint32_t size) {
    return static_cast<std::uint32_t>(std::clamp(std::floor(position * size), 0.0, size - 1.0));
}

} // namespace fetexc::measure
