// SPDX-License-Identifier: GPL-3.0-or-later
/// Outlines of silhouettes: known areas, straight edges under pixels, and what scan lines say.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "compiler/bilevel/coverage.h"
#include "compiler/bilevel/edge_lines.h"
#include "compiler/bilevel/scan_lines.h"
#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"
#include "tests/support/drawn_scene.h"
#include "tests/support/random.h"

namespace fetexc {
namespace {

using test::box;
using test::closed;
using test::Path;
using test::scene_of;

Silhouette silhouette(const std::vector<Path>& paths) {
    auto made = silhouette_of(scene_of(paths), {}, 1);
    EXPECT_TRUE(made.ok()) << made.error().message;
    return std::move(made).value();
}

double sum(const std::vector<double>& v) {
    double s = 0;
    for (const double x : v)
        s += x;
    return s;
}

TEST(CoveredPart, ofKnownLines) {
    EXPECT_EQ(covered_part({1, 0, 0}), 0.5);
    EXPECT_EQ(covered_part({1, 0, -0.25}), 0.75);
    EXPECT_EQ(covered_part({0, -1, 0.5}), 0);
    EXPECT_EQ(covered_part({0, -1, -0.5}), 1);
    const double r = std::sqrt(0.5);
    EXPECT_NEAR(covered_part({r, r, 0}), 0.5, 1e-15);
    EXPECT_NEAR(covered_part({r, r, r * 0.5}), 0.125, 1e-15); // a triangle with legs of one half
    EXPECT_NEAR(covered_part({-r, r, -r * 0.5}), 0.875, 1e-15);
}

/// Against 1000 × 1000 points.
TEST(CoveredPart, isTheArea) {
    test::Random random(3);
    for (int n = 0; n < 20; ++n) {
        const double angle = random.between(-3.2, 3.2), offset = random.between(-0.8, 0.8);
        const EdgeLine line{std::cos(angle), std::sin(angle), offset};
        int inside = 0;
        for (int y = 0; y < 1000; ++y) {
            for (int x = 0; x < 1000; ++x)
                inside += line.nx * ((x + 0.5) / 1000 - 0.5) + line.ny * ((y + 0.5) / 1000 - 0.5) > offset;
        }
        EXPECT_NEAR(covered_part(line), inside / 1e6, 2e-3) << angle << " " << offset;
    }
}

TEST(EdgeLines, areFoundUnderTheirOwnCoverage) {
    test::Random random(4);
    int found = 0;
    for (int n = 0; n < 2000; ++n) {
        const double angle = random.between(-3.2, 3.2), offset = random.between(-0.45, 0.45);
        const EdgeLine line{std::cos(angle), std::sin(angle), offset};
        std::array<double, 9> c{};
        for (int k = 0; k < 9; ++k)
            c[static_cast<std::size_t>(k)] =
                covered_part({line.nx, line.ny, offset - line.nx * (k % 3 - 1) - line.ny * (k / 3 - 1)});
        const auto fitted = fit_edge_line(c);
        ASSERT_TRUE(fitted.has_value()) << angle << " " << offset;
        EXPECT_NEAR(fitted->offset, offset, 2e-3);
        EXPECT_GT(fitted->nx * line.nx + fitted->ny * line.ny, 1 - 1e-4);
        found += std::fabs(fitted->offset - offset) < 1e-6;
    }
    EXPECT_GT(found, 1900);
}

/// A corner isn't a line.
TEST(EdgeLines, areNotSeenInCorners) {
    EXPECT_FALSE(fit_edge_line({0, 0, 0, 0, 0.25, 0.5, 0, 0.5, 1}).has_value());
    EXPECT_FALSE(fit_edge_line({0, 0, 0, 0, 0, 0, 0, 0, 0}).has_value());
}

TEST(Coverage, isExactForBoxes) {
    const Silhouette s = silhouette({box(48, 80, 208, 400)}); // of 512
    const std::vector<double> c = coverage(s, 8, 8);          // cells of 64
    EXPECT_NEAR(sum(c), 160.0 * 320 / 4096, 1e-9);
    EXPECT_NEAR(c[1 * 8 + 0], 16.0 * 48 / 4096, 1e-9);
    EXPECT_NEAR(c[2 * 8 + 1], 1, 1e-9);
    EXPECT_NEAR(c[6 * 8 + 3], 16.0 * 16 / 4096, 1e-9);
}

/// What is above may lie along the canvas's sides, where there are no edges.
TEST(Coverage, closesWhatTheCanvasCuts) {
    for (const Path& p : {box(-100, 128, 256, 384), box(-100, -100, 256, 256), box(256, -100, 700, 700),
                          box(-100, 256, 700, 700), box(128, -100, 256, 700)}) {
        const Silhouette s = silhouette({p});
        const auto clip = [](std::int64_t v) { return static_cast<double>(std::clamp<std::int64_t>(v, 0, 512)); };
        std::int64_t x0 = 1000, x1 = -1000, y0 = 1000, y1 = -1000;
        for (const auto& segment : p) {
            for (const LatticePoint& q : segment)
                x0 = std::min(x0, q.x), x1 = std::max(x1, q.x), y0 = std::min(y0, q.y), y1 = std::max(y1, q.y);
        }
        const double area = (clip(x1) - clip(x0)) * (clip(y1) - clip(y0)) / 512 / 512;
        EXPECT_NEAR(sum(coverage(s, 5, 7)) / 35, area, 1e-9);
        // Scan lines agree about the sides.
        const auto outline = outline_in_texels(s, 8, 8);
        const ScannedOutline scanned(s, outline, 8, 8, 4);
        for (double y = 0.125; y < 8; y += 0.25) {
            for (double x = 0.125; x < 8; x += 0.25) {
                const double cx = x * 64, cy = y * 64;
                EXPECT_EQ(scanned.above(x, y), cx > static_cast<double>(x0) && cx < static_cast<double>(x1) &&
                                                   cy > static_cast<double>(y0) && cy < static_cast<double>(y1));
            }
        }
    }
}

/// A disc's, of chords.
TEST(Coverage, ofARoundShape) {
    const Path disc{{{256, 56}, {367, 56}, {456, 145}, {456, 256}},
                    {{456, 256}, {456, 367}, {367, 456}, {256, 456}},
                    {{256, 456}, {145, 456}, {56, 367}, {56, 256}},
                    {{56, 256}, {56, 145}, {145, 56}, {256, 56}}};
    const Silhouette s = silhouette({disc});
    double area = 0; // by Green's theorem, in 10,000 steps a curve
    for (const auto& c : disc) {
        double px = static_cast<double>(c[0].x), py = static_cast<double>(c[0].y);
        for (int k = 1; k <= 10000; ++k) {
            const double t = k / 10000.0, w = 1 - t;
            const std::array<double, 4> b{w * w * w, 3 * t * w * w, 3 * t * t * w, t * t * t};
            double x = 0, y = 0;
            for (std::size_t n = 0; n < 4; ++n)
                x += b[n] * static_cast<double>(c[n].x), y += b[n] * static_cast<double>(c[n].y);
            area += 0.5 * (px * y - x * py), px = x, py = y;
        }
    }
    // Chords miss it by at most kOutlineChord of a cell, over a length of 2.5 widths.
    for (const std::uint32_t cells : {7u, 64u})
        EXPECT_NEAR(sum(coverage(s, cells, cells)) / cells / cells, area / 512 / 512,
                    2.5 * budget::kOutlineChord / cells);
}

TEST(Silhouettes, takeTwoColours) {
    auto three = silhouette_of(scene_of({box(0, 0, 100, 100), box(200, 200, 300, 300)}), {}, 1);
    ASSERT_FALSE(three.ok());
    EXPECT_EQ(three.error().code, diag::kNotTwoColors);
    auto none = silhouette_of(scene_of({}), {}, 1);
    ASSERT_FALSE(none.ok());
    EXPECT_EQ(none.error().code, diag::kNotTwoColors);
    auto by_alpha =
        silhouette_of(scene_of({box(0, 0, 100, 100), box(200, 200, 300, 300)}), {SilhouetteRule::Kind::Alpha, ""}, 1);
    ASSERT_TRUE(by_alpha.ok());
    EXPECT_NEAR(sum(coverage(by_alpha.value(), 4, 4)) / 16, 20000.0 / 512 / 512, 1e-9);
    auto unknown = silhouette_of(scene_of({box(0, 0, 9, 9)}), {SilhouetteRule::Kind::Element, "nothing"}, 1);
    ASSERT_FALSE(unknown.ok());
    EXPECT_EQ(unknown.error().code, diag::kNoSuchElement);
}

/// The outline of a picture of exact coverage is the drawing's, away from corners.
TEST(Silhouettes, ofBitmapsFollowTheDrawing) {
    const Silhouette drawn = silhouette({closed({{{100, 90}, {420, 160}}, {{420, 160}, {300, 430}}})});
    constexpr std::uint32_t kSide = 128;
    const std::vector<double> c = coverage(drawn, kSide, kSide);
    RasterImage image{kSide, kSide, {}};
    for (const double part : c) {
        const float v = static_cast<float>(std::lround(part * 255) * 257);
        image.rgba.insert(image.rgba.end(), {0, 0, 0, v});
    }
    const Silhouette seen = silhouette_of(image, {}).value();
    const auto wanted = coverage(drawn, 8, 8), found = coverage(seen, 8, 8);
    for (std::size_t k = 0; k < wanted.size(); ++k)
        EXPECT_NEAR(found[k], wanted[k], 0.003) << k; // of 256 pixels
    EXPECT_NEAR(seen.above.a, 1, 1e-3);
    EXPECT_NEAR(seen.below.a, 0, 1e-3);
}

} // namespace
} // namespace fetexc
