// SPDX-License-Identifier: GPL-3.0-or-later
/// Sizes of textures with feature curves that are chosen by how far curves move.
#include <gtest/gtest.h>

#include <algorithm>

#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"
#include "compiler/feature_curves/feature_curves_builder.h"
#include "tests/support/random.h"

namespace fetexc {
namespace {

using test::Random;

constexpr double kSide = 100; // user units

Network random_network(std::uint64_t seed, int curves) {
    Random random(seed);
    Network n{kSide, kSide, {}};
    const auto point = [&] { return CanvasPoint{random.between(0, kSide), random.between(0, kSide)}; };
    for (int k = 0; k < curves; ++k)
        n.curves.push_back({"", {{2, {point(), point(), point()}}}, false, "", {}, {}});
    return n;
}

FeatureCurvesBuild chosen(const Network& network, FeatureLimits limits, const FeatureCurvesOptions& options = {}) {
    auto build = compile_feature_curves_at_chosen_size(network, options, limits);
    EXPECT_TRUE(build.ok()) << build.error().message;
    return std::move(build).value();
}

/// User units.
double farthest(const Network& network, std::uint32_t side) {
    FeatureCurvesOptions options;
    options.size = {side, side};
    const auto build = compile_feature_curves(network, options);
    EXPECT_TRUE(build.ok());
    return build.value().stats.farthest * kSide / side;
}

TEST(FeatureSize, isTheSmallestInWhichCurvesMoveNoFarther) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        const Network network = random_network(seed, 4);
        for (const double units : {2.0, 0.5}) {
            const std::uint32_t side = chosen(network, {units}).texture.width;
            EXPECT_LE(farthest(network, side), units) << seed;
            // What was tried below: a power of two that wasn't good enough, and sizes between it and this one.
            std::uint32_t tried = 4;
            while (2 * tried < side)
                tried *= 2;
            EXPECT_GT(farthest(network, tried), units) << seed << ' ' << side;
        }
    }
}

TEST(FeatureSize, growsAsLessMayMove) {
    const Network network = random_network(4, 5);
    std::uint32_t last = 0;
    for (const double units : {8.0, 2.0, 0.5, 0.2}) {
        const std::uint32_t side = chosen(network, {units}).texture.width;
        EXPECT_GT(side, last) << units;
        last = side;
    }
}

TEST(FeatureSize, isLeastWhereAllIsExactAnyway) {
    const Network straight{40, 20, {{"", {{1, {CanvasPoint{-1, 3}, {41, 17}}}}, false, "", {}, {}}}};
    EXPECT_EQ(chosen(straight, {}).texture.width, 4u);
    EXPECT_EQ(chosen(straight, {}).texture.height, 2u);
}

TEST(FeatureSize, isByTheProfileWhereNothingIsAsked) {
    const Network network = random_network(6, 3);
    FeatureCurvesOptions wide, narrow;
    wide.profile = preset_profile("crease", 16), narrow.profile = preset_profile("crease", 4);
    const std::uint32_t few = chosen(network, {}, wide).texture.width, more = chosen(network, {}, narrow).texture.width;
    EXPECT_LT(few, more);
    EXPECT_LE(farthest(network, more), 4 * budget::kFeatureChosenMove);
    FeatureCurvesOptions thin;
    thin.profile = preset_profile("crease", 1e-3); // none of up to 1024 texels: the best
    EXPECT_LE(chosen(network, {}, thin).texture.width, 1024u);
    EXPECT_GE(chosen(network, {}, thin).texture.width, 512u);
}

TEST(FeatureSize, isLimitedByBytesAndThenRefused) {
    const Network network = random_network(7, 4);
    const FeatureCurvesBuild good = chosen(network, {1});
    EXPECT_EQ(chosen(network, {1, good.stats.gpu_bytes}).texture.width, good.texture.width);
    const auto refused = compile_feature_curves_at_chosen_size(network, {}, {1, good.stats.gpu_bytes / 4});
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().code, diag::kFeatureErrorUnmet);
    EXPECT_EQ(compile_feature_curves_at_chosen_size(network, {}, {1, 100}).error().code, diag::kFeatureBudget);
}

/// It shows once it is no longer inside one texel, or counts as moved by a texel's diagonal.
TEST(FeatureSize, losesNothingThatIsLargerThanWhatMayMove) {
    const Network speck{kSide, kSide, {{"", {{1, {CanvasPoint{50.3, 50.3}, {50.9, 50.4}}}}, false, "", {}, {}}}};
    const FeatureCurvesBuild build = chosen(speck, {1});
    const double diagonal = 1.4142135623730951 * kSide / build.texture.width;
    EXPECT_TRUE(build.stats.snapping.lost_inside == 0 || diagonal <= 1) << build.texture.width;
    EXPECT_GT(build.texture.width, 64u);
}

TEST(FeatureSize, hasATexelForEachPixelOfTheBase) {
    const RasterImage image{37, 20, std::vector<float>(4 * 37 * 20, 30000)};
    FeatureCurvesOptions options;
    options.base = {&image, BaseImageKind::Normal, true, 1};
    const Network straight{40, 20, {{"", {{1, {CanvasPoint{-1, 3}, {41, 17}}}}, false, "", {}, {}}}};
    EXPECT_EQ(chosen(straight, {}, options).texture.width, 37u);
}

} // namespace
} // namespace fetexc
