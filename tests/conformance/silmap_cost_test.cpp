// SPDX-License-Identifier: GPL-3.0-or-later
/// What a lookup of a silhouette-map texture costs beside a plain bilinear one, on a software renderer with one thread.
#include <gtest/gtest.h>

#include <cstdio>
#include <optional>

#include "runtime_glsl/host/sampler_cost.h"
#include "tests/support/random_silmap.h"

namespace fetexc::test {
namespace {

using namespace fetex;

/// At points; what is asked for. Of the ratios of a busy machine a quarter must be below.
constexpr double kNearest = 3.0, kFiltered = 4.2;

class SilmapCosts : public testing::Test {
  protected:
    void SetUp() override {
        auto opened = open_for_timing();
        if (!opened && opened.error().code == RuntimeErrc::BackendMissing) GTEST_SKIP() << opened.error().message;
        ASSERT_TRUE(opened.ok()) << opened.error().message;
        renderer_.emplace(std::move(opened.value()));
        ASSERT_TRUE(renderer_->is_software()) << renderer_->description();
    }
    SamplerCost cost_of(Sampler sampler, const View& view = {}) {
        const auto cost = sampler_cost(*renderer_, sampler, {.view = view, .side = 256, .rounds = 21});
        EXPECT_TRUE(cost.ok()) << cost.error().message;
        return cost ? cost.value() : SamplerCost{};
    }

    std::optional<Renderer> renderer_;
};

TEST_F(SilmapCosts, stayWithinAFewPlainLookups) {
    std::printf("  %s\n  cost / plain bilinear lookup: points, pixels at 4 and at 64 a texel, levels\n",
                renderer_->description().c_str());
    for (const auto cells : kSilmapCellFormats) {
        for (const auto samples : kSilmapSampleFormats) {
            for (const SilmapFilter filter : {SilmapFilter::Nearest, SilmapFilter::Filtered}) {
                const SilmapTexture texture = random_silmap(
                    1, {.width = 61, .height = 47, .cell_format = cells, .sample_format = samples, .mips = true});
                ASSERT_FALSE(renderer_->upload_silmap(texture, filter).has_value());
                const SamplerCost points = cost_of(Sampler::Silmap), pixels = cost_of(Sampler::SilmapArea),
                                  magnified = cost_of(Sampler::SilmapArea, {0.3, 0.4, 1.0 / 16, 1.0 / 16}),
                                  mips = cost_of(Sampler::SilmapMips);
                std::printf("  cells %u, samples %u, %-8s: %.2f (%.2f-%.2f), %.2f, %.2f, %.2f\n",
                            static_cast<unsigned>(cells), static_cast<unsigned>(samples),
                            filter == SilmapFilter::Filtered ? "filtered" : "nearest", points.median,
                            points.lower_quartile, points.upper_quartile, pixels.median, magnified.median, mips.median);
                EXPECT_LE(points.lower_quartile, filter == SilmapFilter::Filtered ? kFiltered : kNearest);
                EXPECT_GT(points.median, 0.3); // something is drawn
            }
        }
    }
}

} // namespace
} // namespace fetexc::test
