// SPDX-License-Identifier: GPL-3.0-or-later
/// Textures with feature curves: the GLSL sampler equals the CPU reference within 1/255 in every pixel whose colour is
/// the same a hair away, on every back end that this machine has, in every dialect that runs there.
#include <algorithm>
#include <array>
#include <functional>

#include <gtest/gtest.h>

#include "formats/feature_curve_geometry.h"
#include "formats/feature_sampler.h"
#include "formats/validate.h"
#include "tests/conformance/backend_fixture.h"
#include "tests/conformance/compare_renderers.h"
#include "tests/support/random_features.h"

namespace fetexc::test {
namespace {

using fetex::FeatureCurvesTexture;
using fetex::FeatureKind;
using fetex::FeatureNumberFormat;
using fetex::FeaturePixel;
using fetex::FeatureSampleFormat;
using fetex::Filter;
using fetex::RenderSize;
using fetex::View;

constexpr std::uint32_t kSide = 96;
constexpr double kMagnifications[] = {1, 8, 64, 512};

/// Pixels that a hair may put on either side of a curve.
constexpr double kLargestEdgeShare = 2e-4;

class FeatureCurvesConformance : public BackendTest {
  protected:
    using Sample = std::function<fetex::FbtColor(double x, double y)>;

    static bool changes_nearby(const FeatureCurvesTexture& t, const Sample& sample, double x, double y) {
        x = std::clamp<double>(x, 0, t.width), y = std::clamp<double>(y, 0, t.height);
        const fetex::FbtColor center = sample(x, y);
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (color_distance(center, sample(x + dx * kEdgeHair, y + dy * kEdgeHair)) > kColorStep) return true;
        return false;
    }

    /// One sample a pixel.
    Comparison compare(const FeatureCurvesTexture& t, const View& view, const RenderSize& size) {
        Comparison result;
        const auto reference = fetex::render_cpu(t, view, size);
        const auto drawn = renderer_->render_feature_curves(view, size);
        if (!reference.ok() || !drawn.ok()) {
            result.error = (reference.ok() ? drawn : reference).error().message;
            return result;
        }
        const fetex::PixelSides sides = fetex::pixel_sides(view, size, t.width, t.height);
        const FeaturePixel pixel{sides.x, sides.y};
        const bool mips = !t.mips.empty() && fetex::wants_mips(view, size, t.width, t.height);
        const Sample sample = [&](double x, double y) {
            return mips                           ? fetex::feature_sample_mip(t, x, y, pixel)
                   : size.filter == Filter::Point ? fetex::feature_sample(t, x, y)
                                                  : fetex::feature_sample_area(t, x, y, pixel);
        };
        const fetex::ImageAxis columns(view.x, view.w, t.width, size.width, 1);
        const fetex::ImageAxis rows(view.y, view.h, t.height, size.height, 1);
        result.pixels = std::uint64_t{size.width} * size.height;
        for (std::uint32_t py = 0; py < size.height; ++py) {
            for (std::uint32_t px = 0; px < size.width; ++px) {
                const std::size_t at = (std::size_t{py} * size.width + px) * 4;
                double difference = 0;
                for (std::size_t c = at; c < at + 4; ++c)
                    difference =
                        std::max<double>(difference, std::abs(reference.value().rgba[c] - drawn.value().rgba[c]));
                const double x = std::ldexp(static_cast<double>(columns.position(px, 0)), -32);
                const double y = std::ldexp(static_cast<double>(rows.position(py, 0)), -32);
                if (!(difference <= kColorStep) && changes_nearby(t, sample, x, y)) {
                    ++result.on_edge;
                    continue;
                }
                result.largest = std::max(result.largest, difference);
                if (difference <= kColorStep) continue;
                ++result.wrong;
                if (result.first_wrong.empty())
                    result.first_wrong = "texel position (" + std::to_string(x) + ", " + std::to_string(y) + ")";
            }
        }
        return result;
    }

    void expect_equal(const FeatureCurvesTexture& t, const View& view, const RenderSize& size,
                      const std::string& what) {
        const Comparison found = compare(t, view, size);
        EXPECT_TRUE(found.equal()) << what << ": " << found.wrong << " of " << found.pixels
                                   << " pixels wrong, by up to " << found.largest << "; " << found.first_wrong
                                   << found.error;
        EXPECT_LE(static_cast<double>(found.on_edge), kLargestEdgeShare * static_cast<double>(found.pixels)) << what;
        total_.add(found);
    }

    void report(const char* what) const {
        std::printf("  %s, %s: %llu pixels, %llu on an edge, largest difference %.2e\n", describe(GetParam()).c_str(),
                    what, static_cast<unsigned long long>(total_.pixels),
                    static_cast<unsigned long long>(total_.on_edge), total_.largest);
    }

