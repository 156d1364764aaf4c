// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "compiler/measure/truth.h"
#include "tests/support/known_shapes.h"
#include "tests/support/measured.h"
#include "tests/support/random.h"

namespace fetexc::measure {
namespace {

using test::Random;
using test::truth_of;

std::vector<Rgba> picture_of(const Scene& scene, GridSize pixels, unsigned threads = 1) {
    return truth_of(scene)->picture(pixels, threads).value();
}

test::Rectangle pixel_box(std::uint32_t i, std::uint32_t j, GridSize pixels, double height = 1) {
    return {1.0 * i / pixels.width, height * j / pixels.height, 1.0 * (i + 1) / pixels.width,
            height * (j + 1) / pixels.height};
}

/// Black on white: a pixel's colour is 1 − covered share. `covered` gives the area in a box.
template <class Covered>
void expect_coverage(const std::vector<Rgba>& picture, GridSize pixels, double tolerance, const Covered& covered) {
    double sum = 0, expected_sum = 0;
    for (std::uint32_t j = 0; j < pixels.height; ++j) {
        for (std::uint32_t i = 0; i < pixels.width; ++i) {
            const test::Rectangle box = pixel_box(i, j, pixels);
            const double expected = covered(box) / box.area();
            const Rgba& c = picture[static_cast<std::size_t>(j) * pixels.width + i];
            ASSERT_NEAR(1 - c.r, expected, tolerance) << i << ", " << j;
            ASSERT_EQ(c.r, c.g);
            ASSERT_NEAR(c.a, 1, 1e-12);
            sum += (1 - c.r) * box.area(), expected_sum += expected * box.area();
        }
    }
    EXPECT_NEAR(sum, expected_sum, tolerance / 64);
    EXPECT_GT(sum, 0.001);
}

TEST(ExactPicture, aDiscCoversWhatTheCircleDoes) {
    const CanvasPoint center{0.47, 0.53};
    const double radius = 0.31;
    const Scene scene = test::black_on_white({test::round_disc(center, radius)});
    for (const GridSize pixels : {GridSize{64, 64}, GridSize{37, 53}}) {
        const std::vector<Rgba> picture = picture_of(scene, pixels);
        // half a lattice step of snapping, along an edge across the pixel
        expect_coverage(picture, pixels, 1e-6,
                        [&](const test::Rectangle& box) { return test::disc_area(center, radius, box); });
        double sum = 0;
        for (const Rgba& c : picture)
            sum += 1 - c.g;
        EXPECT_NEAR(sum / (pixels.width * pixels.height), test::kPi * radius * radius, 1e-7);
    }
}

TEST(ExactPicture, halfPlanesAtRandomAnglesCoverWhatTheirPolygonsDo) {
    Random random(7);
    for (int k = 0; k < 12; ++k) {
        const double angle = k < 4 ? k * test::kPi / 2 : random.between(0, 2 * test::kPi);
        const double offset = 0.5 * (std::cos(angle) + std::sin(angle)) + random.between(-0.3, 0.3);
        const std::vector<CanvasPoint> polygon = test::polygon_of({angle, offset});
        const Scene scene = test::black_on_white({test::closed_polygon(polygon)});
        const GridSize pixels{61, 40};
        expect_coverage(picture_of(scene, pixels), pixels, 1e-9,
                        [&](const test::Rectangle& box) { return test::clipped_area(polygon, box); });
    }
}

TEST(ExactPicture, aThinRingCoversTheDifferenceOfTwoDiscs) {
    const CanvasPoint center{0.5, 0.5};
    const double outer = 0.4, inner = 0.4 - 1.0 / 1024; // a sixteenth of a pixel
    const Scene scene = test::black_on_white({test::round_disc(center, outer), test::round_disc(center, inner)});
    const GridSize pixels{64, 64};
    expect_coverage(picture_of(scene, pixels), pixels, 2e-6, [&](const test::Rectangle& box) {
        return test::disc_area(center, outer, box) - test::disc_area(center, inner, box);
    });
}

Scene checkerboard(int fields) {
    std::vector<CanvasContour> black;
    for (int j = 0; j < fields; ++j) {
        for (int i = j % 2; i < fields; i += 2) {
            const double x0 = 1.0 * i / fields, y0 = 1.0 * j / fields, x1 = 1.0 * (i + 1) / fields,
                         y1 = 1.0 * (j + 1) / fields;
            black.push_back(test::closed_polygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}));
        }
    }
    return test::black_on_white(black);
}

