// SPDX-License-Identifier: GPL-3.0-or-later
/// Cells of silhouette-map textures, their quadrants and areas, and the reference sampler, against other ways to get
/// the same and values computed by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "formats/fbt_mip.h"
#include "formats/fbt_samples.h"
#include "formats/silmap.h"
#include "formats/validate.h"
#include "tests/support/random.h"
#include "tests/support/random_silmap.h"

namespace fetex {
namespace {

using fetexc::test::kSilmapCellFormats;
using fetexc::test::kSilmapSampleFormats;
using fetexc::test::Random;
using fetexc::test::random_silmap;

constexpr std::uint32_t kRed = 0xff0000ff, kGreen = 0xff00ff00, kBlue = 0xffff0000, kWhite = 0xffffffff;
constexpr auto kBits8 = SilmapCellFormat::Bits8;

/// Every point at one place, no boundaries.
SilmapTexture uniform(std::uint32_t width, std::uint32_t height, std::vector<std::uint32_t> colors, SilmapCell cell) {
    SilmapTexture t;
    t.width = width, t.height = height;
    t.colors = std::move(colors);
    t.cells.assign((width + 1) * (height + 1), silmap_pack_cell(kBits8, cell));
    EXPECT_TRUE(validate_silmap(t).empty());
    return t;
}

TEST(SilmapCells, arePackedAsThePaperHasThem) {
    EXPECT_EQ(silmap_pack_cell(kBits8, {5, 3, false, false}), 5 | 3 << 3);
    EXPECT_EQ(silmap_pack_cell(kBits8, {0, 0, true, false}), 64);
    EXPECT_EQ(silmap_pack_cell(kBits8, {0, 0, false, true}), 128);
    EXPECT_EQ(silmap_pack_cell(SilmapCellFormat::Bits16, {127, 1, true, false}), 127 | 1 << 7 | 1 << 14);
    EXPECT_EQ(silmap_pack_cell(SilmapCellFormat::Bits16, {0, 0, false, true}), 1 << 15);
    for (std::uint32_t v = 0; v < 65536; ++v) {
        const auto packed = static_cast<std::uint16_t>(v);
        const auto cell = silmap_unpack_cell(SilmapCellFormat::Bits16, packed);
        EXPECT_EQ(silmap_pack_cell(SilmapCellFormat::Bits16, cell), packed);
        if (v >= 256) continue;
        EXPECT_EQ(silmap_pack_cell(kBits8, silmap_unpack_cell(kBits8, packed)), packed);
    }
}

TEST(SilmapCells, havePointsInTheMiddleOfSteps) {
    for (const SilmapCellFormat format : kSilmapCellFormats) {
        const std::uint32_t n = silmap_steps(format);
        for (std::uint32_t k = 0; k < n; ++k) {
            EXPECT_EQ(silmap_position(format, k), (2 * k + 1) / (2.0 * n));
            EXPECT_EQ(silmap_step(format, silmap_position(format, k)), k);
            EXPECT_EQ(silmap_step(format, double(k) / n), k); // ties go up
        }
        EXPECT_EQ(silmap_step(format, -1), 0u);
        EXPECT_EQ(silmap_step(format, 1), n - 1);
        EXPECT_EQ(silmap_step(format, std::numeric_limits<double>::quiet_NaN()), 0u);
    }
}

/// Cell (1,1) of two by two texels and its four neighbours; at the border cells and bits repeat.
TEST(SilmapCells, seeTheirNeighbours) {
    SilmapTexture t = uniform(2, 2, {kRed, kGreen, kBlue, kWhite}, {0, 0});
    const auto put = [&](std::size_t i, std::size_t j, SilmapCell c) {
        t.cells[3 * j + i] = silmap_pack_cell(kBits8, c);
    };
    put(1, 1, {4, 2, false, true});
    put(0, 1, {7, 3, true, false});
    put(1, 0, {1, 6, true, false});
    put(2, 1, {0, 5, false, false});
    put(1, 2, {2, 1, false, false});
    const SilmapShape s = silmap_shape(t, 1, 1);
    const auto expect_at = [](SilmapPoint p, double x, double y) {
        EXPECT_EQ(p.x, x);
        EXPECT_EQ(p.y, y);
    };
    expect_at(s.point, 0.5625, 0.3125);
    expect_at(s.across[kSilmapWest], 0.9375 - 1, 0.4375);
    expect_at(s.across[kSilmapNorth], 0.1875, 0.8125 - 1);
    expect_at(s.across[kSilmapEast], 1.0625, 0.6875);
    expect_at(s.across[kSilmapSouth], 0.3125, 1.1875);
    EXPECT_EQ(s.boundaries, 1u << kSilmapWest | 1u << kSilmapSouth);
    const SilmapShape west = silmap_shape(t, 0, 1), east = silmap_shape(t, 2, 1);
    expect_at(west.across[kSilmapWest], 0.9375 - 1, 0.4375);
    EXPECT_EQ(west.boundaries, 1u << kSilmapWest | 1u << kSilmapEast);
    expect_at(east.across[kSilmapEast], 1.0625, 0.6875);
    EXPECT_EQ(silmap_shape(t, 9, 1).boundaries, east.boundaries);
}

SilmapPoint along(SilmapPoint a, SilmapPoint b, double t) { return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}; }

/// The skewed quadrant as a polygon: the cell's point, where the link along the border leaves, the corner, and back.
std::vector<SilmapPoint> quadrant_polygon(const SilmapShape& s, std::uint32_t corner) {
    const bool east = (corner & 1) != 0, south = (corner & 2) != 0;
    const SilmapPoint sideways = s.across[east ? kSilmapEast : kSilmapWest],
                      upright = s.across[south ? kSilmapSouth : kSilmapNorth];
    const double right = east ? 1 : 0, below = south ? 1 : 0;
    const SilmapPoint a = along(s.point, upright, (below - s.point.y) / (upright.y - s.point.y)),
                      b = along(s.point, sideways, (right - s.point.x) / (sideways.x - s.point.x));
    return {s.point, a, {right, below}, b};
}

double signed_area(const std::vector<SilmapPoint>& p) {
    double sum = 0;
    for (std::size_t k = 0; k < p.size(); ++k) {
        const SilmapPoint &a = p[k], &b = p[(k + 1) % p.size()];
        sum += a.x * b.y - b.x * a.y;
    }
    return sum / 2;
}

bool inside(const std::vector<SilmapPoint>& p, double x, double y) {
    bool odd = false;
    for (std::size_t k = 0; k < p.size(); ++k) {
        const SilmapPoint &a = p[k], &b = p[(k + 1) % p.size()];
        if ((a.y > y) != (b.y > y) && x < a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
    }
    return odd;
}

/// Sutherland and Hodgman's: what of a polygon lies on one side of a line along an axis.
std::vector<SilmapPoint> cut(const std::vector<SilmapPoint>& p, bool along_x, double at, bool above) {
    std::vector<SilmapPoint> out;
    const auto v = [&](const SilmapPoint& q) {
        return above ? (along_x ? q.x : q.y) - at : at - (along_x ? q.x : q.y);
    };
    for (std::size_t k = 0; k < p.size(); ++k) {
        const SilmapPoint &a = p[k], &b = p[(k + 1) % p.size()];
        if (v(a) >= 0) out.push_back(a);
        if ((v(a) >= 0) != (v(b) >= 0)) out.push_back(along(a, b, v(a) / (v(a) - v(b))));
    }
    return out;
}

SilmapShape random_shape(Random& random, SilmapCellFormat format) {
    const int last = static_cast<int>(silmap_steps(format)) - 1;
    const auto step = [&] { // often as far to one side as can be
        return silmap_position(format, static_cast<std::uint32_t>(random.chance(0.3) ? (random.chance(0.5) ? 0 : last)
                                                                                     : random.integer(0, last)));
    };
    SilmapShape s;
    s.point = {step(), step()};
    s.across = {SilmapPoint{step() - 1, step()}, {step(), step() - 1}, {step() + 1, step()}, {step(), step() + 1}};
    return s;
}

TEST(SilmapQuadrants, areThePolygonsBetweenTheLinks) {
    Random random(1);
    std::array<int, 4> seen{};
    int reflex = 0;
    for (int k = 0; k < 20000; ++k) {
        const SilmapShape s = random_shape(random, kSilmapCellFormats[k % 2]);
        for (int n = 0; n < 10; ++n) {
            const double x = random.unit(), y = random.unit();
            const std::uint32_t corner = silmap_quadrant(s, x, y);
            ASSERT_TRUE(inside(quadrant_polygon(s, corner), x, y)) << k << ": " << x << ", " << y;
            ++seen[corner];
        }
        const auto ne = quadrant_polygon(s, kSilmapNE); // the angle at the point beyond 180 degrees
        reflex += (ne[1].x - ne[0].x) * (ne[3].y - ne[0].y) - (ne[1].y - ne[0].y) * (ne[3].x - ne[0].x) < 0;
    }
    EXPECT_GT(*std::ranges::min_element(seen), 10000);
    EXPECT_GT(reflex, 100);
}

/// The corners lie in their own quadrants however the links run.
TEST(SilmapQuadrants, holdTheirCorners) {
    Random random(2);
    for (int k = 0; k < 5000; ++k) {
        const SilmapShape s = random_shape(random, kSilmapCellFormats[k % 2]);
        for (std::uint32_t corner = 0; corner < 4; ++corner)
            ASSERT_EQ(silmap_quadrant(s, corner & 1, corner >> 1), corner);
    }
}

/// What lies on a link lies east or south of it, seen from either cell; the cell's point lies in the south-east.
TEST(SilmapQuadrants, haveTheirNorthAndWestLinks) {
    SilmapShape s;
    s.point = {0.5625, 0.4375};
    s.across = {SilmapPoint{-0.4375, 0.9375}, {0.0625, -0.5625}, {1.5625, 0.1875}, {0.8125, 1.4375}};
    EXPECT_EQ(silmap_quadrant(s, s.point.x, s.point.y), kSilmapSE);
    for (const double t : {0.125, 0.25}) {
        const auto on = [&](std::uint32_t link) {
            const SilmapPoint p = along(s.point, s.across[link], t);
            return silmap_quadrant(s, p.x, p.y);
        };
        EXPECT_EQ(on(kSilmapWest), kSilmapSW);
        EXPECT_EQ(on(kSilmapNorth), kSilmapNE);
        EXPECT_EQ(on(kSilmapEast), kSilmapSE);
        EXPECT_EQ(on(kSilmapSouth), kSilmapSE);
    }
}

TEST(SilmapAreas, areThoseOfThePolygonsInTheBox) {
    Random random(3);
    for (int k = 0; k < 20000; ++k) {
        const SilmapShape s = random_shape(random, kSilmapCellFormats[k % 2]);
        SilmapBox box;
        if (k % 5 != 0) {
            const double side = std::pow(2.0, -random.between(0, 8)), x = random.unit(), y = random.unit();
            box = {std::max(x - side, 0.0), std::max(y - side, 0.0), std::min(x + side, 1.0), std::min(y + side, 1.0)};
        }
        const auto areas = silmap_areas(s, box);
        const double whole = (box.x1 - box.x0) * (box.y1 - box.y0);
        EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), whole, 1e-14);
        for (std::uint32_t corner = 0; corner < 4; ++corner) {
            auto polygon = quadrant_polygon(s, corner);
            polygon = cut(cut(polygon, true, box.x0, true), true, box.x1, false);
            polygon = cut(cut(polygon, false, box.y0, true), false, box.y1, false);
            ASSERT_NEAR(areas[corner], std::abs(signed_area(polygon)), 1e-14) << k;
        }
    }
}

