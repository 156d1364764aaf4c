// SPDX-License-Identifier: GPL-3.0-or-later
/// What the reference sampler of textures with feature curves makes of distance, gradient and base map: Equation 1, the
/// profile's means, pixels, levels.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "formats/fbt_samples.h"
#include "formats/feature_sampler.h"
#include "formats/validate.h"
#include "tests/support/random_features.h"

namespace fetex {
namespace {

using enum FeatureEdge;
using fetexc::test::random_features;

constexpr std::uint32_t kEntries = 65;
constexpr float kLimit = 4;

/// 8×8 texels, a line at x = 4 + offset; a profile by functions of the distance.
template <class Profile> FeatureCurvesTexture line_texture(double offset, FeatureKind kind, const Profile& profile) {
    FeatureCurvesTexture t = feature_empty_texture(8, 8, FeatureNumberFormat::Float, true, kLimit);
    t.kind = kind;
    t.profile.clear();
    for (std::uint32_t k = 0; k < kEntries; ++k)
        t.profile.push_back(profile(k * double{kLimit} / (kEntries - 1)));
    for (std::uint32_t j = 0; j <= 8; ++j) {
        for (std::uint32_t i = 0; i <= 8; ++i) {
            const double x = i - (4 + offset);
            feature_set_distance(t, i, j, std::abs(x));
            feature_set_gradient(t, i, j, {x < 0 ? -1.0 : 1.0, 0});
        }
        feature_set_crossing(t, 4, j, North, {offset, 0});
        if (j < 8) t.configurations[8 * j + 4] = feature_pack({North, South}, {North, South});
    }
    EXPECT_TRUE(validate_feature_curves(t).empty());
    return t;
}

std::uint32_t packed(const FbtColor& c) { return fbt_pack_sample(c, FbtSampleFormat::Rgba8)[0]; }

/// A groove as wide as `width` on each side.
FeatureProfileEntry groove(double d, double width) {
    const double b = std::clamp(d / width, 0.0, 1.0);
    return {static_cast<float>(0.3 * std::min(d, width)), d < width ? 0.3f : 0, static_cast<float>(b),
            packed({1, 0, 0, 1})};
}

TEST(FeatureShown, normalsAreThoseOfEquation1) {
    FeatureCurvesTexture t = line_texture(0.3, FeatureKind::Normal, [](double d) { return groove(d, 2); });
    t.base = {packed({190 / 255.0, 100 / 255.0, 220 / 255.0, 1})};
    const double factor = 255.0 / 127;
    double nx = 190 / 255.0 * factor - 1, ny = 100 / 255.0 * factor - 1, nz = 220 / 255.0 * factor - 1;
    const double length = std::hypot(std::hypot(nx, ny), nz);
    nx /= length, ny /= length, nz /= length;
    for (const int k : {3, 8, 15, 20, 31}) { // at entries, where products are products
        const double d = k * 4.0 / 64, b = std::min(d / 2, 1.0), slope = d < 2 ? double{0.3f} : 0.0;
        for (const double sign : {-1.0, 1.0}) {
            const FbtColor c = feature_sample(t, 4.3 + sign * d, 3.7);
            const double more = b * std::sqrt(slope * slope + 1);
            double x = -(1 - b) * slope * sign + more * nx, y = more * ny, z = (1 - b) + more * nz;
            const double of = std::hypot(std::hypot(x, y), z);
            EXPECT_NEAR(c.r, (x / of + 1) / 2, 1e-6);
            EXPECT_NEAR(c.g, (y / of + 1) / 2, 1e-6);
            EXPECT_NEAR(c.b, (z / of + 1) / 2, 1e-6);
            EXPECT_EQ(c.a, 1);
        }
    }
}

TEST(FeatureShown, aFlatNormalStaysFlatInEveryFormat) {
    for (const FeatureSampleFormat format : {FeatureSampleFormat::Rgba8, FeatureSampleFormat::Rgba16,
                                             FeatureSampleFormat::Rgba16F, FeatureSampleFormat::Rgb8}) {
        FeatureCurvesTexture t = line_texture(0.5, FeatureKind::Normal, [](double) { return FeatureProfileEntry{}; });
        const double unit = 1 / feature_normal_factor(format);
        t.base_format = format;
        const auto words = fbt_pack_sample({unit, unit, std::min(2 * unit, 1.0), 1}, silmap_fbt_format(format));
        t.base.assign(words.begin(), words.begin() + fbt_sample_words(silmap_fbt_format(format)));
        const FbtColor c = feature_sample(t, 1.2, 3.4);
        EXPECT_NEAR(c.r, 0.5, 1e-9);
        EXPECT_NEAR(c.g, 0.5, 1e-9);
        EXPECT_NEAR(c.b, 1, 1e-9);
    }
}

TEST(FeatureShown, coloursAndHeightsBlend) {
    FeatureCurvesTexture t = line_texture(0.5, FeatureKind::Color, [](double d) { return groove(d, 2); });
    t.base = {packed({0, 0, 1, 1})};
    const FbtColor c = feature_sample(t, 4.5 + 0.5, 1);
    EXPECT_NEAR(c.r, 0.75, 1e-6);
    EXPECT_NEAR(c.b, 0.25, 1e-6);
    EXPECT_NEAR(c.a, 1, 1e-6);
    t.kind = FeatureKind::Height, t.height_scale = 2, t.base = {packed({0.8, 0, 0, 1})};
    const FbtColor h = feature_sample(t, 4.5 + 1, 1); // 0.3 texel of 2 by half, and 0.8 by half
    EXPECT_NEAR(h.r, 0.5 * 0.15 + 0.5 * 0.8, 1e-6);
    EXPECT_EQ(h.g, h.r);
}

/// Against sums over the pixel's reach, across the line too.
TEST(FeatureShown, meansAreThoseOfTheProfile) {
    const FeatureCurvesTexture t = line_texture(0.5, FeatureKind::Normal, [](double d) {
        return FeatureProfileEntry{static_cast<float>(std::sin(9 * d)), static_cast<float>(std::cos(7 * d)),
                                   static_cast<float>(0.5 + 0.5 * std::sin(5 * d)), 0xff804020};
    });
    for (const double d : {0.0, 0.03, 0.2, 1.7, 3.9, 4.0})
        for (const double reach : {0.001, 0.02, 0.1, 0.4, 1.0}) {
            FeatureProducts sum;
            sum.blend = 0;
            constexpr int kPoints = 20000;
            for (int k = 0; k < kPoints; ++k) {
                const double at = d + reach * ((2 * k + 1.0) / kPoints - 1);
                const FeatureProducts p = feature_profile_mean(t, std::abs(at), 0);
                sum.slope += (at < 0 ? -1 : 1) * p.slope / kPoints, sum.base_slope += p.base_slope / kPoints;
                sum.blend += p.blend / kPoints, sum.height += p.height / kPoints, sum.color.g += p.color.g / kPoints;
            }
            const FeatureProducts mean = feature_profile_mean(t, d, reach);
            EXPECT_NEAR(mean.slope, sum.slope, 2e-4);
            EXPECT_NEAR(mean.base_slope, sum.base_slope, 2e-4);
            EXPECT_NEAR(mean.blend, sum.blend, 2e-4);
            EXPECT_NEAR(mean.height, sum.height, 2e-4);
            EXPECT_NEAR(mean.color.g, sum.color.g, 2e-4);
        }
}

/// A thin line and a hard edge of the base map, seen by pixels of half a texel at any place: the mean of what points
/// see.
TEST(FeatureShown, pixelsSeeTheMeanOfPoints) {
    FeatureCurvesTexture t = line_texture(0.37, FeatureKind::Color, [](double d) { return groove(d, 0.125); });
    t.base.clear();
    for (std::uint32_t k = 0; k < 81; ++k)
        t.base.push_back(k % 9 <= 4 ? packed({0, 1, 0, 1}) : packed({0, 0, 1, 1}));
    for (double x = 3.7; x < 5; x += 0.0625) {
        FbtColor sum;
        constexpr int kPoints = 400;
        for (int k = 0; k < kPoints; ++k) {
            const FbtColor c = feature_sample(t, x + 0.5 * ((k + 0.5) / kPoints - 0.5), 2.2);
            sum.r += c.r / kPoints, sum.g += c.g / kPoints, sum.b += c.b / kPoints;
        }
        const FbtColor c = feature_sample_area(t, x, 2.2, {0.5, 0.5});
        EXPECT_NEAR(c.r, sum.r, 0.01) << x;
        EXPECT_NEAR(c.g, sum.g, 0.01) << x;
        EXPECT_NEAR(c.b, sum.b, 0.01) << x;
    }
}

TEST(FeatureShown, aSmallPixelSeesThePoint) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const FeatureCurvesTexture t = random_features(seed, {.kind = fetexc::test::kFeatureKinds[seed % 3]});
        for (double x = 0.01; x < 8; x += 0.37) {
            if (feature_at(t, x, 0.7 * x).distance < 1e-5) continue;
            const FbtColor a = feature_sample(t, x, 0.7 * x), b = feature_sample_area(t, x, 0.7 * x, {1e-6, 1e-6});
            EXPECT_NEAR(a.r, b.r, 1e-4);
            EXPECT_NEAR(a.b, b.b, 1e-4);
        }
    }
}

