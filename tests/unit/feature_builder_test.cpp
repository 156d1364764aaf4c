// SPDX-License-Identifier: GPL-3.0-or-later
/// Textures with feature curves as a whole: what the builder puts in them, and what it says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/diagnostics.h"
#include "compiler/feature_curves/feature_curves_builder.h"
#include "formats/validate.h"
#include "tests/support/random.h"

namespace fetexc {
namespace {

using fetex::FeatureKind;
using test::Random;

NetworkCurve line(CanvasPoint a, CanvasPoint b, std::string profile = "") {
    return {"", {{1, {a, b}}}, false, std::move(profile), {}, {}};
}

Network one_line() { return {40, 20, {line({3, 2}, {35, 17})}}; }

FeatureCurvesOptions options_at(std::uint32_t width, std::uint32_t height) {
    FeatureCurvesOptions options;
    options.size = {width, height};
    return options;
}

FeatureCurvesBuild built(const Network& network, const FeatureCurvesOptions& options) {
    auto build = compile_feature_curves(network, options);
    EXPECT_TRUE(build.ok()) << build.error().message;
    return std::move(build).value();
}

RasterImage image_of(std::uint32_t width, std::uint32_t height, const auto& color_at) {
    RasterImage image{width, height, {}};
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x)
            for (const double v : color_at(x + 0.5, y + 0.5))
                image.rgba.push_back(static_cast<float>(65535 * v));
    return image;
}

TEST(FeatureBuilder, makesValidTexturesOfEveryKind) {
    Random random(1);
    for (const auto numbers :
         {fetex::FeatureNumberFormat::Float, fetex::FeatureNumberFormat::Half, fetex::FeatureNumberFormat::Bits16}) {
        for (const auto kind : {FeatureKind::Color, FeatureKind::Normal, FeatureKind::Height}) {
            for (const auto samples : {fetex::FeatureSampleFormat::Rgba8, fetex::FeatureSampleFormat::Rgba16,
                                       fetex::FeatureSampleFormat::Rgba16F, fetex::FeatureSampleFormat::Rgb8}) {
                Network network{20, 20, {}};
                for (int k = 0; k < 8; ++k)
                    network.curves.push_back(line({random.between(-2, 22), random.between(-2, 22)},
                                                  {random.between(-2, 22), random.between(-2, 22)}));
                FeatureCurvesOptions options = options_at(17, 23);
                options.numbers = numbers, options.kind = kind, options.sample_format = samples;
                options.base_color = {0.5, 0.25, 0, samples == fetex::FeatureSampleFormat::Rgb8 ? 1 : 0.5};
                const RasterImage image = image_of(9, 31, [](double x, double y) {
                    return std::array{x / 18, y / 62, 0.5, 1.0};
                });
                if (random.chance(0.5)) options.base.image = &image;
                const FeatureCurvesBuild b = built(network, options);
                for (const fetex::Finding& f : fetex::validate_feature_curves(b.texture))
                    ADD_FAILURE() << f.message;
                EXPECT_EQ(b.stats.gpu_bytes, fetex::feature_gpu_bytes(b.texture));
                EXPECT_GT(b.stats.texels_one, 0u);
            }
        }
    }
}

TEST(FeatureBuilder, hasTheSameBytesForAnyNumberOfThreads) {
    FeatureCurvesOptions options = options_at(80, 40);
    const RasterImage image = image_of(100, 100, [](double x, double y) {
        return std::array{x / 100, y / 100, 1.0, 1.0};
    });
    options.base = {&image, BaseImageKind::Normal, true, 1};
    const FeatureCurvesBuild one = built(one_line(), options);
    options.threads = 0;
    const FeatureCurvesBuild more = built(one_line(), options);
    EXPECT_EQ(one.texture.distances, more.texture.distances);
    EXPECT_EQ(one.texture.gradients, more.texture.gradients);
    EXPECT_EQ(one.texture.base, more.texture.base);
}

TEST(FeatureBuilder, hasTheSameBytesOfManyLinesForAnyNumberOfThreads) {
    Random random(3);
    Network network{90, 70, {}};
    for (int k = 0; k < 300; ++k) { // half of them on texels' corners and borders
        const auto at = [&](double side) {
            return k % 2 == 0 ? random.between(-5, side + 5) : random.integer(0, 20) * 4.0;
        };
        network.curves.push_back(line({at(90), at(70)}, {at(90), at(70)}));
    }
    std::erase_if(network.curves, [](const NetworkCurve& c) { return is_point(c.segments.front()); });
    FeatureCurvesOptions options = options_at(90, 70);
    const FeatureCurvesBuild one = built(network, options);
    EXPECT_GT(one.stats.snapping.crossings, 10000u);
    for (const unsigned threads : {2u, 8u}) {
        options.threads = threads;
        const FeatureCurvesBuild more = built(network, options);
        EXPECT_EQ(one.texture.configurations, more.texture.configurations);
        EXPECT_EQ(one.texture.signatures, more.texture.signatures);
        EXPECT_EQ(one.texture.distances, more.texture.distances);
        EXPECT_EQ(one.texture.gradients, more.texture.gradients);
        EXPECT_EQ(one.stats.snapping.crossings, more.stats.snapping.crossings);
        ASSERT_EQ(one.moves.size(), more.moves.size());
        for (std::size_t k = 0; k < one.moves.size(); ++k)
            EXPECT_EQ(one.moves[k].distance, more.moves[k].distance);
    }
}

/// Else the distance would be too small, and the profile too wide, where some corners are at the limit.
TEST(FeatureBuilder, cornersAreKnownWhereverTheProfileReaches) {
    FeatureCurvesOptions options = options_at(80, 40);
    options.profile = preset_profile("crease", 1.7);
    const FeatureCurvesBuild b = built(one_line(), options);
    const double width = 1.7 * 2; // texels
    std::size_t reached = 0;
    for (std::uint32_t j = 0; j < 40; ++j) {
        for (std::uint32_t i = 0; i < 80; ++i) {
            const std::array d = {
                fetex::feature_distance(b.texture, i, j), fetex::feature_distance(b.texture, i + 1, j),
                fetex::feature_distance(b.texture, i, j + 1), fetex::feature_distance(b.texture, i + 1, j + 1)};
            if (*std::ranges::min_element(d) > width) continue;
            ++reached;
            EXPECT_LT(*std::ranges::max_element(d), b.texture.distance_limit) << i << ' ' << j;
        }
    }
    EXPECT_GT(reached, 100u);
    EXPECT_LT(reached, 1000u);
}

TEST(FeatureBuilder, profilesAreInTexels) {
    FeatureCurvesOptions options = options_at(80, 40); // two texels a unit
    options.profile = preset_profile("crease", 3);
    options.kind = FeatureKind::Height;
    const RasterImage image = image_of(2, 2, [](double, double) { return std::array{0.5, 0.0, 0.0, 1.0}; });
    options.base.image = &image, options.base.height_scale = 4;
    const FeatureCurvesBuild b = built(one_line(), options);
    ASSERT_EQ(b.texture.profile.size(), kFeatureProfileEntries);
    EXPECT_EQ(b.texture.height_scale, 8);
    for (std::size_t k = 0; k < b.texture.profile.size(); ++k) {
        const double units = static_cast<double>(k) / (kFeatureProfileEntries - 1) * b.texture.distance_limit / 2;
        const fetex::FeatureProfileEntry& e = b.texture.profile[k];
        EXPECT_NEAR(e.height, 2 * profile_height(*options.profile, units), 1e-5);
        EXPECT_NEAR(e.slope, profile_slope(*options.profile, units), 1e-5);
        EXPECT_NEAR(e.blend, profile_blend(*options.profile, units), 1e-5);
    }
    EXPECT_NEAR(fetex::feature_base(b.texture, 3, 4).r, 0.5, 1.0 / 255);
}

TEST(FeatureBuilder, heightsWithoutAnImageAreAroundTheMiddle) {
    FeatureCurvesOptions options = options_at(40, 20);
    options.profile = preset_profile("groove", 3); // 1.5 deep
    options.kind = FeatureKind::Height;
    const FeatureCurvesBuild b = built(one_line(), options);
    EXPECT_FLOAT_EQ(b.texture.height_scale, 3);
    EXPECT_FLOAT_EQ(b.texture.profile.front().height, 0);
    EXPECT_FLOAT_EQ(b.texture.profile.back().height, 1.5);
    EXPECT_NEAR(fetex::feature_base(b.texture, 0, 0).r * 3, 1.5, 3.0 / 255);
}

TEST(FeatureBuilder, takesAsManyTexelsAsTheBytesAllow) {
    for (const bool image : {false, true}) {
        for (const std::uint64_t bytes : {std::uint64_t{5000}, std::uint64_t{100000}, std::uint64_t{123457}}) {
            FeatureCurvesOptions options;
            const RasterImage base = image_of(3, 3, [](double, double) { return std::array{0.5, 0.5, 1.0, 1.0}; });
            if (image) options.base = {&base, BaseImageKind::Normal, true, 1};
            auto within = compile_feature_curves_within(one_line(), options, bytes);
            ASSERT_TRUE(within.ok());
            EXPECT_LE(within.value().stats.gpu_bytes, bytes);
            options.size = {within.value().texture.width + 1, (within.value().texture.width + 2) / 2};
            EXPECT_GT(built(one_line(), options).stats.gpu_bytes, bytes);
        }
    }
    EXPECT_EQ(compile_feature_curves_within(one_line(), {}, 100).error().code, diag::kFeatureBudget);
}

TEST(FeatureBuilder, refusesSizesOutOfRange) {
    EXPECT_EQ(compile_feature_curves(one_line(), options_at(0, 4)).error().code, diag::kSizeOutOfRange);
    EXPECT_EQ(compile_feature_curves(one_line(), options_at(4, 16385)).error().code, diag::kSizeOutOfRange);
}

TEST(BaseMap, linearPicturesStayLinear) {
    const auto ramp = [](double x, double y) { return std::array{x / 64, y / 64, 0.25, 1.0}; };
    for (const std::uint32_t pixels : {64u, 16u}) { // means of pixels, and between pixels
        const RasterImage image =
            image_of(pixels, pixels, [&](double x, double y) { return ramp(x * 64 / pixels, y * 64 / pixels); });
        const std::vector<Rgba> corners = corner_colors(image, 32, 16, 1);
        ASSERT_EQ(corners.size(), 33u * 17);
        for (std::uint32_t j = 4; j <= 12; ++j) {
            for (std::uint32_t i = 4; i <= 28; ++i) {
                EXPECT_NEAR(corners[j * 33 + i].r, i / 32.0, 1e-4) << pixels;
                EXPECT_NEAR(corners[j * 33 + i].g, j / 16.0, 1e-4) << pixels;
            }
        }
        EXPECT_NEAR(corners[0].b, 0.25, 1e-4); // at the border, of what there is
    }
}

TEST(BaseMap, normalsAreUnitAndDownwards) {
    const RasterImage image = image_of(4, 4, [](double, double) { return std::array{0.5, 0.8, 0.9, 1.0}; });
    for (const bool up : {true, false}) {
        for (const NormalVector& n : corner_normals({&image, BaseImageKind::Normal, up, 1}, 8, 8, 1)) {
            EXPECT_NEAR(n.x, 0, 1e-4);
            EXPECT_NEAR(n.y, up ? -0.6 : 0.6, 1e-4);
            EXPECT_NEAR(n.z, 0.8, 1e-4);
        }
    }
}

TEST(BaseMap, slopesOfHeightsBecomeNormals) {
    // 16 texels wide, rising by 8 texels from left to right: 45 degrees at a scale of 16 for a ramp of 0 … 1.
    const RasterImage image = image_of(64, 64, [](double x, double) { return std::array{x / 64, 0.0, 0.0, 1.0}; });
    const std::vector<NormalVector> normals = corner_normals({&image, BaseImageKind::Height, true, 16}, 16, 16, 1);
    const NormalVector& n = normals[5 * 17 + 8];
    EXPECT_NEAR(n.x, -std::numbers::sqrt2 / 2, 1e-3);
    EXPECT_NEAR(n.y, 0, 1e-6);
    EXPECT_NEAR(n.z, std::numbers::sqrt2 / 2, 1e-3);
}

} // namespace
} // namespace fetexc
