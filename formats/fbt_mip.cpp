// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "formats/fbt_mip.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace fetex {
namespace {

/// Taps: a ratio of sides halfway between two numbers gives the lower one, in float as in double.
constexpr double kTapSlack = 0x1p-10;

FbtColor mix(const FbtColor& a, const FbtColor& b, double t) {
    return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b), a.a + t * (b.a - a.a)};
}

FbtColor color_of(std::uint32_t rgba8) {
    const auto channel = [&](unsigned shift) { return static_cast<double>(rgba8 >> shift & 0xffu) / 255; };
    return {channel(0), channel(8), channel(16), channel(24)};
}

/// The two samples around a position along one axis of a level, and how far it is from the first to the second.
struct Neighbours {
    std::uint32_t first = 0, second = 0;
    double weight = 0;
    Neighbours(double position, std::uint32_t texels, std::uint32_t samples) {
        const double part = position > 0 ? std::min(position / texels, 1.0) : 0.0; // NaN becomes 0
        const double at = part * samples - 0.5;
        const double floor = std::floor(at);
        const auto clamped = [&](double v) { return static_cast<std::uint32_t>(std::clamp(v, 0.0, samples - 1.0)); };
        first = clamped(floor), second = clamped(floor + 1), weight = at - floor;
    }
};

FbtColor sample_square(const FbtTexture& t, double x, double y, double side, bool exact) {
    return side > 0 ? fbt_sample_area(t, x, y, {side / 2, side / 2, exact}) : fbt_sample(t, x, y);
}

} // namespace

std::uint32_t fbt_mip_levels(std::uint32_t width, std::uint32_t height) {
    return std::max(1u, static_cast<std::uint32_t>(std::bit_width(std::max(width, height))) - 1u);
}

FbtMipLevel fbt_mip_level(std::uint32_t width, std::uint32_t height, std::uint32_t k) {
    FbtMipLevel level;
    for (std::uint32_t n = 1; n <= k; ++n) {
        level.first += level.samples();
        level.width = std::max(width >> n, 1u), level.height = std::max(height >> n, 1u);
    }
    return level;
}

std::uint64_t fbt_mip_samples(std::uint32_t width, std::uint32_t height) {
    const FbtMipLevel last = fbt_mip_level(width, height, fbt_mip_levels(width, height));
    return last.first + last.samples();
}

double fbt_mip_scale(std::uint32_t width, std::uint32_t height, std::uint32_t k) {
    if (k == 0) return 1;
    const FbtMipLevel level = fbt_mip_level(width, height, k);
    return std::max(static_cast<double>(width) / level.width, static_cast<double>(height) / level.height);
}

std::uint32_t fbt_mip_finer_level(std::uint32_t width, std::uint32_t height, double side) {
    if (!(side > 0)) return 0;
    const std::uint32_t n = fbt_mip_levels(width, height);
    if (!(side < fbt_mip_scale(width, height, n))) return n;
    // Scales lie from 2^k to below 2^(k+1).
    const auto k = static_cast<std::uint32_t>(std::max(std::floor(std::log2(side)), 0.0));
    return k > 0 && fbt_mip_scale(width, height, k) > side ? k - 1 : k;
}

FbtColor fbt_mip_color(std::span<const std::uint32_t> mips, std::uint32_t width, std::uint32_t height, std::uint32_t k,
                       double x, double y) {
    const FbtMipLevel level = fbt_mip_level(width, height, k);
    const Neighbours column(x, width, level.width), row(y, height, level.height);
    const auto at = [&](std::uint32_t i, std::uint32_t j) {
        return color_of(mips[level.first + std::uint64_t{j} * level.width + i]);
    };
    const auto along_row = [&](std::uint32_t j) {
        return mix(at(column.first, j), at(column.second, j), column.weight);
    };
    return mix(along_row(row.first), along_row(row.second), row.weight);
}

FbtColor fbt_sample_mip(const FbtTexture& texture, double x, double y, double texels_per_pixel, bool exact) {
    const double side = texels_per_pixel > 0 ? texels_per_pixel : 0.0; // NaN becomes 0
    const std::uint32_t n = fbt_mip_levels(texture.width, texture.height),
                        k = fbt_mip_finer_level(texture.width, texture.height, side);
    const auto level = [&](std::uint32_t at) {
        return fbt_mip_color(texture.mips, texture.width, texture.height, at, x, y);
    };
    const FbtColor fine = k == 0 ? sample_square(texture, x, y, std::min(side, 1.0), exact) : level(k);
    if (k == n) return fine;
    const double from = fbt_mip_scale(texture.width, texture.height, k),
                 to = fbt_mip_scale(texture.width, texture.height, k + 1);
    if (side <= from) return fine;
    return mix(fine, level(k + 1), std::log(side / from) / std::log(to / from));
}

FbtColor fbt_sample_mip_aniso(const FbtTexture& texture, double x, double y, FbtVector dx, FbtVector dy, bool exact) {
    const double length_x = std::hypot(dx.x, dx.y), length_y = std::hypot(dy.x, dy.y);
    const FbtVector axis = length_x >= length_y ? dx : dy;
    const double length = std::max(length_x, length_y);
    const double height = length > 0 ? std::abs(dx.x * dy.y - dx.y * dy.x) / length : 0;
    const double ratio = length > 0 ? length / std::max(height, length / kFbtMipMaxTaps) : 1.0;
    const double taps = std::max(1.0, std::floor(ratio + 0.5 - kTapSlack)), side = std::max(length / taps, height);
    FbtColor sum;
    for (double tap = 0; tap < taps; ++tap) {
        const double along = (tap + 0.5) / taps - 0.5;
        const FbtColor c = fbt_sample_mip(texture, x + along * axis.x, y + along * axis.y, side, exact);
        sum.r += c.r, sum.g += c.g, sum.b += c.b, sum.a += c.a;
    }
    return {sum.r / taps, sum.g / taps, sum.b / taps, sum.a / taps};
}

} // namespace fetex