/// The two texels of a row; between their middles (x = 1/2 … 3/2) the cell (1, ·), its point at 3/8 + 1/16 of the way.
TEST(SilmapSampling, putsTheEdgeWhereThePointsAre) {
    const SilmapTexture t = uniform(2, 1, {kRed, kBlue}, {3, 0});
    const double edge = 0.5 + 0.4375;
    for (const double y : {0.1, 0.4, 0.9}) {
        EXPECT_EQ(silmap_sample(t, edge - 1e-9, y, SilmapFilter::Nearest).r, 1);
        EXPECT_EQ(silmap_sample(t, edge, y, SilmapFilter::Nearest).r, 0);
        EXPECT_EQ(silmap_sample(t, edge, y, SilmapFilter::Nearest).b, 1);
        EXPECT_NEAR(silmap_sample(t, edge, y).b, 0.4375, 1e-15); // no boundary: as a bitmap
    }
    EXPECT_EQ(silmap_sample(t, -5, 0.5).r, 1);
    EXPECT_EQ(silmap_sample(t, 5, 0.5).b, 1);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(silmap_sample(t, nan, nan).r, 1);
}

/// With no boundary anywhere it is the bitmap, interpolated; the points don't matter.
TEST(SilmapSampling, withoutBoundariesIsBilinear) {
    const SilmapTexture t = random_silmap(4, {.width = 5, .height = 4, .boundaries = 0});
    Random random(5);
    const auto red = [&](int i, int j) {
        return (t.colors[static_cast<std::size_t>(std::clamp(j, 0, 3) * 5 + std::clamp(i, 0, 4))] & 255) / 255.0;
    };
    for (int k = 0; k < 2000; ++k) {
        const double x = random.between(0, 5), y = random.between(0, 4);
        const double u = x - 0.5 - std::floor(x - 0.5), v = y - 0.5 - std::floor(y - 0.5);
        const int i = static_cast<int>(std::floor(x - 0.5)), j = static_cast<int>(std::floor(y - 0.5));
        EXPECT_NEAR(silmap_sample(t, x, y).r,
                    (1 - u) * (1 - v) * red(i, j) + u * (1 - v) * red(i + 1, j) + (1 - u) * v * red(i, j + 1) +
                        u * v * red(i + 1, j + 1),
                    1e-14);
    }
}

