// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/differences.h"

#include <gtest/gtest.h>

#include <cmath>

#include "compiler/error_budget.h"
#include "compiler/measure/errors.h"

namespace fetexc::measure {
namespace {

/// Black left of an edge, a grey right of it.
class Halves final : public Picture {
  public:
    Halves(double edge, double grey) : edge_(edge), grey_(grey) {}
    [[nodiscard]] Rgba at(TexturePoint p) const override {
        const double v = p.u < edge_ ? 0 : grey_;
        return {v, v, v, 1};
    }
    [[nodiscard]] GridSize texels() const override { return {1, 1}; }
    [[nodiscard]] std::uint64_t gpu_bytes() const override { return 4; }

  private:
    double edge_, grey_;
};

TEST(Difference, isNothingBetweenEqualPictures) {
    const Halves a(0.3, 0.5);
    const PictureDifference d = difference(a, a, {64, 48}, 2);
    EXPECT_EQ(d.different_ppm, 0);
    EXPECT_EQ(d.max, 0);
    EXPECT_EQ(d.mean, 0);
    EXPECT_TRUE(std::isinf(d.psnr));
}

/// One pixel column of 64 changes from 0.5 to black: 1/64 of the area.
TEST(Difference, countsAStripe) {
    const Halves a(32.0 / 64, 0.5), b(33.0 / 64, 0.5);
    const PictureDifference d = difference(a, b, {64, 64}, 1);
    EXPECT_NEAR(d.different_ppm, 1e6 / 64, 1e-6);
    EXPECT_NEAR(d.max, 0.5, 1e-12);
    EXPECT_NEAR(d.mean, 0.5 / 64, 1e-12);
    EXPECT_NEAR(d.place.u, 32.5 / 64, 0.5 / 64);
    // Each picture's jump lies somewhere in the last halving: half of it, times 0.5, is missed or added.
    const double part = 0.5 * std::ldexp(1.0 / MeasureOptions{}.supersample, -budget::kJumpHalvings);
    EXPECT_NEAR(d.psnr, -10 * std::log10(0.25 / 64), 20 * std::log10((1 + part) / (1 - part)));
    EXPECT_LT(part, 0x1p-11);
}

/// An edge inside pixels: the mean of a pixel cut at t is (1 − t) of the grey.
TEST(Difference, smoothsEdgesForThePsnr) {
    const Halves a(10.25 / 64, 1), b(10.5 / 64, 1);
    const PictureDifference d = difference(a, b, {64, 64}, 2);
    EXPECT_NEAR(d.psnr, -10 * std::log10(0.25 * 0.25 / 64), 0.05);
}

TEST(Difference, takesAStepOfEightBitsForEqual) {
    const Halves a(0.5, 100.0 / 255), b(0.5, 101.0 / 255), c(0.5, 102.0 / 255);
    EXPECT_EQ(difference(a, b, {32, 32}, 1).different_ppm, 0);
    EXPECT_NEAR(difference(a, c, {32, 32}, 1).different_ppm, 500000, 1e-6);
    EXPECT_NEAR(difference(a, b, {32, 32}, 1).max, 1.0 / 255, 1e-12);
}

TEST(Difference, doesNotDependOnThreads) {
    const Halves a(0.31, 0.7), b(0.32, 0.6);
    const PictureDifference one = difference(a, b, {100, 37}, 1), three = difference(a, b, {100, 37}, 3);
    EXPECT_EQ(one.different_ppm, three.different_ppm);
    EXPECT_EQ(one.mean, three.mean);
    EXPECT_EQ(one.psnr, three.psnr);
    EXPECT_EQ(one.place.u, three.place.u);
}

TEST(Means, countAlphaOverBlackAndWhite) {
    EXPECT_NEAR(mean_square_error({{1, 1, 1, 1}}, {{0, 0, 0, 0}}), 0.5,
                1e-12); // white against nothing: seen over black
    EXPECT_NEAR(mean_square_error({{0, 0, 0, 1}}, {{0, 0, 0, 0}}), 0.5, 1e-12); // black against nothing: over white
}

} // namespace
} // namespace fetexc::measure
