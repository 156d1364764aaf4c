// SPDX-License-Identifier: GPL-3.0-or-later
/// The CPU reference sampler on textures made by hand, where the right answer is known without it.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "formats/validate.h"
#include "tests/support/random_fbt.h"

namespace fetex {
namespace {

constexpr std::uint32_t kRed = 0xff0000ff, kGreen = 0xff00ff00, kBlue = 0xffff0000, kWhite = 0xffffffff;

struct P {
    double x, y;
};
struct FeatureRun {
    std::uint32_t degree, direction;
    std::vector<P> points; ///< polyline, or degree+1 points per piece
    std::uint32_t color = 0;
    bool last = true;
    std::uint32_t mask = 0;
};

using Words = std::vector<std::uint32_t>;

/// Not vector::insert: GCC 12 warns of an overflow there that doesn't exist.
void append(Words& out, const Words& words) {
    for (const std::uint32_t word : words)
        out.push_back(word);
}

/// One texel, or more of the same size; texel (0,0) gets the features.
class Maker {
  public:
    explicit Maker(std::uint32_t width = 1, std::uint32_t height = 1, std::uint32_t apron = 0) {
        t.width = width;
        t.height = height;
        t.apron = apron;
        for (std::uint32_t k = 0; k < (width + apron) * (height + apron); ++k)
            append(t.texels, {kWhite, 0});
    }
    /// Address of the entry list.
    std::uint32_t list(const std::vector<FeatureRun>& runs, std::uint32_t rest, std::uint32_t rest_mask = 0) {
        Words entries;
        for (const FeatureRun& run : runs) {
            const std::uint32_t address = records();
            for (std::size_t k = 0; k < run.points.size(); ++k) {
                t.records.push_back(fbt_pack_point(run.points[k].x, run.points[k].y));
                if (run.degree == 2 && k % 3 == 2) t.records.push_back(0);
            }
            t.records.resize((t.records.size() + 3) / 4 * 4, 0);
            const auto count = static_cast<std::uint32_t>(run.degree == 1 ? run.points.size() - 1
                                                                          : run.points.size() / (run.degree + 1));
            append(entries,
                   {address, count | run.degree << 16 | run.direction << 18 | (run.last ? kFbtEntryLastRun : 0),
                    run.last ? run.color : 0, run.last ? run.mask : 0});
        }
        append(entries, {0, kFbtEntryTerminator, rest, rest_mask});
        const std::uint32_t first = records();
        append(t.records, entries);
        return first;
    }
    void single(const std::vector<FeatureRun>& runs, std::uint32_t rest, std::uint32_t rest_mask = 0) {
        t.texels[1] = kFbtKindSingle << 30 | list(runs, rest, rest_mask);
    }
    void banded(const std::vector<std::pair<double, std::uint32_t>>& bands) {
        Words words = {static_cast<std::uint32_t>(bands.size()), 0};
        for (const auto& [end, first] : bands)
            append(words, {fbt_quantise(end), first});
        words.resize((words.size() + 3) / 4 * 4, 0);
        t.texels[1] = kFbtKindBanded << 30 | records();
        append(t.records, words);
    }
    /// Sample of the region at a point of texel (0,0). The texture must be valid.
    std::uint32_t at(double x, double y) {
        t.traits = fbt_traits(t);
        const auto findings = validate_fbt(t);
        EXPECT_TRUE(findings.empty()) << findings[0].message;
        return fbt_locate_local(t, 0, 0, x, y).sample;
    }
    FbtTexture t;

