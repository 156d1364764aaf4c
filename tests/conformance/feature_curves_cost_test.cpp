// SPDX-License-Identifier: GPL-3.0-or-later
/// What a lookup of a texture with feature curves costs beside a plain bilinear one, on a software renderer with one
/// thread, by the part of the texels that have segments.
#include <gtest/gtest.h>

#include <cstdio>

#include "formats/validate.h"
#include "tests/conformance/timing_fixture.h"
#include "tests/support/random_features.h"

namespace fetexc::test {
namespace {

using namespace fetex;

/// At points, where a fifth of the texels has segments; what is asked for. Of the ratios of a busy machine a quarter
/// must be below.
constexpr double kAskedForCurves = 12, kAskedForLines = 6, kAskedCoverage = 0.2;
constexpr double kCoverages[] = {0.01, 0.05, 0.2, 1};

/// Blocks of texels with a segment from west to east or from north to south: curves go on, as they do, so that edges
/// are open at the blocks' ends alone.
class FeatureCurvesCosts : public TimingTest {
  protected:
    SamplerCost cost_of(Sampler sampler, const View& view = {}) {
        return TimingTest::cost_of(sampler, {.view = view, .side = 256, .rounds = 11});
    }
    /// The least of three where it is above what was asked for: what else a machine does only adds.
    SamplerCost least_cost_of(Sampler sampler, double asked) {
        SamplerCost least = cost_of(sampler);
        for (int again = 0; again < 2 && least.lower_quartile > asked; ++again) {
            const SamplerCost cost = cost_of(sampler);
            if (cost.lower_quartile < least.lower_quartile) least = cost;
        }
        return least;
    }
};

/// Whole columns of texels with curves from north to south, so many of a hundred; no edge is open.
FeatureCurvesTexture texture_of(double coverage, bool linear, FeatureNumberFormat format, FeatureKind kind,
                                std::uint32_t profiles = 1) {
    constexpr std::uint32_t kSide = 100;
    FeatureCurvesTexture t = random_features(3, {.width = kSide,
                                                 .height = kSide,
                                                 .format = format,
                                                 .linear = linear,
                                                 .kind = kind,
                                                 .entries = 256,
                                                 .profiles = profiles,
                                                 .coverage = 0,
                                                 .mips = true});
    const auto columns = static_cast<std::uint32_t>(coverage * kSide + 0.5);
    for (std::uint32_t j = 0; j <= kSide; ++j) {
        for (std::uint32_t k = 0; k < columns; ++k) {
            const std::uint32_t i = k * kSide / columns;
            feature_set_crossing(t, i, j, FeatureEdge::North, {j % 2 == 0 ? 0.4 : 0.6, j % 2 == 0 ? 1.2 : 1.9});
            const FeatureSegment across{FeatureEdge::North, FeatureEdge::South};
            if (j < kSide) t.configurations[j * kSide + i] = feature_pack(across, across);
        }
    }
    // Every column's own; corners have that of the column that they are in.
    for (std::size_t k = 0; k < t.profile_map.size(); ++k) {
        const std::uint32_t column = static_cast<std::uint32_t>(k % (kSide + 1)), own = column / 8 % profiles;
        const bool used =
            column < kSide && t.configurations[std::min<std::size_t>(k / (kSide + 1), kSide - 1) * kSide + column] != 0;
        t.profile_map[k] = feature_profile_word(own, used ? own : 0, 0);
    }
    EXPECT_TRUE(validate_feature_curves(t).empty());
    return t;
}

TEST_F(FeatureCurvesCosts, stayWithinAFewPlainLookups) {
    std::printf("  %s\n  cost / plain bilinear lookup: points, pixels, levels\n", renderer_->description().c_str());
    for (const bool linear : {true, false}) {
        for (const FeatureKind kind : {FeatureKind::Normal, FeatureKind::Color}) {
            for (const double coverage : kCoverages) {
                const FeatureCurvesTexture t = texture_of(coverage, linear, FeatureNumberFormat::Half, kind);
                ASSERT_FALSE(renderer_->upload_feature_curves(t).has_value());
                const double asked = linear ? kAskedForLines : kAskedForCurves;
                const SamplerCost points = least_cost_of(Sampler::FeatureCurves, asked),
                                  pixels = cost_of(Sampler::FeatureCurvesArea),
                                  mips = cost_of(Sampler::FeatureCurvesMips);
                std::printf("  %s, %s, %3.0f%%: %.2f (%.2f-%.2f), %.2f, %.2f\n", linear ? "lines " : "curves",
                            kind == FeatureKind::Normal ? "normals" : "colours", 100 * coverage, points.median,
                            points.lower_quartile, points.upper_quartile, pixels.median, mips.median);
                if (coverage == kAskedCoverage) {
                    EXPECT_LE(points.lower_quartile, asked);
                }
                EXPECT_GT(points.median, 0.3); // something is drawn
            }
        }
    }
}

/// As drawings have them: most texels have one of them alone.
TEST_F(FeatureCurvesCosts, ofSeveralProfiles) {
    for (const bool linear : {true, false}) {
        for (const FeatureKind kind : {FeatureKind::Normal, FeatureKind::Color}) {
            const FeatureCurvesTexture t = texture_of(kAskedCoverage, linear, FeatureNumberFormat::Half, kind, 4);
            ASSERT_FALSE(renderer_->upload_feature_curves(t).has_value());
            const double asked = linear ? kAskedForLines : kAskedForCurves;
            const SamplerCost points = least_cost_of(Sampler::FeatureCurves, asked),
                              pixels = cost_of(Sampler::FeatureCurvesArea);
            std::printf("  %s, %s, 4 profiles: points %.2f, pixels %.2f\n", linear ? "lines " : "curves",
                        kind == FeatureKind::Normal ? "normals" : "colours", points.median, pixels.median);
            EXPECT_LE(points.lower_quartile, asked);
        }
    }
}

/// Two segments in every texel that has any, and open edges: what the worst asset takes.
TEST_F(FeatureCurvesCosts, ofTheWorstTexture) {
    for (const bool linear : {true, false}) {
        const FeatureCurvesTexture t = random_features(3, {.width = 100,
                                                           .height = 100,
                                                           .format = FeatureNumberFormat::Half,
                                                           .linear = linear,
                                                           .entries = 256,
                                                           .coverage = 1});
        ASSERT_FALSE(renderer_->upload_feature_curves(t).has_value());
        const SamplerCost points = cost_of(Sampler::FeatureCurves), pixels = cost_of(Sampler::FeatureCurvesArea);
        std::printf("  %s, all configurations, open edges: points %.2f, pixels %.2f\n", linear ? "lines" : "curves",
                    points.median, pixels.median);
        EXPECT_GT(points.median, 0.3);
    }
}

} // namespace
} // namespace fetexc::test
