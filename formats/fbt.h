// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Feature-based texture (FBT): the in-memory and GPU layout, and the CPU reference sampler.
/// G. Ramanarayanan, K. Bala, B. Walter, "Feature-Based Textures", EGSR 2004. Normative text: formats/SPEC.md.
///
/// Frames: texel space, x right, y down, texel (i,j) covers [i,i+1)×[j,j+1). The paper's "lower left" is the corner
/// (i,j). Inside a texel, points are local: [0,1)². Quantised points are two u16 in one u32, x in the low half:
/// v = u·2^-15 − 1/2, so [-1/2, 3/2) with 0 and 1 exact.
///
/// Texels: width×height words, row-major. Bits 30..31 are the kind:
///   0 solid    one colour, opaque (bit 24 set, bits 0..23 R, G, B with R in the low byte) or nothing (all 0)
///   1 single   bits 0..29 record of its entry list
///   2 banded   bits 0..29 record of its band directory
///   3 shaded   one region that isn't solid: bits 28..29 its model, bits 0..27 its sample
/// Corners: none, or (width+1)×(height+1) samples in the sample format, row-major: the colour at the corner (i,j) of
/// texel (i,j).
/// Mips: none, or a chain of smaller pictures for minification (formats/fbt_mip.h).
/// Records: 4 words each.
///   band directory: word n, then n u16 y_end (quantised, two a word, the even one in the low half), then n words, the
///     bands' entry lists; padded to whole records. Bands are in increasing y; band k covers [y_end(k-1), y_end(k)),
///     the first from 0, the last to 1.
///   entry list: entries one after the other, features in order (FBT §4.5), the runs of a feature in sequence.
///   entry: one run of a simple feature, as many records as it takes.
///     word 0  bits 0..9 pieces in the run, 10..11 degree (0: no pieces), 12..13 ray direction (0 +x, 1 −x, 2 +y, 3
///     −y),
///             14 last run of its feature, 15 last entry of the list, 16..17 model of the region inside the feature,
///             18..19 model of the rest, 20 points shared, 21..23 depth: features that it lies inside of, 7 and more
///             are 7. A feature comes right after those inside it (post-order)
///     word 1  sample of the region inside (valid on the last run of a feature)
///     then    the run's degree·pieces+1 points (neighbours share their end points), or, if shared, the index of the
///             word where they begin
///     then    in the last entry the sample of the rest: what no feature holds
///   Every piece is monotone in x and in y (up to quantisation).
///
/// Models: how a region is coloured (FBT §4.6), and what its sample is.
///   0 solid    the sample: premultiplied RGBA8, R in the low byte
///   1 corners  interpolated between the texel's four corners in Corners; the sample is 0
///   2 patch    interpolated between four samples of its own in the sample format, corners (0,0), (1,0), (0,1), (1,1):
///              the index of their record, or of the first of two
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fetex {

inline constexpr std::uint32_t kFbtKindSolid = 0, kFbtKindSingle = 1, kFbtKindBanded = 2, kFbtKindShaded = 3;
inline constexpr std::uint32_t kFbtAddressMask = (1u << 30) - 1, kFbtSampleMask = (1u << 28) - 1;
inline constexpr std::uint32_t kFbtOpaque = 1u << 24; ///< of a solid texel
inline constexpr std::uint32_t kFbtModelSolid = 0, kFbtModelCorners = 1, kFbtModelPatch = 2;
inline constexpr std::uint32_t kFbtMaxPieces = (1u << 10) - 1; ///< in a run
inline constexpr std::uint32_t kFbtEntryLastRun = 1u << 14, kFbtEntryLast = 1u << 15, kFbtEntryShared = 1u << 20;
inline constexpr std::uint32_t kFbtDepthShift = 21, kFbtMaxDepth = 7;
inline constexpr std::uint32_t kFbtRayPosX = 0, kFbtRayNegX = 1, kFbtRayPosY = 2, kFbtRayNegY = 3;

/// How the samples of the models corners and patch are stored, premultiplied and sRGB-encoded. 16 bits a channel take
/// two words: R low, G high; B low, A high. Other samples are RGBA8 (formats/fbt_samples.h).
enum class FbtSampleFormat : std::uint32_t {
    Rgba8 = 0,
    Rgba16 = 1,  ///< 65535 is 1
    Rgba16F = 2, ///< halves: finite, not negative, alpha at most 1; colours may exceed alpha, and 1
};

/// What the asset needs from a sampler; the shader prelude leaves the rest out.
struct FbtTraits {
    std::uint32_t max_degree = 0;  ///< 0: no features at all
    std::uint32_t degrees = 0;     ///< bit d set: some run has degree d
    bool bands = false;            ///< some texel is banded
    bool corners = false;          ///< some region has the model corners
    bool patches = false;          ///< some region has the model patch
    bool shared = false;           ///< some run's points are shared
    bool translucent = false;      ///< some sample has alpha < 1
    std::uint32_t directions = 0;  ///< bit d set: ray direction d is used
    std::uint32_t max_entries = 0; ///< longest entry list of a band
    std::uint32_t max_bands = 0;   ///< most bands in a texel
    std::uint32_t max_depth = 0;   ///< largest depth of an entry
};

/// Owning FBT. validate_fbt (formats/validate.h) checks the invariants; a reader calls it before anything is sampled.
struct FbtTexture {
    std::uint32_t width = 0, height = 0; ///< texels, 1 … 16384
    FbtTraits traits;
    FbtSampleFormat sample_format = FbtSampleFormat::Rgba8;
    std::vector<std::uint32_t> texels;
    std::vector<std::uint32_t> corners; ///< empty if no region has the model corners
    std::vector<std::uint32_t> records;
    std::vector<std::uint32_t> mips; ///< empty, or the samples of levels 1 … n, row-major, one level after the other
};

inline std::uint64_t fbt_gpu_bytes(const FbtTexture& t) {
    return 4 * (std::uint64_t{t.texels.size()} + t.corners.size() + t.records.size() + t.mips.size());
}

/// Fields of an entry's word 0.
struct FbtEntry {
    explicit FbtEntry(std::uint32_t word) : word_(word) {}
    [[nodiscard]] std::uint32_t pieces() const { return word_ & kFbtMaxPieces; }
    [[nodiscard]] std::uint32_t degree() const { return word_ >> 10 & 3u; }
    [[nodiscard]] std::uint32_t direction() const { return word_ >> 12 & 3u; }
    [[nodiscard]] bool last_run() const { return (word_ & kFbtEntryLastRun) != 0; }
    [[nodiscard]] bool last() const { return (word_ & kFbtEntryLast) != 0; }
    [[nodiscard]] bool shared() const { return (word_ & kFbtEntryShared) != 0; }
    [[nodiscard]] std::uint32_t model() const { return word_ >> 16 & 3u; }
    [[nodiscard]] std::uint32_t rest_model() const { return word_ >> 18 & 3u; }
    [[nodiscard]] std::uint32_t depth() const { return word_ >> kFbtDepthShift & kFbtMaxDepth; }
    [[nodiscard]] std::uint32_t points() const { return pieces() * degree() + 1; }
    /// Words before the sample of the rest.
    [[nodiscard]] std::uint32_t rest_word() const { return shared() ? 3 : 2 + points(); }
    /// Records that the entry takes.
    [[nodiscard]] std::uint32_t records() const { return (rest_word() + (last() ? 1 : 0) + 3) / 4; }

  private:
    std::uint32_t word_;
};

/// Where a point fell. record: the entry that decided, UINT32_MAX in a texel without features; rest: no feature held
/// the point.
struct FbtRegion {
    std::uint32_t i = 0, j = 0;
    std::uint32_t record = 0xffffffffu;
    bool rest = false;
    std::uint32_t model = 0;
    std::uint32_t sample = 0;
};

/// Reference sampler, in double. (x,y) in texel space, clamped to the texture. FBT §5, step 3.
FbtRegion fbt_locate(const FbtTexture& texture, double x, double y);

/// Premultiplied sRGB, 0…1; R, G, B up to 65504 in the sample format Rgba16F. FBT §5, step 4.
struct FbtColor {
    double r = 0, g = 0, b = 0, a = 0;
};
FbtColor fbt_sample(const FbtTexture& texture, double x, double y);

/// Largest local offset that fbt_sample looks up, and the offset of points at the far border and beyond it. On the border
/// itself a ray along it misses what ends there; half a step of the points' grid away, single precision has room.
inline constexpr double kFbtFarBorder = 1 - 0x1p-16;

/// As fbt_sample, for a point given as integer base texel plus local offset in [0,1)² (deep zoom).
FbtColor fbt_sample_local(const FbtTexture& texture, std::uint32_t i, std::uint32_t j, double fx, double fy);

/// A pixel: a rectangle along the axes of the texture around the point, in texels. Half a side from 2^-16 (half a step
/// of the points' grid) to 1/2; less and more count as these.
struct FbtPixel {
    double half_width = 0.5, half_height = 0.5;
    bool exact = false; ///< every texel that it overlaps is looked at
};

/// Area sampling: the mean colour over a pixel around (x,y), or around a local offset of texel (i,j), which is in the
/// texture. A region counts with the area that it has in the pixel, with the colour that it has in the middle. Not
/// exact: where a pixel overlaps several texels with features, one speaks for all, its edges going on straight beyond
/// it (SPEC.md, 4.1).
FbtColor fbt_sample_area(const FbtTexture& texture, double x, double y, FbtPixel pixel);
FbtColor fbt_sample_area_local(const FbtTexture& texture, std::uint32_t i, std::uint32_t j, double fx, double fy,
                               FbtPixel pixel);

/// What queries cost (FBT §6.3, Table 3): s_avg = pieces / queries, f_test = solved[3] / pieces. Adds up over calls.
struct FbtQueryStats {
    std::uint64_t queries = 0;
    std::uint64_t bands = 0;      ///< steps of binary searches over bands (c_lookup)
    std::uint64_t entries = 0;    ///< runs read
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

/// Quantised y_end of a band; words: the directory.
inline std::uint32_t fbt_band_end(const std::uint32_t* words, std::uint32_t band) {
    return words[1 + band / 2] >> (16 * (band & 1u)) & 0xffffu;
}
/// Records that a directory of n bands takes.
inline std::uint64_t fbt_directory_records(std::uint64_t n) { return (1 + (n + 1) / 2 + n + 3) / 4; }

} // namespace fetex
