// SPDX-License-Identifier: GPL-3.0-or-later
/// What holds for every silhouette-map texture: cells agree where they meet, colours stay between those of the corners,
/// pixels are means of points, and nothing steps while pixels grow or move.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "formats/fbt_mip.h"
#include "tests/support/random.h"
#include "tests/support/random_silmap.h"

namespace fetexc::test {
namespace {

using namespace fetex;

constexpr std::uint32_t kWidth = 9, kHeight = 7;

double difference(const FbtColor& a, const FbtColor& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b), std::abs(a.a - b.a)});
}

class SilmapSampling : public testing::TestWithParam<std::tuple<SilmapCellFormat, SilmapFilter>> {
  protected:
    [[nodiscard]] SilmapFilter filter() const { return std::get<1>(GetParam()); }
    [[nodiscard]] SilmapTexture texture(std::uint64_t seed, double boundaries = 0.5) const {
        return random_silmap(seed, {.width = kWidth,
                                    .height = kHeight,
                                    .cell_format = std::get<0>(GetParam()),
                                    .mips = true,
                                    .boundaries = boundaries});
    }
};

/// A link crosses the border between its cells at one place, and parts the same texels on both sides of it.
TEST_P(SilmapSampling, cellsAgreeWhereTheyMeet) {
    Random random(1);
    int different = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const SilmapTexture t = texture(seed);
        for (int k = 0; k < 2000; ++k) {
            const double border = random.integer(0, 6) + 0.5, along = random.between(0, 7), hair = 1e-7;
            const bool across = k % 2 == 0;
            const auto at = [&](double side) {
                return across ? silmap_sample(t, border + side, along, SilmapFilter::Nearest)
                              : silmap_sample(t, along, border + side, SilmapFilter::Nearest);
            };
            different += difference(at(-hair), at(hair)) > 0;
        }
    }
    EXPECT_LE(different, 1); // of 40000; where a link crosses within the hair
}

/// Premultiplied colours stay so, and what is filtered lies between what it is filtered from.
TEST_P(SilmapSampling, colorsLieBetweenThoseOfTheCorners) {
    Random random(2);
    const SilmapTexture t = texture(2);
    for (int k = 0; k < 20000; ++k) {
        const double x = random.between(0, kWidth), y = random.between(0, kHeight);
        const int i = static_cast<int>(std::floor(x + 0.5)), j = static_cast<int>(std::floor(y + 0.5));
        double least = 1, most = 0;
        for (int corner = 0; corner < 4; ++corner) {
            const auto column = std::clamp<int>(i - 1 + corner % 2, 0, kWidth - 1),
                       row = std::clamp<int>(j - 1 + corner / 2, 0, kHeight - 1);
            const double red = (t.colors[static_cast<std::size_t>(row * int{kWidth} + column)] & 255) / 255.0;
            least = std::min(least, red), most = std::max(most, red);
        }
        const FbtColor c = silmap_sample(t, x, y, filter());
        EXPECT_GE(c.r, least - 1e-12);
        EXPECT_LE(c.r, most + 1e-12);
        EXPECT_LE(std::max({c.r, c.g, c.b}), c.a + 1e-12);
        const FbtColor pixel = silmap_sample_area(t, x, y, {0.7, 0.4}, filter());
        EXPECT_LE(std::max({pixel.r, pixel.g, pixel.b}), pixel.a + 1e-12);
        EXPECT_LE(pixel.a, 1 + 1e-12);
    }
}

struct Errors {
    double area = 0, rotated = 0; ///< root mean square, over pixels with an edge
    int pixels = 0;
};

