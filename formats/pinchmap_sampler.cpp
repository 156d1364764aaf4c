// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The reference sampler of pinchmaps: where the signal is read, and its colours there.
#include "formats/pinchmap.h"

#include <algorithm>
#include <cmath>

#include "formats/bitmap_samples.h"
#include "formats/fbt_mip.h"
#include "formats/interpolation.h"
#include "formats/mip_chain.h"

namespace fetex {
namespace {

/// Whole and fractional part of a coordinate clamped to the texture.
std::pair<std::uint32_t, double> texel_and_local(double v, std::uint32_t size) {
    const double clamped = clamp_to(v, size);
    const auto i = std::min(static_cast<std::uint32_t>(clamped), size - 1);
    return {i, clamped - i};
}

FbtColor signal_color(const PinchmapTexture& t, std::uint32_t a, std::uint32_t b) {
    const FbtSampleFormat format = silmap_fbt_format(t.sample_format);
    const std::size_t sample = std::size_t{b} * pinchmap_signal_width(t) + a;
    const std::array<double, 4> c = fbt_sample_channels(&t.signal[sample * fbt_sample_words(format)], format);
    const double unit = fbt_sample_unit(format);
    return {c[0] / unit, c[1] / unit, c[2] / unit, c[3] / unit};
}

/// The samples around a place along an axis of the signal; those at the border are repeated.
Neighbours signal_neighbours(std::uint32_t cluster, double local, std::uint32_t scale, std::uint32_t samples) {
    const double at = std::ldexp(local, static_cast<int>(scale)), whole = std::floor(at);
    const std::int64_t sample = (std::int64_t{cluster} << scale) + static_cast<std::int64_t>(whole);
    if (sample < 0) return {};
    if (sample >= samples) return {samples - 1, samples - 1, 0};
    return Neighbours::around(static_cast<std::uint32_t>(sample), at - whole, samples);
}

FbtColor color_at(const PinchmapTexture& t, const PinchmapPlace& place) {
    return interpolated(signal_neighbours(place.i, place.x, t.scale, pinchmap_signal_width(t)),
                        signal_neighbours(place.j, place.y, t.scale, pinchmap_signal_height(t)),
                        [&](std::uint32_t a, std::uint32_t b) { return signal_color(t, a, b); });
}

FbtColor with_line(const PinchmapTexture& t, const FbtColor& color, double line) {
    return line > 0 ? mix(color, color_of(t.line_color), line) : color;
}

/// The part of the pixel where the discontinuity is nearer than half the line's width.
double line_coverage(const PinchmapTexture& t, const PinchmapBlend& blend, double side, PinchmapPixel pixel) {
    if (t.line_width == 0) return 0;
    const double half = t.line_width / kPinchmapLineUnit / 2 * std::hypot(blend.dfdx, blend.dfdy),
                 change_x = blend.dfdx * pixel.width, change_y = blend.dfdy * pixel.height;
    return cut_coverage(side + half, change_x, change_y) - cut_coverage(side - half, change_x, change_y);
}

/// No wider than the fexel is where nothing is pinched: of a larger pixel the signal's own interpolation is soft
/// enough, and its mip levels are.
PinchmapCut cut_of(const PinchmapBlend& blend, double k, double side, double h, PinchmapPixel pixel) {
    const double change_x = std::abs(blend.dfdx) * pixel.width, change_y = std::abs(blend.dfdy) * pixel.height;
    const double room = std::max(1 - (side > 0 ? k : -k) + std::abs(side), 0.0);
    const double reach = (change_x + change_y) / 2, part = reach > h * room ? h * room / reach : 1.0;
    return {cut_coverage(side, change_x * part, change_y * part), reach * part};
}

} // namespace

std::uint64_t pinchmap_gpu_bytes(const PinchmapTexture& t) {
    const std::uint64_t samples = std::uint64_t{pinchmap_signal_width(t)} * pinchmap_signal_height(t);
    return 4 * std::uint64_t{t.map.size() + t.mips.size()} + bitmap_sample_bytes(t.sample_format) * samples;
}

PinchmapPlace pinchmap_place_local(const PinchmapTexture& t, std::uint32_t i, std::uint32_t j, double fx, double fy,
                                   PinchmapPixel pixel) {
    const PinchmapPixel sides{clamp_to(pixel.width, 1), clamp_to(pixel.height, 1)};
    PinchmapPlace place;
    place.i = i, place.j = j, place.x = clamp_to(fx, 1), place.y = clamp_to(fy, 1);
    const PinchmapBlend blend = pinchmap_blend(t, i, j, place.x, place.y);
    const double side = blend.at.k - blend.at.gamma; // k − gamma, before as after step 5
    place.k = pinchmap_rectified_k(blend.at, place.x, place.y);
    place.gamma = place.k - side;
    place.direction = pinchmap_direction(blend.at, place.k);
    const double h = pinchmap_h(t.scale);
    place.cut = cut_of(blend, place.k, side, h, sides);
    const double shift = pinchmap_shift(place.k, side, h, place.cut);
    place.x += shift * place.direction.x, place.y += shift * place.direction.y;
    place.line =
        line_coverage(t, blend, side, sides) * std::max(std::abs(place.direction.x), std::abs(place.direction.y));
    return place;
}

PinchmapPlace pinchmap_place(const PinchmapTexture& t, double x, double y, PinchmapPixel pixel) {
    const auto [i, fx] = texel_and_local(x, t.width);
    const auto [j, fy] = texel_and_local(y, t.height);
    return pinchmap_place_local(t, i, j, fx, fy, pixel);
}

FbtColor pinchmap_sample_area_local(const PinchmapTexture& t, std::uint32_t i, std::uint32_t j, double fx, double fy,
                                    PinchmapPixel pixel) {
    const PinchmapPlace place = pinchmap_place_local(t, i, j, fx, fy, pixel);
    return with_line(t, color_at(t, place), place.line);
}

FbtColor pinchmap_sample_area(const PinchmapTexture& t, double x, double y, PinchmapPixel pixel) {
    const PinchmapPlace place = pinchmap_place(t, x, y, pixel);
    return with_line(t, color_at(t, place), place.line);
}

FbtColor pinchmap_sample_local(const PinchmapTexture& t, std::uint32_t i, std::uint32_t j, double fx, double fy) {
    return pinchmap_sample_area_local(t, i, j, fx, fy, {});
}

FbtColor pinchmap_sample(const PinchmapTexture& t, double x, double y) { return pinchmap_sample_area(t, x, y, {}); }

FbtColor pinchmap_sample_mip(const PinchmapTexture& t, double x, double y, PinchmapPixel pixel) {
    const std::uint32_t width = pinchmap_signal_width(t), height = pinchmap_signal_height(t);
    const PinchmapPlace place = pinchmap_place(t, x, y, pixel);
    const double longer = std::max({0.0, pixel.width, pixel.height}),
                 scale = std::ldexp(1.0, static_cast<int>(t.scale));
    const auto [level, part] = fbt_mip_place(width, height, longer * scale);
    const auto from_level = [&](std::uint32_t k) {
        return fbt_mip_color(t.mips, width, height, k, (place.i + place.x) * scale, (place.j + place.y) * scale);
    };
    const FbtColor fine = level == 0 ? color_at(t, place) : from_level(level);
    const FbtColor color = part > 0 ? mix(fine, from_level(level + 1), part) : fine;
    return with_line(t, color, place.line / std::max(longer, 1.0));
}

std::vector<std::uint32_t> pinchmap_make_mips(const PinchmapTexture& t) {
    return make_mip_chain(pinchmap_signal_width(t), pinchmap_signal_height(t),
                          [&](std::uint32_t b, std::span<FbtColor> row) {
                              for (std::uint32_t a = 0; a < row.size(); ++a)
                                  row[a] = signal_color(t, a, b);
                          });
}

} // namespace fetex
