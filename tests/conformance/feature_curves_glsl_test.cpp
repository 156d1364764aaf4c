// SPDX-License-Identifier: GPL-3.0-or-later
/// Textures with feature curves: the GLSL sampler equals the CPU reference within 1/255 in every pixel whose colour is
/// the same a hair away, on every back end that this machine has, in every dialect that runs there.
#include <algorithm>
#include <array>

#include "formats/feature_curve_geometry.h"
#include "formats/feature_sampler.h"
#include "formats/validate.h"
#include "tests/conformance/representation_fixture.h"
#include "tests/support/random_features.h"

namespace fetexc::test {
namespace {

using fetex::FeatureCurvesTexture;
using fetex::FeatureKind;
using fetex::FeatureNumberFormat;
using fetex::FeatureSampleFormat;
using fetex::Filter;
using fetex::RenderSize;
using fetex::Sampler;
using fetex::View;

struct DrawnFeatureCurves {
    using Texture = FeatureCurvesTexture;
    static constexpr std::uint32_t kSide = 96;
    /// Pixels that a hair may put on either side of a curve.
    static constexpr double kLargestEdgeShare = 2e-4;
    static constexpr Sampler kSamplers[] = {Sampler::FeatureCurves, Sampler::FeatureCurvesArea,
                                            Sampler::FeatureCurvesMips};

