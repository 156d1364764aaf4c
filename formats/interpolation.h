// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Bilinear interpolation of what lies in rows of samples. Sample i of an axis stands at i + 1/2; those at the border
/// are repeated. Internal to formats/.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "formats/fbt.h"

namespace fetex {

inline FbtColor mix(const FbtColor& a, const FbtColor& b, double t) {
    return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b), a.a + t * (b.a - a.a)};
}

inline FbtColor color_of(std::uint32_t rgba8) {
    const auto channel = [&](unsigned shift) { return static_cast<double>(rgba8 >> shift & 0xffu) / 255; };
    return {channel(0), channel(8), channel(16), channel(24)};
}

/// 0 … most; NaN becomes 0.
inline double clamp_to(double v, double most) { return v > 0 ? std::min(v, most) : 0.0; }

/// The two samples around a position along an axis, and how far it is from the first to the second.
struct Neighbours {
    std::uint32_t first = 0, second = 0;
    double weight = 0;

    /// local: offset from the left side of sample i, 0…1.
    static Neighbours around(std::uint32_t i, double local, std::uint32_t samples) {
        if (local < 0.5) return {i > 0 ? i - 1 : 0, i, local + 0.5};
        return {i, std::min(i + 1, samples - 1), local - 0.5};
    }
    /// A position in an axis of that many texels, over which the samples are spread; beyond its ends the nearer one.
    static Neighbours around(double position, std::uint32_t texels, std::uint32_t samples) {
        const double at = clamp_to(position / texels, 1) * samples;
        const auto i = std::min(static_cast<std::uint32_t>(at), samples - 1);
        return around(i, at - i, samples);
    }
};

/// Between four colours; at(column, row).
template <class At> FbtColor interpolated(const Neighbours& column, const Neighbours& row, const At& at) {
    const auto along_row = [&](std::uint32_t j) {
        return mix(at(column.first, j), at(column.second, j), column.weight);
    };
    return mix(along_row(row.first), along_row(row.second), row.weight);
}

/// The part of a pixel on the positive side of a straight edge, 0…1: the exact area of a rectangle cut by a line.
/// value: at the pixel's middle, 0 on the edge; changes: of it along the pixel's sides. From 1/2 outwards value and
/// part grow alike until a corner of the pixel meets the edge. From there on the part grows ever less, until the
/// opposite side is met: `beyond` of `shorter`. Only that quotient is squared, so a shorter of next to nothing does no
/// harm. Without any change 1 if the value is above 0, else 0.
inline double cut_coverage(double value, double change_x, double change_y) {
    const auto [shorter, longer] = std::minmax({std::abs(change_x), std::abs(change_y)});
    if (!(longer > 0)) return value > 0 ? 1 : 0;
    const double from_edge = std::abs(value);
    const double beyond = std::clamp(from_edge - (longer - shorter) / 2, 0.0, shorter);
    const double missing = shorter > 0 ? beyond * (beyond / shorter) / 2 : 0;
    return std::clamp(0.5 + std::copysign((from_edge - missing) / longer, value), 0.0, 1.0);
}

} // namespace fetex
