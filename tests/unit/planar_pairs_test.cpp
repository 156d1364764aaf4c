// SPDX-License-Identifier: GPL-3.0-or-later
/// Pairs of boxes batch by batch, and what the arrangement makes of more than one batch.
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "compiler/planar/arrangement.h"
#include "compiler/planar/box_pairs.h"
#include "tests/support/drawn_scene.h"
#include "tests/support/random.h"
#include "tests/support/stress_drawings.h"

namespace fetexc::test {
namespace {

bool overlap(const BoxItem& a, const BoxItem& b) {
    return a.x0 <= b.x1 && b.x0 <= a.x1 && a.y0 <= b.y1 && b.y0 <= a.y1;
}

/// On a coarse grid, so that many boxes only touch.
std::vector<BoxItem> random_boxes(std::uint32_t count, Random& random) {
    std::vector<BoxItem> items;
    for (std::uint32_t k = 0; k < count; ++k) {
        const auto [x0, x1] = std::minmax({random.integer(0, 50), random.integer(0, 50)});
        const auto [y0, y1] = std::minmax({random.integer(0, 50), random.integer(0, 50)});
        const std::uint32_t fan = random.chance(0.3) ? static_cast<std::uint32_t>(random.integer(0, 5)) : kNoFan;
        items.push_back({1.0 * x0, 1.0 * y0, 1.0 * x1, 1.0 * y1, k, fan});
    }
    return items;
}

void expect_each_pair_once(const std::vector<BoxItem>& items, std::size_t min_parts, int min_batches) {
    std::vector<IdPair> expected, all;
    for (std::uint32_t i = 0; i < items.size(); ++i) {
        for (std::uint32_t j = i + 1; j < items.size(); ++j) {
            const bool one_fan = items[i].fan == items[j].fan && items[i].fan != kNoFan;
            if (overlap(items[i], items[j]) && !one_fan) expected.emplace_back(i, j);
        }
    }
    int batches = 0;
    const BoxPairs boxes(items);
    EXPECT_GE(boxes.parts(), min_parts);
    for (std::size_t part = 0; part < boxes.parts(); ++part) {
        boxes.visit(part, [&](std::span<const IdPair> pairs) {
            EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
            all.insert(all.end(), pairs.begin(), pairs.end());
            ++batches;
        });
    }
    std::sort(all.begin(), all.end());
    EXPECT_EQ(all, expected);
    EXPECT_GE(batches, min_batches);
}

TEST(BoxPairs, PairsOfAFanAreLeftOut) {
    Random random(1);
    expect_each_pair_once(random_boxes(1200, random), 7, 8); // six fans, and a batch or more of the rest
}

TEST(BoxPairs, StripsShareThePairs) {
    Random random(2);
    std::vector<BoxItem> items;
    for (std::uint32_t k = 0; k < 4000; ++k) { // many left ends coincide, some boxes are long
        const double x = random.integer(0, 60), y = random.integer(0, 500);
        items.push_back(
            {x, y, x + random.integer(0, random.chance(0.02) ? 60 : 2), y + random.integer(0, 9), k, kNoFan});
    }
    expect_each_pair_once(items, 4, 4);
    for (BoxItem& b : items)
        b.x0 = 0, b.x1 = 60; // nothing to be gained by strips
    expect_each_pair_once(items, 1, 1);
    expect_each_pair_once({}, 0, 0);
}

/// Thin rectangles across each other: every one crosses all of the other direction four times.
Scene lattice(std::int64_t bars) {
    std::vector<Path> paths;
    for (std::int64_t k = 0; k < bars; ++k) {
        const std::int64_t from = 1000 * k + 500, to = from + 300;
        paths.push_back(box(from, 100, to, 1000 * bars));
        paths.push_back(box(100, from, 1000 * bars, to));
    }
    return scene_of(paths, FillRule::EvenOdd, 64);
}

TEST(Arrangement, CrossingsComeInTheOrderOfPairs) {
    const Scene scene = lattice(280);
    PlanarStats stats;
    const Result<Arrangement> built = arrange(scene, make_grid(scene.extent, 8, 8), 2, stats);
    ASSERT_TRUE(built.ok());
    const ArcSet& set = built.value().set;
    ASSERT_EQ(stats.crossings, 4u * 280 * 280); // more than a batch
    std::vector<std::tuple<std::uint32_t, std::uint32_t>> pairs;
    for (const Vertex& v : set.vertices) {
        if (!v.integral) pairs.emplace_back(v.a, v.b);
    }
    EXPECT_EQ(pairs.size(), stats.crossings);
    EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
    std::size_t elsewhere = 0;
    for (const Edge& e : built.value().edges) {
        for (const std::uint32_t k : {e.va, e.vb}) {
            const Vertex& v = set.vertices[k];
            const std::uint32_t curve = set.arcs[e.arc].curve;
            elsewhere += !v.integral && v.a != curve && v.b != curve;
        }
    }
    EXPECT_EQ(elsewhere, 0u) << "ends of edges that lie on other curves";
}

TEST(Arrangement, PairsOfLinesThatEndInAPointAreCounted) {
    const Drawing drawing = rays_from_a_point(400);
    const Scene scene = scene_of(drawing);
    const Grid grid = make_grid(scene.extent, 4, 4);
    PlanarStats stats, ignored;
    ASSERT_TRUE(arrange(scene, grid, 1, stats).ok());
    const ArcSet set = prepare_arcs(scene, grid, {}, ignored);
    std::vector<BoxItem> items;
    for (const Arc& a : set.arcs) {
        const Vertex &p = set.vertices[a.v0], &q = set.vertices[a.v1];
        const Interval x = hull(p.x, q.x), y = hull(p.y, q.y);
        items.push_back({x.lo, y.lo, x.hi, y.hi, 0, kNoFan});
    }
    std::uint64_t pairs = 0;
    for (std::size_t i = 0; i < items.size(); ++i)
        pairs +=
            static_cast<std::uint64_t>(std::count_if(items.begin() + static_cast<std::ptrdiff_t>(i) + 1, items.end(),
                                                     [&](const BoxItem& b) { return overlap(items[i], b); }));
    EXPECT_EQ(stats.box_pairs, pairs);
    EXPECT_EQ(stats.pairs_certified, pairs);
    EXPECT_EQ(stats.crossings, 0u);
}

} // namespace
} // namespace fetexc::test
