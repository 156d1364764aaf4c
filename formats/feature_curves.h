// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Texture with feature curves: what curves cross a texel, where, and how far its corners are from them. E. Parilov,
/// D. Zorin, "Real-Time Rendering of Textures with Feature Curves", ACM Transactions on Graphics 2008, §4.
/// Normative text: formats/SPEC.md, sections 2.7 and 9.
///
/// Frames: texel space, x right, y down, [0,W]×[0,H] is the drawing; texel (i,j) covers [i,i+1)×[j,j+1). The paper's y
/// goes up: its south edge is our north one, y = j, and its order of edges (clockwise from there) is N, E, S, W.
///
/// A *discontinuity segment* is the part of a curve inside a texel. It begins and ends on the boundary, on two
/// different edges, each of which has one point at most; a texel has two segments at most. Which edges they join is the
/// texel's *configuration*; where the points are, and in what direction curves go through them, its *signature*.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "formats/fbt.h"
#include "formats/silmap.h"

namespace fetex {

enum class FeatureEdge : std::uint8_t {
    North = 1, ///< y = j
    East = 2,  ///< x = i+1
    South = 3, ///< y = j+1
    West = 4,  ///< x = i
};
inline constexpr std::array<FeatureEdge, 4> kFeatureEdges = {FeatureEdge::North, FeatureEdge::East, FeatureEdge::South,
                                                             FeatureEdge::West};

/// 0 … 3 in the order of kFeatureEdges.
constexpr std::size_t feature_edge_index(FeatureEdge e) { return static_cast<std::size_t>(e) - 1; }

/// The two edges that a discontinuity segment joins.
struct FeatureSegment {
    FeatureEdge first = FeatureEdge::North, second = FeatureEdge::East; ///< first < second
    friend auto operator<=>(const FeatureSegment&, const FeatureSegment&) = default;
};

/// The segments there are: every pair of edges, in increasing order.
inline constexpr std::uint32_t kFeatureSegmentCount = 6;
constexpr std::array<FeatureSegment, kFeatureSegmentCount> feature_segments() {
    std::array<FeatureSegment, kFeatureSegmentCount> all{};
    std::size_t n = 0;
    for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = a + 1; b < 4; ++b)
            all[n++] = {kFeatureEdges[a], kFeatureEdges[b]};
    return all;
}
inline constexpr auto kFeatureSegments = feature_segments();

/// The paper's quadruple (l1, m1), (l2, m2), edges from 1 to 4, in four bits each, l1 the lowest: 0 without a segment;
/// with one segment both pairs are its. Pairs have l < m, and the first is not the greater one, so there is one word
/// for each configuration. Edges need three bits; the fourth of l1 and of l2 says that the first, the second segment is
/// straight (one segment: both or none). Linear textures, whose segments all are, have neither bit.
using FeatureConfiguration = std::uint16_t;
inline constexpr FeatureConfiguration kFeatureStraightFirst = 0x0008, kFeatureStraightSecond = 0x0800;

/// Without the bits that tell straight segments: one of 22 words.
constexpr FeatureConfiguration feature_edges(FeatureConfiguration c) {
    return static_cast<FeatureConfiguration>(c & ~(kFeatureStraightFirst | kFeatureStraightSecond));
}

/// A configuration's segments, distinct and in increasing order.
struct FeatureSegmentList {
    std::array<FeatureSegment, 2> segment{};
    std::uint32_t count = 0;
    std::array<bool, 2> straight{}; ///< what the bits say
    [[nodiscard]] constexpr auto begin() const { return segment.begin(); }
    [[nodiscard]] constexpr auto end() const { return segment.begin() + count; }
};

/// The paper's three rules: no edge has two points (an edge is its point), there are no more than two segments, and
/// each has both ends on the boundary; and the word is the one for its segments.
constexpr bool feature_valid(FeatureConfiguration c) {
    if (c == 0) return true;
    const unsigned edges = feature_edges(c);
    const unsigned l1 = edges & 15u, m1 = edges >> 4 & 15u, l2 = edges >> 8 & 15u, m2 = edges >> 12 & 15u;
    const auto pair = [](unsigned l, unsigned m) { return l >= 1 && l < m && m <= 4; };
    if (!pair(l1, m1) || !pair(l2, m2)) return false;
    if (l1 == l2 && m1 == m2) return ((c & kFeatureStraightFirst) != 0) == ((c & kFeatureStraightSecond) != 0);
    return l1 < l2 || (l1 == l2 && m1 < m2);
}

/// Precondition: feature_valid.
constexpr FeatureSegmentList feature_unpack(FeatureConfiguration c) {
    if (c == 0) return {};
    const auto pair = [&](unsigned shift) -> FeatureSegment {
        return {static_cast<FeatureEdge>(c >> shift & 7u), static_cast<FeatureEdge>(c >> (shift + 4) & 7u)};
    };
    return {{pair(0), pair(8)},
            pair(0) == pair(8) ? 1u : 2u,
            {(c & kFeatureStraightFirst) != 0, (c & kFeatureStraightSecond) != 0}};
}