/// Pixels of a side, at random places where the picture isn't constant, against 48 × 48 points.
Errors errors(const SilmapTexture& t, SilmapFilter filter, double side, Random& random) {
    constexpr int kPoints = 48, kPixels = 150;
    Errors e;
    for (int tries = 0; e.pixels < kPixels && tries < 200000; ++tries) {
        const double x = random.between(0.5, kWidth - 0.5), y = random.between(0.5, kHeight - 0.5);
        const auto at = [&](double u, double v) { return silmap_sample(t, x + side * u, y + side * v, filter).g; };
        double spread = 0;
        for (const double u : {-0.45, 0.0, 0.45})
            for (const double v : {-0.45, 0.0, 0.45})
                spread = std::max(spread, std::abs(at(0, 0) - at(u, v)));
        if (spread < 0.02) continue;
        double truth = 0, rotated = 0;
        for (int k = 0; k < kPoints * kPoints; ++k)
            truth += at((k % kPoints + 0.5) / kPoints - 0.5, (k / kPoints + 0.5) / kPoints - 0.5);
        truth /= kPoints * kPoints;
        for (const auto& [u, v] : {std::pair(-0.375, -0.125), {0.125, -0.375}, {0.375, 0.125}, {-0.125, 0.375}})
            rotated += at(u, v) / 4;
        const double area = silmap_sample_area(t, x, y, {side, side}, filter).g;
        e.area += (area - truth) * (area - truth), e.rotated += (rotated - truth) * (rotated - truth);
        ++e.pixels;
    }
    e.area = std::sqrt(e.area / std::max(e.pixels, 1)), e.rotated = std::sqrt(e.rotated / std::max(e.pixels, 1));
    return e;
}

/// Nearest: the areas are exact, what differs is the grid of points. Filtered: a quadrant that a link cuts has its
/// colour in the middle of the pixel's part of the cell and not in its own.
TEST_P(SilmapSampling, pixelsAreMeansOfPoints) {
    const bool nearest = filter() == SilmapFilter::Nearest;
    for (const double side : {1.0, 0.5, 0.125, 1.0 / 32}) {
        Random random(3);
        Errors sum;
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
            const Errors e = errors(texture(seed), filter(), side, random);
            EXPECT_GT(e.pixels, 100);
            sum.area += e.area / 8, sum.rotated += e.rotated / 8;
        }
        std::printf("  side %.3f: area %.5f, four rotated points %.5f\n", side, sum.area, sum.rotated);
        EXPECT_LT(sum.area, nearest ? 0.003 : 0.03);
        EXPECT_LT(sum.area, sum.rotated / 2);
    }
}

/// While the pixel grows from nothing to beyond the texture, through all levels.
TEST_P(SilmapSampling, nothingStepsWhilePixelsGrow) {
    Random random(5);
    const SilmapTexture t = texture(6);
    for (int k = 0; k < 300; ++k) {
        const double x = random.between(0, kWidth), y = random.between(0, kHeight);
        FbtColor before = silmap_sample_mip(t, x, y, {0.05, 0.05}, filter());
        for (double side = 0.05; side < 20; side *= 1.002) {
            const FbtColor now = silmap_sample_mip(t, x, y, {side, side}, filter());
            ASSERT_LT(difference(now, before), 0.02) << side;
            before = now;
        }
    }
}

TEST_P(SilmapSampling, nothingStepsWhilePixelsMove) {
    Random random(6);
    const SilmapTexture t = texture(7);
    for (int k = 0; k < 100; ++k) {
        const double y = random.between(0, kHeight), side = random.between(0.1, 1), step = side / 500;
        FbtColor before = silmap_sample_area(t, 0, y, {side, side}, filter());
        for (double x = 0; x < kWidth; x += step) {
            const FbtColor now = silmap_sample_area(t, x, y, {side, side}, filter());
            ASSERT_LT(difference(now, before), 0.005) << x; // two sides of the pixel, 1/500 each
            before = now;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, SilmapSampling,
                         testing::Combine(testing::ValuesIn(kSilmapCellFormats),
                                          testing::Values(SilmapFilter::Nearest, SilmapFilter::Filtered)),
                         [](const auto& tested) {
                             return std::string(std::get<0>(tested.param) == SilmapCellFormat::Bits8 ? "bits8"
                                                                                                     : "bits16") +
                                    (std::get<1>(tested.param) == SilmapFilter::Nearest ? "_nearest" : "_filtered");
                         });

} // namespace
} // namespace fetexc::test
