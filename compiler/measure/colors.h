// SPDX-License-Identifier: GPL-3.0-or-later
/// Arithmetic of colours, as figures compare and average them. All are premultiplied.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "compiler/scene/scene.h"

namespace fetexc::measure {

/// Largest difference of a channel.
[[nodiscard]] inline double contrast(const Rgba& a, const Rgba& b) {
    return std::max({std::fabs(a.r - b.r), std::fabs(a.g - b.g), std::fabs(a.b - b.b), std::fabs(a.a - b.a)});
}

/// Squared, of all four channels.
[[nodiscard]] inline double color_distance(const Rgba& a, const Rgba& b) {
    const double dr = a.r - b.r, dg = a.g - b.g, db = a.b - b.b, da = a.a - b.a;
    return dr * dr + dg * dg + db * db + da * da;
}

/// Mean over r, g, b, composited over black and over white.
[[nodiscard]] inline double square_error(const Rgba& a, const Rgba& b) {
    double sum = 0;
    const double alpha = a.a - b.a;
    for (const double d : {a.r - b.r, a.g - b.g, a.b - b.b})
        sum += d * d + (d - alpha) * (d - alpha);
    return sum / 6;
}

/// PSNR in dB; infinite for none.
[[nodiscard]] inline double decibels(double mean_square_error) {
    return mean_square_error > 0 ? -10 * std::log10(mean_square_error) : std::numeric_limits<double>::infinity();
}

inline void add(Rgba& sum, const Rgba& c, double weight) {
    sum.r += weight * c.r, sum.g += weight * c.g, sum.b += weight * c.b, sum.a += weight * c.a;
}

[[nodiscard]] inline Rgba mix(const Rgba& a, const Rgba& b, double t) {
    return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b), a.a + t * (b.a - a.a)};
}

/// 0…1 to 0…255.
[[nodiscard]] inline std::uint8_t to_byte(double value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255));
}

} // namespace fetexc::measure
