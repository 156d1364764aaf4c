// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The samples of the models corners and patch, in the formats that an FBT can have them in (SPEC.md, section 3).
/// Those of the model solid, of solid texels and of the mip chain are RGBA8 in every format.
#pragma once

#include <array>

#include "formats/fbt.h"

namespace fetex {

inline constexpr double kFbtMaxHalf = 65504;
inline constexpr std::uint32_t kFbtHalfOne = 0x3c00, kFbtHalfInfinity = 0x7c00;

/// Words that a sample takes, 1 or 2.
inline std::uint32_t fbt_sample_words(FbtSampleFormat format) { return format == FbtSampleFormat::Rgba8 ? 1 : 2; }
/// Records that a patch of four samples takes.
inline std::uint32_t fbt_patch_records(FbtSampleFormat format) { return fbt_sample_words(format); }

/// Value of a half that isn't negative, infinite or NaN; exact.
double fbt_half_value(std::uint32_t half);
/// The nearest half, ties up; clamped to 0 … kFbtMaxHalf, NaN becomes 0.
std::uint32_t fbt_to_half(double v);

/// What a channel of fbt_sample_channels counts: 255 or 65535 stand for 1, or 1 does.
inline double fbt_sample_unit(FbtSampleFormat format) {
    return format == FbtSampleFormat::Rgba8 ? 255.0 : format == FbtSampleFormat::Rgba16 ? 65535.0 : 1.0;
}
/// R, G, B, A of the sample at `words`, exact.
std::array<double, 4> fbt_sample_channels(const std::uint32_t* words, FbtSampleFormat format);

/// The nearest sample of a premultiplied, sRGB-encoded colour; the second word is 0 in RGBA8. Clamped to what the
/// format holds: alpha to 0 … 1; colours to 0 … alpha, or as halves to 0 … 65504, and to 0 where alpha rounds to 0.
std::array<std::uint32_t, 2> fbt_pack_sample(const FbtColor& color, FbtSampleFormat format);

/// Half a step of the format at a channel value: what rounding may add to it.
double fbt_sample_rounding(double channel, FbtSampleFormat format);

/// Whether the sample's alpha is 1.
bool fbt_sample_opaque(const std::uint32_t* words, FbtSampleFormat format);

} // namespace fetex
