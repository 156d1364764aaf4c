// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "formats/fbt_samples.h"

#include <algorithm>
#include <cmath>

namespace fetex {
namespace {

std::uint32_t to_integer(double v, double unit) {
    return static_cast<std::uint32_t>(std::floor(std::clamp(v, 0.0, 1.0) * unit + 0.5));
}

/// Where the halves' exponent field of a value begins to count: v = m·2^exponent, m in [1/2, 1); that of the smallest
/// normal number for those below.
int half_exponent(double v) {
    constexpr int smallest = -13;
    int exponent = smallest;
    if (v >= 0x1p-14) std::frexp(v, &exponent);
    return exponent;
}

std::array<std::uint32_t, 2> pack_halves(const FbtColor& c) {
    const std::uint32_t alpha = fbt_to_half(std::min(c.a, 1.0));
    if (alpha == 0) return {0, 0};
    return {fbt_to_half(c.r) | fbt_to_half(c.g) << 16, fbt_to_half(c.b) | alpha << 16};
}

} // namespace

double fbt_half_value(std::uint32_t half) {
    const std::uint32_t exponent = half >> 10 & 31u, mantissa = half & 0x3ffu;
    if (exponent == 0) return mantissa * 0x1p-24;
    return std::ldexp(1024.0 + mantissa, static_cast<int>(exponent) - 25);
}

std::uint32_t fbt_to_half(double v) {
    const double clamped = v > 0 ? std::min(v, kFbtMaxHalf) : 0.0; // NaN becomes 0
    const int exponent = half_exponent(clamped);
    const double scaled = std::ldexp(clamped, 11 - exponent), whole = std::floor(scaled);
    const double steps = scaled - whole < 0.5 ? whole : whole + 1; // of 2^(exponent-11)
    // A normal number has 1024 … 2048 steps: a carry raises the exponent by itself.
    return (static_cast<std::uint32_t>(exponent + 13) << 10) + static_cast<std::uint32_t>(steps);
}

std::array<double, 4> fbt_sample_channels(const std::uint32_t* words, FbtSampleFormat format) {
    std::array<double, 4> out{};
    for (std::uint32_t k = 0; k < 4; ++k) {
        if (format == FbtSampleFormat::Rgba8) {
            out[k] = words[0] >> (8 * k) & 0xffu;
        } else {
            const std::uint32_t half = words[k / 2] >> (16 * (k % 2)) & 0xffffu;
            out[k] = format == FbtSampleFormat::Rgba16 ? half : fbt_half_value(half);
        }
    }
    return out;
}

std::array<std::uint32_t, 2> fbt_pack_sample(const FbtColor& color, FbtSampleFormat format) {
    if (format == FbtSampleFormat::Rgba16F) return pack_halves(color);
    const double unit = fbt_sample_unit(format), alpha = std::clamp(color.a, 0.0, 1.0);
    const std::uint32_t r = to_integer(std::min(color.r, alpha), unit), g = to_integer(std::min(color.g, alpha), unit),
                        b = to_integer(std::min(color.b, alpha), unit), a = to_integer(alpha, unit);
    if (format == FbtSampleFormat::Rgba8) return {r | g << 8 | b << 16 | a << 24, 0};
    return {r | g << 16, b | a << 16};
}

double fbt_sample_rounding(double channel, FbtSampleFormat format) {
    if (format == FbtSampleFormat::Rgba16F) return std::ldexp(1.0, half_exponent(channel) - 12);
    return 0.5 / fbt_sample_unit(format);
}

bool fbt_sample_opaque(const std::uint32_t* words, FbtSampleFormat format) {
    switch (format) {
    case FbtSampleFormat::Rgba8:
        return words[0] >> 24 == 0xffu;
    case FbtSampleFormat::Rgba16:
        return words[1] >> 16 == 0xffffu;
    case FbtSampleFormat::Rgba16F:
        return words[1] >> 16 == kFbtHalfOne;
    }
    return false;
}

} // namespace fetex
