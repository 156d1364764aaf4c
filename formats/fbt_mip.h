// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The mip chain of a feature-based texture, for views with more than one texel a pixel (the paper leaves it open, §7),
/// and its CPU reference sampler. Normative text: formats/SPEC.md, sections 2.3 and 4.2.
///
/// Level k has max(1, ⌊W / 2^k⌋) × max(1, ⌊H / 2^k⌋) samples, k = 1 … n, the last 1×1: the sizes that GL, Vulkan and
/// D3D prescribe. Sample (i,j) of a level of w×h is the mean colour of [i·W/w, (i+1)·W/w) × [j·H/h, (j+1)·H/h), and
/// stands in the middle of that. There is no level 0: one texel a pixel is what the features draw.
#pragma once

#include "formats/fbt.h"

namespace fetex {

struct FbtMipLevel {
    std::uint32_t width = 0, height = 0;
    std::uint64_t first = 0; ///< in FbtTexture::mips
    [[nodiscard]] std::uint64_t samples() const { return std::uint64_t{width} * height; }
};

/// n: the levels of a texture of width×height texels, at least 1.
std::uint32_t fbt_mip_levels(std::uint32_t width, std::uint32_t height);
/// Level k, 1 … n.
FbtMipLevel fbt_mip_level(std::uint32_t width, std::uint32_t height, std::uint32_t k);
/// Samples of all levels: words of FbtTexture::mips.
std::uint64_t fbt_mip_samples(std::uint32_t width, std::uint32_t height);
/// Texels across a sample of level k, in the direction that has more: 1 for level 0, from 2^k to below 2^(k+1) for
/// others (less than 2^k only in a texture of one texel).
double fbt_mip_scale(std::uint32_t width, std::uint32_t height, std::uint32_t k);

/// Where the side of a pixel lies among the scales of the levels.
struct FbtMipPlace {
    std::uint32_t level = 0; ///< the coarsest of which the scale is at most the side; 0 if none is
    double part =
        0; ///< how far its logarithm is from that scale to the next, 0 … 1; 0 below level 0's and at the last level
};
/// side: texels, not NaN.
FbtMipPlace fbt_mip_place(std::uint32_t width, std::uint32_t height, double side);
/// The colour of level k, 1 … n, at a point of the texel space of a texture of width×height, bilinear, edges repeated.
/// mips: its RGBA8 samples, as FbtTexture::mips.
FbtColor fbt_mip_color(std::span<const std::uint32_t> mips, std::uint32_t width, std::uint32_t height, std::uint32_t k,
                       double x, double y);

/// A displacement in texels.
struct FbtVector {
    double x = 0, y = 0;
};

inline constexpr std::uint32_t kFbtMipMaxTaps = 8;

/// The colour that a square pixel of `texels_per_pixel` texels a side shows, its centre at (x,y) in texel space.
/// Trilinear in the chain, edges repeated, the level between those whose scales (fbt_mip_scale) enclose
/// texels_per_pixel, by its logarithm; so a pixel that covers a sample of a level has exactly its colour. Level 0, for
/// less than the scale of level 1, is the area sampled mean over a texel, or over the pixel if that is smaller, exact
/// or not (FbtPixel): continuous in texels_per_pixel from 0 up. Precondition: the texture has a chain.
FbtColor fbt_sample_mip(const FbtTexture& texture, double x, double y, double texels_per_pixel, bool exact = true);

/// As fbt_sample_mip for a pixel that is a parallelogram: dx, dy are the displacements from pixel to pixel along the
/// screen's axes. As many taps along the longer one as it is times longer than the parallelogram is high, rounded, at
/// most kFbtMipMaxTaps; each as wide as the parallelogram is high, or as the gaps ask for. So of a pixel that is less
/// than 1.5 times longer than high there is one.
FbtColor fbt_sample_mip_aniso(const FbtTexture& texture, double x, double y, FbtVector dx, FbtVector dy,
                              bool exact = true);

} // namespace fetex
