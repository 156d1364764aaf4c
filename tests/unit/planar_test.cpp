// SPDX-License-Identifier: GPL-3.0-or-later
/// The planar map: counts that geometry fixes, invariance under symmetries, and hard inputs against the ground truth.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "compiler/planar/arrangement.h"
#include "tests/support/drawn_scene.h"
#include "tests/support/random_scene.h"
#include "tests/support/region_check.h"

namespace fetexc::test {
namespace {

PlanarStats arranged(const Scene& scene, std::uint32_t size = 8) {
    PlanarStats stats;
    const Result<Arrangement> a = arrange(scene, make_grid(scene.extent, size, size), 1, stats);
    EXPECT_TRUE(a.ok());
    return stats;
}

void expect_right(const Scene& scene, const std::string& name) {
    for (const std::uint32_t size : {1u, 3u, 8u, 37u}) {
        FbtRegions regions;
        const Result<FbtBuild> build = build_fbt(scene, {{size, size}, 1}, {}, &regions);
        ASSERT_TRUE(build.ok()) << name << " at " << size << ": " << build.error().message << " "
                                << build.error().place;
        const RegionCheck check = check_regions(scene, build.value(), regions, 3000, size);
        EXPECT_EQ(check.wrong_far, 0u) << name << " at " << size << ": " << check.worst;
    }
}

TEST(Arrangement, TwoRectanglesCrossFourTimes) {
    const PlanarStats s = arranged(scene_of({box(100, 200, 400, 300), box(200, 100, 300, 400)}));
    EXPECT_EQ(s.crossings, 4u);
    EXPECT_EQ(s.edges, 8u + 2 * 4);
    EXPECT_EQ(s.pairs_exact, 0u);
}

TEST(Arrangement, SharedBordersBecomeOneEdge) {
    // Neighbours whose common border is cut differently: 200…300 is drawn twice, once in two parts.
    const Path left = box(100, 200, 200, 300);
    const Path right = {{{200, 200}, {300, 200}},
                        {{300, 200}, {300, 300}},
                        {{300, 300}, {200, 300}},
                        {{200, 300}, {200, 250}},
                        {{200, 250}, {200, 200}}};
    const PlanarStats s = arranged(scene_of({left, right}));
    EXPECT_EQ(s.edges, 3u + 3 + 2);
    EXPECT_EQ(s.crossings, 0u);
}

TEST(Arrangement, WhatRunsBackAndForthVanishes) {
    const Path spike = {{{100, 100}, {400, 100}}, {{400, 100}, {100, 100}}};
    EXPECT_EQ(arranged(scene_of({spike})).edges, 0u);
}

TEST(Arrangement, PartsOfALoopOverlapIt) {
    // Both ends of the loop are one vertex, at two parameters of the support that it shares with its half.
    const std::vector<LatticePoint> loop{{256, 64}, {480, 448}, {32, 448}, {256, 64}};
    expect_right(scene_of({{loop}, closed({half_of(loop, true)})}), "a loop and its first half");
    expect_right(scene_of({{loop}, closed({half_of(loop, false)})}), "a loop and its second half");
    expect_right(scene_of({{loop}, closed({half_of(half_of(loop, true), false)})}), "a loop and its second quarter");
}

TEST(Arrangement, PartsOfOneCurveCrossInItsDoublePoint) {
    // The double point lies on a grid line at 8 texels, and the curves that cross there run on one support.
    const std::vector<LatticePoint> ribbon{{64, 64}, {576, 448}, {-64, 448}, {448, 64}};
    expect_right(scene_of({closed({ribbon}), closed({half_of(ribbon, true)})}), "a ribbon and its half");
}

TEST(Arrangement, PartialOverlapOfCurvesIsOneStretch) {
    // The second curve is the first one's half, cut at t = 1/2, with exact integer control points.
    const Path whole = closed({{{64, 64}, {128, 320}, {256, 320}, {320, 64}}});
    const Path half = closed({{{64, 64}, {96, 192}, {144, 256}, {192, 256}}});
    const PlanarStats s = arranged(scene_of({whole, half}));
    EXPECT_EQ(s.overlaps, 1u);
    expect_right(scene_of({whole, half}), "partial overlap");
}

TEST(Arrangement, CountsDoNotDependOnPlacement) {
    using Map = std::function<LatticePoint(LatticePoint)>;
    const std::vector<std::pair<const char*, Map>> maps = {
        {"mirrored",
         [](LatticePoint p) {
             return LatticePoint{kLatticeSteps - p.x, p.y};
         }},
        {"transposed",
         [](LatticePoint p) {
             return LatticePoint{p.y, p.x};
         }},
        {"turned",
         [](LatticePoint p) {
             return LatticePoint{p.y, kLatticeSteps - p.x};
         }},
    };
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        const Scene scene = random_scene(seed, opaque_solids(8));
        if (scene.extent.lattice_w != scene.extent.lattice_h) continue;
        const PlanarStats expected = arranged(scene);
        for (const auto& [name, map] : maps) {
            Scene moved = scene;
            for (Segment& s : moved.segments) {
                for (int i = 0; i <= s.degree; ++i)
                    s.p[i] = map(s.p[i]);
            }
            // Outside the canvas pieces may be left out, differently for each placement: compare what has to be seen.
            const PlanarStats got = arranged(moved);
            if (got.pieces == expected.pieces) {
                EXPECT_EQ(got.crossings, expected.crossings) << name << " seed " << seed;
            }
            expect_right(moved, std::string(name) + " seed " + std::to_string(seed));
        }
    }
}

TEST(PlanarMap, HardCasesAgreeWithTheGroundTruth) {
    const std::vector<std::pair<const char*, std::vector<Path>>> cases = {
        {"two lines, T on a grid line",
         {closed({{{448, 320}, {0, 384}}, {{0, 384}, {128, 192}}, {{128, 192}, {0, 448}}})}},
        {"line and quadratic",
         {closed({{{0, 256}, {384, 448}}, {{384, 448}, {384, 128}}, {{384, 128}, {256, 128}, {0, 320}}})}},
        {"cubic and quadratic",
         {closed({{{384, 128}, {448, 320}, {384, 448}, {448, 256}},
                  {{448, 256}, {320, 0}},
                  {{320, 0}, {256, 256}, {64, 320}}})}},
        {"zero handle", {closed({{{128, 256}, {128, 256}, {448, 192}, {64, 64}}})}},
        {"cusp", {closed({{{64, 64}, {448, 448}, {64, 448}, {448, 64}}})}},
        {"loop", {closed({{{64, 64}, {640, 448}, {-128, 448}, {448, 64}}})}},
        {"quadratic there and back",
         {closed({{{0, 64}, {192, 0}, {0, 0}}, {{0, 0}, {192, 0}, {0, 64}}, {{0, 64}, {300, 300}}})}},
        {"tangent circles and their common tangent",
         {closed({{{256, 100}, {338, 100}, {338, 182}, {256, 182}}, {{256, 182}, {174, 182}, {174, 100}, {256, 100}}}),
          closed({{{256, 182}, {338, 182}, {338, 264}, {256, 264}}, {{256, 264}, {174, 264}, {174, 182}, {256, 182}}}),
          box(0, 182, 512, 400)}},
        {"along grid lines and corners",
         {box(0, 0, 512, 512), box(64, 64, 128, 128), box(128, 128, 192, 192), box(128, 64, 192, 128)}},
        {"diagonals through grid corners",
         {closed({{{0, 0}, {512, 512}}, {{512, 512}, {0, 512}}}), closed({{{512, 0}, {0, 512}}, {{0, 512}, {0, 0}}})}},
        {"beyond the canvas on all sides", {box(-400, -400, 900, 256), box(-400, 128, 256, 900)}},
    };
    for (const auto& [name, paths] : cases) {
        expect_right(scene_of(paths, FillRule::EvenOdd), name);
        expect_right(scene_of(paths, FillRule::NonZero), name);
    }
}

TEST(PlanarMap, ManyLinesThroughOnePoint) {
    std::vector<Path> rays;
    for (int k = 0; k < 60; ++k) {
        const double a = k * 0.1047, b = a + 0.05;
        const auto at = [](double angle) {
            return LatticePoint{256 + std::llround(200 * std::cos(angle)), 256 + std::llround(200 * std::sin(angle))};
        };
        rays.push_back(closed({{{256, 256}, at(a)}, {at(a), at(b)}}));
        rays.push_back(closed({{at(a + 3.1), at(a)}, {at(a), at(b)}}));
    }
    expect_right(scene_of(rays), "star");
}

TEST(Fbt, BytesDoNotDependOnThreads) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const Scene scene = random_scene(seed, everything(10));
        const Result<FbtBuild> one = build_fbt(scene, {{50, 0}, 1}, {}, nullptr),
                               two = build_fbt(scene, {{50, 0}, 2}, {}, nullptr);
        ASSERT_TRUE(one.ok() && two.ok());
        EXPECT_EQ(one.value().texture.texels, two.value().texture.texels) << seed;
        EXPECT_EQ(one.value().texture.records, two.value().texture.records) << seed;
    }
}

TEST(Fbt, SizeIsChecked) {
    const Scene scene = scene_of({box(100, 100, 200, 200)});
    for (const GridSize size : {GridSize{0, 0}, GridSize{16385, 1}, GridSize{1, 16385}}) {
        const Result<FbtBuild> build = build_fbt(scene, {size, 1}, {}, nullptr);
        ASSERT_FALSE(build.ok());
        EXPECT_EQ(build.error().code, 5001);
    }
}

TEST(Fbt, EmptySceneIsTransparent) {
    const Result<FbtBuild> build = build_fbt(scene_of({}), {{4, 4}, 1}, {}, nullptr);
    ASSERT_TRUE(build.ok());
    EXPECT_EQ(build.value().texture.records.size(), 0u);
    EXPECT_EQ(fetex::fbt_sample(build.value().texture, 2.5, 2.5).a, 0);
}

} // namespace
} // namespace fetexc::test
