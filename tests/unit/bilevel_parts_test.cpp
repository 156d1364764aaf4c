// SPDX-License-Identifier: GPL-3.0-or-later
/// Parts of silhouettes that bi-level textures lose or invent.
#include <gtest/gtest.h>

#include "compiler/bilevel/bilevel_builder.h"
#include "compiler/bilevel/mend_parts.h"
#include "compiler/bilevel/parts.h"
#include "compiler/bilevel/threshold_cells.h"
#include "tests/support/drawn_scene.h"

namespace fetexc {
namespace {

constexpr std::uint32_t kRows = 65;

/// Of paths apart from each other.
Silhouette drawn(const std::vector<test::Path>& paths) {
    Silhouette all = silhouette_of(test::scene_of({paths[0]}), {}, 1).value();
    for (std::size_t k = 1; k < paths.size(); ++k) {
        const Silhouette one = silhouette_of(test::scene_of({paths[k]}), {}, 1).value();
        all.edges.insert(all.edges.end(), one.edges.begin(), one.edges.end());
    }
    return all;
}

fetex::BilevelTexture flat(std::uint32_t side, std::uint8_t value) {
    fetex::BilevelTexture t;
    t.width = t.height = side, t.texels.assign(std::size_t{side} * side, value);
    return t;
}

/// Drawings are 512 units wide: specks of 3 units in texels of 16, of a tenth of a unit between the rows that are
/// looked at, and a ring.
TEST(BilevelParts, countsWhatIsLost) {
    std::vector<test::Path> paths{test::box(20, 20, 200, 200)};
    for (int k = 0; k < 5; ++k)
        paths.push_back(test::box(50 + 100 * k, 250, 53 + 100 * k, 253));
    const PartCounts blank = count_parts(drawn(paths), flat(32, 0), kRows, 1);
    EXPECT_EQ(blank.parts, 7u); // and the ground
    EXPECT_EQ(blank.lost, 6u);
    EXPECT_EQ(blank.invented, 0u);
    EXPECT_NEAR(blank.lost_u, 110.0 / 512, 1e-3); // the first in rows from the top is the square
    EXPECT_NEAR(blank.lost_v, 110.0 / 512, 1e-3);
    const PartCounts full = count_parts(drawn(paths), flat(32, 255), kRows, 1);
    EXPECT_EQ(full.lost, 1u);
    Silhouette s = drawn({paths[0]});
    const test::Path tiny = test::box(19201, 19201, 19205, 19205); // 64 of these are a unit
    const Silhouette speck =
        silhouette_of(test::scene_of({tiny}, FillRule::EvenOdd, kLatticeSteps / 512 / 64), {}, 1).value();
    s.edges.insert(s.edges.end(), speck.edges.begin(), speck.edges.end());
    const PartCounts found = count_parts(s, flat(32, 0), kRows, 1);
    EXPECT_EQ(found.parts, 3u);
    EXPECT_EQ(found.lost, 2u);
}

/// A needle is one part up to its tip, along rows and along columns, and so is what lies on both sides of it.
TEST(BilevelParts, aTipBelongsToItsShape) {
    for (const bool level : {false, true}) {
        const test::Path needle =
            level ? test::closed({{{10, 200}, {500, 203}}, {{500, 203}, {10, 206}}, {{10, 206}, {10, 200}}})
                  : test::closed({{{200, 10}, {203, 500}}, {{203, 500}, {206, 10}}, {{206, 10}, {200, 10}}});
        const PartCounts found = count_parts(drawn({needle}), flat(32, 0), kRows, 1);
        EXPECT_EQ(found.parts, 2u) << level;
        EXPECT_EQ(found.lost, 1u) << level;
    }
}

/// A line through the whole canvas makes three parts, one across a corner two.
TEST(BilevelParts, theCanvasEndsParts) {
    EXPECT_EQ(count_parts(drawn({test::box(-10, 200, 600, 220)}), flat(32, 0), kRows, 1).parts, 3u);
    EXPECT_EQ(count_parts(drawn({test::box(200, -10, 220, 600)}), flat(32, 0), kRows, 1).parts, 3u);
    EXPECT_EQ(count_parts(drawn({test::box(-10, -10, 20, 20)}), flat(32, 0), kRows, 1).parts, 2u);
}

TEST(BilevelParts, countsWhatIsInvented) {
    fetex::BilevelTexture t = flat(32, 0);
    t.texels[10 * 32 + 10] = 200, t.texels[20 * 32 + 20] = 140; // far from each other; the second a tenth of a texel
    const PartCounts found = count_parts(drawn({test::box(400, 400, 500, 500)}), t, kRows, 1);
    EXPECT_EQ(found.invented, 2u);
    EXPECT_EQ(found.lost, 1u);
    t.texels[20 * 32 + 20] = 128; // a hundredth
    EXPECT_EQ(count_parts(drawn({test::box(400, 400, 500, 500)}), t, kRows, 1).invented, 2u);
}

/// Values beside an outline that make an island for next to no area.
TEST(BilevelParts, mendsIslandsByAByte) {
    const Silhouette s = drawn({test::box(-10, -10, 250, 600)}); // up to 15.6 texels
    const std::vector<OutlineSegment> outline = outline_in_texels(s, 32, 32);
    const ScannedOutline scanned(s, outline, 32, 32, kRows);
    const ThresholdCells fine(scanned, 32, 32, fetex::BilevelRule::Single);
    fetex::BilevelTexture t = flat(32, 0);
    for (std::size_t j = 0; j < 32; ++j) {
        for (std::size_t i = 0; i < 32; ++i)
            t.texels[j * 32 + i] = i < 15 ? 255 : i == 15 ? 140 : 0;
    }
    t.texels[7 * 32 + 16] = 255; // one texel further, cut off
    t.texels[7 * 32 + 15] = 0;
    for (const std::size_t j : {6, 8})
        t.texels[j * 32 + 15] = t.texels[j * 32 + 16] = 0;
    EXPECT_EQ(count_parts(s, t, kRows, 1).invented, 1u);
    EXPECT_GE(mend_parts(fine, scanned, outline, MidGreys::Allow, t.texels), 1u);
    EXPECT_EQ(count_parts(s, t, kRows, 1).invented, 0u);
    EXPECT_EQ(count_parts(s, t, kRows, 1).lost, 0u);
}

/// A dot of a third of a texel between four centres shows.
TEST(BilevelParts, smallPartsShowWhereThatCostsLittle) {
    const Silhouette s = drawn({test::box(100, 100, 106, 106), test::box(300, 100, 500, 300)});
    BilevelOptions options;
    options.size = {32, 32}, options.channels = 1;
    EXPECT_EQ(compile_bilevel(s, options).value().stats.parts.lost, 0u);
}

} // namespace
} // namespace fetexc
