// SPDX-License-Identifier: GPL-3.0-or-later
/// The builder of silhouette-map textures: what it must get exactly, what it says of the rest, and sizes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"
#include "compiler/silmap/silmap_builder.h"
#include "formats/fbt_samples.h"
#include "formats/validate.h"
#include "tests/support/drawn_scene.h"
#include "tests/support/known_shapes.h"
#include "tests/support/random_scene.h"

namespace fetexc {
namespace {

using namespace fetex;
using test::box, test::closed, test::scene_of;

constexpr SilmapCellFormat kFormats[] = {SilmapCellFormat::Bits8, SilmapCellFormat::Bits16};

SilmapBuild built(const Scene& scene, std::uint32_t size, SilmapCellFormat format = SilmapCellFormat::Bits8) {
    SilmapOptions options;
    options.size = grid_for(scene.extent, size), options.cell_format = format;
    auto made = compile_silmap(scene, options);
    EXPECT_TRUE(made.ok());
    EXPECT_TRUE(validate_silmap(made.value().texture).empty());
    return std::move(made).value();
}

std::uint32_t texel(const SilmapTexture& t, std::uint32_t i, std::uint32_t j) { return t.colors[j * t.width + i]; }

bool warns(const SilmapBuild& b, int code) {
    return std::ranges::any_of(b.report.diagnostics, [&](const Diagnostic& d) { return d.code == code; });
}

/// Of 16 texels, 32 units each: positions 4 apart, from 18 on, are those of an eight-bit point.
TEST(Silmap, whatLiesOnThePointsIsExact) {
    const auto at = [](std::int64_t k) { return 18 + 4 * k; };
    const SilmapBuild b = built(scene_of({box(at(10), at(12), at(81), at(99))}), 16);
    EXPECT_NEAR(b.stats.wrong_area, 0, 1e-12);
    EXPECT_EQ(b.stats.cells_crowded, 0u);
    EXPECT_EQ(b.stats.cells_corner, 4u);
}

/// A quarter of a step beside every edge, at most, and a step in the corners' cells.
TEST(Silmap, straightEdgesAreExactToTheSteps) {
    const std::vector<std::vector<LatticePoint>> corners{{{37, 61}, {455, 103}, {251, 467}},
                                                         {{101, 53}, {467, 199}, {311, 471}, {41, 301}}};
    for (const auto& c : corners) {
        test::Path path;
        double perimeter = 0;
        for (std::size_t k = 0; k + 1 < c.size(); ++k)
            path.push_back({c[k], c[k + 1]});
        for (std::size_t k = 0; k < c.size(); ++k) {
            const LatticePoint &p = c[k], &q = c[(k + 1) % c.size()];
            perimeter += std::hypot(static_cast<double>(p.x - q.x), static_cast<double>(p.y - q.y)) / 512;
        }
        for (const SilmapCellFormat format : kFormats) {
            for (const std::uint32_t size : {16u, 23u, 64u}) {
                const SilmapBuild b = built(scene_of({closed(path)}), size, format);
                const double step = 1.0 / silmap_steps(format); // texels
                EXPECT_LE(b.stats.wrong_area * size * size, perimeter * size * step / 4 + 4 * step) << size;
            }
        }
    }
}

/// An edge that meets the border, where points repeat beyond it, needs no level piece.
TEST(Silmap, edgesReachTheBorder) {
    const Scene scene =
        scene_of({closed({{{-100, 203}, {700, 331}}, {{700, 331}, {700, 700}}, {{700, 700}, {-100, 700}}})});
    for (const SilmapCellFormat format : kFormats) {
        const double step = 1.0 / silmap_steps(format);
        const SilmapBuild b = built(scene, 16, format);
        EXPECT_LE(b.stats.wrong_area * 16 * 16, 16 * step / 4);
        const std::uint32_t left = texel(b.texture, 0, 6), right = texel(b.texture, 0, 8);
        EXPECT_NE(left, right);
    }
}

/// A flag of four fields, whose middle lies in no texel's middle: every colour is one of the fields', the junction is
/// where it should be to a step, and no field's texel is filtered with another's.
TEST(Silmap, fieldsThatMeetKeepTheirColours) {
    const Scene scene =
        scene_of({box(-10, -10, 211, 171), box(211, -10, 600, 171), box(-10, 171, 211, 600), box(211, 171, 600, 600)});
    for (const SilmapCellFormat format : kFormats) {
        const SilmapBuild b = built(scene, 16, format);
        const SilmapTexture& t = b.texture;
        EXPECT_EQ(std::set(t.colors.begin(), t.colors.end()).size(), 4u);
        const double step = 1.0 / silmap_steps(format), x = 211 / 32.0, y = 171 / 32.0;
        EXPECT_LE(b.stats.wrong_area * 16 * 16, (16 + 16) * step / 2);
        for (const double dx : {-1.0, 1.0}) {
            for (const double dy : {-1.0, 1.0}) {
                const FbtColor near = silmap_sample(t, x + dx * step, y + dy * step),
                               far = silmap_sample(t, dx < 0 ? 1 : 15, dy < 0 ? 1 : 15);
                EXPECT_NEAR(near.r, far.r, 1e-9);
                EXPECT_NEAR(near.g, far.g, 1e-9);
            }
        }
    }
}

TEST(Silmap, nothingBleedsAcrossEdges) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const SilmapTexture t = built(test::random_scene(seed, test::opaque_solids(8)), 24).texture;
        const std::set<std::uint32_t> colors(t.colors.begin(), t.colors.end());
        for (int k = 0; k < 1000; ++k) {
            const FbtColor c = silmap_sample(t, (k % 32 + 0.37) / 32 * t.width, (k / 32 + 0.21) / 32 * t.height);
            EXPECT_TRUE(colors.contains(fbt_pack_sample(c, FbtSampleFormat::Rgba8)[0])) << seed << " " << k;
        }
    }
}