/// With every link a boundary there is one corner in every set: nearest and filtered are the same.
TEST(SilmapSampling, withAllBoundariesIsTheNearest) {
    const SilmapTexture t = random_silmap(6, {.width = 5, .height = 4, .boundaries = 1});
    Random random(6);
    for (int k = 0; k < 2000; ++k) {
        const double x = random.between(-1, 6), y = random.between(-1, 5);
        EXPECT_EQ(silmap_sample(t, x, y).g, silmap_sample(t, x, y, SilmapFilter::Nearest).g);
        EXPECT_NEAR(silmap_sample_area(t, x, y, {0.3, 0.9}).g,
                    silmap_sample_area(t, x, y, {0.3, 0.9}, SilmapFilter::Nearest).g, 1e-12);
    }
}

TEST(SilmapSampling, isTheSameFromTexelAndOffset) {
    for (const SilmapCellFormat cells : kSilmapCellFormats)
        for (const SilmapSampleFormat samples : kSilmapSampleFormats) {
            const SilmapTexture t =
                random_silmap(7, {.width = 6, .height = 4, .cell_format = cells, .sample_format = samples});
            for (std::uint32_t j = 0; j < 4; ++j)
                for (std::uint32_t i = 0; i < 6; ++i)
                    for (const double f : {0.0, 0.25, 0.5, 0.875}) {
                        const double e = 1 - f - 0x1p-10;
                        EXPECT_EQ(silmap_sample(t, i + f, j + e).g, silmap_sample_local(t, i, j, f, e).g);
                        EXPECT_EQ(silmap_sample_area(t, i + f, j + e, {0.5, 0.25}).b,
                                  silmap_sample_area_local(t, i, j, f, e, {0.5, 0.25}).b);
                    }
        }
}

