// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Feature-based texture (FBT): the in-memory and GPU layout, and the CPU reference sampler.
/// G. Ramanarayanan, K. Bala, B. Walter, "Feature-Based Textures", EGSR 2004. Normative text: formats/SPEC.md.
///
/// Frames: texel space, x right, y down, texel (i,j) covers [i,i+1)×[j,j+1). The paper's "lower left" is the corner
/// (i,j). Inside a texel, points are local: [0,1)². Quantised points are two u16 in one u32, x in the low half:
/// v = u·2^-15 − 1/2, so [-1/2, 3/2) with 0 and 1 exact.
///
/// Texels: (width+apron)×(height+apron) × 2 words, row-major.
///   word 0  representative sample: premultiplied sRGB RGBA8, R in the low byte: colour at the texel's corner (i,j).
///   word 1  bits 30..31 kind: 0 empty    bits 0..7 availability mask of its only region
///                             1 single   bits 0..29 record index of the first entry of its only band
///                             2 banded   bits 0..29 record index of the band directory
///   The apron (0 or 1, present when any region needs neighbours' samples) is one more column and row of
///   representative samples; its word 1 is 0.
/// Records: 4 words each.
///   band directory: words n, 0, then for each band k: y_end (u16 quantised, low half), record index of its first
///     entry; bands are in increasing y; band k covers [y_end(k-1), y_end(k)), the first from 0, the last to 1.
///     Padded to whole records.
///   entry: one run of a simple feature, or the terminator.
///     word 0  record index of the run's first piece record
///     word 1  bits 0..15 pieces in the run, 16..17 degree (1…3), 18..19 ray direction (0 +x, 1 −x, 2 +y, 3 −y),
///             bit 20 last run of its feature, bit 21 terminator (no pieces; its region takes what is left)
///     word 2  sample of the region inside the feature (valid on the last run of the feature): premultiplied RGBA8
///     word 3  bits 0..7 its availability mask
///     Entries of a band are consecutive: features in order (FBT §4.5), runs of a feature in sequence, the
///     terminator last.
///   pieces: degree 1: a polyline of count+1 points, four points a record, padded; degree 2: one record each, points
///     0,1,2, pad; degree 3: one record each. Every piece is monotone in x and in y (up to quantisation).
///
/// Availability mask (FBT §4.6): 2 bits per corner k (bits 2k, 2k+1), corners 0 (i,j), 1 (i+1,j), 2 (i,j+1),
/// 3 (i+1,j+1): which sample stands there: 0 the region's own, 1…3 the representative sample of texel (i+1,j),
/// (i,j+1), (i+1,j+1). Mask 0: constant colour.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fetex {

inline constexpr std::uint32_t kFbtKindEmpty = 0, kFbtKindSingle = 1, kFbtKindBanded = 2;
inline constexpr std::uint32_t kFbtAddressMask = (1u << 30) - 1;
inline constexpr std::uint32_t kFbtEntryLastRun = 1u << 20, kFbtEntryTerminator = 1u << 21;
inline constexpr std::uint32_t kFbtRayPosX = 0, kFbtRayNegX = 1, kFbtRayPosY = 2, kFbtRayNegY = 3;

/// What the asset needs from a sampler; the shader prelude leaves the rest out.
struct FbtTraits {
    std::uint32_t max_degree = 0;  ///< 0: no features at all
    std::uint32_t degrees = 0;     ///< bit d set: some run has degree d
    bool bands = false;            ///< some texel is banded
    bool interpolated = false;     ///< some availability mask is not 0
    bool translucent = false;      ///< some sample has alpha < 255
    std::uint32_t directions = 0;  ///< bit d set: ray direction d is used
    std::uint32_t max_entries = 0; ///< longest entry list of a band
    std::uint32_t max_bands = 0;   ///< most bands in a texel
};

/// Owning FBT. validate_fbt (formats/validate.h) checks the invariants; a reader calls it before anything is sampled.
struct FbtTexture {
    std::uint32_t width = 0, height = 0; ///< texels, 1 … 16384
    std::uint32_t apron = 0;             ///< 0 or 1
    FbtTraits traits;
    std::vector<std::uint32_t> texels;
    std::vector<std::uint32_t> records;
};

/// Where a point fell. record: the entry (last run of the feature, or terminator) whose region holds the point,
/// or UINT32_MAX in an empty texel.
struct FbtRegion {
    std::uint32_t i = 0, j = 0;
    std::uint32_t record = 0xffffffffu;
    std::uint32_t sample = 0; ///< RGBA8
    std::uint32_t mask = 0;
};

/// Reference sampler, in double. (x,y) in texel space, clamped to the texture. FBT §5, step 3.
FbtRegion fbt_locate(const FbtTexture& texture, double x, double y);

/// Premultiplied sRGB, 0…1. FBT §5, step 4.
struct FbtColor {
    double r = 0, g = 0, b = 0, a = 0;
};
FbtColor fbt_sample(const FbtTexture& texture, double x, double y);

/// As fbt_sample, for a point given as integer base texel plus local offset in [0,1)² (deep zoom).
FbtColor fbt_sample_local(const FbtTexture& texture, std::uint32_t i, std::uint32_t j, double fx, double fy);

/// What queries cost (FBT §6.3, Table 3): s_avg = pieces / queries, f_test = solved[3] / pieces. Adds up over calls.
struct FbtQueryStats {
    std::uint64_t queries = 0;
    std::uint64_t bands = 0;      ///< steps of binary searches over bands (c_lookup)
    std::uint64_t entries = 0;    ///< runs and terminators read
    std::uint64_t pieces = 0;     ///< curves considered
    std::uint64_t outside = 0;    ///< decided by the half-open interval of the end points: not crossed
    std::uint64_t box = 0;        ///< decided by the bounding box of the control points (c_hull)
    std::uint64_t solved[4] = {}; ///< [degree]: decided by solving for the crossing (c_cubic for degree 3)
};

/// As fbt_locate, for base texel and local offset in [0,1]²; i and j are clamped to the texture. stats may be null.
FbtRegion fbt_locate_local(const FbtTexture& texture, std::uint32_t i, std::uint32_t j, double fx, double fy,
                           FbtQueryStats* stats = nullptr);

/// The colour of a region at a local offset of its texel (FBT §4.6); region as fbt_locate returned it.
FbtColor fbt_shade(const FbtTexture& texture, const FbtRegion& region, double fx, double fy);

/// Quantisation of a texel-local coordinate: nearest of u·2^-15 − 1/2, ties up, clamped to [-1/2, 3/2).
std::uint32_t fbt_quantise(double v);
/// Two quantised coordinates in a word, x in the low half.
std::uint32_t fbt_pack_point(double x, double y);
/// Inverse of fbt_quantise, exact in float and double.
inline double fbt_dequantise(std::uint32_t u16) { return static_cast<double>(u16) * 0x1p-15 - 0.5; }

/// Records that `count` pieces of a degree take: polylines hold four points a record, curves take one record each.
inline std::uint64_t fbt_piece_records(std::uint32_t degree, std::uint64_t count) {
    return degree == 1 ? (count + 4) / 4 : count;
}
/// Records of a band directory of n bands: 2 + 2n words.
inline std::uint64_t fbt_directory_records(std::uint64_t n) { return (n + 2) / 2; }

} // namespace fetex
