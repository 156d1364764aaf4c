// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "formats/bilevel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/fbt_mip.h"
#include "formats/interpolation.h"

namespace fetex {
namespace {

constexpr double kThreshold = 0.5;

BilevelValue channel_value(const BilevelTexture& t, std::uint32_t channel, const Neighbours& column,
                           const Neighbours& row) {
    const auto at = [&](std::uint32_t i, std::uint32_t j) {
        return t.texels[(std::size_t{j} * t.width + i) * t.channels + channel] / 255.0;
    };
    const double upper_left = at(column.first, row.first), upper_right = at(column.second, row.first),
                 lower_left = at(column.first, row.second), lower_right = at(column.second, row.second);
    const double upper = std::lerp(upper_left, upper_right, column.weight),
                 lower = std::lerp(lower_left, lower_right, column.weight);
    return {std::lerp(upper, lower, row.weight),
            std::lerp(upper_right - upper_left, lower_right - lower_left, row.weight), lower - upper};
}

/// The channel whose value the rule takes, the first of those with the same value.
BilevelValue combine(BilevelRule rule, const std::array<BilevelValue, 3>& c) {
    switch (rule) {
    case BilevelRule::Single:
        break;
    case BilevelRule::Min:
        return c[1].t < c[0].t ? c[1] : c[0];
    case BilevelRule::Max:
        return c[1].t > c[0].t ? c[1] : c[0];
    case BilevelRule::Median: {
        const double least = std::min(c[0].t, c[1].t), most = std::max(c[0].t, c[1].t);
        const double median = std::max(least, std::min(most, c[2].t));
        return *std::ranges::find(c, median, &BilevelValue::t);
    }
    }
    return c[0];
}

BilevelValue value_between(const BilevelTexture& t, const Neighbours& column, const Neighbours& row) {
    std::array<BilevelValue, 3> channels;
    for (std::uint32_t k = 0; k < t.channels; ++k)
        channels[k] = channel_value(t, k, column, row);
    return combine(t.rule, channels);
}

/// The colour above at a point of the texture.
FbtColor color_above(const BilevelTexture& t, double x, double y) {
    if (t.image.empty()) return color_of(t.above);
    return interpolated(
        Neighbours::around(x, t.width, t.image_width), Neighbours::around(y, t.height, t.image_height),
        [&](std::uint32_t i, std::uint32_t j) { return color_of(t.image[std::size_t{j} * t.image_width + i]); });
}

FbtColor color_of_coverage(const BilevelTexture& t, double coverage, double x, double y) {
    return mix(color_of(t.below), color_above(t, x, y), coverage);
}

/// Whole and fractional part of a coordinate clamped to the texture.
std::pair<std::uint32_t, double> texel_and_local(double v, std::uint32_t size) {
    const double clamped = clamp_to(v, size);
    const auto i = std::min(static_cast<std::uint32_t>(clamped), size - 1);
    return {i, clamped - i};
}

} // namespace

std::uint32_t bilevel_channels(BilevelRule rule) {
    return rule == BilevelRule::Single ? 1 : rule == BilevelRule::Median ? 3 : 2;
}

std::uint64_t bilevel_gpu_bytes(const BilevelTexture& t) {
    return std::uint64_t{t.texels.size()} + t.mips.size() + 4 * std::uint64_t{t.image.size()};
}

BilevelValue bilevel_value_local(const BilevelTexture& texture, std::uint32_t i, std::uint32_t j, double fx,
                                 double fy) {
    return value_between(texture, Neighbours::around(i, clamp_to(fx, 1), texture.width),
                         Neighbours::around(j, clamp_to(fy, 1), texture.height));
}

BilevelValue bilevel_value(const BilevelTexture& texture, double x, double y) {
    const auto [i, fx] = texel_and_local(x, texture.width);
    const auto [j, fy] = texel_and_local(y, texture.height);
    return bilevel_value_local(texture, i, j, fx, fy);
}

double bilevel_coverage(const BilevelValue& value, BilevelPixel pixel) {
    return cut_coverage(value.t - kThreshold, std::abs(value.dx) * clamp_to(pixel.width, 1),
                        std::abs(value.dy) * clamp_to(pixel.height, 1));
}

FbtColor bilevel_sample_area_local(const BilevelTexture& texture, std::uint32_t i, std::uint32_t j, double fx,
                                   double fy, BilevelPixel pixel) {
    const double coverage = bilevel_coverage(bilevel_value_local(texture, i, j, fx, fy), pixel);
    return color_of_coverage(texture, coverage, i + clamp_to(fx, 1), j + clamp_to(fy, 1));
}

FbtColor bilevel_sample_area(const BilevelTexture& texture, double x, double y, BilevelPixel pixel) {
    const auto [i, fx] = texel_and_local(x, texture.width);
    const auto [j, fy] = texel_and_local(y, texture.height);
    return bilevel_sample_area_local(texture, i, j, fx, fy, pixel);
}

FbtColor bilevel_sample(const BilevelTexture& texture, double x, double y) {
    return bilevel_sample_area(texture, x, y, {});
}

FbtColor bilevel_sample_local(const BilevelTexture& texture, std::uint32_t i, std::uint32_t j, double fx, double fy) {
    return bilevel_sample_area_local(texture, i, j, fx, fy, {});
}

double bilevel_mip_coverage(const BilevelTexture& texture, std::uint32_t k, double x, double y) {
    const FbtMipLevel level = fbt_mip_level(texture.width, texture.height, k);
    const auto column = Neighbours::around(x, texture.width, level.width),
               row = Neighbours::around(y, texture.height, level.height);
    const auto at = [&](std::uint32_t i, std::uint32_t j) {
        return texture.mips[level.first + std::uint64_t{j} * level.width + i] / 255.0;
    };
    return std::lerp(std::lerp(at(column.first, row.first), at(column.second, row.first), column.weight),
                     std::lerp(at(column.first, row.second), at(column.second, row.second), column.weight), row.weight);
}

FbtColor bilevel_sample_mip(const BilevelTexture& texture, double x, double y, BilevelPixel pixel) {
    const auto [k, part] = fbt_mip_place(texture.width, texture.height, std::max({0.0, pixel.width, pixel.height}));
    double coverage =
        k == 0 ? bilevel_coverage(bilevel_value(texture, x, y), pixel) : bilevel_mip_coverage(texture, k, x, y);
    if (part > 0) coverage = std::lerp(coverage, bilevel_mip_coverage(texture, k + 1, x, y), part * part);
    return color_of_coverage(texture, coverage, clamp_to(x, texture.width), clamp_to(y, texture.height));
}

} // namespace fetex
