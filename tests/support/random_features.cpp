// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/random_features.h"

#include <cmath>
#include <numbers>

#include "formats/fbt_mip.h"
#include "formats/fbt_samples.h"
#include "formats/feature_curve_geometry.h"
#include "tests/support/random.h"

namespace fetexc::test {
namespace {

using namespace fetex;

constexpr float kLimit = 4;
constexpr double kHardlyInside = 0.02; ///< positions keep as far from the corners

FbtColor random_color(Random& random, bool opaque) {
    const double alpha = opaque ? 1.0 : random.unit();
    return {random.between(0, alpha), random.between(0, alpha), random.between(0, alpha), alpha};
}

/// Segments of a texel, by the edges' points; bent where they can be and chance has it.
FeatureConfiguration random_configuration(Random& random, const FeatureSignature& signature, bool linear) {
    const auto all = feature_configurations();
    const auto c = all[static_cast<std::size_t>(random.integer(1, static_cast<int>(all.size()) - 1))];
    const FeatureSegmentList list = feature_unpack(c);
    std::array<bool, 2> straight{};
    for (std::uint32_t k = 0; k < list.count && !linear; ++k)
        straight[k] = random.chance(0.2) || !feature_curve(signature, list.segment[k], false);
    if (list.count == 1) straight[1] = straight[0];
    return feature_pack(list.segment[0], list.segment[1], straight[0], straight[1]);
}

void add_curves(Random& random, FeatureCurvesTexture& t, double coverage) {
    const auto crossing = [&] {
        return FeatureCrossing{random.between(kHardlyInside, 1 - kHardlyInside), random.between(0, std::numbers::pi)};
    };
    for (std::uint32_t j = 0; j <= t.height; ++j)
        for (std::uint32_t i = 0; i <= t.width; ++i)
            for (const FeatureEdge e : {FeatureEdge::North, FeatureEdge::West})
                feature_set_crossing(t, i, j, e, crossing());
    FeatureCurvesTexture used = feature_empty_texture(t.width, t.height, t.format, t.linear, t.distance_limit);
    const auto keep = [&](std::uint32_t i, std::uint32_t j, FeatureEdge e) {
        if (e == FeatureEdge::East) ++i, e = FeatureEdge::West;
        if (e == FeatureEdge::South) ++j, e = FeatureEdge::North;
        feature_set_crossing(used, i, j, e, feature_crossing(t, i, j, e));
    };
    for (std::uint32_t j = 0; j < t.height; ++j) {
        for (std::uint32_t i = 0; i < t.width; ++i) {
            if (!random.chance(coverage)) continue;
            const auto c = random_configuration(random, feature_signature(t, i, j), t.linear);
            t.configurations[std::size_t{j} * t.width + i] = c;
            for (const FeatureSegment s : feature_unpack(c))
                keep(i, j, s.first), keep(i, j, s.second);
        }
    }
    t.signatures = used.signatures;
}

void add_maps(Random& random, FeatureCurvesTexture& t, const RandomFeaturesOptions& o) {
    const bool gradients = o.gradients || o.kind == FeatureKind::Normal;
    const FbtSampleFormat format = silmap_fbt_format(t.base_format);
    t.base.clear();
    for (std::uint32_t j = 0; j <= t.height; ++j) {
        for (std::uint32_t i = 0; i <= t.width; ++i) {
            feature_set_distance(t, i, j, random.between(0, kLimit));
            const double angle = random.between(0, 2 * std::numbers::pi);
            if (gradients) feature_set_gradient(t, i, j, {std::cos(angle), std::sin(angle)});
            if (!o.base_map && i + j > 0) continue;
            const bool opaque = t.kind == FeatureKind::Normal || t.base_format == FeatureSampleFormat::Rgb8;
            FbtColor color = random_color(random, opaque);
            if (t.kind == FeatureKind::Normal) color.b = random.between(0.7, 1); // out of the texture
            const auto words = fbt_pack_sample(color, format);
            t.base.insert(t.base.end(), words.begin(), words.begin() + fbt_sample_words(format));
        }
    }
}

/// Edges that no segment ends on have profile 0.
void add_profile_map(Random& random, FeatureCurvesTexture& t) {
    std::vector<unsigned> used(feature_corner_count(t)); // bit 0: the north edge, bit 1: the west edge
    const auto corner = [&](std::uint32_t i, std::uint32_t j) {
        return std::size_t{j} * (std::size_t{t.width} + 1) + i;
    };
    for (std::uint32_t j = 0; j < t.height; ++j)
        for (std::uint32_t i = 0; i < t.width; ++i)
            for (const FeatureSegment s : feature_unpack(t.configurations[std::size_t{j} * t.width + i]))
                for (const FeatureEdge e : {s.first, s.second}) {
                    const bool horizontal = e == FeatureEdge::North || e == FeatureEdge::South;
                    used[corner(i + (e == FeatureEdge::East), j + (e == FeatureEdge::South))] |= horizontal ? 1u : 2u;
                }
    const auto any = [&](bool is) {
        return is ? static_cast<unsigned>(random.integer(0, static_cast<int>(t.profiles) - 1)) : 0u;
    };
    for (const unsigned edges : used)
        t.profile_map.push_back(feature_profile_word(any(true), any((edges & 1u) != 0), any((edges & 2u) != 0)));
}

} // namespace

FeatureCurvesTexture random_features(std::uint64_t seed, const RandomFeaturesOptions& o) {
    Random random(seed);
    FeatureCurvesTexture t = feature_empty_texture(o.width, o.height, o.format, o.linear, kLimit);
    t.kind = o.kind, t.base_format = o.base_format;
    if (t.kind == FeatureKind::Height) t.height_scale = 2;
    add_curves(random, t, o.coverage);
    add_maps(random, t, o);
    t.profile.clear();
    t.profiles = o.profiles;
    if (o.profiles > 1) add_profile_map(random, t);
    for (std::uint32_t k = 0; k < o.entries * o.profiles; ++k)
        t.profile.push_back({static_cast<float>(random.between(-1, 1)), static_cast<float>(random.between(-1, 1)),
                             static_cast<float>(random.unit()),
                             fbt_pack_sample(random_color(random, false), FbtSampleFormat::Rgba8)[0]});
    for (std::uint64_t k = 0; o.mips && k < fbt_mip_samples(t.width, t.height); ++k)
        t.mips.push_back(fbt_pack_sample(random_color(random, false), FbtSampleFormat::Rgba8)[0]);
    return t;
}

} // namespace fetexc::test
