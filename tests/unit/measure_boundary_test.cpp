// SPDX-License-Identifier: GPL-3.0-or-later
/// Misclassified area and boundary distances of shapes that are off by a known amount.
#include <gtest/gtest.h>

#include <cmath>

#include "compiler/measure/pictures.h"
#include "tests/support/known_shapes.h"
#include "tests/support/measured.h"
#include "tests/support/random.h"

namespace fetexc::measure {
namespace {

using test::black_where;
using test::errors_at;
using test::Random;

constexpr GridSize kTexels{64, 64};
constexpr double kTexel = 1.0 / 64;
constexpr double kSnapped = 2e-8; ///< a lattice step and a bit, in width units

bool holds(const std::vector<CanvasPoint>& polygon, TexturePoint p) {
    bool inside = true;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const CanvasPoint a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        inside = inside && (b.x - a.x) * (p.v - a.y) - (b.y - a.y) * (p.u - a.x) >= 0;
    }
    return inside;
}

void expect_sampled(const SizeErrors& e, double ppm) {
    EXPECT_NEAR(e.misclassified_ppm, ppm, 4 * e.misclassified_error_ppm);
}

void expect_all(const Distances& d, double distance, double tolerance) {
    EXPECT_NEAR(d.mean, distance, tolerance);
    EXPECT_NEAR(d.p95, distance, tolerance);
    EXPECT_NEAR(d.hausdorff, distance, tolerance);
    EXPECT_EQ(d.beyond_reach, 0u);
    EXPECT_GT(d.points, 0u);
}

struct MovedEdge {
    std::vector<CanvasPoint> truth, picture;
};

/// The polygon runs clockwise on the screen, so `holds` can take its sides one by one.
MovedEdge moved_edge(double angle, double by) {
    const double offset = 0.5 * (std::cos(angle) + std::sin(angle)) + 0.07;
    return {test::polygon_of({angle, offset}), test::polygon_of({angle, offset + by})};
}

TEST(Boundary, anEdgeMovedByAHundredthOfATexelIsFoundAtAnyAngle) {
    Random random(1);
    for (int k = 0; k < 10; ++k) {
        const double angle = k < 2 ? k * test::kPi / 2 : random.between(0, 2 * test::kPi), by = 0.01 * kTexel;
        const MovedEdge edge = moved_edge(angle, k % 2 == 0 ? by : -by);
        const Scene scene = test::black_on_white({test::closed_polygon(edge.truth)});
        const SizeErrors e =
            errors_at(scene, black_where(kTexels, [&](TexturePoint p) { return holds(edge.picture, p); }), 512);
        expect_all(e.to_truth, by, kSnapped);
        expect_all(e.to_picture, by, kSnapped);
        const double area = test::clipped_area(edge.picture, {}) - test::clipped_area(edge.truth, {});
        expect_sampled(e, 1e6 * std::fabs(area));
        EXPECT_GT(e.misclassified_ppm, 0);
        EXPECT_EQ(e.islands.lost + e.islands.invented, 0u);
        EXPECT_EQ(e.away.max, 0);
    }
}

TEST(Boundary, anEdgeMovedByATexelIsFoundWithinReach) {
    const double by = kTexel;
    const MovedEdge edge = moved_edge(0.6, by);
    const Scene scene = test::black_on_white({test::closed_polygon(edge.truth)});
    const SizeErrors e =
        errors_at(scene, black_where(kTexels, [&](TexturePoint p) { return holds(edge.picture, p); }), 512);
    // at the canvas's border the nearest point of one edge is an end of the other
    EXPECT_NEAR(e.to_truth.mean, by, 0.01 * by);
    EXPECT_NEAR(e.to_truth.p95, by, kSnapped);
    EXPECT_NEAR(e.to_picture.mean, by, 0.01 * by);
    EXPECT_NEAR(e.to_picture.p95, by, kSnapped);
    EXPECT_LT(e.to_picture.hausdorff, 1.3 * by);
    expect_sampled(e, 1e6 * (test::clipped_area(edge.picture, {}) - test::clipped_area(edge.truth, {})));
}

TEST(Boundary, aDiscWithARadiusOffByAKnownAmount) {
    const CanvasPoint center{0.47, 0.53};
    for (const double by : {0.01 * kTexel, -0.2 * kTexel, 0.7 * kTexel}) {
        const double radius = 0.31;
        const Scene scene = test::black_on_white({test::round_disc(center, radius)});
        const SizeErrors e = errors_at(
            scene,
            black_where(kTexels,
                        [&](TexturePoint p) { return std::hypot(p.u - center.x, p.v - center.y) < radius + by; }),
            512);
        expect_all(e.to_truth, std::fabs(by), kSnapped);
        expect_all(e.to_picture, std::fabs(by), kSnapped);
        expect_sampled(e, 1e6 * test::kPi * std::fabs((radius + by) * (radius + by) - radius * radius));
    }
}

TEST(Boundary, aThinRingMovedSideways) {
    const CanvasPoint center{0.5, 0.5};
    const double outer = 0.4, inner = 0.4 - 0.25 * kTexel, by = 0.05 * kTexel;
    const Scene scene = test::black_on_white({test::round_disc(center, outer), test::round_disc(center, inner)});
    const SizeErrors e = errors_at(scene,
                                   black_where(kTexels,
                                               [&](TexturePoint p) {
                                                   const double r = std::hypot(p.u - center.x - by, p.v - center.y);
                                                   return r < outer && r > inner;
                                               }),
                                   512);
    // distances are |by·cos| around the circle
    EXPECT_NEAR(e.to_picture.mean, by * 2 / test::kPi, 0.01 * by);
    EXPECT_NEAR(e.to_picture.hausdorff, by, 1e-3 * by);
    EXPECT_NEAR(e.to_picture.p95, by * std::sin(0.95 * test::kPi / 2), 0.01 * by);
    EXPECT_NEAR(e.to_truth.hausdorff, by, 1e-3 * by);
    EXPECT_EQ(e.to_picture.beyond_reach, 0u);
    // lens-shaped differences on both circles: 2·(2r)·by each, up to by² / r
    expect_sampled(e, 1e6 * 4 * by * (outer + inner));
}

TEST(Boundary, aCheckerboardMovedAlongXIsOffAtItsUprightEdgesOnly) {
    std::vector<CanvasContour> black;
    for (int j = 0; j < 8; ++j) {
        for (int i = j % 2; i < 8; i += 2)
            black.push_back(test::closed_polygon({{i / 8.0, j / 8.0},
                                                  {(i + 1) / 8.0, j / 8.0},
                                                  {(i + 1) / 8.0, (j + 1) / 8.0},
                                                  {i / 8.0, (j + 1) / 8.0}}));
    }
    const double by = 0.1 * kTexel;
    const auto is_black = [&](TexturePoint p) {
        return (static_cast<int>(std::floor(std::max(p.u - by, 0.0) * 8)) + static_cast<int>(std::floor(p.v * 8))) %
                   2 ==
               0;
    };
    const SizeErrors e = errors_at(test::black_on_white(black), black_where(kTexels, is_black), 512);
    EXPECT_NEAR(e.to_picture.mean, by / 2, 0.02 * by);
    EXPECT_NEAR(e.to_picture.p95, by, 1e-6 * by);
    EXPECT_NEAR(e.to_picture.hausdorff, by, 1e-6 * by);
    expect_sampled(e, 1e6 * 7 * by);
}

TEST(Boundary, aNotchShowsInTheLargestDistanceAndItsShareInTheMean) {
    const Scene scene = test::black_on_white({test::closed_polygon({{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}})});
    const double depth = 0.5 * kTexel;
    const auto notched = [&](double length) {
        return black_where(kTexels,
                           [=](TexturePoint p) { return p.u < 0.5 - (p.v > 0.3 && p.v < 0.3 + length ? depth : 0); });
    };
    const SizeErrors large = errors_at(scene, notched(0.1), 1024), small = errors_at(scene, notched(0.03), 1024);
    EXPECT_NEAR(large.to_picture.hausdorff, depth, 1e-8);
    EXPECT_NEAR(large.to_truth.hausdorff, depth, 1e-8);
    EXPECT_NEAR(large.to_picture.mean, 0.1 * depth, 0.02 * depth);
    EXPECT_NEAR(large.to_picture.p95, depth, 1e-8);
    EXPECT_NEAR(large.to_truth.farthest.x, 0.5 - depth, 1e-8);
    EXPECT_TRUE(large.to_truth.farthest.y > 0.3 && large.to_truth.farthest.y < 0.4);
    EXPECT_NEAR(small.to_picture.hausdorff, depth, 1e-8);
    EXPECT_LT(small.to_picture.p95, 1e-8);
    expect_sampled(large, 1e6 * 0.1 * depth);
}

TEST(Boundary, anEdgeThatIsNotThereIsBeyondReach) {
    const Scene scene = test::black_on_white({test::closed_polygon({{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}})});
    const SizeErrors e = errors_at(scene, black_where(kTexels, [](TexturePoint) { return false; }), 256);
    EXPECT_EQ(e.to_picture.beyond_reach, e.to_picture.points);
    EXPECT_GE(e.to_picture.points, 256u);
    EXPECT_NEAR(e.to_picture.mean, 1.5 * kTexel, 1e-12);
    EXPECT_NEAR(e.away.max, 1, 0);
}

/// Off to a side where no normal meets it, some thirty pixels away: what is drawn between sample points tells.
TEST(Boundary, aShapeThatMovedCornerwiseIsFoundFarAway) {
    const auto square = [](double at) {
        return test::closed_polygon({{at, at}, {at + 0.02, at}, {at + 0.02, at + 0.02}, {at, at + 0.02}});
    };
    const Scene scene = test::black_on_white({square(0.5)});
    const auto is_moved = [](TexturePoint p) { return p.u > 0.6 && p.u < 0.62 && p.v > 0.6 && p.v < 0.62; };
    const SizeErrors e = errors_at(scene, black_where({8, 8}, is_moved), 256);
    double mean = 0;
    constexpr int kSteps = 1000;
    for (int k = 0; k < kSteps; ++k) {
        const double t = 0.02 * (k + 0.5) / kSteps;
        for (const CanvasPoint p : {CanvasPoint{0.5, 0.5 + t}, {0.52, 0.5 + t}, {0.5 + t, 0.5}, {0.5 + t, 0.52}})
            mean += std::hypot(0.6 - p.x, 0.6 - p.y) / (4 * kSteps);
    }
    constexpr double kPixel = 1.0 / 256;
    EXPECT_EQ(e.to_picture.beyond_reach, 0u);
    EXPECT_NEAR(e.to_picture.mean, mean, kPixel / 2);
    EXPECT_NEAR(e.to_picture.hausdorff, 0.1 * std::sqrt(2), kPixel);
    EXPECT_EQ(e.islands.lost, 1u);
    EXPECT_EQ(e.islands.invented, 1u);
}

TEST(Boundary, edgesWithoutContrastAreLeftOut) {
    const CanvasContour left = test::closed_polygon({{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}});
    const auto scene = [&](double grey) {
        return test::layered({{{test::canvas_box()}, {0.4, 0.4, 0.4, 1}}, {{left}, {grey, grey, grey, 1}}});
    };
    const test::FunctionPicture flat(kTexels, [](TexturePoint) { return Rgba{0.4, 0.4, 0.4, 1}; });
    const SizeErrors faint = errors_at(scene(0.4 + 2.0 / 255), flat, 128), clear = errors_at(scene(0.5), flat, 128);
    EXPECT_GT(faint.edges_without_contrast, 0u);
    EXPECT_EQ(faint.to_picture.points, 0u);
    EXPECT_EQ(faint.misclassified_ppm, 0);
    EXPECT_EQ(clear.edges_without_contrast, 0u);
    EXPECT_EQ(clear.to_picture.beyond_reach, clear.to_picture.points);
    EXPECT_GT(clear.misclassified_ppm, 0);
}

TEST(Boundary, aNearestTexelOnTheWrongSideIsItsAreaAndItsSide) {
    // an edge along texel borders, drawn by a nearest bitmap with one texel wrong
    const Scene scene = test::black_on_white({test::closed_polygon({{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}})});
    std::vector<std::uint8_t> rgba;
    for (std::uint32_t j = 0; j < 16; ++j) {
        for (std::uint32_t i = 0; i < 16; ++i) {
            const std::uint8_t v = i < 8 && !(i == 7 && j == 5) ? 0 : 255;
            rgba.insert(rgba.end(), {v, v, v, 255});
        }
    }
    const SizeErrors e = errors_at(scene, BitmapPicture({16, 16}, rgba, BitmapPicture::Filter::Nearest), 512);
    EXPECT_NEAR(e.misclassified_ppm, 1e6 / 256, 1e-9); // texels are made of whole pixels
    EXPECT_NEAR(e.misclassified_place.u, 7.5 / 16, 0.5 / 16);
    EXPECT_NEAR(e.misclassified_place.v, 5.5 / 16, 0.5 / 16);
    EXPECT_NEAR(e.to_truth.hausdorff, 1.0 / 16, 1e-8);
    // from the notch's ends to its middle up to half a texel, a quarter of one on average; a sixteenth of the edge
    EXPECT_NEAR(e.to_picture.mean, 0.25 / 16 / 16, 1e-5);
}

TEST(Errors, theNumberOfThreadsChangesNothing) {
    const Scene scene = test::black_on_white({test::round_disc({0.4, 0.6}, 0.33), test::round_disc({0.6, 0.4}, 0.2)});
    const auto picture = black_where(kTexels, [](TexturePoint p) { return std::hypot(p.u - 0.4, p.v - 0.6) < 0.32; });
    const SizeErrors a = errors_at(scene, picture, 200, 1), b = errors_at(scene, picture, 200, 3);
    EXPECT_EQ(a.misclassified_ppm, b.misclassified_ppm);
    EXPECT_EQ(a.to_truth.mean, b.to_truth.mean);
    EXPECT_EQ(a.to_truth.p95, b.to_truth.p95);
    EXPECT_EQ(a.to_picture.mean, b.to_picture.mean);
    EXPECT_EQ(a.to_picture.hausdorff, b.to_picture.hausdorff);
    EXPECT_EQ(a.psnr, b.psnr);
    EXPECT_EQ(a.away.mean, b.away.mean);
    EXPECT_EQ(a.islands.lost, b.islands.lost);
    EXPECT_GT(a.misclassified_ppm, 0);
}

TEST(Errors, aSizeOutOfRangeIsRefused) {
    const Scene scene = test::black_on_white({test::round_disc({0.4, 0.6}, 0.33)});
    const auto picture = black_where(kTexels, [](TexturePoint) { return true; });
    MeasureOptions options;
    options.sizes = {{16, 0}};
    EXPECT_FALSE(measure(*test::truth_of(scene), picture, options).ok());
}

} // namespace
} // namespace fetexc::measure