/// Of one segment, or of two; equal ones are one, and both or none are said to be straight. Without the last arguments:
/// as linear textures have it.
constexpr FeatureConfiguration feature_pack(FeatureSegment a, FeatureSegment b, bool a_straight = false,
                                            bool b_straight = false) {
    const auto pair = [](FeatureSegment s, bool straight) {
        return static_cast<unsigned>(s.first) | static_cast<unsigned>(s.second) << 4 |
               (straight ? unsigned{kFeatureStraightFirst} : 0u);
    };
    const unsigned first = pair(a, a_straight), second = pair(b, b_straight);
    return static_cast<FeatureConfiguration>(b < a ? second | first << 8 : first | second << 8);
}

/// How many there are of segments, straight or not: found by looking at every word.
constexpr std::uint32_t feature_configuration_count() {
    std::uint32_t n = 0;
    for (std::uint32_t c = 0; c <= 0xffff; ++c)
        n += feature_valid(static_cast<FeatureConfiguration>(c)) &&
             feature_edges(static_cast<FeatureConfiguration>(c)) == c;
    return n;
}
/// All of them in increasing order, the empty one first, no segment said to be straight.
std::vector<FeatureConfiguration> feature_configurations();

/// "empty", "N-E", "N-S E-W"; with "|" for "-" if the segment is said to be straight. Precondition: feature_valid.
std::string feature_name(FeatureConfiguration c);

/// A symmetry of the texel: bit 0 mirrors x, bit 1 mirrors y, bit 2 exchanges x and y afterwards.
inline constexpr std::uint32_t kFeatureSymmetries = 8;
FeatureEdge feature_turned(std::uint32_t symmetry, FeatureEdge e);
FeatureSegment feature_turned(std::uint32_t symmetry, FeatureSegment s);
FeatureConfiguration feature_turned(std::uint32_t symmetry, FeatureConfiguration c);

/// What curves do on an edge.
struct FeatureCrossing {
    double position = 0.5; ///< 0 … 1 along the edge, from its left or upper end
    double angle = 0;      ///< of the tangent, from x towards y, radians in [0, π)
    friend bool operator==(const FeatureCrossing&, const FeatureCrossing&) = default;
};
/// By feature_edge_index; edges without a point have the default.
using FeatureSignature = std::array<FeatureCrossing, 4>;
FeatureSignature feature_turned(std::uint32_t symmetry, const FeatureSignature& s);

/// A crossing's place in its texel, local 0 … 1.
struct FeaturePoint {
    double x = 0, y = 0;
};
FeaturePoint feature_point(FeatureEdge e, double position);

enum class FeatureNumberFormat : std::uint32_t {
    Float = 0,
    Half = 1,
    Bits16 = 2, ///< positions in steps of 2^-15, angles of π·2^-16, distances of the limit / 65535
};

/// What the base map and the profile are of, and so what is shown.
enum class FeatureKind : std::uint32_t {
    Color = 0,  ///< colours, premultiplied and sRGB-encoded
    Normal = 1, ///< unit normals n, x right, y down, z out of the texture, as colours (n + 1) / 2 (feature_normal)
    Height = 2, ///< heights in texels, as grey of height / height_scale; the base map's is its red channel
};

/// The base map's samples have the formats that bitmaps of silhouette-map textures have.
using FeatureSampleFormat = SilmapSampleFormat;

/// What there is at a distance from the curves. Between entries everything is linear.
struct FeatureProfileEntry {
    float height = 0;        ///< h, texels
    float slope = 0;         ///< h'
    float blend = 1;         ///< b, 0 … 1: how much the base map counts
    std::uint32_t color = 0; ///< RGBA8, premultiplied
    friend bool operator==(const FeatureProfileEntry&, const FeatureProfileEntry&) = default;
};
inline constexpr std::uint32_t kFeatureProfileMost = 4096; ///< entries of a profile
inline constexpr std::uint32_t kFeatureProfilesMost = 16;  ///< profiles of a texture

/// Numbers of profiles, of a texel's corner (i,j), of the point on its north edge, and on its west edge.
constexpr std::uint16_t feature_profile_word(unsigned corner, unsigned north, unsigned west) {
    return static_cast<std::uint16_t>(corner | north << 4 | west << 8);
}

