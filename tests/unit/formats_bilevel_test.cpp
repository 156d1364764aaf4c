// SPDX-License-Identifier: GPL-3.0-or-later
/// The reference sampler of bi-level textures against values computed by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "formats/bilevel.h"
#include "formats/validate.h"
#include "tests/support/random_bilevel.h"

namespace fetex {
namespace {

using fetexc::test::random_bilevel;

constexpr std::uint32_t kBlack = 0xff000000, kWhite = 0xffffffff;

BilevelTexture grey(std::uint32_t width, std::uint32_t height, std::vector<std::uint8_t> texels,
                    BilevelRule rule = BilevelRule::Single) {
    BilevelTexture t;
    t.width = width, t.height = height;
    t.rule = rule, t.channels = bilevel_channels(rule);
    t.texels = std::move(texels);
    t.below = kBlack, t.above = kWhite;
    EXPECT_TRUE(validate_bilevel(t).empty());
    return t;
}

void expect_value(const BilevelValue& v, double t, double dx, double dy) {
    EXPECT_NEAR(v.t, t, 1e-15);
    EXPECT_NEAR(v.dx, dx, 1e-15);
    EXPECT_NEAR(v.dy, dy, 1e-15);
}

TEST(BilevelValues, areInterpolatedBetweenTheMiddlesOfTexels) {
    const BilevelTexture t = grey(2, 2, {0, 51, 102, 255}); // 0, 0.2, 0.4, 1
    expect_value(bilevel_value(t, 1, 1), 0.4, 0.4, 0.6);
    expect_value(bilevel_value(t, 0.75, 1.25), 0.25 * 0.25 * 0.2 + 0.75 * 0.75 * 0.4 + 0.25 * 0.75 * 1,
                 0.25 * 0.2 + 0.75 * 0.6, 0.75 * 0.4 + 0.25 * 0.8);
    expect_value(bilevel_value(t, 0.5, 0.5), 0, 0.2, 0.4); // a middle: the square to the right and below
}

TEST(BilevelValues, areRepeatedBeyondTheOutermostMiddles) {
    const BilevelTexture t = grey(2, 2, {0, 51, 102, 255});
    for (const double far : {-5.0, 0.0, 0.25, 0.4999}) {
        expect_value(bilevel_value(t, far, far), 0, 0, 0);
        expect_value(bilevel_value(t, 2 - far, far), 0.2, 0, 0);
        expect_value(bilevel_value(t, far, 2 - far), 0.4, 0, 0);
        expect_value(bilevel_value(t, 2 - far, 2 - far), 1, 0, 0);
        expect_value(bilevel_value(t, 1, far), 0.1, 0.2, 0);
        expect_value(bilevel_value(t, far, 1), 0.2, 0, 0.4);
    }
    const double nan = std::numeric_limits<double>::quiet_NaN();
    expect_value(bilevel_value(t, nan, nan), 0, 0, 0);
    expect_value(bilevel_value(grey(1, 1, {51}), 0.9, 0.1), 0.2, 0, 0);
}

/// Two channels that cross: 0, 1 and 0.8, 0.4 along x. Half way 0.5 and 0.6.
TEST(BilevelRules, chooseAValueWithItsGradient) {
    const std::vector<std::uint8_t> texels = {0, 204, 255, 102};
    const BilevelTexture least = grey(2, 1, texels, BilevelRule::Min), most = grey(2, 1, texels, BilevelRule::Max);
    expect_value(bilevel_value(least, 1, 0.5), 0.5, 1, 0);
    expect_value(bilevel_value(most, 1, 0.5), 0.6, -0.4, 0);
    expect_value(bilevel_value(least, 1.25, 0.5), 0.5, -0.4, 0);
    expect_value(bilevel_value(most, 1.25, 0.5), 0.75, 1, 0);
}

/// Three channels, and all orders of them: 0, 0.4, 1 at the left, 0.2, 0.8, 0.6 at the right.
TEST(BilevelRules, takeTheMedianOfThree) {
    std::array<std::size_t, 3> order = {0, 1, 2};
    const std::array<std::uint8_t, 3> left = {0, 102, 255}, right = {51, 204, 153};
    do {
        std::vector<std::uint8_t> texels(6);
        for (std::size_t k = 0; k < 3; ++k)
            texels[k] = left[order[k]], texels[3 + k] = right[order[k]];
        const BilevelTexture t = grey(2, 1, texels, BilevelRule::Median);
        expect_value(bilevel_value(t, 0.25, 0.5), 0.4, 0, 0);
        expect_value(bilevel_value(t, 0.75, 0.5), 0.5, 0.4, 0);  // 0.05, 0.5, 0.9
        expect_value(bilevel_value(t, 1.4, 0.5), 0.64, -0.4, 0); // 0.18, 0.76, 0.64
        expect_value(bilevel_value(t, 1.75, 0.5), 0.6, 0, 0);
    } while (std::next_permutation(order.begin(), order.end()));
}

TEST(BilevelRules, takeTheFirstOfEqualChannels) {
    const BilevelTexture t = grey(2, 1, {0, 255, 255, 0}, BilevelRule::Min);
    expect_value(bilevel_value(t, 1, 0.5), 0.5, 1, 0);
    expect_value(bilevel_value(grey(2, 1, {255, 0, 0, 255}, BilevelRule::Max), 1, 0.5), 0.5, -1, 0);
}

TEST(BilevelCut, isHardForAPoint) {
    const BilevelTexture t = grey(2, 1, {0, 255});
    EXPECT_EQ(bilevel_sample(t, 1 - 1e-9, 0.5).r, 0);
    EXPECT_EQ(bilevel_sample(t, 1, 0.5).r, 0); // t is 1/2
    EXPECT_EQ(bilevel_sample(t, 1 + 1e-9, 0.5).r, 1);
    EXPECT_EQ(bilevel_coverage({0.7, 0, 0}, {1, 1}), 1); // nothing changes
    EXPECT_EQ(bilevel_coverage({0.5, 0, 0}, {1, 1}), 0);
}

/// An edge along an axis, and a pixel that the edge divides.
TEST(BilevelCut, isTheExactCoverageOfEdgesAlongAnAxis) {
    const BilevelTexture across = grey(2, 1, {51, 255}), down = grey(1, 2, {51, 255});
    const double edge = 0.5 + 0.3 / 0.8;
    for (const double side : {0.01, 0.1, 0.6}) {
        for (double at = edge - 0.35; at < edge + 0.35; at += 0.013) {
            const double exact = std::clamp((at + side / 2 - edge) / side, 0.0, 1.0);
            EXPECT_NEAR(bilevel_sample_area(across, at, 0.5, {side, 0.7}).g, exact, 1e-12);
            EXPECT_NEAR(bilevel_sample_area(down, 0.5, at, {0.7, side}).g, exact, 1e-12);
        }
    }
}

/// The part of a pixel where d + x·u + y·v > 0, u and v its coordinates from -1/2 to 1/2: the pixel clipped as a
/// polygon.
double clipped_part(double d, double x, double y) {
    constexpr std::array<std::array<double, 2>, 4> kCorners = {{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}};
    std::vector<std::array<double, 2>> inside;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto &a = kCorners[k], &b = kCorners[(k + 1) % 4];
        const double from = d + x * a[0] + y * a[1], to = d + x * b[0] + y * b[1];
        if (from > 0) inside.push_back(a);
        if ((from > 0) == (to > 0)) continue;
        const double part = from / (from - to);
        inside.push_back({std::lerp(a[0], b[0], part), std::lerp(a[1], b[1], part)});
    }
    double twice = 0;
    for (std::size_t k = 0; k < inside.size(); ++k) {
        const auto &a = inside[k], &b = inside[(k + 1) % inside.size()];
        twice += a[0] * b[1] - a[1] * b[0];
    }
    return twice / 2;
}

/// Numbers up to 1, rounded some twenty times on either way; 2^-53 each.
constexpr double kRounding = 1e-14;

/// Slopes and pixels with all kinds of angles between edge and pixel, some of them very nearly upright.
std::vector<std::pair<BilevelValue, BilevelPixel>> slopes_and_pixels() {
    std::vector<double> angles;
    for (int k = 0; k < 96; ++k)
        angles.push_back(k * 0.0654498469497873573); // a turn in 96 steps
    for (const double little : {1e-3, 1e-6, 1e-9, 1e-15, 1e-18, 1e-200, 1e-310})
        angles.insert(angles.end(), {little, -little, std::numbers::pi / 2 - little});
    std::vector<std::pair<BilevelValue, BilevelPixel>> all;
    for (const double angle : angles)
        for (const double slope : {1.3, 0.02})
            for (const BilevelPixel pixel : {BilevelPixel{1, 1}, {0.25, 0.25}, {0.9, 0.1}, {0.001, 0.5}, {1, 1e-12}})
                all.push_back({{0.5, slope * std::cos(angle), slope * std::sin(angle)}, pixel});
    return all;
}

/// How far from 1/2 t is where the edge leaves the pixel.
double reach(const BilevelValue& v, BilevelPixel pixel) {
    return (std::abs(v.dx) * pixel.width + std::abs(v.dy) * pixel.height) / 2;
}

TEST(BilevelCut, isTheExactCoverageOfStraightEdges) {
    for (auto [v, pixel] : slopes_and_pixels()) {
        const double leaves = reach(v, pixel);
        for (double at = -1.2; at <= 1.2; at += 0.03) {
            v.t = 0.5 + at * leaves;
            const double exact = clipped_part(v.t - 0.5, v.dx * pixel.width, v.dy * pixel.height);
            ASSERT_NEAR(bilevel_coverage(v, pixel), exact, kRounding) << v.dx << ' ' << v.dy << ' ' << at;
        }
    }
}

TEST(BilevelCut, ofASlantedEdgeByHand) {
    const double dx = 0.3, dy = -0.2; // over the pixel 0.06 and 0.02: straight to ±0.02, gone at ±0.04
    const BilevelPixel pixel{0.2, 0.1};
    EXPECT_DOUBLE_EQ(bilevel_coverage({0.5, dx, dy}, pixel), 0.5);
    EXPECT_NEAR(bilevel_coverage({0.51, dx, dy}, pixel), 2.0 / 3, kRounding);
    EXPECT_NEAR(bilevel_coverage({0.52, dx, dy}, pixel), 5.0 / 6, kRounding);
    EXPECT_NEAR(bilevel_coverage({0.53, dx, dy}, pixel), 23.0 / 24, kRounding);
    EXPECT_NEAR(bilevel_coverage({0.47, dx, dy}, pixel), 1.0 / 24, kRounding);
    EXPECT_NEAR(bilevel_coverage({0.54, dx, dy}, pixel), 1, kRounding);
    EXPECT_NEAR(bilevel_coverage({0.46, dx, dy}, pixel), 0, kRounding);
    EXPECT_EQ(bilevel_coverage({0.5401, dx, dy}, pixel), 1);
    EXPECT_EQ(bilevel_coverage({0.4599, dx, dy}, pixel), 0);
}

/// A small step of t is a small step of the coverage, upwards; also where one piece of it ends and the next begins.
TEST(BilevelCut, isContinuousAndMonotone) {
    for (auto [v, pixel] : slopes_and_pixels()) {
        const double x = std::abs(v.dx) * pixel.width, y = std::abs(v.dy) * pixel.height;
        for (const double place : {-(x + y) / 2, -std::abs(x - y) / 2, 0.0, std::abs(x - y) / 2, (x + y) / 2}) {
            double before = 0, last = 0;
            for (int step = -20; step <= 20; ++step) {
                v.t = 0.5 + place + step * 1e-3 * (x + y);
                const double coverage = bilevel_coverage(v, pixel);
                ASSERT_TRUE(coverage >= 0 && coverage <= 1) << coverage;
                if (step > -20) {
                    ASSERT_GE(coverage, before - kRounding);
                    ASSERT_LE(coverage, before + (v.t - last) / std::max(x, y) + kRounding);
                }
                before = coverage, last = v.t;
            }
        }
    }
}

/// Nothing becomes of a slope too small for its square, or of none, but a hard cut.
TEST(BilevelCut, isANumberForEverySlope) {
    constexpr double kLeast = std::numeric_limits<double>::denorm_min();
    for (const double dx : {0.0, kLeast, 1e-310, 1e-200, 1e-20, 1.0}) {
        for (const double dy : {0.0, kLeast, 1e-310, 1e-200, 1e-20, 1.0}) {
            for (const double side : {0.0, kLeast, 1e-160, 1.0}) {
                for (const double t : {0.0, 0.5, 1.0, std::nextafter(0.5, 1.0)}) {
                    const double coverage = bilevel_coverage({t, dx, dy}, {side, 1});
                    ASSERT_TRUE(coverage >= 0 && coverage <= 1) << dx << ' ' << dy << ' ' << side << ' ' << t;
                    if (std::max(dx, dy) < 1e-20) {
                        EXPECT_EQ(coverage, t > 0.5 ? 1.0 : t < 0.5 || (dx * side == 0 && dy == 0) ? 0.0 : 0.5);
                    }
                }
            }
        }
    }
}

TEST(BilevelCut, countsSidesBeyondATexelAsOne) {
    const BilevelValue v{0.6, 0.4, 0.1};
    EXPECT_EQ(bilevel_coverage(v, {7, 1}), bilevel_coverage(v, {1, 1}));
    EXPECT_EQ(bilevel_coverage(v, {-1, 0.5}), bilevel_coverage(v, {0, 0.5}));
    EXPECT_EQ(bilevel_coverage(v, {std::numeric_limits<double>::quiet_NaN(), 0}), 1);
}

TEST(BilevelColors, areMixedPremultiplied) {
    BilevelTexture t = grey(2, 1, {0, 255});
    t.below = 0x80800000, t.above = 0x00000000;
    const FbtColor c = bilevel_sample_area(t, 1.1, 0.5, {0.8, 0}); // coverage 0.625
    EXPECT_NEAR(c.r, 0, 1e-15);
    EXPECT_NEAR(c.b, 0.375 * 128 / 255, 1e-15);
    EXPECT_NEAR(c.a, 0.375 * 128 / 255, 1e-15);
}

TEST(BilevelColors, ofAnImageLieOverTheWholeTexture) {
    BilevelTexture t = grey(4, 2, std::vector<std::uint8_t>(8, 255));
    t.image_width = 2, t.image_height = 1;
    t.image = {0xff0000ff, 0xffff0000};
    EXPECT_DOUBLE_EQ(bilevel_sample(t, 0.5, 1).r, 1); // beyond the first sample's middle, x = 1
    EXPECT_DOUBLE_EQ(bilevel_sample(t, 1, 1).r, 1);
    EXPECT_DOUBLE_EQ(bilevel_sample(t, 1.5, 0.1).r, 0.75);
    EXPECT_DOUBLE_EQ(bilevel_sample(t, 1.5, 1.9).b, 0.25);
    EXPECT_DOUBLE_EQ(bilevel_sample(t, 9, 9).b, 1);
    t.texels.assign(8, 0);
    EXPECT_DOUBLE_EQ(bilevel_sample(t, 1.5, 1).r, 0); // below isn't the image's affair
}

/// 4×2 texels: levels of 2×1 and 1×1.
TEST(BilevelLevels, areMixedByTheSquareOfTheLogarithmOfTheLongerSide) {
    BilevelTexture t = grey(4, 2, {0, 0, 255, 255, 0, 0, 255, 255});
    t.mips = {51, 204, 102}; // 0.2, 0.8; 0.4
    const auto red = [&](double x, double side) { return bilevel_sample_mip(t, x, 1, {side, side}).r; };
    EXPECT_NEAR(red(1, 2), 0.2, 1e-15); // a sample of level 1
    EXPECT_NEAR(red(2, 2), 0.5, 1e-15);
    EXPECT_NEAR(red(-3, 2), 0.2, 1e-15);
    EXPECT_NEAR(red(1, 4), 0.4, 1e-15);
    EXPECT_NEAR(red(3, 1e6), 0.4, 1e-15);
    EXPECT_NEAR(red(1, 2 * std::sqrt(2.0)), 0.25, 1e-15); // a quarter of the coarser
    EXPECT_NEAR(red(2, 1), 0.5, 1e-15);                   // the soft cut
    EXPECT_NEAR(red(2.25, 1), 0.75, 1e-15);
    EXPECT_NEAR(red(2.25, std::sqrt(2.0)), 0.75 * 0.75 + 0.25 * (0.2 + 0.6 * 0.625), 1e-15);
    EXPECT_EQ(bilevel_sample_mip(t, 2.25, 1, {0.3, 4}).r, bilevel_sample_mip(t, 2.25, 1, {4, 0.1}).r);
    EXPECT_NEAR(bilevel_sample_mip(t, 2.1, 1, {0.4, 0.3}).r, bilevel_sample_area(t, 2.1, 1, {0.4, 0.3}).r, 1e-15);
}

TEST(BilevelSizes, countEveryByte) {
    BilevelTexture t = random_bilevel(
        1, {.width = 5, .height = 3, .rule = BilevelRule::Median, .mips = true, .image_width = 2, .image_height = 3});
    EXPECT_EQ(bilevel_gpu_bytes(t), 45u + 3u + 24u);
}

TEST(BilevelSampling, isTheSameFromTexelAndOffset) {
    for (const BilevelRule rule : fetexc::test::kBilevelRules) {
        const BilevelTexture t = random_bilevel(5, {.width = 6, .height = 4, .rule = rule});
        for (std::uint32_t j = 0; j < 4; ++j)
            for (std::uint32_t i = 0; i < 6; ++i)
                for (const double f : {0.0, 0.25, 0.5, 0.875}) {
                    const BilevelValue a = bilevel_value(t, i + f, j + 1 - f - 0x1p-10),
                                       b = bilevel_value_local(t, i, j, f, 1 - f - 0x1p-10);
                    EXPECT_EQ(a.t, b.t);
                    EXPECT_EQ(a.dx, b.dx);
                    EXPECT_EQ(bilevel_sample(t, i + f, j + f).r, bilevel_sample_local(t, i, j, f, f).r);
                }
    }
}

} // namespace
} // namespace fetex
