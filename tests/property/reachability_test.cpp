// SPDX-License-Identifier: GPL-3.0-or-later
/// The reachability graph: what visible edges separate is a fact of the picture, whatever grid it is cut by.
#include <gtest/gtest.h>

#include "compiler/fbt/fbt_builder.h"
#include "compiler/scene/ground_truth.h"
#include "tests/support/drawn_scene.h"
#include "tests/support/random.h"
#include "tests/support/random_scene.h"

namespace fetexc::test {
namespace {

struct Built {
    FbtBuild build;
    FbtRegions regions;
};

Built built(const Scene& scene, GridSize size) {
    Built b;
    Result<FbtBuild> build = build_fbt(scene, {size, 1}, {}, &b.regions);
    EXPECT_TRUE(build.ok()) << (build.ok() ? "" : build.error().message + " " + build.error().place);
    if (build.ok()) b.build = std::move(build).value();
    return b;
}

void expect_parts(const Scene& scene, std::uint64_t parts, const char* name) {
    for (const GridSize size : {GridSize{1, 1}, GridSize{2, 3}, GridSize{8, 8}, GridSize{16, 4}, GridSize{37, 23}})
        EXPECT_EQ(built(scene, size).build.report.planar.regions_connected, parts)
            << name << " at " << size.width << "x" << size.height;
}

TEST(Reachability, PartsOfDrawnPictures) {
    expect_parts(scene_of({}), 1, "nothing");
    expect_parts(scene_of({box(100, 100, 200, 200), box(300, 100, 400, 200)}), 3, "two squares");
    expect_parts(scene_of({box(64, 64, 448, 448), box(128, 128, 384, 384), box(192, 192, 320, 320)}), 4,
                 "rings on grid lines");
    expect_parts(scene_of({box(0, 200, 512, 300)}), 3, "a bar from side to side");
    // Corner to corner: what is outside stays in two parts, the squares touch in a point only.
    expect_parts(scene_of({box(0, 0, 256, 256), box(256, 256, 512, 512)}), 4, "two squares corner to corner");
    // A slit that ends inside: around its end everything is connected.
    expect_parts(scene_of({closed({{{0, 250}, {300, 256}}, {{300, 256}, {0, 262}}})}), 2, "a wedge");
    expect_parts(scene_of({closed({{{64, 256}, {64, 0}, {448, 0}, {448, 256}}}),
                           closed({{{64, 256}, {64, 512}, {448, 512}, {448, 256}}})}),
                 3, "two half discs, edge to edge");
}

TEST(Reachability, CheckersOnGridLines) {
    std::vector<Path> checkers;
    for (std::int64_t y = 0; y < 8; ++y) {
        for (std::int64_t x = 0; x < 8; ++x) {
            if ((x + y) % 2 == 0) checkers.push_back(box(64 * x, 64 * y, 64 * x + 64, 64 * y + 64));
        }
    }
    expect_parts(scene_of(checkers), 64, "checkers");
}

/// One texel is the whole picture: its regions are found by one sweep, without any side between texels.
TEST(Reachability, PartsDoNotDependOnTheGrid) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const Scene scene = random_scene(seed, seed % 2 == 0 ? opaque_solids(4 + static_cast<int>(seed % 9))
                                                             : everything(3 + static_cast<int>(seed % 7)));
        const std::uint64_t parts = built(scene, {1, 1}).build.report.planar.regions_connected;
        for (const GridSize size : {GridSize{2, 2}, GridSize{5, 3}, GridSize{16, 16}, GridSize{33, 20}})
            EXPECT_EQ(built(scene, size).build.report.planar.regions_connected, parts)
                << "seed " << seed << " at " << size.width << "x" << size.height;
    }
}

/// No edge is nearer to p than q is: q can be reached from p. Links join regions with one visible result only.
TEST(Reachability, WhatNoEdgeSeparatesIsConnected) {
    for (std::uint64_t seed = 100; seed < 130; ++seed) {
        const Scene scene = random_scene(seed, opaque_solids(4 + static_cast<int>(seed % 9)));
        const Built b = built(scene, {static_cast<std::uint32_t>(3 + seed % 31), 0});
        const fetex::FbtTexture& t = b.build.texture;
        const GroundTruth truth(scene);
        const std::vector<std::uint32_t> part = b.regions.reachability->components();
        for (const ReachLink& l : b.regions.reachability->links())
            ASSERT_EQ(b.regions.reachability->result(l.a), b.regions.reachability->result(l.b)) << "seed " << seed;
        const double sx = static_cast<double>(scene.extent.lattice_w) / t.width,
                     sy = static_cast<double>(scene.extent.lattice_h) / t.height;
        Random random(seed);
        for (int k = 0; k < 400; ++k) {
            const double x = random.between(0, t.width), y = random.between(0, t.height);
            // In texels of the smaller side, less what quantisation may move an edge by.
            const double room = truth.distance_to_curves(x * sx, y * sy) / std::max(sx, sy) - 0x1p-13;
            if (room <= 0) continue;
            const double u = x + random.between(-0.7, 0.7) * room, v = y + random.between(-0.7, 0.7) * room;
            if (u < 0 || v < 0 || u >= t.width || v >= t.height) continue;
            EXPECT_EQ(part[b.regions.vertex_of(fetex::fbt_locate(t, x, y))],
                      part[b.regions.vertex_of(fetex::fbt_locate(t, u, v))])
                << "seed " << seed << ": " << x << " " << y << " and " << u << " " << v;
        }
    }
}

TEST(Fbt, PartsThinnerThanTheOutputGridAreReported) {
    // At 1 × 1 texels a step of the output grid is 2^-15 of the canvas; one path unit is 2^-9.
    Scene thin = scene_of({box(100, 100, 400, 200), box(100, 300, 400, 301)});
    for (std::uint32_t k = thin.shapes[1].first; k < thin.shapes[1].first + 4; ++k) {
        for (LatticePoint& p : thin.segments[k].p) {
            if (p.y == 301 * (kLatticeSteps / 512)) p.y = 300 * (kLatticeSteps / 512) + 100; // 100 of 2048 steps
        }
    }
    const Built coarse = built(thin, {1, 1}), fine = built(thin, {64, 64});
    EXPECT_EQ(coarse.build.report.fbt.parts_lost, 1u);
    ASSERT_EQ(coarse.build.report.diagnostics.size(), 1u);
    EXPECT_EQ(coarse.build.report.diagnostics[0].code, 4101);
    EXPECT_EQ(fine.build.report.fbt.parts_lost, 0u);
    EXPECT_TRUE(fine.build.report.diagnostics.empty());
}

} // namespace
} // namespace fetexc::test
