// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "formats/fbt_mip.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "formats/interpolation.h"

namespace fetex {
namespace {

/// Taps: a ratio of sides halfway between two numbers gives the lower one, in float as in double.
constexpr double kTapSlack = 0x1p-10;

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

FbtMipPlace fbt_mip_place(std::uint32_t width, std::uint32_t height, double side) {
    const std::uint32_t n = fbt_mip_levels(width, height);
    if (!(side < fbt_mip_scale(width, height, n))) return {n, 0};
    auto k = static_cast<std::uint32_t>(std::max(std::floor(std::log2(side)), 0.0));
    if (k > 0 && fbt_mip_scale(width, height, k) > side) --k;
    const double from = fbt_mip_scale(width, height, k);
    if (side <= from) return {k, 0};
    return {k, std::log(side / from) / std::log(fbt_mip_scale(width, height, k + 1) / from)};
}

FbtColor fbt_mip_color(std::span<const std::uint32_t> mips, std::uint32_t width, std::uint32_t height, std::uint32_t k,
                       double x, double y) {
    const FbtMipLevel level = fbt_mip_level(width, height, k);
    return interpolated(Neighbours::around(x, width, level.width), Neighbours::around(y, height, level.height),
                        [&](std::uint32_t i, std::uint32_t j) {
                            return color_of(mips[level.first + std::uint64_t{j} * level.width + i]);
                        });
}

FbtColor fbt_sample_mip(const FbtTexture& texture, double x, double y, double texels_per_pixel, bool exact) {
    const double side = texels_per_pixel > 0 ? texels_per_pixel : 0.0; // NaN becomes 0
    const auto [k, part] = fbt_mip_place(texture.width, texture.height, side);
    const auto level = [&](std::uint32_t at) {
        return fbt_mip_color(texture.mips, texture.width, texture.height, at, x, y);
    };
    const FbtColor fine = k == 0 ? sample_square(texture, x, y, std::min(side, 1.0), exact) : level(k);
    return part > 0 ? mix(fine, level(k + 1), part) : fine;
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
