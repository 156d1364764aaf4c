// SPDX-License-Identifier: GPL-3.0-or-later
/// The bitmap of runs against the plain one, whose areas come from the planar map, on random drawings and our own art.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "compiler/measure/alternatives.h"
#include "compiler/measure/sparse_bitmap.h"
#include "compiler/svg/svg.h"
#include "tests/support/drawn_scene.h"
#include "tests/support/random.h"

namespace fetexc::measure {
namespace {

namespace fs = std::filesystem;

Scene load(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    const std::vector<char> text((std::istreambuf_iterator<char>(in)), {});
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    std::vector<Diagnostic> diagnostics;
    auto scene = load_svg(bytes, {}, diagnostics);
    EXPECT_TRUE(scene.ok()) << file;
    return scene ? std::move(scene).value() : Scene{};
}

double difference(std::uint32_t rgba, const Rgba& exact) {
    const double channels[] = {exact.r, exact.g, exact.b, exact.a};
    double worst = 0;
    for (int k = 0; k < 4; ++k)
        worst = std::max(worst, std::abs((rgba >> 8 * k & 255u) - channels[k] * 255));
    return worst;
}

/// In bytes; half a byte is rounding.
double worst_difference(const Truth& truth, GridSize size) {
    const SparseBitmap sparse(truth, size, 0);
    const auto exact = truth.picture(size, 0);
    EXPECT_TRUE(exact.ok());
    double worst = 0;
    for (std::uint32_t j = 0; j < size.height; ++j)
        for (std::uint32_t i = 0; i < size.width; ++i)
            worst = std::max(worst, difference(sparse.texel(i, j), exact.value()[std::size_t{j} * size.width + i]));
    return worst;
}

TEST(SparseBitmap, equalsTheExactPictureOfOurArt) {
    int compared = 0;
    for (const char* folder : {"", "alternatives"})
        for (const auto& entry : fs::directory_iterator(fs::path(FETEXC_ART_DIR) / folder)) {
            if (entry.path().extension() != ".svg") continue;
            const Scene scene = load(entry.path());
            const auto truth = Truth::of(scene, 0);
            ASSERT_TRUE(truth.ok());
            const auto all_are = [&](const auto& test) {
                return std::all_of(scene.paints.begin(), scene.paints.end(), test);
            };
            if (!all_are([](const Paint& p) { return !std::holds_alternative<RasterPaint>(p); })) continue;
            // A paint that varies is taken at the texel's centre.
            const bool solid = all_are([](const Paint& p) { return std::holds_alternative<SolidPaint>(p); });
            EXPECT_LT(worst_difference(*truth.value(), {131, 97}), solid ? 0.5 + 1e-5 : 12) << entry.path();
            ++compared;
        }
    EXPECT_GE(compared, 20);
}

/// Edges on lines of the grid, through its corners, and out through every border.
TEST(SparseBitmap, equalsTheExactPictureOfRandomDrawings) {
    test::Random random(11);
    for (int n = 0; n < 60; ++n) {
        const auto place = [&] {
            const int step = 1 << random.integer(0, 6);
            return LatticePoint{random.integer(-200, 700) / step * step, random.integer(-200, 700) / step * step};
        };
        std::vector<test::Path> paths;
        for (int k = random.integer(1, 6); k > 0; --k) {
            test::Path path;
            LatticePoint at = place();
            for (int s = random.integer(2, 5); s > 0; --s) {
                std::vector<LatticePoint> segment{at};
                for (int d = random.integer(1, 3); d > 0; --d)
                    segment.push_back(place());
                at = segment.back();
                path.push_back(segment);
            }
            paths.push_back(test::closed(path));
        }
        const Scene scene = test::scene_of(paths);
        const auto truth = Truth::of(scene, 1);
        ASSERT_TRUE(truth.ok());
        for (const GridSize size : {GridSize{16, 16}, {1, 1}, {37, 5}, {100, 64}})
            EXPECT_LT(worst_difference(*truth.value(), size), 0.5 + 1e-5) << n << ' ' << size.width;
    }
}

TEST(SparseBitmap, samplesAsTheDenseOneDoes) {
    const Scene scene = load(fs::path(FETEXC_ART_DIR) / "alternatives" / "glyph_g.svg");
    const auto truth = Truth::of(scene, 1);
    ASSERT_TRUE(truth.ok());
    const GridSize size{77, 53};
    const SparseBitmap sparse(*truth.value(), size, 1);
    const auto dense = make_alternative(*truth.value(), Alternative::Bitmap, size, 1);
    ASSERT_TRUE(dense.ok());
    EXPECT_EQ(sparse.gpu_bytes(), dense.value()->gpu_bytes());
    test::Random random(3);
    for (int n = 0; n < 20000; ++n) {
        const TexturePoint p{random.between(-0.1, 1.1), random.between(-0.1, 1.1)};
        const Rgba a = sparse.at(p), b = dense.value()->at(p);
        for (const auto channel : {&Rgba::r, &Rgba::g, &Rgba::b, &Rgba::a})
            ASSERT_NEAR(a.*channel, b.*channel, 1e-12) << p.u << ' ' << p.v;
    }
}

TEST(SparseBitmap, goesTo16384) {
    const Scene scene = load(fs::path(FETEXC_ART_DIR) / "alternatives" / "star.svg");
    const auto truth = Truth::of(scene, 1);
    ASSERT_TRUE(truth.ok());
    const SparseBitmap sparse(*truth.value(), {16384, 16384}, 0);
    EXPECT_EQ(sparse.gpu_bytes(), std::uint64_t{1} << 30);
    test::Random random(9);
    for (int n = 0; n < 5000; ++n) {
        const TexturePoint p{random.unit(), random.unit()};
        if (truth.value()->nearest_edge(p, 1.5 / 16384).edge != kNone) continue;
        EXPECT_EQ(sparse.at(p), truth.value()->color(truth.value()->result_at(p), p));
    }
}

TEST(SparseBitmap, isTheSameOnAnyNumberOfThreads) {
    const Scene scene = load(fs::path(FETEXC_ART_DIR) / "gear.svg");
    const auto truth = Truth::of(scene, 1);
    ASSERT_TRUE(truth.ok());
    const GridSize size{301, 299};
    const SparseBitmap one(*truth.value(), size, 1), all(*truth.value(), size, 0);
    for (std::uint32_t j = 0; j < size.height; ++j)
        for (std::uint32_t i = 0; i < size.width; ++i)
            ASSERT_EQ(one.texel(i, j), all.texel(i, j));
}

} // namespace
} // namespace fetexc::measure
