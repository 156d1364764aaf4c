// SPDX-License-Identifier: GPL-3.0-or-later
/// Silhouette maps of images with features (Sen 2004, Fig. 6): where boundaries run, and that nothing is mixed across
/// them.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "compiler/diagnostics.h"
#include "compiler/silmap/silmap_builder.h"
#include "formats/validate.h"
#include "tests/support/raster_picture.h"

namespace fetexc {
namespace {

using test::featured;
using test::grey;
using test::image_of;
using test::polyline;

constexpr double kStep = 1.0 / 255;

SilmapBuild build(const FeaturedImage& picture, GridSize size = {}, unsigned threads = 1) {
    SilmapOptions options;
    options.size = size.width == 0 ? GridSize{picture.image.width, picture.image.height} : size;
    options.threads = threads;
    auto built = compile_silmap(picture, options);
    if (!built.ok()) throw std::runtime_error(built.error().message);
    EXPECT_TRUE(fetex::validate_silmap(built.value().texture).empty());
    return std::move(built).value();
}

fetex::SilmapCell cell(const fetex::SilmapTexture& t, std::uint32_t i, std::uint32_t j) {
    return fetex::silmap_unpack_cell(t.cell_format, t.cells[std::size_t{j} * fetex::silmap_columns(t) + i]);
}

std::size_t boundaries(const fetex::SilmapTexture& t) {
    std::size_t count = 0;
    for (const std::uint16_t packed : t.cells) {
        const fetex::SilmapCell c = fetex::silmap_unpack_cell(t.cell_format, packed);
        count += (c.east ? 1 : 0) + (c.south ? 1 : 0);
    }
    return count;
}

TEST(SilmapFeatures, mixNothingAcross) {
    // A blurred edge along a slanted line: pixels within two of it are no samples.
    const auto side = [](double x, double y) { return x - 10 - 0.3 * y; };
    const auto picture = featured(image_of(24, 20,
                                           [&](double x, double y) {
                                               const double t = std::clamp(0.5 + 0.4 * side(x, y), 0.0, 1.0);
                                               return grey(0.2 + 0.6 * t);
                                           }),
                                  {polyline({{9.7, -1}, {16.3, 21}})}, 2);
    for (const GridSize size : {GridSize{24, 20}, {12, 10}}) {
        const SilmapBuild b = build(picture, size);
        const double pixel = 24.0 / size.width, reach = 0.11 * pixel; // the points' grid
        for (double y = 0.05; y < 20; y += 0.31) {
            for (double x = 0.05; x < 24; x += 0.17) {
                if (std::fabs(side(x, y)) < reach) continue;
                const double shown = fetex::silmap_sample(b.texture, x / pixel, y / pixel).g;
                EXPECT_NEAR(shown, side(x, y) > 0 ? 0.8 : 0.2, kStep) << x << ", " << y;
            }
        }
    }
}

/// An upright line between texels' middles, from above the picture to a level in row 6: of the links that it runs
/// along, those above its end are boundaries.
TEST(SilmapFeatures, endWhereTheFeatureEnds) {
    const auto picture = featured(image_of(12, 12, [](double x, double) { return grey(x < 5.25 ? 0.1 : 0.9); }),
                                  {polyline({{5.25, -1}, {5.25, 6.25}})}, 0.5);
    const SilmapBuild b = build(picture);
    for (std::uint32_t j = 0; j <= 12; ++j) {
        for (std::uint32_t i = 0; i <= 12; ++i) {
            const fetex::SilmapCell c = cell(b.texture, i, j);
            EXPECT_FALSE(c.east) << i << ", " << j;
            // The line is in column 5, which is the cell between the middles of texels 4 and 5; it ends in cell 6.
            EXPECT_EQ(c.south, i == 5 && j <= 4) << i << ", " << j;
        }
    }
}

/// A spike across the ways between the middles of texels 4 and 5, which lie outside it: where one can go around it
/// inside the two cells of such a way nothing is apart, elsewhere its sides are.
TEST(SilmapFeatures, separateWhatIsFarApartAroundThem) {
    const auto spike = [](double tip) {
        return featured(image_of(12, 12, [](double, double) { return grey(0.5); }),
                        {polyline({{4.8, 9.2}, {5, tip}, {5.2, 9.2}, {4.8, 9.2}})}, 0);
    };
    EXPECT_EQ(boundaries(build(spike(8.1)).texture), 0u); // crosses row 8's way alone
    EXPECT_EQ(boundaries(build(spike(7.1)).texture), 0u); // those of rows 7 and 8, from whose cells both ends are seen
    const fetex::SilmapTexture t = build(spike(5.1)).texture; // those of rows 5 to 8
    EXPECT_EQ(boundaries(t), 2u);
    EXPECT_TRUE(cell(t, 5, 6).south && cell(t, 5, 7).south);
}

TEST(SilmapFeatures, aRingIsClosed) {
    const auto picture = featured(image_of(16, 16,
                                           [](double x, double y) {
                                               const bool inside = std::max(std::fabs(x - 8), std::fabs(y - 8)) < 4.2;
                                               return grey(inside ? 1 : 0);
                                           }),
                                  {polyline({{3.8, 3.8}, {12.2, 3.8}, {12.2, 12.2}, {3.8, 12.2}, {3.8, 3.8}})}, 1);
    const SilmapBuild b = build(picture);
    // Texels 4 to 11 have their middles inside: 8 links a side.
    EXPECT_EQ(boundaries(b.texture), 32u);
    EXPECT_EQ(b.stats.cells_edge, 32u);
    for (std::uint32_t j = 0; j < 16; ++j) {
        for (std::uint32_t i = 0; i < 16; ++i) {
            const bool inside = i >= 4 && i < 12 && j >= 4 && j < 12;
            EXPECT_NEAR(fetex::silmap_sample(b.texture, i + 0.5, j + 0.5).g, inside ? 1 : 0, kStep);
        }
    }
    EXPECT_LT(b.stats.wrong_area * 256, 32 * 0.0625); // half a step of an eighth, along 32 texels
}

TEST(SilmapFeatures, beyondTheCanvasRunOn) {
    const auto picture = featured(image_of(8, 8, [](double x, double) { return grey(x < 3.7 ? 0 : 1); }),
                                  {polyline({{3.7, -2}, {3.7, 10}})}, 0.5);
    const SilmapBuild b = build(picture);
    for (double y = 0.01; y < 8; y += 0.09) {
        EXPECT_NEAR(fetex::silmap_sample(b.texture, 3.55, y).g, 0, kStep) << y;
        EXPECT_NEAR(fetex::silmap_sample(b.texture, 3.85, y).g, 1, kStep) << y;
    }
}

/// So do those that end on the border, or in the half texel beyond it.
TEST(SilmapFeatures, thatEndOnTheBorderReachIt) {
    for (const double beyond : {0.0, 0.3}) {
        const auto picture = featured(image_of(8, 8, [](double x, double) { return grey(x < 3.7 ? 0 : 1); }),
                                      {polyline({{3.7, -beyond}, {3.7, 8 + beyond}})}, 0.5);
        const SilmapBuild b = build(picture);
        for (double y = 0.01; y < 8; y += 0.09) {
            EXPECT_NEAR(fetex::silmap_sample(b.texture, 3.55, y).g, 0, kStep) << y;
            EXPECT_NEAR(fetex::silmap_sample(b.texture, 3.85, y).g, 1, kStep) << y;
        }
    }
}

TEST(SilmapFeatures, areTheSameForAnyThreads) {
    const auto picture = featured(image_of(40, 30, [](double x, double y) { return grey(0.5 + 0.01 * x - 0.01 * y); }),
                                  {polyline({{2, 3}, {37, 11}, {20, 27}}), polyline({{5, 29}, {33, 2}})}, 1);
    const SilmapBuild one = build(picture, {}, 1), four = build(picture, {}, 4);
    EXPECT_EQ(one.texture.cells, four.texture.cells);
    EXPECT_EQ(one.texture.colors, four.texture.colors);
}

TEST(SilmapFeatures, haveAtMostAsManyTexelsAsPixels) {
    const auto picture = featured(image_of(20, 10, [](double x, double) { return grey(x < 7.3 ? 0 : 1); }),
                                  {polyline({{7.3, -1}, {7.3, 11}})}, 0.5);
    const auto large = compile_silmap_at_chosen_size(picture, {}, 1u << 20, 0);
    ASSERT_TRUE(large.ok());
    EXPECT_EQ(large.value().texture.width, 20u);
    const auto small = compile_silmap_at_chosen_size(picture, {}, 300, 0);
    ASSERT_TRUE(small.ok());
    EXPECT_LE(small.value().stats.gpu_bytes, 300u);
    EXPECT_EQ(small.value().texture.width, 10u);
    const auto none = compile_silmap_at_chosen_size(picture, {}, 3, 0);
    ASSERT_FALSE(none.ok());
    EXPECT_EQ(none.error().code, diag::kSilmapBudget);
}

} // namespace
} // namespace fetexc
