// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Pinchmap: a bitmap, the signal, and a small map that says how to move the places where it is read, so that colours
/// on the two sides of a line never mix; the layout and the CPU reference sampler. M. Tarini and P. Cignoni,
/// "Pinchmaps: Textures with Customizable Discontinuities", Eurographics 2005. Normative text: formats/SPEC.md,
/// sections 2.6 and 8; what differs from the paper stands there.
///
/// Frames: texel space, x right, y down, [0,W]×[0,H] is the drawing; its texels [i,i+1) × [j,j+1) are the paper's
/// *clusters* of 2^K × 2^K samples of the signal (§6.4), which lie on one side of every line as a whole. Signal sample
/// (a,b) stands at ((a+1/2)/2^K, (b+1/2)/2^K). Map texel (i,j), 0 … W by 0 … H, stands at the corner (i,j) of clusters,
/// in the middle of a *fexel* of side 2h, h = 2^-(K+1), the square between the nearest samples of the four clusters
/// around. Beyond the border clusters and samples repeat. Points anywhere are allowed, and count as the nearest one of
/// the drawing.
///
/// A map texel is *active* (k = 0) where a line passes: its fexel is undesired, no place of it is ever read, but for
/// soft edges and strengths below 1. Else k is −1 or +1, the side of the clusters around.
///
/// Colours are premultiplied and sRGB-encoded.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/fbt.h"
#include "formats/silmap.h"