TEST(ExactPicture, aCheckerboardOfPowersOfTwoIsExact) {
    const Scene scene = checkerboard(16);
    // fields on pixel borders, two fields a pixel, and borders inside pixels
    const std::vector<Rgba> aligned = picture_of(scene, {32, 32}), halves = picture_of(scene, {16, 8});
    for (std::size_t k = 0; k < aligned.size(); ++k) {
        const bool black = (k % 32 / 2 + k / 32 / 2) % 2 == 0;
        ASSERT_EQ(aligned[k].r, black ? 0 : 1) << k;
    }
    for (const Rgba& c : halves)
        ASSERT_NEAR(c.r, 0.5, 1e-12);
    const GridSize pixels{24, 24}; // every pixel is two thirds of a field wide
    expect_coverage(picture_of(scene, pixels), pixels, 1e-12, [&](const test::Rectangle& box) {
        double area = 0;
        for (int j = 0; j < 16; ++j) {
            for (int i = j % 2; i < 16; i += 2) {
                const double w = std::min(box.x1, (i + 1) / 16.0) - std::max(box.x0, i / 16.0),
                             h = std::min(box.y1, (j + 1) / 16.0) - std::max(box.y0, j / 16.0);
                area += std::max(w, 0.0) * std::max(h, 0.0);
            }
        }
        return area;
    });
}

TEST(ExactPicture, aLinearGradientIsIntegrated) {
    // 1 − x over a triangle: the mean of a pixel is known from moments; quadrature is exact for what is linear
    SceneBuilder builder(1, 1);
    builder.scene().paints.emplace_back(LinearPaint{{}, {{0, {1, 1, 1, 1}}, {1, {0, 0, 0, 1}}}, Spread::Pad});
    Node node;
    node.shape = builder.add_shape({test::closed_polygon({{0, 0}, {1, 0}, {0, 1}})}, FillRule::NonZero, kNone);
    node.paint = 0, node.end = 1;
    builder.scene().nodes.push_back(node);
    const Scene scene = builder.finish().value();
    const GridSize pixels{8, 8};
    const std::vector<Rgba> picture = picture_of(scene, pixels);
    for (std::uint32_t j = 0; j < 8; ++j) {
        for (std::uint32_t i = 0; i < 8; ++i) {
            const Rgba& c = picture[j * 8 + i];
            const double covered = i + j < 7    ? 1
                                   : i + j == 7 ? 0.5
                                                : 0,
                         mean_x = (i + (i + j == 7 ? 1.0 / 3 : 0.5)) / 8;
            ASSERT_NEAR(c.a, covered, 1e-9);
            ASSERT_NEAR(c.r, covered * (1 - mean_x), 1e-9) << i << ", " << j;
        }
    }
}

TEST(ExactPicture, theNumberOfThreadsChangesNothing) {
    const Scene scene = test::black_on_white({test::round_disc({0.4, 0.6}, 0.33), test::round_disc({0.6, 0.4}, 0.2)});
    EXPECT_EQ(picture_of(scene, {100, 90}, 1), picture_of(scene, {100, 90}, 3));
}

TEST(ExactPicture, aSizeOutOfRangeIsRefused) {
    const Scene scene = checkerboard(2);
    const auto truth = truth_of(scene);
    EXPECT_FALSE(truth->picture({0, 4}, 1).ok());
    EXPECT_FALSE(truth->picture({4, 16385}, 1).ok());
}

TEST(VisibleEdges, ofADiscLieOnItsCircleAndKnowTheirSides) {
    const CanvasPoint center{0.47, 0.53};
    const double radius = 0.31;
    const Scene scene = test::black_on_white({test::round_disc(center, radius)});
    const auto truth = truth_of(scene);
    double length = 0;
    for (const VisibleEdge& e : truth->edges()) {
        const WidthPoint a = e.p[0], b = e.p[static_cast<std::size_t>(e.degree)];
        EXPECT_NEAR(std::hypot(a.x - center.x, a.y - center.y), radius, 1e-8);
        length += std::hypot(b.x - a.x, b.y - a.y);
        // the left of the chord is (dy, −dx)
        const double toward = (b.y - a.y) * (a.x - center.x) - (b.x - a.x) * (a.y - center.y);
        const Rgba left = truth->color(e.left, {0, 0}), right = truth->color(e.right, {0, 0});
        EXPECT_EQ(left.r, toward > 0 ? 1 : 0);
        EXPECT_EQ(right.r, toward > 0 ? 0 : 1);
    }
    EXPECT_NEAR(length, 2 * test::kPi * radius, 1e-4); // of chords, a bit less than the arcs'
    EXPECT_LT(length, 2 * test::kPi * radius);
}

TEST(VisibleEdges, ofACheckerboardAreAllThere) {
    // its lines lie on the lines of any grid of a power of two: they must not get lost
    const Scene scene = checkerboard(8);
    const auto truth = truth_of(scene);
    double length = 0;
    for (const VisibleEdge& e : truth->edges())
        length += std::hypot(e.p[1].x - e.p[0].x, e.p[1].y - e.p[0].y);
    EXPECT_NEAR(length, 14, 1e-9);
}

