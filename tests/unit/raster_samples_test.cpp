// SPDX-License-Identifier: GPL-3.0-or-later
/// Textures of images with features: what is sampled where (FBT §4.3 – §4.6).
#include <algorithm>

#include <gtest/gtest.h>

#include "compiler/compile.h"
#include "compiler/diagnostics.h"
#include "formats/fbt_mip.h"
#include "formats/validate.h"
#include "tests/support/raster_picture.h"

namespace fetexc {
namespace {

using test::featured;
using test::grey;
using test::image_of;
using test::polyline;

constexpr double kStep = 1.0 / 255;

FbtBuild build(const FeaturedImage& picture, GridSize size = {}, unsigned threads = 1) {
    if (size.width == 0 && size.height == 0) size = {picture.image.width, picture.image.height};
    auto built = compile_fbt(picture, {size, threads});
    if (!built.ok()) throw std::runtime_error(built.error().message);
    EXPECT_TRUE(fetex::validate_fbt(built.value().texture).empty());
    return std::move(built).value();
}

/// Grey at a point in pixels.
double value_at(const FbtBuild& b, const FeaturedImage& picture, double x, double y) {
    return fetex::fbt_sample(b.texture, x * b.texture.width / picture.image.width,
                             y * b.texture.height / picture.image.height)
        .g;
}

bool has(const FbtBuild& b, int code) {
    return std::ranges::any_of(b.report.diagnostics, [&](const Diagnostic& d) { return d.code == code; });
}

TEST(ImageFbt, keepsBothSidesOfAnEdgeApart) {
    // A blurred edge along a slanted line: pixels within two of it are no samples.
    const auto side = [](double x, double y) { return x - 10 - 0.3 * y; };
    const auto picture = featured(image_of(24, 20,
                                           [&](double x, double y) {
                                               const double t = std::clamp(0.5 + 0.4 * side(x, y), 0.0, 1.0);
                                               return grey(0.2 + 0.6 * t);
                                           }),
                                  {polyline({{9.7, -1}, {16.3, 21}})}, 2);
    const FbtBuild b = build(picture);
    for (double y = 0.05; y < 20; y += 0.31) {
        for (double x = 0.05; x < 24; x += 0.17) {
            if (std::fabs(side(x, y)) < 0.01) continue;
            EXPECT_NEAR(value_at(b, picture, x, y), side(x, y) > 0 ? 0.8 : 0.2, kStep) << x << ", " << y;
        }
    }
}

/// A corridor between two walls, too narrow for a valid pixel, open at its far end only. Beside it, across the wall, it
/// is bright; what it opens to is dark.
TEST(ImageFbt, fillsHolesByReachabilityAndNotByNearness) {
    const auto picture = featured(image_of(40, 16, [](double x, double) { return grey(x < 28 ? 0.9 : 0.1); }),
                                  {polyline({{30, 7.25}, {4, 7.25}, {4, 8.75}, {30, 8.75}}),
                                   polyline({{28, -1}, {28, 7.25}}), polyline({{28, 8.75}, {28, 17}})},
                                  1);
    const FbtBuild b = build(picture);
    for (const double x : {5.5, 9.3, 14.1, 20.7, 26.0}) {
        EXPECT_NEAR(value_at(b, picture, x, 8), 0.1, 2 * kStep) << x;
        EXPECT_NEAR(value_at(b, picture, x, 7.1), 0.9, 2 * kStep) << x;
        EXPECT_NEAR(value_at(b, picture, x, 8.9), 0.9, 2 * kStep) << x;
    }
    EXPECT_GT(b.report.image.holes_filled, 0u);
    EXPECT_EQ(b.report.image.parts_unsampled, 0u);
}

/// A slope on either side of a curve, with a jump between them: close to the curve and across texels it goes on.
TEST(ImageFbt, gradientsGoOnUpToAnEdgeAndAcrossTexels) {
    const auto left = [](double x, double y) { return 0.1 + 0.012 * x + 0.006 * y; };
    const auto right = [](double x, double y) { return 0.95 - 0.006 * x - 0.008 * y; };
    const CanvasPoint c{18, 15};
    const auto inside = [&](double x, double y) { return std::hypot(x - c.x, y - c.y) - 9.3; };
    CanvasContour circle;
    constexpr double k = 0.5522847498, r = 9.3;
    const CanvasPoint at[4] = {{r, 0}, {0, r}, {-r, 0}, {0, -r}};
    for (int q = 0; q < 4; ++q) {
        const CanvasPoint a = at[q], b = at[(q + 1) % 4];
        circle.push_back({3,
                          {{{c.x + a.x, c.y + a.y},
                            {c.x + a.x + k * b.x, c.y + a.y + k * b.y},
                            {c.x + b.x + k * a.x, c.y + b.y + k * a.y},
                            {c.x + b.x, c.y + b.y}}}});
    }
    const auto picture = featured(image_of(36, 30,
                                           [&](double x, double y) {
                                               const double t = std::clamp(0.5 + inside(x, y), 0.0, 1.0);
                                               return grey((1 - t) * left(x, y) + t * right(x, y));
                                           }),
                                  {circle});
    for (const std::uint32_t width : {36u, 18u, 60u}) {
        const FbtBuild b = build(picture, {width, 0});
        double worst = 0;
        for (double y = 0.52; y < 29.5; y += 0.37) {
            for (double x = 0.52; x < 35.5; x += 0.23) {
                const double d = inside(x, y);
                if (std::fabs(d) < 0.02) continue;
                worst = std::max(worst, std::fabs(value_at(b, picture, x, y) - (d < 0 ? left(x, y) : right(x, y))));
            }
        }
        EXPECT_LT(worst, 2.5 * kStep) << width;
        // No steps where texels meet: both limits agree.
        for (std::uint32_t i = 1; i < b.texture.width; ++i) {
            for (std::uint32_t j = 0; j < b.texture.height; ++j) {
                const double y = j + 0.37, x = i;
                const double scale = 36.0 / b.texture.width;
                if (std::fabs(inside(x * scale, y * scale)) < 0.1) continue;
                const auto before = fetex::fbt_sample_local(b.texture, i - 1, j, 1 - 1e-9, 0.37);
                const auto after = fetex::fbt_sample_local(b.texture, i, j, 0, 0.37);
                EXPECT_NEAR(before.g, after.g, 1e-6) << i << ", " << j;
            }
        }
    }
}

/// Where a feature ends, its two sides become one without a step.
TEST(ImageFbt, sidesMeetBehindTheEndOfAFeature) {
    const auto picture = featured(image_of(32, 32,
                                           [](double x, double y) {
                                               const double fade = std::clamp((24 - x) / 24, 0.0, 1.0);
                                               return grey(0.5 + (y < 16 ? -0.4 : 0.4) * fade);
                                           }),
                                  {polyline({{-1, 16}, {25.3, 16}})});
    const FbtBuild b = build(picture, {31, 31}); // the feature runs inside a row of texels
    EXPECT_NEAR(value_at(b, picture, 2, 15.99), 0.5 - 0.4 * 22 / 24, 3 * kStep);
    EXPECT_NEAR(value_at(b, picture, 2, 16.01), 0.5 + 0.4 * 22 / 24, 3 * kStep);
    EXPECT_NEAR(value_at(b, picture, 29, 15.99), 0.5, 3 * kStep);
    EXPECT_NEAR(value_at(b, picture, 29, 15.99), value_at(b, picture, 29, 16.01), kStep);
    EXPECT_EQ(b.report.image.floating, 1u);
}

TEST(ImageFbt, ignoresAndCountsWhatFloatsInATexel) {
    const RasterImage image = image_of(12, 12, [](double x, double) { return grey(x / 12); });
    // Two apart in one texel, a T whose arms end inside, one across a border (a part in each texel), and a ring.
    const auto picture = featured(image, {polyline({{2.2, 2.2}, {2.4, 2.6}}), polyline({{2.7, 2.2}, {2.8, 2.6}}),
                                          polyline({{5.2, 5.5}, {5.8, 5.5}}), polyline({{5.5, 5.5}, {5.5, 5.8}}),
                                          polyline({{7.5, 9.5}, {8.5, 9.5}}),
                                          polyline({{9.2, 2.2}, {9.8, 2.2}, {9.5, 2.8}, {9.2, 2.2}})});
    const FbtBuild b = build(picture);
    EXPECT_EQ(b.report.image.floating, 5u);
    EXPECT_TRUE(has(b, diag::kFeaturesFloating));
    EXPECT_EQ(b.report.fbt.features, 1u); // the ring
    EXPECT_TRUE(has(b, diag::kRegionsUnsampled));
    EXPECT_EQ(b.report.image.parts_unsampled, 1u); // its inside
}

TEST(ImageFbt, withoutFeaturesIsABilinearTextureAndSaysSo) {
    const auto f = [](double x, double y) { return 0.5 + 0.3 * std::sin(0.3 * x) * std::cos(0.25 * y); };
    const auto picture = featured(image_of(40, 30, [&](double x, double y) { return grey(f(x, y)); }), {});
    const FbtBuild b = build(picture);
    EXPECT_TRUE(has(b, diag::kNoFeatures));
    EXPECT_EQ(b.report.fbt.features, 0u);
    EXPECT_TRUE(b.texture.records.empty()); // corners only
    for (double y = 1; y < 29; y += 0.77) {
        for (double x = 1; x < 39; x += 0.71)
            EXPECT_NEAR(value_at(b, picture, x, y), f(x, y), 2.5 * kStep) << x << ", " << y;
    }
}

/// More texels than pixels: no better than the image, and no worse.
TEST(ImageFbt, fillsTexelsWithoutPixels) {
    const auto f = [](double x, double y) { return 0.1 + 0.08 * x + 0.01 * y; };
    const auto picture =
        featured(image_of(9, 6, [&](double x, double y) { return grey(x + 0.4 * y > 6.1 ? 1 - f(x, y) : f(x, y)); }),
                 {polyline({{6.5, -1}, {3.3, 7}})});
    for (const std::uint32_t width : {19u, 36u}) {
        const FbtBuild b = build(picture, {width, 0});
        EXPECT_FALSE(has(b, diag::kTexelsTooSmall));
        for (double y = 0.6; y < 5.4; y += 0.13) {
            for (double x = 0.6; x < 8.4; x += 0.11) {
                const double side = x + 0.4 * y - 6.1;
                if (std::fabs(side) < 0.05) continue;
                EXPECT_NEAR(value_at(b, picture, x, y), side > 0 ? 1 - f(x, y) : f(x, y), 8 * kStep)
                    << width << ": " << x << ", " << y;
            }
        }
    }
}

TEST(ImageFbt, warnsOfTexelsMuchSmallerThanPixels) {
    const auto picture =
        featured(image_of(9, 6, [](double x, double) { return grey(x / 9); }), {polyline({{6.5, -1}, {3.3, 7}})});
    EXPECT_TRUE(has(build(picture, {37, 0}), diag::kTexelsTooSmall));
}

/// A grid line between texels is no place to mix across, either.
TEST(ImageFbt, featuresMayRunAlongTexelBorders) {
    const auto picture =
        featured(image_of(16, 16, [](double x, double y) { return grey((x < 8) == (y < 8) ? 0.2 : 0.8); }),
                 {polyline({{8, 0}, {8, 16}}), polyline({{0, 8}, {16, 8}})}, 0);
    const FbtBuild b = build(picture);
    for (double y = 0.02; y < 16; y += 0.14) {
        for (double x = 0.02; x < 16; x += 0.14)
            EXPECT_NEAR(value_at(b, picture, x, y), (x < 8) == (y < 8) ? 0.2 : 0.8, kStep) << x << ", " << y;
    }
    EXPECT_EQ(b.report.fbt.features, 0u);
    EXPECT_EQ(b.report.planar.regions_connected, 4u);
}

TEST(ImageFbt, keepsTranslucency) {
    const auto picture = featured(image_of(16, 8,
                                           [](double x, double) {
                                               const double a = x < 8 ? 0.25 : 1;
                                               return Rgba{0.5 * a, 0.25 * a, a, a};
                                           }),
                                  {polyline({{8.3, -1}, {7.7, 9}})});
    const FbtBuild b = build(picture);
    const fetex::FbtColor left = fetex::fbt_sample(b.texture, 3, 4), right = fetex::fbt_sample(b.texture, 12, 4);
    EXPECT_NEAR(left.a, 0.25, kStep);
    EXPECT_NEAR(left.b, 0.25, kStep);
    EXPECT_NEAR(left.r, 0.125, kStep);
    EXPECT_NEAR(right.a, 1, kStep);
    EXPECT_NEAR(right.r, 0.5, kStep);
}

TEST(ImageFbt, sameBytesForAnyNumberOfThreads) {
    const auto picture =
        featured(image_of(60, 45, [](double x, double y) { return grey(0.5 + 0.5 * std::sin(x * y * 0.01)); }),
                 {polyline({{-1, 3}, {30, 44}, {61, 5}}), {{3, {{{5, 20}, {20, -10}, {40, 70}, {55, 20}}}}}});
    const FbtBuild one = build(picture, {}, 1), many = build(picture, {}, 4);
    EXPECT_EQ(one.texture.texels, many.texture.texels);
    EXPECT_EQ(one.texture.records, many.texture.records);
    EXPECT_EQ(one.texture.corners, many.texture.corners);
}

/// Levels of odd sizes, whose samples end inside texels, are means of the texture too.
TEST(ImageFbt, hasAMipChainOfItsMeans) {
    const auto picture = featured(
        image_of(23, 14, [](double x, double y) { return grey(x + 0.3 * y < 12 ? 0.2 + 0.01 * y : 0.9 - 0.01 * x); }),
        {polyline({{12.3, -1}, {7.5, 15}})}, 1);
    auto built = compile_fbt(picture, {.size = {23, 14}, .threads = 2, .mips = true});
    ASSERT_TRUE(built.ok());
    const fetex::FbtTexture& t = built.value().texture;
    ASSERT_TRUE(fetex::validate_fbt(t).empty());
    ASSERT_EQ(t.mips.size(), fetex::fbt_mip_samples(23, 14));
    constexpr int kSide = 40;
    for (std::uint32_t k = 1; k <= fetex::fbt_mip_levels(23, 14); ++k) {
        const fetex::FbtMipLevel level = fetex::fbt_mip_level(23, 14, k);
        for (std::uint32_t n = 0; n < level.samples(); ++n) {
            double mean = 0;
            for (int m = 0; m < kSide * kSide; ++m)
                mean += fetex::fbt_sample(t, (n % level.width + (m % kSide + 0.5) / kSide) * 23 / level.width,
                                          (n / level.width + (m / kSide + 0.5) / kSide) * 14 / level.height)
                            .g /
                        (kSide * kSide);
            // A texel that a level cuts counts as if its mean filled it.
            EXPECT_NEAR((t.mips[level.first + n] >> 8 & 255u) / 255.0, mean, k == 1 ? 0.06 : 0.04) << k << " " << n;
        }
    }
    const auto one = compile_fbt(picture, {.size = {23, 14}, .threads = 1, .mips = true});
    ASSERT_TRUE(one.ok());
    EXPECT_EQ(one.value().texture.mips, t.mips);
}

} // namespace
} // namespace fetexc