TEST(Silmap, namesWhatItCannotHold) {
    const Scene scene = scene_of({box(40, 100, 460, 104), box(211, 209, 222, 226), box(300, 300, 480, 480)});
    SilmapOptions options;
    options.size = {16, 16}, options.lend = false;
    const SilmapBuild b = compile_silmap(scene, options).value();
    EXPECT_EQ(b.stats.parts_lost, 2u); // the line of an eighth of a texel, and the speck
    EXPECT_TRUE(warns(b, diag::kSilmapPartsLost));
    EXPECT_TRUE(warns(b, diag::kSilmapCellsCrowded));
    EXPECT_GE(b.stats.cells_crowded, 13u);
    const SilmapBuild with_lent = built(scene, 16);
    EXPECT_EQ(with_lent.stats.parts_lost, 1u); // the speck is near the middle of a texel
    EXPECT_GE(with_lent.stats.texels_lent, 1u);
    EXPECT_LT(with_lent.stats.wrong_area, b.stats.wrong_area);
    const SilmapBuild fine = built(scene, 256);
    EXPECT_EQ(fine.stats.parts_lost, 0u);
    EXPECT_FALSE(warns(fine, diag::kSilmapPartsLost));
}

/// A lost part counts by its own area, not by what else of its colour its cell has.
TEST(Silmap, specksBesideTheirColourAreSpecks) {
    const auto lost = [&](std::int64_t side) {
        SilmapOptions options;
        options.size = {16, 16}, options.lend = false;
        const Scene scene = scene_of({box(0, 0, 180, 512), box(190, 250, 190 + side, 250 + side)});
        return compile_silmap(scene, options).value();
    };
    EXPECT_EQ(lost(4).stats.parts_lost, 0u); // 1/64 square texel
    const SilmapBuild larger = lost(9);
    EXPECT_EQ(larger.stats.parts_lost, 1u);
    const auto found = std::ranges::find(larger.report.diagnostics, diag::kSilmapPartsLost, &Diagnostic::code);
    ASSERT_NE(found, larger.report.diagnostics.end());
    EXPECT_NE(found->message.find("the largest: 0.079 square texels"), std::string::npos) << found->message;
}

/// Half a texel wide, slightly slanted: half of the middles miss it.
TEST(Silmap, thinLinesStayTogether) {
    const Scene scene = scene_of({closed({{{0, 96}, {512, 192}}, {{512, 192}, {512, 208}}, {{512, 208}, {0, 112}}})});
    const auto missed = [&](bool lend) {
        SilmapOptions options;
        options.size = {16, 16}, options.lend = lend;
        const SilmapTexture t = compile_silmap(scene, options).value().texture;
        int points = 0;
        for (int k = 0; k < 512; ++k) {
            const double x = (k + 0.5) / 32, y = (104 + (k + 0.5) * 96 / 512) / 32;
            points += silmap_sample(t, x, y, SilmapFilter::Nearest).a < 0.5 ? 1 : 0;
        }
        return points;
    };
    std::printf("  missed: %d of 512 points, %d without\n", missed(true), missed(false));
    EXPECT_LE(missed(true), missed(false) / 3);
}

TEST(Silmap, emptyScenesCostNothing) {
    const SilmapBuild b = built(scene_of({}), 33);
    EXPECT_EQ(b.stats.cells, 34u * 34u);
    EXPECT_EQ(b.stats.cells_empty, b.stats.cells);
    EXPECT_EQ(b.stats.positions_tried, 0u);
    EXPECT_EQ(b.stats.wrong_area, 0);
}