/// Owning texture with feature curves. validate_feature_curves (formats/validate.h) checks the invariants.
///
/// Signatures: (W+1)·(H+1) groups, row by row; that of texel (i,j) has the position and angle of its north edge and the
/// position and angle of its west edge (linear: the two positions). Its east edge is the west one of texel (i+1,j), its
/// south edge the north one of (i,j+1). Distances: (W+1)·(H+1), those of the texels' corners (i,j). That is five
/// numbers a texel, three when linear (the paper, §6). Gradients: pairs, of the same corners. Numbers are
/// little-endian, of four bytes (float) or two, as in the file. With several profiles each edge's point and each corner
/// has one of them.
struct FeatureCurvesTexture {
    std::uint32_t width = 0, height = 0; ///< texels, 1 … 16384
    FeatureNumberFormat format = FeatureNumberFormat::Float;
    bool linear = true;                               ///< segments are straight, there are no angles
    float distance_limit = 1;                         ///< texels, > 0; distances beyond are this
    std::vector<FeatureConfiguration> configurations; ///< width·height, row by row
    std::vector<std::uint8_t> signatures, distances;

    FeatureKind kind = FeatureKind::Color;
    FeatureSampleFormat base_format = FeatureSampleFormat::Rgba8;
    float height_scale = 1;              ///< texels, > 0: the height that 1 in the base map stands for; else 1
    std::vector<std::uint8_t> gradients; ///< empty (not with normals), or x and y at each corner, −1 … 1
    std::vector<std::uint32_t> base;     ///< one sample for everywhere, or one for each corner, packed, row by row
    /// Of each profile 2 … kFeatureProfileMost entries, evenly from distance 0 to the limit; one profile after the
    /// other.
    std::vector<FeatureProfileEntry> profile;
    std::uint32_t profiles = 1;             ///< 1 … kFeatureProfilesMost
    std::vector<std::uint16_t> profile_map; ///< one profile: empty; else a feature_profile_word a corner, row by row
    /// Empty, or levels 1 … n of what is shown (fbt_mip_level gives their sizes and where they begin), RGBA8, row by
    /// row.
    std::vector<std::uint32_t> mips;
};

/// Bytes of a number, and numbers of a texel's signature.
inline std::uint32_t feature_number_bytes(FeatureNumberFormat f) { return f == FeatureNumberFormat::Float ? 4 : 2; }
inline std::uint32_t feature_signature_numbers(bool linear) { return linear ? 2 : 4; }
/// (W+1)·(H+1).
inline std::uint64_t feature_corner_count(const FeatureCurvesTexture& t) {
    return (std::uint64_t{t.width} + 1) * (std::uint64_t{t.height} + 1);
}
/// Entries of each profile.
inline std::size_t feature_profile_entries(const FeatureCurvesTexture& t) { return t.profile.size() / t.profiles; }
/// Bytes of all arrays, as the file has them.
std::uint64_t feature_gpu_bytes(const FeatureCurvesTexture& t);

/// Size and default content: no curve, every distance the limit, no gradients; colours, white everywhere, a profile
/// that changes nothing.
FeatureCurvesTexture feature_empty_texture(std::uint32_t width, std::uint32_t height, FeatureNumberFormat format,
                                           bool linear, float distance_limit);

/// What a number means.
enum class FeatureQuantity { Position, Angle, Distance, Gradient };
/// The nearest number, ties up (floats: to even). Positions are clamped to 0 … 1, distances to 0 … limit, gradients to
/// −1 … 1; angles are taken modulo π.
std::uint32_t feature_pack_number(FeatureNumberFormat format, FeatureQuantity quantity, double value, float limit);
/// Precondition: no float or half that is infinite or NaN, or negative but for a gradient.
double feature_number(FeatureNumberFormat format, FeatureQuantity quantity, std::uint32_t packed, float limit);

/// Of a texel; edges by feature_edge_index.
FeatureSignature feature_signature(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j);
/// North or West edge of (i,j), 0 … W by 0 … H.
FeatureCrossing feature_crossing(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j, FeatureEdge edge);
void feature_set_crossing(FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j, FeatureEdge edge,
                          const FeatureCrossing& crossing);
/// Texels; at corner (i,j), 0 … W by 0 … H.
double feature_distance(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j);
void feature_set_distance(FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j, double distance);

/// Of the distance, per texel, x right and y down.
struct FeatureVector {
    double x = 0, y = 0;
};
/// At corner (i,j); 0 without gradients.
FeatureVector feature_gradient(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j);
/// The first makes room for all of them, 0 elsewhere.
void feature_set_gradient(FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j, const FeatureVector& gradient);

/// Numbers of the profiles that a texel's corners (bit 0 east, bit 1 south) and the points of its edges (by
/// feature_edge_index) have.
struct FeatureTexelProfiles {
    std::array<std::uint8_t, 4> corners{}, edges{};
};
/// All 0 with one profile.
FeatureTexelProfiles feature_texel_profiles(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j);

/// Of the base map at corner (i,j), or the sample for everywhere.
FbtColor feature_base(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j);
/// What a base map's channel n, 0 … 1, stands for in a normal: n·factor − 1, clamped to −1 … 1; 0 is one of the
/// format's numbers, 127, 32767 or a half of 1/2.
double feature_normal_factor(FeatureSampleFormat format);

} // namespace fetex
