// SPDX-License-Identifier: GPL-3.0-or-later
/// What holds for every bi-level texture: t is continuous and its gradient is its slope, coverage grows with t and
/// stays between hard cut and 1/2, levels follow each other without a step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "formats/fbt_mip.h"
#include "tests/support/random.h"
#include "tests/support/random_bilevel.h"

namespace fetexc::test {
namespace {

using namespace fetex;

class BilevelSampling : public testing::TestWithParam<BilevelRule> {
  protected:
    BilevelTexture texture(std::uint64_t seed) {
        return random_bilevel(seed, {.width = 9, .height = 7, .rule = GetParam(), .mips = true});
    }
};

/// No channel changes by more than 1 a texel along either axis, nor do the rules add to that.
TEST_P(BilevelSampling, valuesAreContinuousAcrossTexels) {
    Random random(1);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const BilevelTexture t = texture(seed);
        for (int k = 0; k < 2000; ++k) {
            const double x = random.between(-1, 10), y = random.between(-1, 8), step = 1e-6;
            // Half of the points lie where squares of interpolation meet.
            const double cx = k % 2 ? x : std::round(x) + 0.5 - step / 2, cy = k % 4 < 2 ? y : std::round(y) + 0.5;
            const double here = bilevel_value(t, cx, cy).t;
            EXPECT_LE(std::abs(bilevel_value(t, cx + step, cy).t - here), step * (1 + 1e-6));
            EXPECT_LE(std::abs(bilevel_value(t, cx, cy + step).t - here), step * (1 + 1e-6));
        }
    }
}

TEST_P(BilevelSampling, gradientsAreTheSlopes) {
    Random random(2);
    int compared = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const BilevelTexture t = texture(seed);
        for (int k = 0; k < 500; ++k) {
            const double x = random.between(0, 9), y = random.between(0, 7), h = 1e-5;
            const BilevelValue left = bilevel_value(t, x - h, y), right = bilevel_value(t, x + h, y),
                               up = bilevel_value(t, x, y - h), down = bilevel_value(t, x, y + h),
                               here = bilevel_value(t, x, y);
            // Where another channel or square begins there is no one slope.
            if (std::abs(left.dx - right.dx) + std::abs(up.dy - down.dy) > 1e-4) continue;
            ++compared;
            EXPECT_NEAR((right.t - left.t) / (2 * h), here.dx, 1e-4);
            EXPECT_NEAR((down.t - up.t) / (2 * h), here.dy, 1e-4);
        }
    }
    EXPECT_GT(compared, 9000);
}

TEST_P(BilevelSampling, coverageIsMonotoneAndBetweenTheHardCutAndHalf) {
    Random random(3);
    for (int k = 0; k < 20000; ++k) {
        const BilevelValue a{random.unit(), random.between(-1, 1), random.between(-1, 1)};
        const BilevelValue b{random.between(a.t, 1), a.dx, a.dy};
        const double side = random.unit();
        const BilevelPixel pixel{side, random.unit()}, larger{random.between(side, 1), pixel.height};
        const double coverage = bilevel_coverage(a, pixel), hard = bilevel_coverage(a, {});
        EXPECT_LE(coverage, bilevel_coverage(b, pixel));
        EXPECT_LE(std::abs(coverage - 0.5), std::abs(hard - 0.5));
        EXPECT_LE(std::abs(bilevel_coverage(a, larger) - 0.5), std::abs(coverage - 0.5) + 1e-12);
    }
}

/// The colour against points in the pixel, cut hard. Of small pixels most have an edge that is straight in them; a few
/// have a corner, where two channels meet.
TEST_P(BilevelSampling, coverageIsNearTheMeanOfPointsInSmallPixels) {
    Random random(4);
    double worst = 0, squares = 0;
    int pixels = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        BilevelTexture t = texture(seed);
        t.below = 0xff000000, t.above = 0xffffffff;
        for (int k = 0; k < 4000 && pixels < 3000; ++k) {
            const double x = random.between(0, 9), y = random.between(0, 7), side = 1.0 / 32;
            const double soft = bilevel_sample_area(t, x, y, {side, side}).r;
            if (soft == 0 || soft == 1) continue;
            double sum = 0;
            constexpr int kPoints = 24;
            for (int a = 0; a < kPoints; ++a)
                for (int b = 0; b < kPoints; ++b)
                    sum += bilevel_sample(t, x + side * ((a + 0.5) / kPoints - 0.5),
                                          y + side * ((b + 0.5) / kPoints - 0.5))
                               .r;
            const double difference = std::abs(soft - sum / (kPoints * kPoints));
            worst = std::max(worst, difference), squares += difference * difference;
            ++pixels;
        }
    }
    const double mean = std::sqrt(squares / pixels);
    std::printf("  rule %u: %d pixels with an edge, root mean square %.4f, worst %.3f\n",
                static_cast<unsigned>(GetParam()), pixels, mean, worst);
    EXPECT_GT(pixels, 500);
    EXPECT_LT(mean, bilevel_channels(GetParam()) == 1 ? 0.015 : 0.035);
}

TEST_P(BilevelSampling, levelsFollowEachOtherWithoutAStep) {
    Random random(5);
    const BilevelTexture t = texture(6);
    for (int k = 0; k < 300; ++k) {
        const double x = random.between(0, 9), y = random.between(0, 7);
        FbtColor before = bilevel_sample_mip(t, x, y, {0.9, 0.9});
        for (double side = 0.9; side < 20; side *= 1.0005) {
            const FbtColor now = bilevel_sample_mip(t, x, y, {side, side});
            ASSERT_LT(std::abs(now.a - before.a) + std::abs(now.g - before.g), 0.005) << side;
            before = now;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Rules, BilevelSampling, testing::ValuesIn(kBilevelRules), [](const auto& tested) {
    return std::string(1, static_cast<char>('0' + static_cast<int>(tested.param))) + "_channels" +
           std::to_string(bilevel_channels(tested.param));
});

} // namespace
} // namespace fetexc::test
