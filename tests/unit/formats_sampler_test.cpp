// SPDX-License-Identifier: GPL-3.0-or-later
/// The CPU reference sampler on textures made by hand, where the right answer is known without it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "formats/validate.h"
#include "tests/support/fbt_maker.h"
#include "tests/support/random_fbt.h"

namespace fetex {
namespace {

constexpr std::uint32_t kRed = 0xff0000ff, kGreen = 0xff00ff00, kBlue = 0xffff0000, kWhite = 0xffffffff;

struct P {
    double x, y;
};
struct FeatureRun {
    std::uint32_t degree, direction;
    std::vector<P> points;   ///< neighbouring pieces share one
    std::uint32_t color = 0; ///< or what the model's sample is
    bool last = true;
    std::uint32_t model = kFbtModelSolid;
};

using fetexc::test::append_directory;
using fetexc::test::append_list;
using fetexc::test::append_patch;
using fetexc::test::MadeRegion;
using fetexc::test::MadeRun;
using fetexc::test::shaded_texel;
using fetexc::test::solid_texel;

MadeRun made(const FeatureRun& run) {
    MadeRun out{
        run.degree, run.direction,         static_cast<std::uint32_t>(run.points.size() - 1) / run.degree, {}, 0,
        run.last,   {run.model, run.color}};
    for (const P& p : run.points)
        out.points.push_back(fbt_pack_point(p.x, p.y));
    return out;
}

/// One texel, or more of the same size; texel (0,0) gets the features.
class Maker {
  public:
    explicit Maker(std::uint32_t width = 1, std::uint32_t height = 1) {
        t.width = width;
        t.height = height;
        t.texels.assign(std::size_t{width} * height, solid_texel(kWhite));
    }
    /// Its entry list.
    std::uint32_t list(const std::vector<FeatureRun>& runs, MadeRegion rest) {
        std::vector<MadeRun> all;
        for (const FeatureRun& run : runs)
            all.push_back(made(run));
        return append_list(t.records, all, rest);
    }
    std::uint32_t list(const std::vector<FeatureRun>& runs, std::uint32_t rest) {
        return list(runs, MadeRegion{kFbtModelSolid, rest});
    }
    void single(const std::vector<FeatureRun>& runs, std::uint32_t rest) {
        t.texels[0] = kFbtKindSingle << 30 | list(runs, rest);
    }
    void banded(const std::vector<std::pair<double, std::uint32_t>>& bands) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> directory;
        for (const auto& [end, first] : bands)
            directory.emplace_back(fbt_quantise(end), first);
        t.texels[0] = kFbtKindBanded << 30 | append_directory(t.records, directory);
    }
    void check() {
        t.traits = fbt_traits(t);
        const auto findings = validate_fbt(t);
        EXPECT_TRUE(findings.empty()) << findings[0].message;
    }
    /// Sample of the region at a point of texel (0,0). The texture must be valid.
    std::uint32_t at(double x, double y) {
        check();
        return fbt_locate_local(t, 0, 0, x, y).sample;
    }
    FbtTexture t;
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

TEST(Sampler, solidTexelIsItsColour) {
    Maker m;
    m.t.texels[0] = solid_texel(kGreen);
    EXPECT_EQ(m.at(0.3, 0.9), kGreen);
    EXPECT_EQ(fbt_locate(m.t, 0.3, 0.9).record, 0xffffffffu);
    m.t.texels[0] = 0; // nothing
    EXPECT_EQ(m.at(0.3, 0.9), 0u);
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

/// FBT Fig. 6 (a): all four corners; a plane of 10 a column, 30 a row.
TEST(Sampler, cornersAreInterpolatedAndReachBeyondTheLastTexel) {
    Maker m(2, 2);
    for (std::uint32_t k = 0; k < 9; ++k)
        m.t.corners.push_back(0xff000000u + 10 * k);
    for (std::uint32_t& texel : m.t.texels)
        texel = shaded_texel({kFbtModelCorners, 0});
    m.check();
    EXPECT_TRUE(m.t.traits.corners);
    const auto inside = [](double v) { return std::min(v, 1 + kFbtFarBorder); }; // of the far border
    for (double y = 0; y <= 2; y += 0.25)
        for (double x = 0; x <= 2; x += 0.25)
            EXPECT_NEAR(fbt_sample(m.t, x, y).r * 255, 10 * inside(x) + 30 * inside(y), 1e-9) << x << " " << y;
}

/// Each side of a feature has its own gradient: a patch inside, the texel's corners outside.
TEST(Sampler, regionsHaveModelsOfTheirOwn) {
    Maker m;
    m.t.corners = {0xff000000, 0xff000064, 0xff000000, 0xff000064}; // 100 a column
    const std::uint32_t patch = append_patch(m.t.records, 0xff0000c8, 0xff0000c8, 0xff000000, 0xff000000);
    m.t.texels[0] = kFbtKindSingle << 30 | m.list({{1, kFbtRayPosX, {{0.5, 0}, {0.5, 1}}, patch, true, kFbtModelPatch}},
                                                  {kFbtModelCorners, 0});
    m.check();
    EXPECT_NEAR(fbt_sample(m.t, 0.25, 0.25).r * 255, 0.75 * 200, 1e-9);
    EXPECT_NEAR(fbt_sample(m.t, 0.75, 0.25).r * 255, 75, 1e-9);
    m.t.texels[0] = shaded_texel({kFbtModelPatch, patch});
    m.check();
    EXPECT_NEAR(fbt_sample(m.t, 0.75, 0.5).r * 255, 100, 1e-9);
}

/// Bands may share points: the second list reads those of the first.
TEST(Sampler, sharedPointsAreThoseOfTheOtherRun) {
    Maker m;
    const MadeRun cubic = made({3, kFbtRayPosX, {{0.25, 0}, {0.25, 0.25}, {0.75, 0.75}, {0.75, 1}}, kRed});
    std::vector<std::uint32_t> words;
    const std::uint32_t above = append_list(m.t.records, {cubic}, {kFbtModelSolid, kBlue}, &words);
    MadeRun again = cubic;
    again.points.clear(), again.shared_from = words[0], again.inside.sample = kGreen;
    const std::uint32_t below = append_list(m.t.records, {again}, {kFbtModelSolid, kWhite});
    m.banded({{0.5, above}, {1, below}});
    EXPECT_EQ(m.at(0.3, 0.4), kRed);
    EXPECT_EQ(m.at(0.6, 0.4), kBlue);
    EXPECT_EQ(m.at(0.4, 0.6), kGreen);
    EXPECT_EQ(m.at(0.7, 0.6), kWhite);
    EXPECT_TRUE(m.t.traits.shared);
}

TEST(Sampler, clampsPointsOutsideAndNotANumber) {
    const FbtTexture t = fetexc::test::random_fbt(3);
    const auto same = [&](double x, double y, double cx, double cy) {
        const FbtRegion a = fbt_locate(t, x, y), b = fbt_locate(t, cx, cy);
        EXPECT_TRUE(a.i == b.i && a.j == b.j && a.record == b.record && a.rest == b.rest);
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

/// The border is repeated: a point on it sees what ends there.
TEST(Sampler, seesWhatEndsAtTheFarBorder) {
    for (const std::uint32_t ray : {kFbtRayPosY, kFbtRayNegY}) {
        Maker m;
        m.single({{1, ray, {{0, 0.25}, {1, 0.75}}, kRed}}, kBlue);
        m.t.traits = fbt_traits(m.t);
        const bool above = ray == kFbtRayPosY;
        EXPECT_EQ(fbt_sample(m.t, 1, 0.7).r, above ? 1 : 0);
        EXPECT_EQ(fbt_sample(m.t, 5, 0.8).r, above ? 0 : 1);
    }
}

} // namespace
} // namespace fetex
