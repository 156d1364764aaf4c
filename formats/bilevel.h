// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Bi-level texture: a drawing of two colours as a small grey texture whose interpolation, cut at 1/2, is the drawing;
/// the layout and the CPU reference sampler. J. Loviscach, "Efficient Magnification of Bi-Level Textures", 2005. More
/// than one channel is our answer to the paper's future work (sharp corners). Normative text: formats/SPEC.md,
/// sections 2.4 and 6.
///
/// Frames: texel space, x right, y down, texel (i,j) covers [i,i+1)×[j,j+1), [0,W]×[0,H] is the drawing. A texel's
/// value stands in its middle, (i+1/2, j+1/2); between the middles the values are interpolated bilinearly, in full
/// precision, those at the border repeated. Values are 0…1: bytes / 255. Points anywhere are allowed, and count as the
/// nearest one of the texture.
///
/// Colours are premultiplied and sRGB-encoded; packed: RGBA8, R in the low byte.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/fbt.h"

namespace fetex {

/// How the interpolated channels become the one value t that is cut at 1/2.
enum class BilevelRule : std::uint32_t {
    Single = 0, ///< one channel
    Min = 1,    ///< two channels, the lesser: above is where both are
    Max = 2,    ///< two channels, the greater: above is where either is
    Median = 3, ///< three channels, the middle one: above is where two of three are
};

/// The number of channels that a rule combines: 1, 2, 2, 3.
std::uint32_t bilevel_channels(BilevelRule rule);

/// Owning bi-level texture. validate_bilevel (formats/validate.h) checks the invariants; a reader calls it before
/// anything is sampled.
struct BilevelTexture {
    std::uint32_t width = 0, height = 0; ///< texels, 1 … 16384
    std::uint32_t channels = 1;          ///< bilevel_channels(rule)
    BilevelRule rule = BilevelRule::Single;
    std::vector<std::uint8_t> texels; ///< level 0: width·height texels of `channels` bytes, row by row, no padding
    /// Empty, or levels 1 … n (fbt_mip_level(width, height, k) gives their sizes and where they begin), a byte a texel,
    /// row by row: the part of the texel that is above, 255 is all of it.
    std::vector<std::uint8_t> mips;
    std::uint32_t below = 0, above = 0; ///< packed: where t ≤ 1/2, and where t > 1/2
    /// Instead of `above`: a picture spread over the whole texture, packed, row by row; empty: none. Its samples stand
    /// in the middle of its pixels, those at the border repeated.
    std::uint32_t image_width = 0, image_height = 0; ///< 0, or 1 … 16384
    std::vector<std::uint32_t> image;
};

/// Bytes of level 0, the mip levels and the image, as the file has them. (Some GPUs keep three channels as four.)
std::uint64_t bilevel_gpu_bytes(const BilevelTexture& t);

/// t and its gradient, per texel, at a point: that of the channel which the rule chose, of the first where several have
/// the same value.
struct BilevelValue {
    double t = 0, dx = 0, dy = 0;
};
BilevelValue bilevel_value(const BilevelTexture& texture, double x, double y);
/// As bilevel_value, for a point given as texel (i,j) of the texture plus local offset in [0,1] (deep zoom).
BilevelValue bilevel_value_local(const BilevelTexture& texture, std::uint32_t i, std::uint32_t j, double fx, double fy);

/// The sides of a pixel along x and y, in texels, 0 … 1; less and more count as these. 0 and 0: a point.
struct BilevelPixel {
    double width = 0, height = 0;
};

/// The part of a pixel, 0…1, that is above, if the contour is straight in it: the exact area of a rectangle cut by a
/// line. With a and b the greater and the lesser of |dt/dx|·width and |dt/dy|·height, and d = |t − 1/2|: what is on the
/// side of the pixel's middle is 1/2 + d/a for d ≤ (a − b)/2, 1 − ((a + b)/2 − d)² / (2ab) beyond, 1 from (a + b)/2 on.
/// a = 0: 1 if t > 1/2, else 0. Continuous, and monotone in t but for rounding.
double bilevel_coverage(const BilevelValue& value, BilevelPixel pixel);

/// The colour at a point, cut hard.
FbtColor bilevel_sample(const BilevelTexture& texture, double x, double y);
FbtColor bilevel_sample_local(const BilevelTexture& texture, std::uint32_t i, std::uint32_t j, double fx, double fy);

/// The colour of a pixel around a point, cut softly: below and above mixed by bilevel_coverage.
FbtColor bilevel_sample_area(const BilevelTexture& texture, double x, double y, BilevelPixel pixel);
FbtColor bilevel_sample_area_local(const BilevelTexture& texture, std::uint32_t i, std::uint32_t j, double fx,
                                   double fy, BilevelPixel pixel);

/// The coverage, 0…1, of level k = 1 … n at a point of texel space, bilinear. Precondition: the texture has mips.
double bilevel_mip_coverage(const BilevelTexture& texture, std::uint32_t k, double x, double y);

/// The colour of a pixel of any size around a point, sides as in BilevelPixel but without its upper bound: of the
/// levels between whose scales (fbt_mip_scale) the longer side lies the coarser one counts with the square of how far
/// its logarithm is on the way. A level interpolated is blurred as by a pixel √3 as long as its scale, so the coarser
/// one comes late. Level 0 counts with its bilevel_coverage over the pixel, sides of at most 1. Continuous in the
/// sides. Precondition: the texture has mips.
FbtColor bilevel_sample_mip(const BilevelTexture& texture, double x, double y, BilevelPixel pixel);

} // namespace fetex
