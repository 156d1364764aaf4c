// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/raster/invalidation.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "compiler/error_budget.h"
#include "tests/support/raster_picture.h"

namespace fetexc {
namespace {

using test::polyline;

constexpr std::uint32_t kWidth = 32, kHeight = 16;

std::vector<std::uint8_t> mask_of(std::vector<CanvasContour> runs, double distance) {
    const FeatureCurves curves{kWidth, kHeight, std::move(runs)};
    const auto scene = feature_scene(curves, kWidth, kHeight);
    EXPECT_TRUE(scene.ok());
    return invalid_pixels(scene.value(), kWidth, kHeight, distance);
}

std::vector<std::uint32_t> invalid_columns(const std::vector<std::uint8_t>& mask, std::uint32_t row) {
    std::vector<std::uint32_t> columns;
    for (std::uint32_t x = 0; x < kWidth; ++x) {
        if (mask[row * kWidth + x] != 0) columns.push_back(x);
    }
    return columns;
}

TEST(Invalidation, takesPixelsWhoseCentreIsWithinTheDistance) {
    const std::vector<CanvasContour> upright{polyline({{5.5, 0}, {5.5, 16}})};
    EXPECT_EQ(invalid_columns(mask_of(upright, 1), 7), (std::vector<std::uint32_t>{4, 5, 6}));
    EXPECT_EQ(invalid_columns(mask_of(upright, 0.99), 7), (std::vector<std::uint32_t>{5}));
    EXPECT_EQ(invalid_columns(mask_of(upright, 0), 7), (std::vector<std::uint32_t>{5}));
    const std::vector<CanvasContour> between{polyline({{5, 0}, {5, 16}})};
    EXPECT_EQ(invalid_columns(mask_of(between, 1), 7), (std::vector<std::uint32_t>{4, 5}));
    EXPECT_EQ(invalid_columns(mask_of(between, 0), 7), (std::vector<std::uint32_t>{}));
    EXPECT_EQ(invalid_columns(mask_of(between, 2.5), 7), (std::vector<std::uint32_t>{2, 3, 4, 5, 6, 7}));
}

/// In the infinity norm the square around a line's end has corners.
TEST(Invalidation, measuresInTheInfinityNorm) {
    const auto mask = mask_of({polyline({{10.5, 8.5}, {10.5, 12.5}})}, 2);
    EXPECT_EQ(invalid_columns(mask, 6), (std::vector<std::uint32_t>{8, 9, 10, 11, 12}));
    EXPECT_EQ(invalid_columns(mask, 5), (std::vector<std::uint32_t>{}));
}

/// Against the least distance of many points of the curve.
TEST(Invalidation, followsCurves) {
    const std::array<CanvasPoint, 4> p{{{-3, 4}, {40, -14}, {-8, 34}, {35, 9}}};
    std::vector<CanvasPoint> points;
    constexpr int n = 20000;
    for (int k = 0; k <= n; ++k) {
        const double t = static_cast<double>(k) / n, s = 1 - t;
        const double w[4] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
        CanvasPoint q;
        for (std::size_t i = 0; i < 4; ++i)
            q.x += w[i] * p[i].x, q.y += w[i] * p[i].y;
        points.push_back(q);
    }
    constexpr double step = 0.02; // more than from point to point
    for (const double distance : {0.5, 1.0, 2.75}) {
        const auto mask = mask_of({{{3, p}}}, distance);
        std::size_t decided = 0;
        for (std::uint32_t y = 0; y < kHeight; ++y) {
            for (std::uint32_t x = 0; x < kWidth; ++x) {
                double least = 1e9;
                for (const CanvasPoint& q : points)
                    least = std::min(least, std::max(std::fabs(q.x - x - 0.5), std::fabs(q.y - y - 0.5)));
                if (std::fabs(least - distance) < step) continue;
                ++decided;
                EXPECT_EQ(mask[y * kWidth + x] != 0, least < distance) << x << ", " << y << ", at " << least;
            }
        }
        EXPECT_GT(decided, 480u);
    }
}

TEST(FeatureScene, keepsWhatIsDrawnThereAndBack) {
    const CanvasContour there = polyline({{1, 1}, {20, 9}}), back = polyline({{20, 9}, {1, 1}});
    const FeatureCurves curves{kWidth, kHeight, {there, back, there}};
    const auto scene = feature_scene(curves, kWidth, kHeight);
    ASSERT_TRUE(scene.ok());
    EXPECT_EQ(scene.value().segments.size(), 1u);
    EXPECT_TRUE(has_features(scene.value()));
}

TEST(FeatureScene, saysWhetherAnyFeatureLiesOnTheImage) {
    for (const auto& [run, expected] :
         {std::pair(polyline({{-9, 2}, {-1, 12}}), false), std::pair(polyline({{-9, 2}, {1, 12}}), true)}) {
        const auto scene = feature_scene({kWidth, kHeight, {run}}, kWidth, kHeight);
        ASSERT_TRUE(scene.ok());
        EXPECT_EQ(has_features(scene.value()), expected);
    }
    EXPECT_FALSE(has_features(feature_scene({kWidth, kHeight, {}}, kWidth, kHeight).value()));
}

} // namespace
} // namespace fetexc
