// SPDX-License-Identifier: GPL-3.0-or-later
/// What a lookup of a pinchmap costs beside a plain bilinear one, on a software renderer with one thread.
#include <gtest/gtest.h>

#include <cstdio>

#include "tests/conformance/timing_fixture.h"
#include "tests/support/known_pinchmap.h"

namespace fetexc::test {
namespace {

using namespace fetex;

/// At points, and of pixels if samples have 8 bits; what is asked for. Of the ratios of a busy machine a quarter must
/// be below.
constexpr double kAskedFor = 2.6;

PinchmapTexture texture_of(PinchmapFormat map, PinchmapSampleFormat samples) {
    return pinchmap_of(random_mask(1, 61, 47), {.scale = 1,
                                                .map_format = map,
                                                .sample_format = samples,
                                                .signal = KnownSignal::Random,
                                                .gamma_from = -0.5,
                                                .gamma_to = 0.5,
                                                .mips = true});
}

class PinchmapCosts : public TimingTest {
  protected:
    SamplerCost cost_of(Sampler sampler, const View& view = {}) {
        return TimingTest::cost_of(sampler, {.view = view, .side = 256, .rounds = 21});
    }
    /// The least of up to nine where it is above what was asked for: what else a machine does only adds.
    SamplerCost least_cost_of(Sampler sampler) {
        SamplerCost least = cost_of(sampler);
        for (int again = 0; again < 8 && least.lower_quartile > kAskedFor; ++again) {
            const SamplerCost cost = cost_of(sampler);
            if (cost.lower_quartile < least.lower_quartile) least = cost;
        }
        return least;
    }
};

TEST_F(PinchmapCosts, stayWithinAFewPlainLookups) {
    std::printf("  %s\n  cost / plain bilinear lookup: points, pixels at 4 and at 64 a texel, levels\n",
                renderer_->description().c_str());
    for (const PinchmapFormat map : kPinchmapFormats) {
        for (const PinchmapSampleFormat samples : kPinchmapSampleFormats) {
            const PinchmapTexture texture = texture_of(map, samples);
            for (const PinchmapFetch fetch : {PinchmapFetch::Interpolated, PinchmapFetch::Filtered}) {
                ASSERT_FALSE(renderer_->upload_pinchmap(texture, fetch).has_value());
                const SamplerCost points = least_cost_of(Sampler::Pinchmap),
                                  pixels = least_cost_of(Sampler::PinchmapArea),
                                  magnified = cost_of(Sampler::PinchmapArea, {0.3, 0.4, 1.0 / 16, 1.0 / 16}),
                                  mips = cost_of(Sampler::PinchmapMips);
                std::printf("  map %u, samples %u, %-12s: %.2f (%.2f-%.2f), %.2f, %.2f, %.2f\n",
                            static_cast<unsigned>(map), static_cast<unsigned>(samples),
                            fetch == PinchmapFetch::Filtered ? "filtered" : "interpolated", points.median,
                            points.lower_quartile, points.upper_quartile, pixels.median, magnified.median, mips.median);
                EXPECT_LE(points.lower_quartile, kAskedFor);
                if (samples == PinchmapSampleFormat::Rgba8) {
                    EXPECT_LE(pixels.lower_quartile, kAskedFor);
                }
                EXPECT_GT(points.median, 0.3); // something is drawn
            }
        }
    }
}

} // namespace
} // namespace fetexc::test