  private:
    [[nodiscard]] std::uint32_t records() const { return static_cast<std::uint32_t>(t.records.size() / 4); }
};

TEST(Quantise, keepsZeroAndOneExact) {
    EXPECT_EQ(fbt_quantise(0), 0x4000u);
    EXPECT_EQ(fbt_quantise(1), 0xc000u);
    EXPECT_EQ(fbt_dequantise(0x4000), 0.0);
    EXPECT_EQ(fbt_dequantise(0xc000), 1.0);
    EXPECT_EQ(fbt_quantise(-7), 0u);
    EXPECT_EQ(fbt_quantise(7), 0xffffu);
    for (std::uint32_t u = 0; u < 65536; u += 17)
        EXPECT_EQ(fbt_quantise(fbt_dequantise(u)), u);
}

TEST(Sampler, emptyTexelIsItsSample) {
    Maker m;
    m.t.texels[0] = kGreen;
    EXPECT_EQ(m.at(0.3, 0.9), kGreen);
    EXPECT_EQ(fbt_locate(m.t, 0.3, 0.9).record, 0xffffffffu);
}

/// FBT Fig. 5 (a): a line from top to bottom, red on its left. The ray runs along +x; along −x the line bounds the
/// right.
TEST(Sampler, lineDividesTheTexelAlongEachRayDirection) {
    for (const std::uint32_t direction : {kFbtRayPosX, kFbtRayNegX}) {
        Maker m;
        m.single({{1, direction, {{0.25, 0}, {0.75, 1}}, kRed}}, kBlue);
        const std::uint32_t left = direction == kFbtRayPosX ? kRed : kBlue;
        const std::uint32_t right = direction == kFbtRayPosX ? kBlue : kRed;
        for (double y = 0; y < 1; y += 1.0 / 64) {
            EXPECT_EQ(m.at(0.25 + y / 2 - 1e-6, y), left);
            EXPECT_EQ(m.at(0.25 + y / 2 + 1e-6, y), right);
        }
    }
    for (const std::uint32_t direction : {kFbtRayPosY, kFbtRayNegY}) {
        Maker m;
        m.single({{1, direction, {{0, 0.25}, {1, 0.75}}, kRed}}, kBlue);
        const std::uint32_t above = direction == kFbtRayPosY ? kRed : kBlue;
        const std::uint32_t below = direction == kFbtRayPosY ? kBlue : kRed;
        for (double x = 0; x < 1; x += 1.0 / 64) {
            EXPECT_EQ(m.at(x, 0.25 + x / 2 - 1e-6), above);
            EXPECT_EQ(m.at(x, 0.25 + x / 2 + 1e-6), below);
        }
    }
}

/// On the line itself: +x needs x(t*) > p.x, −x takes the rest, so the two are complements everywhere.
TEST(Sampler, oppositeRaysAreComplementsAlsoOnTheLine) {
    for (const std::uint32_t positive : {kFbtRayPosX, kFbtRayPosY}) {
        Maker a, b;
        a.single({{1, positive, {{0, 0}, {1, 1}}, kRed}}, kBlue);
        b.single({{1, positive + 1, {{0, 0}, {1, 1}}, kRed}}, kBlue);
        for (int k = 0; k < 16; ++k)
            for (int n = 0; n < 16; ++n)
                EXPECT_NE(a.at(k / 16.0, n / 16.0), b.at(k / 16.0, n / 16.0)) << k << " " << n;
    }
}

/// FBT Fig. 5 (a): the feature cuts the corner (0,0); a ray towards the left or the top side would miss the closing
/// edge.
TEST(Sampler, cornerCutNeedsARayAwayFromItsSides) {
    for (const std::uint32_t direction : {kFbtRayPosX, kFbtRayPosY}) {
        Maker m;
        m.single({{1, direction, {{0.5, 0}, {0, 0.5}}, kRed}}, kBlue);
        EXPECT_EQ(m.at(0.1, 0.1), kRed);
        EXPECT_EQ(m.at(0.24, 0.25), kRed);
        EXPECT_EQ(m.at(0.26, 0.25), kBlue);
        EXPECT_EQ(m.at(0.1, 0.9), kBlue);
        EXPECT_EQ(m.at(0.9, 0.1), kBlue);
    }
}

TEST(Sampler, loopHasAnInsideForEveryRay) {
    const std::vector<P> octagon = {{0.7, 0.4}, {0.7, 0.6}, {0.6, 0.7}, {0.4, 0.7}, {0.3, 0.6},
                                    {0.3, 0.4}, {0.4, 0.3}, {0.6, 0.3}, {0.7, 0.4}};
    for (std::uint32_t direction = 0; direction < 4; ++direction) {
        Maker m;
        m.single({{1, direction, octagon, kRed}}, kBlue);
        for (int k = 0; k < 64; ++k) {
            for (int n = 0; n < 64; ++n) {
                const double x = (k + 0.37) / 64, y = (n + 0.59) / 64, dx = std::abs(x - 0.5), dy = std::abs(y - 0.5);
                const bool inside = dx < 0.2 && dy < 0.2 && dx + dy < 0.3;
                EXPECT_EQ(m.at(x, y), inside ? kRed : kBlue) << x << " " << y << " ray " << direction;
            }
        }
    }
}

/// The quarter circle's cubic against the equation of the circle; the curve deviates from it by 2.8e-4 of the radius.
TEST(Sampler, cubicFollowsItsCurve) {
    const double k = 0.5522847498;
    for (std::uint32_t direction : {kFbtRayPosX, kFbtRayPosY}) {
        Maker m;
        m.single({{3, direction, {{0.75, 0}, {0.75, 0.75 * k}, {0.75 * k, 0.75}, {0, 0.75}}, kRed}}, kBlue);
        std::mt19937_64 random(1);
        for (int n = 0; n < 20000; ++n) {
            const double x = static_cast<double>(random() >> 11) * 0x1p-53,
                         y = static_cast<double>(random() >> 11) * 0x1p-53;
            const double r = std::hypot(x, y);
            if (std::abs(r - 0.75) < 3e-4) continue;
            EXPECT_EQ(m.at(x, y), r < 0.75 ? kRed : kBlue) << x << " " << y;
            if (HasFailure()) return;
        }
    }
}

/// y = x² as a quadratic piece, exactly.
TEST(Sampler, quadraticFollowsItsCurve) {
    for (std::uint32_t direction = 0; direction < 4; ++direction) {
        Maker m;
        m.single({{2, direction, {{0, 0}, {0.5, 0}, {1, 1}}, kRed}}, kBlue);
        for (int k = 1; k < 200; ++k) {
            for (int n = 1; n < 200; ++n) {
                const double x = k / 200.0 + 1e-5, y = n / 200.0 + 2e-5;
                const bool curve_is_right = x < std::sqrt(y), curve_is_below = y < x * x;
                const bool hit[] = {curve_is_right, !curve_is_right, curve_is_below, !curve_is_below};
                const bool inside = hit[direction];
                EXPECT_EQ(m.at(x, y), inside ? kRed : kBlue) << x << " " << y << " ray " << direction;
                if (HasFailure()) return;
            }
        }
    }
}

/// A line as polyline, as quadratic and as cubic divides the texel in the same way.
TEST(Sampler, degreesAgreeOnTheSameLine) {
    std::mt19937_64 random(4);
    // Multiples of 6 steps: halves and thirds of differences stay on the u16 grid.
    const auto coordinate = [&] { return static_cast<double>(random() % 5461) * 6 / 32768; };
    for (std::uint32_t n = 0; n < 400; ++n) {
        const P a{coordinate(), coordinate()}, b{coordinate(), coordinate()};
        const auto between = [&](double t) { return P{a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t}; };
        const std::uint32_t direction = n % 4;
        Maker line, quadratic, cubic;
        line.single({{1, direction, {a, b}, kRed}}, kBlue);
        quadratic.single({{2, direction, {a, between(0.5), b}, kRed}}, kBlue);
        cubic.single({{3, direction, {a, between(1.0 / 3), between(2.0 / 3), b}, kRed}}, kBlue);
        for (int k = 0; k < 100; ++k) {
            const double x = coordinate() + 1e-7, y = coordinate() + 1e-7;
            EXPECT_EQ(line.at(x, y), quadratic.at(x, y));
            EXPECT_EQ(line.at(x, y), cubic.at(x, y));
        }
    }
}

/// A chain of pieces: a ray through the shared end points counts each crossing once.
TEST(Sampler, raysThroughSharedEndPointsCountOnce) {
    std::vector<P> zigzag;
    for (int k = 0; k <= 8; ++k)
        zigzag.push_back({k % 2 ? 0.6 : 0.4, k / 8.0});
    Maker m;
    m.single({{1, kFbtRayPosX, zigzag, kRed}}, kBlue);
    for (int k = 0; k < 8; ++k) {
        EXPECT_EQ(m.at(0.2, k / 8.0), kRed);
        EXPECT_EQ(m.at(0.8, k / 8.0), kBlue);
    }
}

/// Runs of different degrees make one feature; its parity is taken over all.
TEST(Sampler, parityRunsOverAllRunsOfAFeature) {
    Maker m;
    m.single({{1, kFbtRayPosX, {{0.5, 0}, {0.5, 0.25}}, 0, false},
              {2, kFbtRayPosX, {{0.5, 0.25}, {0.5, 0.5}, {0.75, 0.5}}, 0, false},
              {3, kFbtRayPosX, {{0.75, 0.5}, {0.75, 0.6}, {0.75, 0.9}, {0.75, 1}}, kRed, true}},
             kBlue);
    for (const double y : {0.1, 0.2, 0.6, 0.9}) {
        EXPECT_EQ(m.at(0.4, y), kRed);
        EXPECT_EQ(m.at(0.8, y), kBlue);
    }
    EXPECT_EQ(m.at(0.7, 0.45), kBlue);
    EXPECT_EQ(m.at(0.7, 0.55), kRed);
}

/// FBT Fig. 5 (c): the first feature with the point inside wins.
TEST(Sampler, featuresAreTestedInOrder) {
    Maker m;
    m.single({{1, kFbtRayPosX, {{0.25, 0}, {0.25, 1}}, kRed}, {1, kFbtRayPosX, {{0.75, 0}, {0.75, 1}}, kGreen}}, kBlue);
    EXPECT_EQ(m.at(0.1, 0.5), kRed);
    EXPECT_EQ(m.at(0.5, 0.5), kGreen);
    EXPECT_EQ(m.at(0.9, 0.5), kBlue);
}

/// FBT Fig. 2 (d): two crossing diagonals need a band above and one below the crossing.
TEST(Sampler, bandsSeparateCrossingFeatures) {
    Maker m;
    const FeatureRun down{1, kFbtRayPosX, {{0, 0}, {1, 1}}, kRed}, up{1, kFbtRayPosX, {{0, 1}, {1, 0}}, kGreen};
    FeatureRun up_below = up, down_below = down;
    down_below.color = kWhite;
    const std::uint32_t above = m.list({down, up}, kBlue), below = m.list({up_below, down_below}, kBlue);
    m.banded({{0.5, above}, {1, below}});
    EXPECT_EQ(m.at(0.1, 0.25), kRed);
    EXPECT_EQ(m.at(0.5, 0.25), kGreen);
    EXPECT_EQ(m.at(0.9, 0.25), kBlue);
    EXPECT_EQ(m.at(0.1, 0.75), kGreen);
    EXPECT_EQ(m.at(0.5, 0.75), kWhite);
    EXPECT_EQ(m.at(0.9, 0.75), kBlue);
}

TEST(Sampler, bandHoldsItsStartAndNotItsEnd) {
    for (int bands = 1; bands <= 9; ++bands) {
        Maker m;
        std::vector<std::pair<double, std::uint32_t>> directory;
        for (int k = 0; k < bands; ++k)
            directory.emplace_back(k + 1 == bands ? 1.0 : fbt_dequantise(fbt_quantise((k + 1.0) / bands)),
                                   m.list({}, 0xff000000u | static_cast<std::uint32_t>(k)));
        m.banded(directory);
        double start = 0;
        for (int k = 0; k < bands; ++k) {
            const double end = directory[static_cast<std::size_t>(k)].first;
            EXPECT_EQ(m.at(0.5, start), 0xff000000u + static_cast<std::uint32_t>(k));
            EXPECT_EQ(m.at(0.5, end - 1e-9), 0xff000000u + static_cast<std::uint32_t>(k));
            start = end;
        }
    }
}

/// FBT Fig. 6: (a) all four samples, (b) the right ones blocked and the left copied, (c) only one neighbour reachable.
TEST(Sampler, masksNameTheSampleOfEachCorner) {
    Maker m(1, 1, 1);
    m.t.texels = {0xff000000, 0, 0xff000040, 0, 0xff000080, 0, 0xff0000c0, 0}; // red 0, 64, 128, 192
    const auto red = [&](std::uint32_t mask, double x, double y) {
        m.t.texels[1] = mask;
        m.at(x, y);
        return fbt_sample(m.t, x, y).r * 255;
    };
    EXPECT_NEAR(red(0xe4, 0.25, 0.5), 0.25 * 64 + 0.5 * 128, 1e-9); // (a): codes 0 1 2 3
    EXPECT_NEAR(red(0xa0, 0.25, 0.5), 0.5 * 128, 1e-9);             // (b): codes 0 0 2 2
    EXPECT_NEAR(red(0xff, 0.25, 0.5), 192, 1e-9);                   // (c): codes 3 3 3 3
    EXPECT_NEAR(red(0xc0, 0.5, 0.5), 0.25 * 192, 1e-9);             // codes 0 0 0 3
    EXPECT_NEAR(red(0x00, 0.9, 0.9), 0, 1e-9);
}

/// A region inside a feature interpolates from its own sample and the neighbours its mask names, not the texel's.
TEST(Sampler, regionsInterpolateFromTheirOwnSample) {
    Maker m(2, 1, 1);
    for (std::size_t k = 0; k < 6; ++k)
        m.t.texels[2 * k] = 0xff000000u + 10 * static_cast<std::uint32_t>(k);
    m.single({{1, kFbtRayPosX, {{0.5, 0}, {0.5, 1}}, 0xff0000c8, true, 0xa0}}, 0xff000064, 0x55);
    m.at(0, 0);
    EXPECT_NEAR(fbt_sample(m.t, 0.25, 0.5).r * 255, 0.5 * 200 + 0.5 * 30, 1e-9); // own 200, below 30
    EXPECT_NEAR(fbt_sample(m.t, 0.75, 0.5).r * 255, 10, 1e-9);                   // the right neighbour's only
}

TEST(Sampler, apronReachesBeyondTheLastTexel) {
    Maker m(2, 2, 1);
    for (std::size_t k = 0; k < 9; ++k)
        m.t.texels[2 * k] = 0xff000000u + 10 * static_cast<std::uint32_t>(k);
    for (const std::size_t k : {0u, 1u, 3u, 4u})
        m.t.texels[2 * k + 1] = 0xe4;
    m.t.traits = fbt_traits(m.t);
    ASSERT_TRUE(validate_fbt(m.t).empty());
    // A plane: 10 a column, 30 a row.
    for (double y = 0; y <= 2; y += 0.25)
        for (double x = 0; x <= 2; x += 0.25)
            EXPECT_NEAR(fbt_sample(m.t, x, y).r * 255, 10 * x + 30 * y, 1e-9) << x << " " << y;
}

TEST(Sampler, clampsPointsOutsideAndNotANumber) {
    const FbtTexture t = fetexc::test::random_fbt(3);
    const auto same = [&](double x, double y, double cx, double cy) {
        const FbtRegion a = fbt_locate(t, x, y), b = fbt_locate(t, cx, cy);
        EXPECT_TRUE(a.i == b.i && a.j == b.j && a.record == b.record);
    };
    same(-3, 2.5, 0, 2.5);
    same(1e300, -1e300, 8, 0);
    same(std::nan(""), 4.5, 0, 4.5);
    same(INFINITY, -INFINITY, 8, 0);
}

TEST(Sampler, baseAndLocalEqualsTheSum) {
    const FbtTexture t = fetexc::test::random_fbt(4);
    std::mt19937_64 random(9);
    for (int n = 0; n < 5000; ++n) {
        const std::uint32_t i = static_cast<std::uint32_t>(random() % 8), j = static_cast<std::uint32_t>(random() % 8);
        const double fx = static_cast<double>(random() % 65536) / 65536,
                     fy = static_cast<double>(random() % 65536) / 65536;
        const FbtColor a = fbt_sample(t, i + fx, j + fy), b = fbt_sample_local(t, i, j, fx, fy);
        EXPECT_TRUE(a.r == b.r && a.g == b.g && a.b == b.b && a.a == b.a);
    }
}

/// FBT §6.3: the box settles what it can; each considered curve is settled in exactly one way.
TEST(QueryStats, countEachPieceOnce) {
    Maker m;
    m.single({{3, kFbtRayPosX, {{0.5, 0}, {0.5, 0.3}, {0.75, 0.6}, {0.75, 1}}, kRed}}, kBlue);
    m.at(0, 0);
    FbtQueryStats stats;
    fbt_locate_local(m.t, 0, 0, 0.1, 0.5, &stats);
    EXPECT_EQ(stats.box, 1u);
    EXPECT_EQ(stats.solved[3], 0u);
    fbt_locate_local(m.t, 0, 0, 0.6, 0.5, &stats);
    EXPECT_EQ(stats.solved[3], 1u);
    const FbtTexture t = fetexc::test::random_fbt(6);
    FbtQueryStats all;
    std::mt19937_64 random(2);
    for (int n = 0; n < 2000; ++n)
        fbt_locate_local(t, static_cast<std::uint32_t>(random() % 8), static_cast<std::uint32_t>(random() % 8),
                         static_cast<double>(random() >> 11) * 0x1p-53, static_cast<double>(random() >> 11) * 0x1p-53,
                         &all);
    EXPECT_EQ(all.queries, 2000u);
    EXPECT_GT(all.solved[1] * all.solved[2] * all.solved[3] * all.box * all.outside * all.bands, 0u);
    EXPECT_EQ(all.pieces, all.outside + all.box + all.solved[1] + all.solved[2] + all.solved[3]);
}

} // namespace
} // namespace fetex