TEST(SilmapColors, areThoseOfTheirFormat) {
    SilmapTexture t = uniform(1, 1, {0x80402010}, {0, 0});
    EXPECT_EQ(silmap_sample(t, 0.5, 0.5).a, 128 / 255.0);
    EXPECT_EQ(silmap_sample(t, 0.5, 0.5).b, 64 / 255.0);
    t.sample_format = SilmapSampleFormat::Rgba16;
    t.colors = {0x20001000, 0x80004000};
    EXPECT_EQ(silmap_sample(t, 0.5, 0.5).g, 0x2000 / 65535.0);
    EXPECT_EQ(silmap_sample(t, 0.5, 0.5).a, 0x8000 / 65535.0);
    t.sample_format = SilmapSampleFormat::Rgba16F;
    t.colors = {0x3c004200, 0x38003400}; // 3, 1, 0.25, 0.5
    EXPECT_EQ(silmap_sample(t, 0.5, 0.5).r, 3);
    EXPECT_EQ(silmap_sample(t, 0.5, 0.5).a, 0.5);
}

/// An edge along an axis, exactly: red left of 0.9375, blue right of it.
TEST(SilmapPixels, haveTheExactCoverageOfStraightEdges) {
    SilmapTexture t = uniform(2, 2, {kRed, kBlue, kRed, kBlue}, {3, 3, false, true});
    for (const double side : {0.01, 0.3, 1.0})
        for (double x = 0; x <= 2; x += 0.03125) {
            const double covered = std::clamp((x + side / 2 - 0.9375) / side, 0.0, 1.0);
            EXPECT_NEAR(silmap_sample_area(t, x, 0.9, {side, 0.7}).b, covered, 1e-12);
            EXPECT_NEAR(silmap_sample_area(t, x, 1.6, {side, 1e-9}, SilmapFilter::Nearest).r, 1 - covered, 1e-12);
        }
}

