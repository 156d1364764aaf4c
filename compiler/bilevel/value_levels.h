// SPDX-License-Identifier: GPL-3.0-or-later
/// How the values of a texture that is cut at one half are stored.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace fetexc {

/// A value is stored / steps + its texel's offset, stored a whole number from least to most. Bytes 0 … 255 for 0 … 1
/// by default.
struct ValueLevels {
    std::uint32_t steps = 255;
    std::uint16_t least = 0, most = 255;
    int grain = 1;                  ///< the least change of a stored number that a fit tries
    std::span<const float> offsets; ///< of each texel; empty: 0

    [[nodiscard]] float offset(std::size_t texel) const { return offsets.empty() ? 0 : offsets[texel]; }
    [[nodiscard]] float value(std::size_t texel, std::uint16_t stored) const {
        const float v = static_cast<float>(stored) * (1.0F / static_cast<float>(steps));
        return offsets.empty() ? v : v + offsets[texel];
    }
    /// The nearest stored number, of a value without its offset.
    [[nodiscard]] std::uint16_t nearest(double v) const {
        return static_cast<std::uint16_t>(std::lround(std::clamp<double>(v * steps, least, most)));
    }
    [[nodiscard]] double low() const { return static_cast<double>(least) / steps; }
    [[nodiscard]] double high() const { return static_cast<double>(most) / steps; }
};

} // namespace fetexc
