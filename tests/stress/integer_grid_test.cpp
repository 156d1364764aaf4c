// SPDX-License-Identifier: GPL-3.0-or-later
/// Curves with control points on a small grid of integers, where every coincidence happens: shared ends and borders,
/// T-junctions, tangencies, overlaps, cusps, loops, many curves through one point, edges along grid lines and through
/// grid corners. Each drawing also turned, mirrored, reversed and in another order of its shapes.
#include <gtest/gtest.h>

#include <functional>

#include "tests/stress/grid_drawing.h"
#include "tests/stress/seeds.h"
#include "tests/support/region_check.h"

namespace fetexc::test {
namespace {

/// What separates the picture into parts, and whether every point is in the right one.
std::uint64_t parts(const Drawing& d, FillRule rule, GridSize size, std::uint64_t seed, const char* what) {
    FbtRegions regions;
    const Scene scene = scene_of(d.paths, rule);
    const Result<FbtBuild> build = build_fbt(scene, {size, 1}, {}, &regions);
    if (!build) {
        ADD_FAILURE() << "seed " << seed << " " << what << " at " << size.width << "x" << size.height << ": "
                      << build.error().message << " " << build.error().place;
        return 0;
    }
    const RegionCheck check = check_regions(scene, build.value(), regions, 200, seed);
    EXPECT_EQ(check.wrong_far, 0u) << "seed " << seed << " " << what << " at " << size.width << "x" << size.height
                                   << ": " << check.worst;
    return build.value().report.planar.regions_connected;
}

using Map = std::function<LatticePoint(LatticePoint)>;

Drawing mapped(Drawing d, const Map& map) {
    for (Path& path : d.paths) {
        for (auto& segment : path)
            std::transform(segment.begin(), segment.end(), segment.begin(), map);
    }
    return d;
}

Drawing reversed(Drawing d) {
    for (Path& path : d.paths) {
        std::reverse(path.begin(), path.end());
        for (auto& segment : path)
            std::reverse(segment.begin(), segment.end());
    }
    return d;
}

TEST(IntegerGrid, PartsDoNotDependOnTheTexelGrid) {
    for (std::uint64_t seed : stress_seeds(600)) {
        const Drawing d = random_drawing(seed);
        const FillRule rule = seed % 2 == 0 ? FillRule::NonZero : FillRule::EvenOdd;
        const std::uint64_t whole = parts(d, rule, {1, 1}, seed, "as drawn");
        const auto cells = static_cast<std::uint32_t>(d.cells);
        for (const GridSize size : {GridSize{cells, cells}, GridSize{static_cast<std::uint32_t>(1 + seed % 13),
                                                                     static_cast<std::uint32_t>(1 + seed % 7)}})
            EXPECT_EQ(parts(d, rule, size, seed, "as drawn"), whole) << "seed " << seed << " at " << size.width;
    }
}

TEST(IntegerGrid, PartsDoNotDependOnPlacementDirectionOrParametrisation) {
    const std::vector<std::pair<const char*, Map>> maps = {
        {"mirrored",
         [](LatticePoint p) {
             return LatticePoint{512 - p.x, p.y};
         }},
        {"transposed",
         [](LatticePoint p) {
             return LatticePoint{p.y, p.x};
         }},
        {"turned",
         [](LatticePoint p) {
             return LatticePoint{p.y, 512 - p.x};
         }},
        {"sheared",
         [](LatticePoint p) {
             return LatticePoint{(p.x + p.y) / 2, p.y};
         }},
    };
    for (std::uint64_t seed : stress_seeds(200)) {
        // Away from the canvas's border: what that cuts off depends on the placement.
        const Drawing d = mapped(random_drawing(seed), [](LatticePoint p) {
            return LatticePoint{64 + p.x * 3 / 4, 64 + p.y * 3 / 4};
        });
        const FillRule rule = seed % 2 == 0 ? FillRule::NonZero : FillRule::EvenOdd;
        const GridSize size{static_cast<std::uint32_t>(1 + seed % 5), static_cast<std::uint32_t>(1 + seed % 3)};
        const std::uint64_t expected = parts(d, rule, size, seed, "as drawn");
        for (const auto& [name, map] : maps)
            EXPECT_EQ(parts(mapped(d, map), rule, size, seed, name), expected) << "seed " << seed << " " << name;
        EXPECT_EQ(parts(reversed(d), rule, size, seed, "reversed"), expected) << "seed " << seed;
    }
}

} // namespace
} // namespace fetexc::test
