// SPDX-License-Identifier: GPL-3.0-or-later
/// What lookups cost beside a plain bilinear one, on a software renderer with one thread. Prints the table; fails only
/// if a sampler becomes several times dearer than it was.
#include <gtest/gtest.h>

#include <cstdio>

#include "formats/validate.h"
#include "tests/conformance/timing_fixture.h"
#include "tests/support/fbt_maker.h"

namespace fetexc::test {
namespace {

using namespace fetex;

/// One feature across each of `percent` of the texels, the rest of one region; all interpolated.
FbtTexture simple_texture(std::uint32_t degree, std::uint32_t percent) {
    constexpr std::uint32_t kSide = 64;
    FbtTexture t;
    t.width = t.height = kSide;
    for (std::uint32_t k = 0; k < (kSide + 1) * (kSide + 1); ++k)
        t.corners.push_back(0xff000000u + k % kSide * 3 + (k / kSide * 3 << 8));
    const MadeRegion corners{kFbtModelCorners, 0};
    for (std::uint32_t j = 0; j < kSide; ++j) {
        for (std::uint32_t i = 0; i < kSide; ++i) {
            if ((i * 37 + j * 59) % 100 >= percent) {
                t.texels.push_back(shaded_texel(corners));
                continue;
            }
            const double x = 0.2 + 0.5 * ((i * 7 + j) % 16) / 16;
            const std::vector<std::uint32_t> points[3] = {
                {fbt_pack_point(x, 0), fbt_pack_point(x + 0.2, 1)},
                {fbt_pack_point(x, 0), fbt_pack_point(x, 0.5), fbt_pack_point(x + 0.2, 1)},
                {fbt_pack_point(x, 0), fbt_pack_point(x, 0.4), fbt_pack_point(x + 0.1, 0.8),
                 fbt_pack_point(x + 0.2, 1)}};
            const MadeRun run{degree, kFbtRayPosX, 1, points[degree - 1], 0, true, corners};
            t.texels.push_back(kFbtKindSingle << 30 | append_list(t.records, {run}, corners));
        }
    }
    t.traits = fbt_traits(t);
    EXPECT_TRUE(validate_fbt(t).empty());
    return t;
}

class SamplerCosts : public TimingTest {
  protected:
    SamplerCost cost_of(Sampler sampler) { return TimingTest::cost_of(sampler, {.side = 256}); }
};

TEST_F(SamplerCosts, fbtStaysAFewPlainLookups) {
    std::printf("  cost / plain bilinear lookup, at 0, 5, 20, 100%% of texels with a feature\n");
    for (std::uint32_t degree = 1; degree <= 3; ++degree) {
        std::printf("  degree %u:", degree);
        for (const std::uint32_t percent : {0u, 5u, 20u, 100u}) {
            ASSERT_FALSE(renderer_->upload(simple_texture(degree, percent)).has_value());
            const SamplerCost cost = cost_of(Sampler::Fbt), area = cost_of(Sampler::FbtArea);
            std::printf("  %.2f (%.2f-%.2f), area %.2f", cost.median, cost.lower_quartile, cost.upper_quartile,
                        area.median);
            EXPECT_GT(cost.median, 1);
            EXPECT_LT(cost.median, 25);
            EXPECT_LT(area.median, 50);
        }
        std::printf("\n");
    }
}

/// The control: a lookup against itself. Bounds for a machine under load.
TEST_F(SamplerCosts, plainLookupCostsItself) {
    const SamplerCost cost = cost_of(Sampler::Bilinear);
    std::printf("  plain: %.3f (%.3f-%.3f)\n", cost.median, cost.lower_quartile, cost.upper_quartile);
    EXPECT_NEAR(cost.median, 1, 0.3);
    EXPECT_EQ(cost.rounds, 11u);
}

TEST_F(SamplerCosts, fieldsCostLessThanFourLookups) {
    Field field{.width = 61, .height = 47, .values = std::vector<std::uint8_t>(std::size_t{61} * 47)};
    for (std::size_t k = 0; k < field.values.size(); ++k)
        field.values[k] = static_cast<std::uint8_t>(k * 89 % 251);
    for (const double range : {0.0, 4.0}) {
        field.range = range;
        ASSERT_FALSE(renderer_->upload_field(field).has_value());
        const SamplerCost cost = cost_of(Sampler::Field);
        std::printf("  %s: %.2f (%.2f-%.2f)\n", range > 0 ? "distance field" : "threshold", cost.median,
                    cost.lower_quartile, cost.upper_quartile);
        EXPECT_GT(cost.median, 0.5);
        EXPECT_LT(cost.median, 4);
    }
}

TEST_F(SamplerCosts, needWhatTheyLookUp) {
    const auto cost = sampler_cost(*renderer_, Sampler::Field);
    ASSERT_FALSE(cost.ok());
    EXPECT_EQ(cost.error().code, RuntimeErrc::NothingUploaded);
}

} // namespace
} // namespace fetexc::test
