// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The reference sampler of silhouette-map textures: points, pixels, levels.
#include "formats/silmap.h"

#include <algorithm>
#include <cmath>

#include "formats/fbt_mip.h"
#include "formats/fbt_samples.h"
#include "formats/interpolation.h"

namespace fetex {
namespace {

using Weights = std::array<double, 4>;

/// NaN becomes `least`.
double clamp_to(double v, double least, double most) { return v > least ? std::min(v, most) : least; }

/// Whole and fractional part of a coordinate clamped to the texture.
std::pair<std::uint32_t, double> texel_and_local(double v, std::uint32_t size) {
    const double clamped = clamp_to(v, 0, size);
    const auto i = std::min(static_cast<std::uint32_t>(clamped), size - 1);
    return {i, clamped - i};
}

FbtColor texel_color(const SilmapTexture& t, std::uint32_t i, std::uint32_t j) {
    const FbtSampleFormat format = silmap_fbt_format(t.sample_format);
    const std::size_t sample = std::size_t{j} * t.width + i;
    const std::array<double, 4> c = fbt_sample_channels(&t.colors[sample * fbt_sample_words(format)], format);
    const double unit = fbt_sample_unit(format);
    return {c[0] / unit, c[1] / unit, c[2] / unit, c[3] / unit};
}

/// The texels of a cell's corners, those beyond the border repeated, by their weights.
FbtColor weighted_corners(const SilmapTexture& t, std::uint32_t i, std::uint32_t j, const Weights& weights) {
    const std::uint32_t columns[2] = {i > 0 ? i - 1 : 0, std::min(i, t.width - 1)};
    const std::uint32_t rows[2] = {j > 0 ? j - 1 : 0, std::min(j, t.height - 1)};
    FbtColor sum;
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
        if (weights[corner] == 0) continue;
        const FbtColor c = texel_color(t, columns[corner & 1], rows[corner >> 1]);
        const double w = weights[corner];
        sum.r += w * c.r, sum.g += w * c.g, sum.b += w * c.b, sum.a += w * c.a;
    }
    return sum;
}

/// The part of a pixel that lies in one of the two cells over which it may reach along an axis, local to the cell.
struct Part {
    double from = 0, to = 0;
    /// local: the pixel's middle in the texel that both cells share; second: the cell that begins in its middle.
    Part(double local, double side, bool second) {
        const double begin = second ? 1 : 0;
        from = std::max(local + 0.5 - side / 2 - begin, 0.0);
        to = std::min(local + 0.5 + side / 2 - begin, 1.0);
    }
    [[nodiscard]] bool empty() const { return !(from < to); }
    [[nodiscard]] double middle() const { return (from + to) / 2; }
};

/// Of what a pixel has of a cell, each corner's share of the colour. They add up to the area.
Weights area_weights(const SilmapShape& shape, const Part& column, const Part& row, SilmapFilter filter) {
    const Weights areas = silmap_areas(shape, {column.from, row.from, column.to, row.to});
    if (filter == SilmapFilter::Nearest) return areas;
    Weights sum{};
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
        if (areas[corner] == 0) continue;
        const Weights weights =
            silmap_weights(silmap_reachable(corner, shape.boundaries), column.middle(), row.middle());
        for (std::uint32_t c = 0; c < 4; ++c)
            sum[c] += areas[corner] * weights[c];
    }
    return sum;
}

} // namespace

SilmapRegion silmap_locate_local(const SilmapTexture& texture, std::uint32_t i, std::uint32_t j, double fx, double fy) {
    const double x = clamp_to(fx, 0, 1), y = clamp_to(fy, 0, 1);
    SilmapRegion region;
    region.i = i + (x < 0.5 ? 0 : 1), region.j = j + (y < 0.5 ? 0 : 1);
    region.x = x < 0.5 ? x + 0.5 : x - 0.5, region.y = y < 0.5 ? y + 0.5 : y - 0.5;
    const SilmapShape shape = silmap_shape(texture, region.i, region.j);
    region.corner = silmap_quadrant(shape, region.x, region.y);
    region.reachable = silmap_reachable(region.corner, shape.boundaries);
    return region;
}

SilmapRegion silmap_locate(const SilmapTexture& texture, double x, double y) {
    const auto [i, fx] = texel_and_local(x, texture.width);
    const auto [j, fy] = texel_and_local(y, texture.height);
    return silmap_locate_local(texture, i, j, fx, fy);
}

FbtColor silmap_sample_local(const SilmapTexture& texture, std::uint32_t i, std::uint32_t j, double fx, double fy,
                             SilmapFilter filter) {
    const SilmapRegion region = silmap_locate_local(texture, i, j, fx, fy);
    const std::uint32_t corners = filter == SilmapFilter::Nearest ? 1u << region.corner : region.reachable;
    return weighted_corners(texture, region.i, region.j, silmap_weights(corners, region.x, region.y));
}

FbtColor silmap_sample(const SilmapTexture& texture, double x, double y, SilmapFilter filter) {
    const auto [i, fx] = texel_and_local(x, texture.width);
    const auto [j, fy] = texel_and_local(y, texture.height);
    return silmap_sample_local(texture, i, j, fx, fy, filter);
}

FbtColor silmap_sample_area_local(const SilmapTexture& texture, std::uint32_t i, std::uint32_t j, double fx, double fy,
                                  SilmapPixel pixel, SilmapFilter filter) {
    const double width = clamp_to(pixel.width, kSilmapSmallestPixel, 1),
                 height = clamp_to(pixel.height, kSilmapSmallestPixel, 1);
    const double x = clamp_to(fx, 0, 1), y = clamp_to(fy, 0, 1);
    FbtColor sum;
    for (std::uint32_t below = 0; below < 2; ++below) {
        const Part row(y, height, below != 0);
        if (row.empty()) continue;
        for (std::uint32_t right = 0; right < 2; ++right) {
            const Part column(x, width, right != 0);
            if (column.empty()) continue;
            Weights weights = area_weights(silmap_shape(texture, i + right, j + below), column, row, filter);
            for (double& w : weights)
                w /= width * height;
            const FbtColor c = weighted_corners(texture, i + right, j + below, weights);
            sum.r += c.r, sum.g += c.g, sum.b += c.b, sum.a += c.a;
        }
    }
    return sum;
}

FbtColor silmap_sample_area(const SilmapTexture& texture, double x, double y, SilmapPixel pixel, SilmapFilter filter) {
    const auto [i, fx] = texel_and_local(x, texture.width);
    const auto [j, fy] = texel_and_local(y, texture.height);
    return silmap_sample_area_local(texture, i, j, fx, fy, pixel, filter);
}

FbtColor silmap_sample_mip(const SilmapTexture& texture, double x, double y, SilmapPixel pixel, SilmapFilter filter) {
    const std::uint32_t w = texture.width, h = texture.height;
    const double side = std::max({0.0, pixel.width, pixel.height});
    const auto [k, part] = fbt_mip_place(w, h, side);
    const FbtColor fine =
        k == 0 ? silmap_sample_area(texture, x, y, pixel, filter) : fbt_mip_color(texture.mips, w, h, k, x, y);
    return part > 0 ? mix(fine, fbt_mip_color(texture.mips, w, h, k + 1, x, y), part) : fine;
}

} // namespace fetex
