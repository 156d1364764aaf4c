// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes of bi-level textures in given bytes, and what --silhouette takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cli/bilevel_budget.h"
#include "cli/compile_bilevel.h"
#include "compiler/measure/pictures.h"
#include "formats/fbt_mip.h"

namespace fetexc::cli {
namespace {

std::uint64_t bytes_of(GridSize grid, std::uint32_t channels, bool mips) {
    return std::uint64_t{grid.width} * grid.height * channels +
           (mips ? fetex::fbt_mip_samples(grid.width, grid.height) : 0);
}

TEST(BilevelGrid, isTheLargestThatFits) {
    for (const double aspect : {1.0, 0.37, 2.2}) {
        for (std::uint64_t bytes = 40; bytes < 50000; bytes = bytes * 3 / 2) {
            for (const std::uint32_t channels : {1u, 2u, 3u}) {
                for (const bool mips : {false, true}) {
                    const auto grid = bilevel_grid_of_bytes(aspect, bytes, channels, mips);
                    ASSERT_TRUE(grid) << bytes;
                    EXPECT_LE(bytes_of(*grid, channels, mips), bytes);
                    const GridSize next = {grid->width + 1, static_cast<std::uint32_t>(
                                                                std::max(1.0, std::round((grid->width + 1) * aspect)))};
                    EXPECT_GT(bytes_of(next, channels, mips), bytes) << aspect << " " << channels << " " << mips;
                }
            }
        }
    }
}

TEST(BilevelGrid, isNoneWhereNothingFits) {
    EXPECT_FALSE(bilevel_grid_of_bytes(1, 2, 3, false));
    EXPECT_FALSE(bilevel_grid_of_bytes(1, 1, 1, true));
    EXPECT_FALSE(bilevel_grid_of_bytes(1, 0, 1, false));
    EXPECT_TRUE(bilevel_grid_of_bytes(1, 3, 3, false));
}

TEST(SilhouetteRuleText, isReadOrRefused) {
    using Kind = SilhouetteRule::Kind;
    EXPECT_EQ(silhouette_rule("two-colors")->kind, Kind::TwoColors);
    EXPECT_EQ(silhouette_rule("alpha")->kind, Kind::Alpha);
    EXPECT_EQ(silhouette_rule("luminance")->kind, Kind::Luminance);
    EXPECT_EQ(silhouette_rule("id:a b:c")->element, "a b:c");
    for (const char* text : {"", "id", "id:", "ID:a", "two", "alpha "})
        EXPECT_FALSE(silhouette_rule(text)) << text;
}

TEST(BilevelPicture, isCutHardAtOneHalf) {
    fetex::BilevelTexture texture;
    texture.width = 2, texture.height = 1, texture.texels = {0, 255};
    texture.below = 0xff000000u, texture.above = 0xff0000ffu;
    const measure::BilevelPicture picture(texture);
    EXPECT_EQ(picture.at({0.499, 0.5}).r, 0);
    EXPECT_EQ(picture.at({0.501, 0.5}).r, 1);
    EXPECT_EQ(picture.texels().width, 2u);
    EXPECT_EQ(picture.gpu_bytes(), 2u);
}

} // namespace
} // namespace fetexc::cli
