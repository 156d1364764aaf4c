// SPDX-License-Identifier: GPL-3.0-or-later
/// What an FBT lookup costs beside a plain bilinear one, on a software renderer with one thread: medians of paired CPU
/// times over interleaved rounds. Prints the table; fails only if the sampler becomes several times dearer than it was.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "formats/validate.h"
#include "runtime_glsl/host/renderer.h"

namespace fetexc::test {
namespace {

using namespace fetex;

/// One feature across each of `percent` of the texels, the rest empty; all interpolated.
FbtTexture simple_texture(std::uint32_t degree, std::uint32_t percent) {
    constexpr std::uint32_t kSide = 64;
    FbtTexture t;
    t.width = t.height = kSide;
    t.apron = 1;
    for (std::uint32_t j = 0; j <= kSide; ++j) {
        for (std::uint32_t i = 0; i <= kSide; ++i) {
            const bool inside = i < kSide && j < kSide;
            const bool feature = inside && (i * 37 + j * 59) % 100 < percent;
            t.texels.push_back(0xff000000u + i * 3 + (j * 3 << 8));
            t.texels.push_back(feature ? kFbtKindSingle << 30 | static_cast<std::uint32_t>(t.records.size() / 4 + 1)
                                       : (inside ? 0xe4u : 0u));
            if (!feature) continue;
            const double x = 0.2 + 0.5 * ((i * 7 + j) % 16) / 16;
            const std::uint32_t points[3][4] = {
                {fbt_pack_point(x, 0), fbt_pack_point(x + 0.2, 1), 0, 0},
                {fbt_pack_point(x, 0), fbt_pack_point(x, 0.5), fbt_pack_point(x + 0.2, 1), 0},
                {fbt_pack_point(x, 0), fbt_pack_point(x, 0.4), fbt_pack_point(x + 0.1, 0.8),
                 fbt_pack_point(x + 0.2, 1)}};
            for (const std::uint32_t word : points[degree - 1])
                t.records.push_back(word);
            const auto piece = static_cast<std::uint32_t>(t.records.size() / 4 - 1);
            for (const std::uint32_t word : {piece, 1u | degree << 16 | kFbtEntryLastRun, 0xff2040ffu, 0xe4u})
                t.records.push_back(word);
            for (const std::uint32_t word : {0u, kFbtEntryTerminator, 0xff00ff20u, 0xe4u})
                t.records.push_back(word);
        }
    }
    t.traits = fbt_traits(t);
    EXPECT_TRUE(validate_fbt(t).empty());
    return t;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// Cost of the uploaded FBT in lookups of the uploaded bitmap.
double relative_cost(Renderer& renderer) {
    constexpr std::uint32_t kSide = 256, kRounds = 11;
    std::vector<double> ratios;
    for (std::uint32_t round = 0; round <= kRounds; ++round) {
        const auto plain = renderer.time_draws(false, {}, kSide, 1), fbt = renderer.time_draws(true, {}, kSide, 1);
        if (!plain.ok() || !fbt.ok()) return -1;
        if (round > 0) ratios.push_back(fbt.value()[0] / plain.value()[0]); // the first compiles the shaders
    }
    return median(ratios);
}

TEST(SamplerCost, staysAFewPlainLookups) {
    setenv("LP_NUM_THREADS", "0", 1);
    auto opened = Renderer::open(Backend::OSMesa);
    ASSERT_TRUE(opened.ok()) << opened.error().message;
    Renderer& renderer = opened.value();
    std::vector<std::uint8_t> bitmap(std::size_t{256} * 256 * 4, 77);
    ASSERT_FALSE(renderer.upload_bitmap(bitmap, 256, 256).has_value());
    std::printf("  cost / plain bilinear lookup, at 0, 5, 20, 100%% of texels with a feature\n");
    for (std::uint32_t degree = 1; degree <= 3; ++degree) {
        std::printf("  degree %u:", degree);
        for (const std::uint32_t percent : {0u, 5u, 20u, 100u}) {
            ASSERT_FALSE(renderer.upload(simple_texture(degree, percent)).has_value());
            const double cost = relative_cost(renderer);
            ASSERT_GT(cost, 0);
            std::printf(" %.2f", cost);
            EXPECT_LT(cost, 25);
        }
        std::printf("\n");
    }
}

} // namespace
} // namespace fetexc::test
