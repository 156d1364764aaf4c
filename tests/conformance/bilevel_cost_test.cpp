// SPDX-License-Identifier: GPL-3.0-or-later
/// What a bi-level lookup costs beside a plain bilinear one, on a software renderer with one thread.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/conformance/timing_fixture.h"
#include "tests/support/random_bilevel.h"

namespace fetexc::test {
namespace {

using namespace fetex;

/// Hard and soft cut, interpolated or filtered. Of the ratios of a busy machine a quarter must be below.
constexpr double kOneChannel = 1.3, kMoreChannels = 1.6;

class BilevelCosts : public TimingTest {
  protected:
    SamplerCost cost_of(Sampler sampler) { return TimingTest::cost_of(sampler, {.side = 256, .rounds = 21}); }
};

TEST_F(BilevelCosts, stayNearThatOfAPlainLookup) {
    std::printf("  %s\n  cost / plain bilinear lookup: hard, soft, levels\n", renderer_->description().c_str());
    for (const BilevelRule rule : kBilevelRules) {
        for (const BilevelFetch fetch : {BilevelFetch::Interpolated, BilevelFetch::Filtered}) {
            const BilevelTexture texture = random_bilevel(1, {.width = 61, .height = 47, .rule = rule, .mips = true});
            ASSERT_FALSE(renderer_->upload_bilevel(texture, fetch).has_value());
            const SamplerCost hard = cost_of(Sampler::Bilevel), soft = cost_of(Sampler::BilevelArea),
                              mips = cost_of(Sampler::BilevelMips);
            std::printf("  rule %u %-12s: %.2f (%.2f-%.2f), %.2f (%.2f-%.2f), %.2f\n", static_cast<unsigned>(rule),
                        fetch == BilevelFetch::Filtered ? "filtered" : "interpolated", hard.median, hard.lower_quartile,
                        hard.upper_quartile, soft.median, soft.lower_quartile, soft.upper_quartile, mips.median);
            const double bar = rule == BilevelRule::Single ? kOneChannel : kMoreChannels;
            EXPECT_LE(hard.lower_quartile, bar);
            EXPECT_LE(soft.lower_quartile, bar);
            EXPECT_GT(hard.median, 0.3); // something is drawn
        }
    }
}

} // namespace
} // namespace fetexc::test