TEST(Silmap, isTheSameForAnyThreads) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        const Scene scene = test::random_scene(seed);
        SilmapOptions options;
        options.size = {61, 61}, options.mips = true, options.cell_format = kFormats[seed % 2];
        const auto one = compile_silmap(scene, options);
        options.threads = 4;
        const auto four = compile_silmap(scene, options);
        EXPECT_EQ(one.value().texture.cells, four.value().texture.cells);
        EXPECT_EQ(one.value().texture.colors, four.value().texture.colors);
        EXPECT_EQ(one.value().texture.mips, four.value().texture.mips);
        EXPECT_EQ(one.value().stats.positions_tried, four.value().stats.positions_tried);
        EXPECT_EQ(one.value().stats.wrong_area, four.value().stats.wrong_area);
    }
}

/// Colours of gradients are those in the middles of texels, whatever the samples' format.
TEST(Silmap, samplesComeInEveryFormat) {
    Scene scene = scene_of({box(0, 0, 512, 512)});
    LinearPaint paint;
    paint.canvas_to_unit.a = 1.0 / 512;
    paint.stops = {{0, {0, 0, 0, 1}}, {1, {1, 1, 1, 1}}};
    scene.paints[0] = paint;
    for (const SilmapSampleFormat format : {SilmapSampleFormat::Rgba8, SilmapSampleFormat::Rgba16,
                                            SilmapSampleFormat::Rgba16F, SilmapSampleFormat::Rgb8}) {
        SilmapOptions options;
        options.size = {64, 64}, options.sample_format = format;
        const auto made = compile_silmap(scene, options);
        ASSERT_TRUE(made.ok());
        EXPECT_TRUE(validate_silmap(made.value().texture).empty());
        for (const double x : {3.5, 10.2, 40.9})
            EXPECT_NEAR(silmap_sample(made.value().texture, x, 20).r, x / 64, 0.6 / 255);
    }
}

TEST(Silmap, refusesSizesOutOfRange) {
    for (const GridSize size : {GridSize{0, 0}, GridSize{16385, 4}}) {
        SilmapOptions options;
        options.size = size;
        const auto made = compile_silmap(scene_of({box(0, 0, 100, 100)}), options);
        ASSERT_FALSE(made.ok());
        EXPECT_EQ(made.error().code, diag::kSizeOutOfRange);
    }
}

Scene disc() { return test::black_on_white({test::round_disc({0.5, 0.5}, 0.31)}); }

TEST(SilmapSize, isTheLargestThatFits) {
    for (const bool mips : {false, true}) {
        for (const std::uint64_t limit : {5u, 1000u, 12288u}) {
            SilmapOptions options;
            options.mips = mips;
            if (mips && limit == 5) continue; // one texel takes twelve
            options.sample_format = limit == 5 ? SilmapSampleFormat::Rgb8 : SilmapSampleFormat::Rgba8;
            const auto made = compile_silmap_at_chosen_size(disc(), options, limit + 3, 0);
            ASSERT_TRUE(made.ok()) << made.error().message;
            EXPECT_LE(made.value().stats.gpu_bytes, limit + 3);
            options.size = {made.value().texture.width + 1, 0};
            EXPECT_GT(compile_silmap(disc(), options).value().stats.gpu_bytes, limit + 3);
        }
    }
    const auto none = compile_silmap_at_chosen_size(disc(), {}, 6, 0);
    ASSERT_FALSE(none.ok());
    EXPECT_EQ(none.error().code, diag::kSilmapBudget);
}

TEST(SilmapSize, isTheSmallestThatIsGoodEnough) {
    for (const double most : {1e-2, 1e-3, 2e-4}) {
        const auto made = compile_silmap_at_chosen_size(disc(), {}, 0, most);
        ASSERT_TRUE(made.ok()) << made.error().message;
        EXPECT_LE(made.value().stats.wrong_area, most);
        EXPECT_GT(built(disc(), made.value().texture.width * 3 / 4).stats.wrong_area, most);
    }
    const auto none = compile_silmap_at_chosen_size(disc(), {}, 200, 1e-4);
    ASSERT_FALSE(none.ok());
    EXPECT_EQ(none.error().code, diag::kSilmapErrorUnmet);
    const auto unasked = compile_silmap_at_chosen_size(disc(), {}, 0, 0);
    ASSERT_TRUE(unasked.ok());
    EXPECT_LE(unasked.value().stats.wrong_area, budget::kSilmapChosenError);
}

} // namespace
} // namespace fetexc
