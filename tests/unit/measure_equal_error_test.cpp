// SPDX-License-Identifier: GPL-3.0-or-later
/// The bitmap size for equal error: the search on made-up errors, then on a drawing.
#include <gtest/gtest.h>

#include <set>

#include "compiler/measure/equal_error.h"
#include "compiler/measure/sparse_bitmap.h"
#include "tests/support/drawn_scene.h"

namespace fetexc::measure {
namespace {

TEST(SmallestSide, isFoundWhereverItIs) {
    for (std::uint32_t first_good = 1; first_good <= 1000; ++first_good) {
        std::set<std::uint32_t> asked;
        const auto found = smallest_side(1000, 0, [&](std::uint32_t side) -> Result<bool> {
            EXPECT_LE(side, 1000u);
            EXPECT_TRUE(asked.insert(side).second) << "no size is measured twice";
            return side >= first_good;
        });
        ASSERT_TRUE(found.ok());
        EXPECT_TRUE(found.value().found);
        EXPECT_EQ(found.value().side, first_good);
        EXPECT_EQ(found.value().tried, asked.size());
        EXPECT_LE(asked.size(), 18u);
    }
}

TEST(SmallestSide, isWithinThePrecision) {
    for (const std::uint32_t first_good : {9u, 100u, 5000u, 12345u, 16384u}) {
        const auto found =
            smallest_side(16384, 0.05, [&](std::uint32_t side) -> Result<bool> { return side >= first_good; });
        ASSERT_TRUE(found.ok());
        EXPECT_GE(found.value().side, first_good);
        EXPECT_LE(found.value().side, std::max<double>(first_good, first_good / 0.95 + 1));
        EXPECT_LE(found.value().tried, 18u);
    }
}

TEST(SmallestSide, saysWhenEvenTheLargestIsTooSmall) {
    std::uint32_t last = 0;
    const auto found = smallest_side(1000, 0.02, [&](std::uint32_t side) -> Result<bool> {
        last = side;
        return false;
    });
    ASSERT_TRUE(found.ok());
    EXPECT_FALSE(found.value().found);
    EXPECT_EQ(found.value().side, 1000u);
    EXPECT_EQ(last, 1000u) << "the largest was tried";
    EXPECT_FALSE(smallest_side(1000, 0, [](std::uint32_t) -> Result<bool> { return Error{}; }).ok());
}

class EqualError : public testing::Test {
  protected:
    EqualError()
        : scene_(test::scene_of({test::closed({{{70, 60}, {430, 101}}, {{430, 101}, {500, 300}, {333, 433}}})})) {
        options_.measure.sizes = {{200, 200}};
        options_.precision = 0;
    }
    void SetUp() override {
        auto truth = Truth::of(scene_, 1);
        ASSERT_TRUE(truth.ok());
        truth_ = std::move(truth).value();
    }
    [[nodiscard]] SizeErrors errors_at(std::uint32_t side) const {
        const auto measured = measure(*truth_, SparseBitmap(*truth_, {side, side}, 1), options_.measure);
        EXPECT_TRUE(measured.ok());
        return measured.value().front();
    }

    Scene scene_;
    std::unique_ptr<Truth> truth_;
    EqualErrorOptions options_;
};

/// Errors go up and down from size to size, so a bitmap's own need not be the one found.
TEST_F(EqualError, isReachedJustThere) {
    for (const ErrorFigure figure : {ErrorFigure::MisclassifiedArea, ErrorFigure::Psnr}) {
        options_.figure = figure;
        const auto value = [&](const SizeErrors& e) {
            return figure == ErrorFigure::Psnr ? e.psnr : e.misclassified_ppm;
        };
        const double target = value(errors_at(100));
        const auto found = bitmap_of_equal_error(*truth_, target, options_);
        ASSERT_TRUE(found.ok());
        EXPECT_TRUE(found.value().found);
        EXPECT_NEAR(found.value().size.width, 100, 30);
        EXPECT_EQ(found.value().bytes, std::uint64_t{found.value().size.width} * found.value().size.height * 4);
        EXPECT_EQ(found.value().error, value(errors_at(found.value().size.width)));
        if (figure == ErrorFigure::Psnr) {
            EXPECT_GE(found.value().error, target);
            EXPECT_LT(value(errors_at(found.value().size.width - 1)), target);
        } else {
            EXPECT_LE(found.value().error, target);
            EXPECT_GT(value(errors_at(found.value().size.width - 1)), target);
        }
    }
}

TEST_F(EqualError, mayNotBeReached) {
    options_.largest = 32;
    const auto found = bitmap_of_equal_error(*truth_, errors_at(100).misclassified_ppm, options_);
    ASSERT_TRUE(found.ok());
    EXPECT_FALSE(found.value().found);
    EXPECT_EQ(found.value().text(), "more than 32x32");
    EXPECT_EQ(found.value().error, errors_at(32).misclassified_ppm);
}

} // namespace
} // namespace fetexc::measure