TEST(VisibleEdges, hiddenOnesAndThoseBetweenEqualColoursAreNone) {
    const CanvasContour left = test::closed_polygon({{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}}),
                        right = test::closed_polygon({{0.5, 0}, {1, 0}, {1, 1}, {0.5, 1}}),
                        inner = test::closed_polygon({{0.2, 0.2}, {0.8, 0.2}, {0.8, 0.8}, {0.2, 0.8}});
    const Rgba red{1, 0, 0, 1};
    EXPECT_TRUE(truth_of(test::layered({{{left}, red}, {{right}, red}, {{inner}, red}}))->edges().empty());
    EXPECT_FALSE(truth_of(test::layered({{{left}, red}, {{right}, {1, 0, 0.1, 1}}}))->edges().empty());
}

TEST(NearestEdge, isAtTheDistanceOfTheCircle) {
    const CanvasPoint center{0.5, 0.5};
    const double radius = 0.25;
    const Scene scene = test::black_on_white({test::round_disc(center, radius)});
    const auto truth = truth_of(scene);
    Random random(3);
    for (int k = 0; k < 2000; ++k) {
        const TexturePoint p{random.between(-0.2, 1.2), random.between(-0.2, 1.2)};
        const EdgePoint found = truth->nearest_edge(p, std::numeric_limits<double>::infinity());
        const double expected = std::fabs(std::hypot(p.u - center.x, p.v - center.y) - radius);
        ASSERT_NE(found.edge, kNone);
        ASSERT_NEAR(found.distance, expected, 2e-8); // of snapping
        const EdgePoint nothing = truth->nearest_edge(p, found.distance * (1 - 1e-9));
        ASSERT_EQ(nothing.edge, kNone);
    }
}

TEST(NearestEdge, ofALineIsAccurateToFarBelowALatticeStep) {
    Random random(5);
    for (int k = 0; k < 20; ++k) {
        const double angle = random.between(0, 2 * test::kPi);
        const std::vector<CanvasPoint> polygon = test::polygon_of({angle, 0.5 * (std::cos(angle) + std::sin(angle))});
        const Scene scene = test::layered({{{test::closed_polygon(polygon)}, {0, 0, 0, 1}}});
        const auto truth = truth_of(scene);
        for (int n = 0; n < 50; ++n) {
            const TexturePoint p{random.between(0.3, 0.7), random.between(0.3, 0.7)};
            double expected = std::numeric_limits<double>::infinity();
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const CanvasPoint a = polygon[i], b = polygon[(i + 1) % polygon.size()];
                const double dx = b.x - a.x, dy = b.y - a.y;
                expected = std::min(expected, std::fabs(dx * (p.v - a.y) - dy * (p.u - a.x)) / std::hypot(dx, dy));
            }
            ASSERT_NEAR(truth->nearest_edge(p, 1).distance, expected, 1e-12);
        }
    }
}

TEST(NearestEdge, onACanvasOfAnotherShapeIsMeasuredInWidths) {
    const Scene scene =
        test::layered({{{test::canvas_box(0.3)}, {1, 1, 1, 1}},
                       {{test::closed_polygon({{0, 0.1}, {1, 0.1}, {1, 0.3}, {0, 0.3}})}, {0, 0, 0, 1}}},
                      0.3);
    const auto truth = truth_of(scene);
    EXPECT_NEAR(truth->height(), 0.3, 1e-15);
    EXPECT_NEAR(truth->nearest_edge({0.4, 0.9}, 1).distance, 0.17, 1e-8);
    EXPECT_EQ(truth->nearest_edge({0.4, 0.9}, 0.16).edge, kNone);
    EXPECT_EQ(truth->color(truth->result_at({0.4, 0.3}), {}).r, 1);
    EXPECT_EQ(truth->color(truth->result_at({0.4, 0.4}), {}).r, 0);
}

TEST(EdgesNear, holdAllWithinTheRadius) {
    const Scene scene = checkerboard(6);
    const auto truth = truth_of(scene);
    Random random(11);
    std::vector<std::uint32_t> near;
    for (int k = 0; k < 300; ++k) {
        const TexturePoint p{random.unit(), random.unit()};
        const double radius = random.between(0, 0.1);
        truth->edges_near(p, radius, near);
        std::size_t within = 0;
        for (std::uint32_t e = 0; e < truth->edges().size(); ++e) {
            if (truth->nearest_on(e, p, radius).edge == kNone) continue;
            ++within;
            ASSERT_TRUE(std::binary_search(near.begin(), near.end(), e));
        }
        ASSERT_LE(within, near.size());
    }
}

} // namespace
} // namespace fetexc::measure