namespace fetex {

/// Steps of a channel of the map: v = (stored − zero) / zero, stored 0 … 2·zero.
enum class PinchmapFormat : std::uint32_t {
    Bits8 = 0,  ///< zero = 127 (the paper, §5.1)
    Bits16 = 1, ///< zero = 32767
};

/// The signal's samples have the formats that bitmaps of silhouette-map textures have.
using PinchmapSampleFormat = SilmapSampleFormat;

/// A texel of the map, or what lies between some, −1 … 1.
struct PinchmapTexel {
    double du = 0, dv = 0; ///< direction of the pinch, towards +1, times its strength
    double k = 0;          ///< position along the pinch
    double gamma = 0;      ///< where along it the discontinuity is
    friend bool operator==(const PinchmapTexel&, const PinchmapTexel&) = default;
};

/// What stands for 0, 127 or 32767.
std::uint32_t pinchmap_zero(PinchmapFormat format);
/// Words of a packed texel, 1 or 2.
inline std::uint32_t pinchmap_words(PinchmapFormat format) { return format == PinchmapFormat::Bits8 ? 1 : 2; }
/// To the nearest steps, clamped to −1 … 1; du, dv, k, gamma from the low bits up. The second word is 0 in Bits8.
std::array<std::uint32_t, 2> pinchmap_pack(PinchmapFormat format, const PinchmapTexel& texel);
PinchmapTexel pinchmap_unpack(PinchmapFormat format, const std::uint32_t* words);

/// Of a line's width, a texel.
inline constexpr double kPinchmapLineUnit = 65536;

/// Owning pinchmap and signal. validate_pinchmap (formats/validate.h) checks the invariants; a reader calls it before
/// anything is sampled.
struct PinchmapTexture {
    std::uint32_t width = 0, height = 0; ///< clusters; those of the signal, 2^scale times as many, 1 … 16384
    std::uint32_t scale = 0;             ///< K
    PinchmapFormat map_format = PinchmapFormat::Bits8;
    PinchmapSampleFormat sample_format = PinchmapSampleFormat::Rgba8;
    std::uint32_t line_color = 0;      ///< RGBA8, of the solid line along the discontinuities (§6.5)
    std::uint32_t line_width = 0;      ///< in 1/kPinchmapLineUnit of a texel, at most one; 0: no line
    std::vector<std::uint32_t> map;    ///< (width+1)·(height+1) texels, packed, row by row
    std::vector<std::uint32_t> signal; ///< samples, packed, row by row
    /// Empty, or levels 1 … n of the signal (fbt_mip_level of its size gives theirs and where they begin), RGBA8, row
    /// by row.
    std::vector<std::uint32_t> mips;
};

/// Map texels across and down.
inline std::uint32_t pinchmap_columns(const PinchmapTexture& t) { return t.width + 1; }
inline std::uint32_t pinchmap_rows(const PinchmapTexture& t) { return t.height + 1; }
/// Samples of the signal across and down.
inline std::uint32_t pinchmap_signal_width(const PinchmapTexture& t) { return t.width << t.scale; }
inline std::uint32_t pinchmap_signal_height(const PinchmapTexture& t) { return t.height << t.scale; }

/// h = 2^-(K+1) texels: half the side of a fexel.
double pinchmap_h(std::uint32_t scale);

/// Bytes of map, signal and mip levels, as the file has them. (Some GPUs keep three bytes as four.)
std::uint64_t pinchmap_gpu_bytes(const PinchmapTexture& t);

/// Whether some active texel has a strength below 1: a discontinuity starts smoothly, or is open (§6.2, §6.3).
/// Precondition: map has the right length.
bool pinchmap_is_open(const PinchmapTexture& t);

/// Texel (i,j) of the map; i 0 … width, j 0 … height.
PinchmapTexel pinchmap_texel(const PinchmapTexture& t, std::uint32_t i, std::uint32_t j);

/// Step 2: between the four map texels of a cluster, bilinear; and the gradient of k − gamma, per texel.
struct PinchmapBlend {
    PinchmapTexel at;
    double dfdx = 0, dfdy = 0;
};
/// (i,j) a cluster, local 0 … 1.
PinchmapBlend pinchmap_blend(const PinchmapTexture& t, std::uint32_t i, std::uint32_t j, double fx, double fy);

/// Step 3: k made linear along the pinch again where one or three of the four texels are active.
double pinchmap_rectified_k(const PinchmapTexel& between, double fx, double fy);

/// A displacement in texels.
struct PinchmapVector {
    double x = 0, y = 0;
};
/// Step 4: the direction of the pinch, as long as its strength in the maximum norm. k: rectified.
PinchmapVector pinchmap_direction(const PinchmapTexel& between, double k);

/// How the discontinuity cuts a pixel.
struct PinchmapCut {
    double coverage = 0; ///< the part of the pixel where k exceeds gamma; 0 or 1 if the cut is hard
    double reach = 0;    ///< the least |k − gamma| at which it is 0 or 1; 0 if the cut is hard
};
/// Equation 1, and its soft form: how far k moves. side: k − gamma, whose sign decides.
double pinchmap_shift(double k, double side, double h, const PinchmapCut& cut);

/// The sides of a pixel along x and y, in texels, 0 … 1; less and more count as these. 0 and 0: a point.
struct PinchmapPixel {
    double width = 0, height = 0;
};

/// Steps 1 to 6 for a pixel around a point.
struct PinchmapPlace {
    std::uint32_t i = 0, j = 0;    ///< the cluster of the point
    double x = 0, y = 0;           ///< where the signal is read, from the upper left corner of the cluster
    double k = 0, gamma = 0;       ///< of steps 3 and 5
    PinchmapVector direction = {}; ///< of step 4
    PinchmapCut cut = {};
    double line = 0; ///< the part of it on the solid line, times the strength
};
PinchmapPlace pinchmap_place(const PinchmapTexture& t, double x, double y, PinchmapPixel pixel = {});
/// For a point given as texel (i,j) of the texture plus local offset in [0,1] (deep zoom).
PinchmapPlace pinchmap_place_local(const PinchmapTexture& t, std::uint32_t i, std::uint32_t j, double fx, double fy,
                                   PinchmapPixel pixel = {});

/// The colour at a point.
FbtColor pinchmap_sample(const PinchmapTexture& t, double x, double y);
FbtColor pinchmap_sample_local(const PinchmapTexture& t, std::uint32_t i, std::uint32_t j, double fx, double fy);

/// The colour of a pixel around a point: discontinuities as soft as it is large, exact for straight ones; the signal
/// at one place.
FbtColor pinchmap_sample_area(const PinchmapTexture& t, double x, double y, PinchmapPixel pixel);
FbtColor pinchmap_sample_area_local(const PinchmapTexture& t, std::uint32_t i, std::uint32_t j, double fx, double fy,
                                    PinchmapPixel pixel);

/// The colour of a pixel of any size around a point, sides as in PinchmapPixel but without its upper bound. Trilinear:
/// the levels between whose scales (fbt_mip_scale of the signal) the longer side lies, all read at the place that
/// pinchmap_place gives (§3). The solid line fades where the longer side exceeds a texel. Continuous in the sides.
/// Precondition: the texture has mips.
FbtColor pinchmap_sample_mip(const PinchmapTexture& t, double x, double y, PinchmapPixel pixel);

/// The mip chain of the signal: each sample of a level the mean of its share of the signal's. Packed as
/// PinchmapTexture::mips; what exceeds 1 or alpha is clipped. mips of the texture are not looked at.
std::vector<std::uint32_t> pinchmap_make_mips(const PinchmapTexture& t);

} // namespace fetex