/// A pixel of no size is a point.
TEST(SilmapPixels, ofNoSizeArePoints) {
    Random random(8);
    const SilmapTexture t = random_silmap(8);
    int different = 0;
    for (int k = 0; k < 5000; ++k) {
        const double x = random.between(0, 8), y = random.between(0, 8);
        different += std::abs(silmap_sample_area(t, x, y, {}).g - silmap_sample(t, x, y).g) > 1e-3;
    }
    EXPECT_LE(different, 5); // on a link
}

TEST(SilmapPixels, countSidesBeyondATexelAsOne) {
    const SilmapTexture t = random_silmap(9);
    EXPECT_EQ(silmap_sample_area(t, 3.3, 4.4, {7, 2}).g, silmap_sample_area(t, 3.3, 4.4, {1, 1}).g);
    EXPECT_EQ(silmap_sample_area(t, 3.3, 4.4, {-1, 0.5}).g, silmap_sample_area(t, 3.3, 4.4, {0, 0.5}).g);
}

/// 4×2 texels: levels of 2×1 and 1×1.
TEST(SilmapLevels, areMixedByTheLogarithmOfTheLongerSide) {
    SilmapTexture t = uniform(4, 2, std::vector<std::uint32_t>(8, 0xff000000), {0, 0});
    t.mips = {0xff000033, 0xff0000cc, 0xff000066}; // 0.2, 0.8; 0.4
    const auto red = [&](double x, double side) { return silmap_sample_mip(t, x, 1, {side, side}).r; };
    EXPECT_NEAR(red(1, 2), 0.2, 1e-15); // a sample of level 1
    EXPECT_NEAR(red(2, 2), 0.5, 1e-15);
    EXPECT_NEAR(red(-3, 2), 0.2, 1e-15);
    EXPECT_NEAR(red(1, 4), 0.4, 1e-15);
    EXPECT_NEAR(red(3, 1e6), 0.4, 1e-15);
    EXPECT_NEAR(red(1, 2 * std::sqrt(2.0)), 0.3, 1e-15);
    EXPECT_NEAR(red(2, 1), 0, 1e-15); // the texels
    EXPECT_NEAR(red(2.25, std::sqrt(2.0)), (0.2 + 0.6 * 0.625) / 2, 1e-15);
    EXPECT_EQ(silmap_sample_mip(t, 2.25, 1, {0.3, 4}).r, silmap_sample_mip(t, 2.25, 1, {4, 0.1}).r);
}