TEST(FeatureMips, areMeansOfWhatIsShownAndContinueIt) {
    FeatureCurvesTexture t = random_features(4, {.kind = FeatureKind::Color, .base_format = FeatureSampleFormat::Rgb8});
    t.mips = feature_make_mips(t);
    ASSERT_TRUE(validate_feature_curves(t).empty());
    FbtColor sum;
    constexpr int kPoints = 160;
    for (int k = 0; k < kPoints * kPoints; ++k) {
        const FbtColor c = feature_sample(t, (k % kPoints + 0.5) / kPoints * 8, (k / kPoints + 0.5) / kPoints * 8);
        sum.r += c.r / (kPoints * kPoints), sum.a += c.a / (kPoints * kPoints);
    }
    const FbtColor last = feature_sample_mip(t, 3, 3, {64, 64});
    EXPECT_NEAR(last.r, sum.r, 0.01);
    EXPECT_NEAR(last.a, sum.a, 0.01);
    for (const double side : {0.5, 0.999, 1.0}) {
        const FbtColor a = feature_sample_mip(t, 3.3, 2.2, {side, side}),
                       b = feature_sample_area(t, 3.3, 2.2, {side, side});
        EXPECT_NEAR(a.r, b.r, 1e-12);
    }
    const FbtColor below = feature_sample_mip(t, 3.3, 2.2, {1.999999, 1}),
                   above = feature_sample_mip(t, 3.3, 2.2, {2.000001, 1});
    EXPECT_NEAR(below.r, above.r, 1e-5);
}

} // namespace
} // namespace fetex