    Comparison total_;
};

/// Around the middle of the texture and around its corner.
std::vector<View> views_at(const FeatureCurvesTexture& t, double pixels_per_texel) {
    const double w = kSide / pixels_per_texel / t.width, h = kSide / pixels_per_texel / t.height;
    return {{0.4713 - w / 2, 0.5229 - h / 2, w, h}, {1 - 0.7013 * w, -0.2071 * h, w, h}};
}

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
                ASSERT_FALSE(renderer_->upload_feature_curves(t).has_value());
                for (const double magnification : kMagnifications)
                    for (const View& view : views_at(t, magnification))
                        for (const Filter area : {Filter::Point, Filter::Area})
                            expect_equal(t, view, {kSide, kSide, 1, area},
                                         "seed " + std::to_string(seed) + " at " + std::to_string(magnification));
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
            ASSERT_FALSE(renderer_->upload_feature_curves(t).has_value());
            for (const double magnification : kMagnifications)
                for (const View& view : views_at(t, magnification))
                    for (const Filter area : {Filter::Point, Filter::Area})
                        expect_equal(t, view, {kSide, kSide, 1, area},
                                     std::to_string(profiles) + " profiles at " + std::to_string(magnification));
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
            ASSERT_FALSE(renderer_->upload_feature_curves(t).has_value());
            for (const Filter area : {Filter::Point, Filter::Area})
                expect_equal(t, {0.2513, 0.2487, 0.5019, 0.4993}, {64, 64, 1, area}, fetex::feature_name(edges));
        }
    }
    report("configurations");
}

TEST_P(FeatureCurvesConformance, equalsTheReferenceAtEveryScaleOfTheLevels) {
    for (const auto& [width, height] :
         {std::pair(64u, 64u), std::pair(37u, 50u), std::pair(1u, 33u), std::pair(1u, 1u)}) {
        const FeatureCurvesTexture t = texture_of(
            width + height, {.width = width, .height = height, .kind = kFeatureKinds[width % 3], .mips = true});
        ASSERT_FALSE(renderer_->upload_feature_curves(t).has_value());
        for (const double texels : {1.0001, 1.3, 2.0, 2.5, 4.0, 7.7, 33.0, 100.0}) {
            const double extent = texels * 61;
            const View view{0.5 - 0.53 * extent / width, 0.5 - 0.48 * extent / height, extent / width, extent / height};
            const std::string what = std::to_string(width) + " at " + std::to_string(texels) + " texels a pixel";
            expect_equal(t, view, {61, 61, 1, Filter::Area, fetex::Minification::Mips}, what);
            expect_equal(t, {view.x, view.y, view.w, view.h / 3}, {61, 61, 1, Filter::Area, fetex::Minification::Mips},
                         what + ", flat");
        }
    }
    report("levels");
}

/// fp32 has 10 bits left for the place in a texel at 16382; texel and offset have 32.
TEST_P(FeatureCurvesConformance, staysSharpFarFromTheOrigin) {
    constexpr std::uint32_t kWidth = 16383; // corners are one more
    const FeatureCurvesTexture t = texture_of(7, {.width = kWidth, .height = 3, .format = FeatureNumberFormat::Bits16});
    ASSERT_FALSE(renderer_->upload_feature_curves(t).has_value());
    const double extent = kSide / 512.0;
    for (const double i : {16382.0, 16000.25, 12345.0})
        for (const Filter area : {Filter::Point, Filter::Area})
            expect_equal(t, {i / kWidth, 1.0 / 3, extent / kWidth, extent / 3}, {kSide, kSide, 1, area},
                         "texel " + std::to_string(i));
}

/// Textures of every kind take turns in one renderer.
TEST_P(FeatureCurvesConformance, dropsTheTextureBefore) {
    const RenderSize size{48, 48, 1, Filter::Area, fetex::Minification::Mips};
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const FeatureCurvesTexture t = texture_of(seed, {.width = 20,
                                                         .height = 13,
                                                         .format = kFeatureNumberFormats[seed % 3],
                                                         .linear = seed % 2 == 0,
                                                         .kind = kFeatureKinds[seed / 2 % 3],
                                                         .profiles = seed % 4 == 1 ? 4u : 1u,
                                                         .mips = seed % 3 == 0});
        ASSERT_FALSE(renderer_->upload_feature_curves(t).has_value());
        if (!t.mips.empty()) expect_equal(t, {-1, -1, 20, 20}, size, "levels");
        expect_equal(t, {0.1, 0.1, 0.5, 0.5}, size, "texture " + std::to_string(seed));
    }
}

TEST_P(FeatureCurvesConformance, saysWhatIsMissing) {
    EXPECT_EQ(renderer_->render_feature_curves({}, {4, 4, 1}).error().code, fetex::RuntimeErrc::NothingUploaded);
    for (const auto sampler :
         {fetex::Sampler::FeatureCurves, fetex::Sampler::FeatureCurvesArea, fetex::Sampler::FeatureCurvesMips})
        EXPECT_EQ(renderer_->time_draws(sampler, {}, 16, 1).error().code, fetex::RuntimeErrc::NothingUploaded);
    EXPECT_EQ(renderer_->render_feature_curves({0, 0, -1, 1}, {4, 4, 1}).error().code, fetex::RuntimeErrc::BadView);
    ASSERT_FALSE(renderer_->upload_feature_curves(texture_of(1, {})).has_value());
    EXPECT_FALSE(renderer_->time_draws(fetex::Sampler::FeatureCurvesMips, {}, 16, 1).ok()); // it has no levels
    FeatureCurvesTexture large = fetex::feature_empty_texture(16384, 1, FeatureNumberFormat::Bits16, true, 1);
    EXPECT_EQ(renderer_->upload_feature_curves(large)->code, fetex::RuntimeErrc::TextureTooLarge);
    EXPECT_TRUE(renderer_->render_feature_curves({}, {4, 4, 1}).ok()); // what was there stays
}

INSTANTIATE_TEST_SUITE_P(Backends, FeatureCurvesConformance, testing::ValuesIn(backend_variants()), variant_name);

} // namespace
} // namespace fetexc::test
