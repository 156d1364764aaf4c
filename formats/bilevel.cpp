// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "formats/bilevel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/fbt_mip.h"

namespace fetex {
namespace {

constexpr double kThreshold = 0.5;

FbtColor mix(const FbtColor& a, const FbtColor& b, double t) {
    return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b), a.a + t * (b.a - a.a)};
}

FbtColor color_of(std::uint32_t rgba8) {
    const auto channel = [&](unsigned shift) { return static_cast<double>(rgba8 >> shift & 0xffu) / 255; };
    return {channel(0), channel(8), channel(16), channel(24)};
}

/// The two samples around a position along an axis, those at the border repeated, and how far it is from the first to
/// the second. Sample i stands at i + 1/2.
struct Neighbours {
    std::uint32_t first = 0, second = 0;
    double weight = 0;

    /// local: offset from the left side of sample i, 0…1.
    static Neighbours around(std::uint32_t i, double local, std::uint32_t samples) {
        if (local < 0.5) return {i > 0 ? i - 1 : 0, i, local + 0.5};
        return {i, std::min(i + 1, samples - 1), local - 0.5};
    }
    /// position: 0 … samples.
    static Neighbours around(double position, std::uint32_t samples) {
        const auto i = std::min(static_cast<std::uint32_t>(position), samples - 1);
        return around(i, position - i, samples);
    }
};

/// NaN becomes 0.
double clamp_to(double v, double most) { return v > 0 ? std::min(v, most) : 0.0; }

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
    const auto column = Neighbours::around(x / t.width * t.image_width, t.image_width),
               row = Neighbours::around(y / t.height * t.image_height, t.image_height);
    const auto at = [&](std::uint32_t i, std::uint32_t j) {
        return color_of(t.image[std::size_t{j} * t.image_width + i]);
    };
    const auto along_row = [&](std::uint32_t j) {
        return mix(at(column.first, j), at(column.second, j), column.weight);
    };
    return mix(along_row(row.first), along_row(row.second), row.weight);
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

/// The coarsest level whose scale is at most `side`; 0 if there is none. Scales lie from 2^k to below 2^(k+1).
std::uint32_t finer_level(const BilevelTexture& t, double side) {
    const std::uint32_t n = fbt_mip_levels(t.width, t.height);
    std::uint32_t k = 0;
    while (k < n && fbt_mip_scale(t.width, t.height, k + 1) <= side)
        ++k;
    return k;
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

/// From 1/2 outwards t and the coverage grow alike until a corner of the pixel meets the edge. From there on the
/// coverage grows ever less, until the opposite side is met: `beyond` of `shorter`. Only that quotient is squared, so a
/// shorter of next to nothing does no harm.
double bilevel_coverage(const BilevelValue& value, BilevelPixel pixel) {
    const auto [shorter, longer] = std::minmax({std::abs(value.dx) * clamp_to(pixel.width, 1), //
                                                std::abs(value.dy) * clamp_to(pixel.height, 1)});
    if (!(longer > 0)) return value.t > kThreshold ? 1 : 0;
    const double from_edge = std::abs(value.t - kThreshold);
    const double beyond = std::clamp(from_edge - (longer - shorter) / 2, 0.0, shorter);
    const double missing = shorter > 0 ? beyond * (beyond / shorter) / 2 : 0;
    return std::clamp(0.5 + std::copysign((from_edge - missing) / longer, value.t - kThreshold), 0.0, 1.0);
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
    const auto column = Neighbours::around(clamp_to(x / texture.width, 1) * level.width, level.width),
               row = Neighbours::around(clamp_to(y / texture.height, 1) * level.height, level.height);
    const auto at = [&](std::uint32_t i, std::uint32_t j) {
        return texture.mips[level.first + std::uint64_t{j} * level.width + i] / 255.0;
    };
    return std::lerp(std::lerp(at(column.first, row.first), at(column.second, row.first), column.weight),
                     std::lerp(at(column.first, row.second), at(column.second, row.second), column.weight), row.weight);
}

FbtColor bilevel_sample_mip(const BilevelTexture& texture, double x, double y, BilevelPixel pixel) {
    const double side = std::max({0.0, pixel.width, pixel.height});
    const std::uint32_t n = fbt_mip_levels(texture.width, texture.height), k = finer_level(texture, side);
    double coverage =
        k == 0 ? bilevel_coverage(bilevel_value(texture, x, y), pixel) : bilevel_mip_coverage(texture, k, x, y);
    const double from = fbt_mip_scale(texture.width, texture.height, k);
    if (k < n && side > from) {
        const double part =
            std::log(side / from) / std::log(fbt_mip_scale(texture.width, texture.height, k + 1) / from);
        coverage = std::lerp(coverage, bilevel_mip_coverage(texture, k + 1, x, y), part * part);
    }
    return color_of_coverage(texture, coverage, clamp_to(x, texture.width), clamp_to(y, texture.height));
}

} // namespace fetex
