// SPDX-License-Identifier: GPL-3.0-or-later
/// Fits of bi-level textures: what they reach on six shapes, and rules that every fit keeps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>

#include "compiler/bilevel/bilevel_builder.h"
#include "compiler/bilevel/coverage.h"
#include "compiler/bilevel/seed.h"
#include "compiler/bilevel/threshold_cells.h"
#include "compiler/error_budget.h"
#include "tests/support/art_scenes.h"
#include "tests/support/drawn_scene.h"

namespace fetexc {
namespace {

using fetex::BilevelRule;
using test::kShapes;
using test::silhouette_of_shape;

GridSize square_of(double bytes) {
    const auto side = static_cast<std::uint32_t>(std::sqrt(bytes));
    return {side, side};
}

BilevelBuild fit(const Silhouette& s, GridSize size, std::uint32_t channels) {
    BilevelOptions options;
    options.size = size, options.channels = channels, options.threads = 0;
    auto made = compile_bilevel(s, options);
    EXPECT_TRUE(made.ok());
    return std::move(made).value();
}

/// Part of the points that the texture has on the wrong side, through the reference sampler. Independent of the fit's
/// scan lines but for the outline.
double wrong_points(const Silhouette& s, const fetex::BilevelTexture& t) {
    constexpr std::uint32_t kPoints = 2048;
    const ScannedOutline truth(s, outline_in_texels(s, kPoints, kPoints), kPoints, kPoints, 2);
    std::size_t wrong = 0;
    for (std::uint32_t y = 0; y < kPoints; ++y) {
        for (std::uint32_t x = 0; x < kPoints; ++x) {
            const double u = (x + 0.5) / kPoints, v = (y + 0.25) / kPoints;
            wrong += (fetex::bilevel_value(t, u * t.width, v * t.height).t > 0.5) != truth.above(x + 0.5, y + 0.25);
        }
    }
    return static_cast<double>(wrong) / kPoints / kPoints;
}

/// The same around the outline, along more lines than any fit sees: a hundred parts in a million of the points above
/// would be a hundred of them, and 10 % of that chance.
double wrong_area(const Silhouette& s, const fetex::BilevelTexture& t) {
    const ScannedOutline scanned(s, outline_in_texels(s, t.width, t.height), t.width, t.height, 96);
    return ThresholdCells(scanned, t.width, t.height, t.rule).wrong_area(t.texels) / (double{1} * t.width * t.height);
}

struct Bar {
    double bytes, ppm;
};

double mean_ppm(double bytes, std::uint32_t channels) {
    double logs = 0;
    for (const char* name : kShapes) {
        const Silhouette s = silhouette_of_shape(name);
        const BilevelBuild b = fit(s, square_of(bytes), channels);
        EXPECT_LE(b.texture.texels.size(), bytes * 1.001) << name;
        EXPECT_EQ(b.stats.parts.invented, 0u) << name << " " << bytes;
        logs += std::log(b.stats.fits[0].wrong);
    }
    return std::exp(logs / std::size(kShapes)) * 1e6;
}

/// Geometric means of the wrong area over six shapes.
TEST(BilevelFit, sixShapesInOneChannel) {
    for (const Bar& bar : {Bar{768, 2900}, {3072, 850}, {12288, 190}, {49152, 50}}) {
        const double ppm = mean_ppm(bar.bytes, 1);
        std::printf("  %.0f bytes, one channel: %.1f ppm\n", bar.bytes, ppm);
        EXPECT_LE(ppm, bar.ppm);
    }
}
TEST(BilevelFit, sixShapesInAsManyBytesOfMoreChannels) {
    for (const Bar& bar : {Bar{768, 1450}, {3072, 425}, {12288, 95}, {49152, 25}}) {
        const double ppm = mean_ppm(bar.bytes, 0);
        std::printf("  %.0f bytes, channels chosen: %.1f ppm\n", bar.bytes, ppm);
        EXPECT_LE(ppm, bar.ppm);
    }
}

/// Of any values, by every rule.
TEST(BilevelFit, areasAreThoseOfTheSampler) {
    const Silhouette s = silhouette_of_shape("glyph_g");
    std::mt19937 random(5);
    for (const BilevelRule rule : {BilevelRule::Single, BilevelRule::Min, BilevelRule::Max, BilevelRule::Median}) {
        fetex::BilevelTexture t;
        t.width = t.height = 20, t.rule = rule, t.channels = fetex::bilevel_channels(rule);
        const std::vector<OutlineSegment> outline = outline_in_texels(s, 20, 20);
        const ScannedOutline scanned(s, outline, 20, 20, 64);
        const ThresholdCells cells(scanned, 20, 20, rule);
        t.texels = seed_values(cells, scanned, outline, budget::kSeedReach, 0);
        for (const std::uint32_t texel : cells.texels()) {
            for (std::uint32_t c = 0; c < t.channels; ++c)
                t.texels[std::size_t{texel} * t.channels + c] = static_cast<std::uint8_t>(random());
        }
        EXPECT_NEAR(wrong_points(s, t), cells.wrong_area(t.texels) / 400, 2e-4) << static_cast<int>(rule);
    }
}

TEST(BilevelFit, reportsWhatTheSamplerShows) {
    const Silhouette s = silhouette_of_shape("glyph_g");
    for (const std::uint32_t channels : {1u, 2u, 3u}) {
        const BilevelBuild b = fit(s, {40, 40}, channels);
        EXPECT_NEAR(wrong_points(s, b.texture) * 1e6, b.stats.fits[0].wrong * 1e6, 60) << channels;
        EXPECT_LE(b.stats.fits[0].trace.back(), b.stats.fits[0].trace.front() * 1.0001);
    }
}

TEST(BilevelFit, isTheSameForAnyThreads) {
    const Silhouette s = silhouette_of_shape("star");
    BilevelOptions options;
    options.size = {30, 30}, options.mips = true;
    options.threads = 1;
    const auto one = compile_bilevel(s, options);
    options.threads = 4;
    const auto four = compile_bilevel(s, options);
    EXPECT_EQ(one.value().texture.texels, four.value().texture.texels);
    EXPECT_EQ(one.value().texture.mips, four.value().texture.mips);
    EXPECT_EQ(one.value().texture.rule, four.value().texture.rule);
}

TEST(BilevelFit, keepsAwayFromGreysIfTold) {
    BilevelOptions options;
    options.size = {40, 40}, options.channels = 1, options.greys = MidGreys::Avoid;
    const auto made = compile_bilevel(silhouette_of_shape("icon"), options);
    EXPECT_TRUE(std::ranges::none_of(made.value().texture.texels, [](std::uint8_t v) { return v >= 112 && v <= 143; }));
}

/// An edge at any place and angle is off by less than what one step of a byte moves it, where values change over the
/// reach on both sides.
TEST(BilevelFit, straightEdgesAreWithinAByte) {
    const double step = 2 * budget::kSeedReach / 255; // texels
    for (const auto& [x0, x1] : {std::pair{200, 200}, {203, 203}, {180, 290}, {90, 430}}) {
        const auto scene =
            test::scene_of({test::closed({{{-100, 0}, {x0, 0}}, {{x0, 0}, {x1, 512}}, {{x1, 512}, {-100, 512}}})});
        const Silhouette s = silhouette_of(scene, {}, 1).value();
        EXPECT_LT(fit(s, {16, 16}, 1).stats.fits[0].wrong * 16 * 16, 16 * step) << x0;
    }
}

TEST(BilevelFit, aPictureOfOneColourIsFlat) {
    Silhouette s;
    for (const bool above : {false, true}) {
        s.above_everywhere = above;
        const BilevelBuild b = fit(s, {3, 2}, 1);
        EXPECT_EQ(b.texture.texels, std::vector<std::uint8_t>(6, above ? 255 : 0));
        EXPECT_EQ(b.stats.fits[0].wrong, 0);
    }
}

TEST(BilevelFit, levelsAreCoverage) {
    const Silhouette s = silhouette_of_shape("yin_yang");
    BilevelOptions options;
    options.size = {32, 32}, options.channels = 1, options.mips = true;
    const auto made = compile_bilevel(s, options);
    const std::vector<double> half = coverage(s, 16, 16);
    for (std::size_t k = 0; k < half.size(); ++k)
        EXPECT_NEAR(made.value().texture.mips[k], half[k] * 255, 0.5001);
}

/// Between the levels nothing is grey that isn't half covered: pictures of n pixels a side against exact coverage.
TEST(BilevelFit, levelsChangeWithoutHalos) {
    for (const char* name : kShapes) {
        const Silhouette s = silhouette_of_shape(name);
        BilevelOptions options;
        options.size = {64, 64}, options.channels = 1, options.mips = true;
        fetex::BilevelTexture t = compile_bilevel(s, options).value().texture;
        t.below = 0xff000000u, t.above = 0xffffffffu;
        std::printf("  %s:", name);
        for (const std::uint32_t n : {128u, 64u, 56u, 48u, 40u, 32u, 24u, 16u}) {
            const std::vector<double> truth = coverage(s, n, n);
            const double side = 64.0 / n;
            double squares = 0;
            for (std::uint32_t y = 0; y < n; ++y) {
                for (std::uint32_t x = 0; x < n; ++x) {
                    const fetex::FbtColor c =
                        fetex::bilevel_sample_mip(t, (x + 0.5) * side, (y + 0.5) * side, {side, side});
                    const double d = c.r - truth[std::size_t{y} * n + x];
                    squares += d * d;
                }
            }
            const double decibels = -10 * std::log10(squares / n / n);
            std::printf(" %u: %.1f", n, decibels);
            EXPECT_GE(decibels, n == 32 || n == 16 ? 40 : 20) << name << " " << n;
        }
        std::printf(" dB\n");
    }
}

/// A picture of 1024² pixels says as much as the drawing.
TEST(BilevelFit, ofABitmapIsAsGoodAsOfTheDrawing) {
    for (const char* name : kShapes) {
        const Silhouette drawn = silhouette_of_shape(name);
        constexpr std::uint32_t kSide = 1024;
        RasterImage image{kSide, kSide, {}};
        for (const double part : coverage(drawn, kSide, kSide)) {
            const auto v = static_cast<float>(std::lround((1 - part) * 255) * 257);
            image.rgba.insert(image.rgba.end(), {v, v, v, 65535});
        }
        const Silhouette seen = silhouette_of(image, {}).value();
        const double from_bitmap = wrong_area(drawn, fit(seen, {64, 64}, 1).texture),
                     from_drawing = wrong_area(drawn, fit(drawn, {64, 64}, 1).texture);
        std::printf("  %s: %.1f ppm from a bitmap, %.1f from the drawing\n", name, from_bitmap * 1e6,
                    from_drawing * 1e6);
        EXPECT_LE(from_bitmap, 1.1 * from_drawing) << name;
    }
}

} // namespace
} // namespace fetexc