/// The paper's §2.2: the corners weighted by the areas of their quadrants, each pixel of a level 0 of means; then a
/// box.
TEST(SilmapLevels, areMeansOfWhatTheTextureShows) {
    // Points at 7/16 in both directions, all links boundaries: texel (0,0) shows itself left of x = 15/16.
    const SilmapTexture t = uniform(2, 2, {kRed, kGreen, kBlue, kWhite}, {3, 3, true, true});
    const double near = 15.0 / 16, far = 2 - near;
    const auto mips = silmap_make_mips(t);
    ASSERT_EQ(mips.size(), 1u);
    const std::uint32_t expected[] = {
        fbt_pack_sample({(near * near + far * far) / 4, (far * near + far * far) / 4, (far * near + far * far) / 4, 1},
                        FbtSampleFormat::Rgba8)[0]};
    EXPECT_EQ(mips[0], expected[0]);
}

/// Also at sizes that aren't powers of two, and in which a texel lies in two samples.
TEST(SilmapLevels, haveTheMeanOfTheirShare) {
    for (const auto& [width, height] : {std::pair(5u, 3u), std::pair(8u, 8u), std::pair(1u, 1u), std::pair(7u, 1u)}) {
        const SilmapTexture t = random_silmap(width, {.width = width, .height = height});
        const auto mips = silmap_make_mips(t);
        ASSERT_EQ(mips.size(), fbt_mip_samples(width, height));
        for (std::uint32_t k = 1; k <= fbt_mip_levels(width, height); ++k) {
            const FbtMipLevel level = fbt_mip_level(width, height, k);
            for (std::uint32_t j = 0; j < level.height; ++j)
                for (std::uint32_t i = 0; i < level.width; ++i) {
                    double sum = 0, area = 0;
                    for (std::uint32_t y = 0; y < height; ++y)
                        for (std::uint32_t x = 0; x < width; ++x) {
                            const double across = std::min((i + 1.0) * width / level.width, x + 1.0) -
                                                  std::max(double(i) * width / level.width, double(x)),
                                         down = std::min((j + 1.0) * height / level.height, y + 1.0) -
                                                std::max(double(j) * height / level.height, double(y));
                            if (across <= 0 || down <= 0) continue;
                            sum += across * down * silmap_sample_area(t, x + 0.5, y + 0.5, {1, 1}).g;
                            area += across * down;
                        }
                    const std::uint32_t sample = mips[level.first + std::size_t{j} * level.width + i];
                    EXPECT_NEAR((sample >> 8 & 255) / 255.0, sum / area, 0.5001 / 255) << k << ": " << i << ", " << j;
                }
        }
    }
}

TEST(SilmapSizes, countEveryByte) {
    SilmapTexture t = random_silmap(1, {.width = 5, .height = 3, .mips = true});
    EXPECT_EQ(silmap_gpu_bytes(t), 24u + 60u + 4u * (2 + 1));
    t = random_silmap(
        1,
        {.width = 5, .height = 3, .cell_format = SilmapCellFormat::Bits16, .sample_format = SilmapSampleFormat::Rgb8});
    EXPECT_EQ(silmap_gpu_bytes(t), 48u + 45u);
    t = random_silmap(1, {.width = 5, .height = 3, .sample_format = SilmapSampleFormat::Rgba16F});
    EXPECT_EQ(silmap_gpu_bytes(t), 24u + 120u);
}

} // namespace
} // namespace fetex
