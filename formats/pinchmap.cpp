// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Map texels, and the pinch function (Tarini and Cignoni 2005, §4, §5).
#include "formats/pinchmap.h"

#include <algorithm>
#include <cmath>

#include "formats/interpolation.h"

namespace fetex {
namespace {

/// Keeps quotients whose dividend is 0 as well from being 0/0.
constexpr double kLeast = 0x1p-40;

std::uint32_t to_step(double v, double zero) {
    const double inside = v > -1 ? std::min(v, 1.0) : -1.0; // NaN becomes −1
    return static_cast<std::uint32_t>(std::floor(inside * zero + zero + 0.5));
}

/// The value of one channel between the four corners, and its gradient.
struct Slope {
    double at = 0, dx = 0, dy = 0;
};
Slope between(const std::array<PinchmapTexel, 4>& corners, double PinchmapTexel::*channel, double fx, double fy) {
    const double nw = corners[0].*channel, ne = corners[1].*channel, sw = corners[2].*channel, se = corners[3].*channel;
    const double upper = std::lerp(nw, ne, fx), lower = std::lerp(sw, se, fx);
    return {std::lerp(upper, lower, fy), std::lerp(ne - nw, se - sw, fy), lower - upper};
}

} // namespace

std::uint32_t pinchmap_zero(PinchmapFormat format) { return format == PinchmapFormat::Bits8 ? 127 : 32767; }

std::array<std::uint32_t, 2> pinchmap_pack(PinchmapFormat format, const PinchmapTexel& texel) {
    const double zero = pinchmap_zero(format);
    const std::uint32_t u = to_step(texel.du, zero), v = to_step(texel.dv, zero), k = to_step(texel.k, zero),
                        gamma = to_step(texel.gamma, zero);
    if (format == PinchmapFormat::Bits8) return {u | v << 8 | k << 16 | gamma << 24, 0};
    return {u | v << 16, k | gamma << 16};
}

PinchmapTexel pinchmap_unpack(PinchmapFormat format, const std::uint32_t* words) {
    const double zero = pinchmap_zero(format);
    const auto channel = [&](unsigned n) {
        const std::uint32_t stored =
            format == PinchmapFormat::Bits8 ? words[0] >> (8 * n) & 0xffu : words[n / 2] >> (16 * (n % 2)) & 0xffffu;
        return (stored - zero) / zero;
    };
    return {channel(0), channel(1), channel(2), channel(3)};
}

double pinchmap_h(std::uint32_t scale) { return std::ldexp(0.5, -static_cast<int>(scale)); }

PinchmapTexel pinchmap_texel(const PinchmapTexture& t, std::uint32_t i, std::uint32_t j) {
    const std::size_t at = std::size_t{j} * pinchmap_columns(t) + i;
    return pinchmap_unpack(t.map_format, &t.map[at * pinchmap_words(t.map_format)]);
}

bool pinchmap_is_open(const PinchmapTexture& t) {
    for (std::size_t k = 0; k < t.map.size(); k += pinchmap_words(t.map_format)) {
        const PinchmapTexel texel = pinchmap_unpack(t.map_format, &t.map[k]);
        if (texel.k == 0 && std::max(std::abs(texel.du), std::abs(texel.dv)) < 1) return true;
    }
    return false;
}

PinchmapBlend pinchmap_blend(const PinchmapTexture& t, std::uint32_t i, std::uint32_t j, double fx, double fy) {
    const std::array<PinchmapTexel, 4> corners = {pinchmap_texel(t, i, j), pinchmap_texel(t, i + 1, j),
                                                  pinchmap_texel(t, i, j + 1), pinchmap_texel(t, i + 1, j + 1)};
    const Slope k = between(corners, &PinchmapTexel::k, fx, fy),
                gamma = between(corners, &PinchmapTexel::gamma, fx, fy);
    PinchmapBlend blend;
    blend.at.du = between(corners, &PinchmapTexel::du, fx, fy).at;
    blend.at.dv = between(corners, &PinchmapTexel::dv, fx, fy).at;
    blend.at.k = k.at, blend.at.gamma = gamma.at;
    blend.dfdx = k.dx - gamma.dx, blend.dfdy = k.dy - gamma.dy;
    return blend;
}

/// Of the two straight ways that k may take through the cluster the one that is nearer to the interpolated value: along
/// the borders of the cluster, and everywhere if two texels are active, one of them is that value.
double pinchmap_rectified_k(const PinchmapTexel& between, double fx, double fy) {
    if (between.du == 0 || between.dv == 0 || between.k == 0) return between.k;
    const double half = std::copysign(0.5, between.k);
    const double by_x = half + std::copysign(1.0, between.du) * (fx - 0.5),
                 by_y = half + std::copysign(1.0, between.dv) * (fy - 0.5);
    return std::abs(by_x - between.k) <= std::abs(by_y - between.k) ? by_x : by_y;
}

/// At full strength the divisor is the direction's own maximum norm, or less of it where that belongs to the component
/// across the pinch: SPEC 8.2. Both vanish together; what rounding leaves of them stays within 1.
PinchmapVector pinchmap_direction(const PinchmapTexel& between, double k) {
    const double length = std::max(1 - std::max(std::abs(k), std::abs(between.k)), kLeast);
    return {std::clamp(between.du / length, -1.0, 1.0), std::clamp(between.dv / length, -1.0, 1.0)};
}

/// Where k comes to lie: across the fexel as the coverage goes, then evenly to the end, which stays.
double pinchmap_shift(double k, double side, double h, const PinchmapCut& cut) {
    const double way = side > 0 ? 1 : -1, from = std::abs(side), room = 1 - way * k + from; // from gamma to the end
    const double beyond = std::max(from - cut.reach, 0.0) / std::max(room - cut.reach, kLeast);
    return (2 * cut.coverage - 1) * h + way * (1 - h) * beyond - k;
}

} // namespace fetex