    static auto validate(const Texture& t) { return fetex::validate_feature_curves(t); }
    static double step(const Texture&) { return kColorStep; }
    static auto upload(fetex::Renderer& renderer, const Texture& t) { return renderer.upload_feature_curves(t); }
    static auto draw(fetex::Renderer& renderer, const View& view, const RenderSize& size) {
        return renderer.render_feature_curves(view, size);
    }
    static auto reference(const Texture& t, const View& view, const RenderSize& size) {
        return fetex::render_cpu(t, view, size);
    }
    static ReferenceSampler sampler(const Texture& t, const View& view, const RenderSize& size) {
        const fetex::PixelSides sides = fetex::pixel_sides(view, size, t.width, t.height);
        const fetex::FeaturePixel pixel{sides.x, sides.y};
        if (!t.mips.empty() && fetex::wants_mips(view, size, t.width, t.height))
            return [=, &t](double x, double y) { return fetex::feature_sample_mip(t, x, y, pixel); };
        if (size.filter == Filter::Point) return [&t](double x, double y) { return fetex::feature_sample(t, x, y); };
        return [=, &t](double x, double y) { return fetex::feature_sample_area(t, x, y, pixel); };
    }
};

using FeatureCurvesConformance = RepresentationConformance<DrawnFeatureCurves>;

FeatureCurvesTexture texture_of(std::uint64_t seed, const RandomFeaturesOptions& options) {
    FeatureCurvesTexture t = random_features(seed, options);
    if (options.mips) t.mips = fetex::feature_make_mips(t);
    EXPECT_TRUE(fetex::validate_feature_curves(t).empty());
    return t;
}

TEST_P(FeatureCurvesConformance, equalsTheReferenceOnRandomTextures) {
    std::uint64_t seed = 0;
    for (const FeatureNumberFormat format : kFeatureNumberFormats) {
        for (const FeatureKind kind : kFeatureKinds) {
            for (const bool linear : {false, true}) {
                ++seed;
                const auto samples = static_cast<FeatureSampleFormat>(seed % 4);
                const FeatureCurvesTexture t = texture_of(seed, {.width = 24,
                                                                 .height = 17,
                                                                 .format = format,
                                                                 .linear = linear,
                                                                 .kind = kind,
                                                                 .base_format = samples,
                                                                 .base_map = seed % 5 != 0,
                                                                 .gradients = seed % 2 == 0});
                upload(t);
                expect_equal(t, magnified_frames(t, DrawnFeatureCurves::kSide), "seed " + std::to_string(seed));
            }
        }
    }
    report("points and pixels");
}

/// Every corner and every edge's point has one of them by chance.
TEST_P(FeatureCurvesConformance, equalsTheReferenceWithSeveralProfiles) {
    std::uint64_t seed = 50;
    for (const std::uint32_t profiles : {2u, 3u, 5u, 8u, 16u}) {
        for (const FeatureKind kind : kFeatureKinds) {
            ++seed;
            const FeatureCurvesTexture t = texture_of(seed, {.width = 24,
                                                             .height = 17,
                                                             .format = kFeatureNumberFormats[seed % 3],
                                                             .linear = seed % 2 == 0,
                                                             .kind = kind,
                                                             .base_map = seed % 5 != 0,
                                                             .gradients = seed % 4 < 2,
                                                             .profiles = profiles,
                                                             .coverage = seed % 3 == 0 ? 0.2 : 0.7});
            upload(t);
            expect_equal(t, magnified_frames(t, DrawnFeatureCurves::kSide), std::to_string(profiles) + " profiles");
        }
    }
    report("several profiles");
}

/// Each configuration alone, straight and bent, with and without neighbours that leave edges open.
TEST_P(FeatureCurvesConformance, equalsTheReferenceInEveryConfiguration) {
    const auto all = fetex::feature_configurations();
    std::uint64_t seed = 100;
    for (const fetex::FeatureConfiguration edges : all) {
        for (const bool neighbours : {false, true}) {
            ++seed;
            FeatureCurvesTexture t = texture_of(
                seed,
                {.width = 3, .height = 3, .linear = seed % 3 == 0, .profiles = seed % 2 == 0 ? 3u : 1u, .coverage = 1});
            if (!neighbours) std::ranges::fill(t.configurations, fetex::FeatureConfiguration{0});
            const fetex::FeatureSegmentList list = fetex::feature_unpack(edges);
            std::array<bool, 2> straight{};
            for (std::uint32_t k = 0; k < list.count && !t.linear; ++k)
                straight[k] = !fetex::feature_curve(fetex::feature_signature(t, 1, 1), list.segment[k], false);
            if (list.count == 1) straight[1] = straight[0];
            t.configurations[4] = list.count == 0
                                      ? edges
                                      : fetex::feature_pack(list.segment[0], list.segment[1], straight[0], straight[1]);
            // Edges that lose their segment keep their numbers, which no valid texture has.
            ASSERT_FALSE(drawn_.upload(*renderer_, t).has_value());
            for (const Filter area : {Filter::Point, Filter::Area})
                expect_equal(t, Frame{{0.2513, 0.2487, 0.5019, 0.4993}, {64, 64, 1, area}, "its texel"},
                             fetex::feature_name(edges));
        }
    }
    report("configurations");
}

TEST_P(FeatureCurvesConformance, equalsTheReferenceAtEveryScaleOfTheLevels) {
    for (const auto& [width, height] :
         {std::pair(64u, 64u), std::pair(37u, 50u), std::pair(1u, 33u), std::pair(1u, 1u)}) {
        const FeatureCurvesTexture t = texture_of(
            width + height, {.width = width, .height = height, .kind = kFeatureKinds[width % 3], .mips = true});
        upload(t);
        expect_equal(t, frames_of_levels(t), "levels");
    }
    report("levels");
}

/// fp32 has 10 bits left for the place in a texel at 16382; texel and offset have 32.
TEST_P(FeatureCurvesConformance, staysSharpFarFromTheOrigin) {
    constexpr std::uint32_t kWidth = 16383; // corners are one more
    const FeatureCurvesTexture t = texture_of(7, {.width = kWidth, .height = 3, .format = FeatureNumberFormat::Bits16});
    upload(t);
    expect_equal(t, frames_far_out(t, DrawnFeatureCurves::kSide), "far out");
}

/// Textures of every kind take turns in one renderer.
TEST_P(FeatureCurvesConformance, dropsTheTextureBefore) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed)
        expect_equal_after_others(texture_of(seed, {.width = 20,
                                                    .height = 13,
                                                    .format = kFeatureNumberFormats[seed % 3],
                                                    .linear = seed % 2 == 0,
                                                    .kind = kFeatureKinds[seed / 2 % 3],
                                                    .profiles = seed % 4 == 1 ? 4u : 1u,
                                                    .mips = seed % 3 == 0}),
                                  "texture " + std::to_string(seed));
}

TEST_P(FeatureCurvesConformance, saysWhatIsMissing) {
    expect_errors(texture_of(1, {}), fetex::feature_empty_texture(16384, 1, FeatureNumberFormat::Bits16, true, 1));
}

INSTANTIATE_TEST_SUITE_P(Backends, FeatureCurvesConformance, testing::ValuesIn(backend_variants()), variant_name);

} // namespace
} // namespace fetexc::test
