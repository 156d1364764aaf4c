// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/fbt/size_choice.h"

#include <new>

#include <gtest/gtest.h>

#include "compiler/compile.h"
#include "compiler/diagnostics.h"
#include "tests/support/fbt_maker.h"
#include "tests/support/known_shapes.h"

namespace fetexc {
namespace {

Scene disc() { return test::black_on_white({test::round_disc({0.5, 0.5}, 0.31)}); }

TEST(SizeChoice, takesTheLargestThatFits) {
    const Scene scene = disc();
    for (const std::uint64_t limit : {2000u, 3072u, 12288u, 100000u}) {
        const auto chosen = compile_fbt_at_chosen_size(scene, {}, limit);
        ASSERT_TRUE(chosen.ok()) << chosen.error().message;
        EXPECT_LE(fetex::fbt_gpu_bytes(chosen.value().texture), limit);
        const std::uint32_t side = chosen.value().texture.width;
        const auto twice = compile_fbt(scene, {grid_for(scene.extent, side + side / 8 + 1)});
        ASSERT_TRUE(twice.ok());
        EXPECT_GT(fetex::fbt_gpu_bytes(twice.value().texture), limit) << side;
    }
}

/// What is too large for the memory ends the search, and loses nothing.
TEST(SizeChoice, keepsTheBestWhenMemoryRunsOut) {
    const Scene scene = disc();
    std::uint32_t beyond = 16;
    const auto build = [&](GridSize size) -> Result<FbtBuild> {
        if (size.width > beyond) throw std::bad_alloc();
        return compile_fbt(scene, {size});
    };
    const auto largest = largest_within(scene.extent, 16384, 1u << 20, build);
    ASSERT_TRUE(largest.ok()) << largest.error().message;
    EXPECT_EQ(largest.value().texture.width, 16u);
    const auto cheapest = cheapest_lookup(scene.extent, 1, 1024, build);
    ASSERT_TRUE(cheapest.ok()) << cheapest.error().message;
    EXPECT_LE(cheapest.value().texture.width, 16u);
    beyond = 0;
    for (const auto& none :
         {largest_within(scene.extent, 16384, 1u << 20, build), cheapest_lookup(scene.extent, 1, 1024, build)}) {
        ASSERT_FALSE(none.ok());
        EXPECT_EQ(none.error().code, diag::kOutOfMemory);
    }
}

TEST(SizeChoice, staysWithinTheLargestSize) {
    const Scene scene = disc();
    const auto build = [&](GridSize size) { return compile_fbt(scene, {size}); };
    for (const std::uint32_t largest : {1u, 3u, 4u, 100u}) {
        const auto chosen = largest_within(scene.extent, largest, 1u << 30, build);
        ASSERT_TRUE(chosen.ok()) << chosen.error().message;
        EXPECT_EQ(chosen.value().texture.width, largest);
    }
}

TEST(SizeChoice, saysWhatItTakesWhenNothingFits) {
    const auto chosen = compile_fbt_at_chosen_size(disc(), {}, 100);
    ASSERT_FALSE(chosen.ok());
    EXPECT_EQ(chosen.error().code, diag::kFbtBudget);
    // A picture of one colour takes a word a texel: four texels fit in 16 bytes.
    const auto plain = compile_fbt_at_chosen_size(test::black_on_white({}), {}, 16);
    ASSERT_TRUE(plain.ok());
    EXPECT_EQ(plain.value().report.fbt.gpu_bytes, 16u);
}

TEST(SizeChoice, withoutALimitStopsWhereLookupsGetNoCheaper) {
    const Scene scene = disc();
    const auto chosen = compile_fbt_at_chosen_size(scene, {}, 0);
    ASSERT_TRUE(chosen.ok());
    const std::uint32_t side = chosen.value().texture.width;
    const auto cost = [&](std::uint32_t size) {
        return lookup_cost(compile_fbt(scene, {grid_for(scene.extent, size)}).value().texture);
    };
    EXPECT_GT(cost(2 * side), 0.75 * cost(side));
    EXPECT_LE(cost(side), 0.75 * cost(side / 2));
}

/// One read for a solid texel; a texel with one line: texel, entry, piece.
TEST(LookupCost, countsReads) {
    fetex::FbtTexture t;
    t.width = 2, t.height = 1;
    const test::MadeRun line{1, 0, 1, {fetex::fbt_pack_point(0.5, 0), fetex::fbt_pack_point(0.5, 1)}, 0, true, {}};
    t.texels = {test::solid_texel(0xff000000),
                fetex::kFbtKindSingle << 30 | test::append_list(t.records, {line}, {0, 0xffffffff})};
    EXPECT_DOUBLE_EQ(lookup_cost(t), 2);
}

} // namespace
} // namespace fetexc
