// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

#include "compiler/scene/bezier.h"
#include "compiler/scene/curve_distance.h"
#include "compiler/scene/ground_truth.h"
#include "compiler/scene/scene_builder.h"
#include "tests/support/known_shapes.h"
#include "tests/support/random_scene.h"
#include "tests/support/random_shapes.h"

namespace fetexc {
namespace {

using test::Contours;
using test::Random;

constexpr double kUnit = static_cast<double>(kLatticeSteps) / 100; ///< lattice steps per user unit of a 100×100 canvas

Scene filled(const std::vector<std::pair<Contours, FillRule>>& shapes) {
    SceneBuilder builder(100, 100);
    builder.scene().paints.emplace_back(SolidPaint{{1, 0, 0, 1}});
    for (const auto& [contours, rule] : shapes) {
        Node node;
        node.shape = builder.add_shape(contours, rule, kNone);
        node.paint = 0;
        builder.scene().nodes.push_back(node);
    }
    Result<Scene> scene = builder.finish({false});
    EXPECT_TRUE(scene.ok());
    return std::move(scene).value();
}

bool holds(const GroundTruth& truth, double x, double y) { return !truth.inside(x * kUnit, y * kUnit).empty(); }

TEST(Winding, discHoldsExactlyWhatIsCloserThanItsRadius) {
    const Scene scene = filled({{{test::circle({50, 50}, 30)}, FillRule::NonZero}});
    const GroundTruth truth(scene);
    Random random(1);
    int in = 0;
    for (int i = 0; i < 20000; ++i) {
        const double x = random.between(0, 100), y = random.between(0, 100), r = std::hypot(x - 50, y - 50);
        if (std::abs(r - 30) < 30 * 3e-4) continue; // a circle of four cubics is this wrong
        EXPECT_EQ(holds(truth, x, y), r < 30);
        in += r < 30 ? 1 : 0;
    }
    EXPECT_NEAR(in / 2.0, 3.14159265 * 900, 100);
}

TEST(Winding, latticePointsOnVertexAndExtremumLevelsAreNotMiscounted) {
    // rays through vertices, along horizontal edges and through extrema of curves; even-odd shows a level counted twice
    const Contours hexagon{test::polygon({{10, 50}, {25, 25}, {50, 25}, {75, 25}, {90, 50}, {50, 90}})};
    const Scene scene = filled({{{test::circle({50, 50}, 25)}, FillRule::EvenOdd},
                                {hexagon, FillRule::NonZero},
                                {hexagon, FillRule::EvenOdd},
                                {test::reversed(hexagon), FillRule::EvenOdd}});
    const GroundTruth truth(scene);
    using Shapes = std::vector<std::uint32_t>;
    EXPECT_EQ(truth.inside(5 * kUnit, 50 * kUnit), Shapes{});
    EXPECT_EQ(truth.inside(20 * kUnit, 50 * kUnit), (Shapes{1, 2, 3}));
    EXPECT_EQ(truth.inside(50 * kUnit, 50 * kUnit), (Shapes{0, 1, 2, 3}));
    EXPECT_EQ(truth.inside(5 * kUnit, 25 * kUnit), Shapes{});
    EXPECT_EQ(truth.inside(5 * kUnit, 75 * kUnit), Shapes{});
    EXPECT_EQ(truth.inside(5 * kUnit, 90 * kUnit), Shapes{});
    EXPECT_EQ(truth.inside(36 * kUnit, 75 * kUnit), (Shapes{1, 2, 3}));
}

TEST(Winding, fillRulesDifferWhereAPathOverlapsItself) {
    const Contours twice{test::rectangle(10, 10, 60, 60), test::rectangle(40, 40, 90, 90)};
    const Contours opposed{test::rectangle(10, 10, 60, 60), test::reversed({test::rectangle(40, 40, 90, 90)})[0]};
    const Scene scene = filled({{twice, FillRule::NonZero}, {twice, FillRule::EvenOdd}, {opposed, FillRule::NonZero}});
    const GroundTruth truth(scene);
    using Shapes = std::vector<std::uint32_t>;
    EXPECT_EQ(truth.inside(50 * kUnit, 50 * kUnit), Shapes{0});
    EXPECT_EQ(truth.inside(20 * kUnit, 50 * kUnit), (Shapes{0, 1, 2}));
    EXPECT_EQ(truth.inside(80 * kUnit, 80 * kUnit), (Shapes{0, 1, 2}));
}

TEST(Winding, sampledAreaOfStarShapedPolygonsIsTheShoelaceArea) {
    Random random(2);
    for (int round = 0; round < 8; ++round) {
        std::vector<CanvasPoint> corners;
        for (int i = 0; i < 9; ++i) {
            const double angle = (i + 0.8 * random.unit()) * 2 * 3.14159265 / 9, r = random.between(10, 45);
            corners.push_back({50 + r * std::cos(angle), 50 + r * std::sin(angle)});
        }
        const Scene scene = filled({{{test::polygon(corners)}, FillRule::NonZero}});
        const GroundTruth truth(scene);
        int in = 0;
        for (int y = 0; y < 200; ++y)
            for (int x = 0; x < 200; ++x)
                in += holds(truth, (x + random.unit()) / 2, (y + random.unit()) / 2) ? 1 : 0;
        EXPECT_NEAR(in / 4.0, test::polygon_area(corners), 12); // jittered grid: σ below 2.5
    }
}

/// Independent winding by summing angles along dense samples.
int sampled_winding(const Scene& scene, const Shape& shape, double x, double y) {
    double angle = 0;
    for (std::uint32_t k = shape.first; k < shape.first + shape.count; ++k) {
        const CanvasSegment s = bezier::to_double(scene.segments[k]);
        const int steps = s.degree == 1 ? 1 : 1000;
        for (int i = 0; i < steps; ++i) {
            const CanvasPoint a = bezier::point_at(s, double(i) / steps),
                              b = bezier::point_at(s, double(i + 1) / steps);
            const double ax = a.x - x, ay = a.y - y, bx = b.x - x, by = b.y - y;
            angle += std::atan2(ax * by - ay * bx, ax * bx + ay * by);
        }
    }
    return static_cast<int>(std::lround(angle / (2 * 3.14159265358979323846)));
}

TEST(Winding, agreesWithTheAngleSumOnRandomScenes) {
    Random random(3);
    int compared = 0;
    for (std::uint64_t seed = 0; seed < 25; ++seed) {
        test::RandomSceneOptions options;
        options.cull = false;
        const Scene scene = test::random_scene(seed, options);
        const GroundTruth truth(scene);
        for (int i = 0; i < 40; ++i) {
            const double x = random.between(0, 100) * kUnit, y = random.between(0, 100) * kUnit;
            if (truth.distance_to_curves_within(x, y, 0.01 * kUnit) < 0.01 * kUnit)
                continue; // the sum samples coarsely
            std::vector<std::uint32_t> expected;
            for (std::uint32_t s = 0; s < scene.shapes.size(); ++s) {
                const int winding = sampled_winding(scene, scene.shapes[s], x, y);
                if (scene.shapes[s].rule == FillRule::EvenOdd ? winding % 2 != 0 : winding != 0) expected.push_back(s);
            }
            EXPECT_EQ(truth.inside(x, y), expected) << "seed " << seed;
            ++compared;
        }
    }
    EXPECT_GT(compared, 900);
}

// ---- distance ----

/// Dense samples, then ternary search around each local minimum.
double sampled_distance(const CanvasSegment& s, double x, double y) {
    constexpr int kSteps = 4000;
    const auto at = [&](double t) {
        const CanvasPoint p = bezier::point_at(s, t);
        return std::hypot(p.x - x, p.y - y);
    };
    double best = std::min(at(0), at(1));
    for (int i = 1; i < kSteps; ++i) {
        double lo = double(i - 1) / kSteps, hi = double(i + 1) / kSteps;
        if (at(double(i) / kSteps) > std::min(at(lo), at(hi))) continue;
        for (int k = 0; k < 120; ++k) {
            const double a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
            (at(a) < at(b) ? hi : lo) = at(a) < at(b) ? b : a;
        }
        best = std::min(best, at((lo + hi) / 2));
    }
    return best;
}

CanvasPoint lattice_point(Random& random) {
    return {std::floor(random.between(-0.2, 1.2) * double(kLatticeSteps)),
            std::floor(random.between(-0.2, 1.2) * double(kLatticeSteps))};
}

CanvasSegment random_segment(Random& random, int round) {
    CanvasSegment s;
    s.degree = random.integer(1, 3);
    for (int i = 0; i <= s.degree; ++i)
        s.p[i] = lattice_point(random);
    if (round % 5 == 1) s.p[1] = s.p[0];                  // zero handle
    if (round % 5 == 2 && s.degree == 3) s.p[3] = s.p[0]; // loop
    if (s.degree == 1 && s.p[0].x == s.p[1].x) s.p[1].x += 1;
    return s;
}

TEST(Distance, equalsTheSampledMinimum) {
    Random random(4);
    for (int round = 0; round < 400; ++round) {
        const CanvasSegment s = random_segment(random, round);
        const CanvasPoint p = lattice_point(random);
        const double expected = sampled_distance(s, p.x, p.y);
        const double actual = distance_below(s, p.x, p.y, std::numeric_limits<double>::infinity());
        EXPECT_NEAR(actual, expected, 1e-6) << "round " << round << " degree " << s.degree;
    }
}

TEST(Distance, ofPointsNearTheCurveIsTheOffset) {
    Random random(5);
    for (int round = 0; round < 400; ++round) {
        const CanvasSegment s = random_segment(random, 0);
        const double t = random.between(0.05, 0.95), h = 1e-6;
        const CanvasPoint p = bezier::point_at(s, t), a = bezier::point_at(s, t - h), b = bezier::point_at(s, t + h);
        const double length = std::hypot(b.x - a.x, b.y - a.y), offset = std::exp2(random.between(-10, 3));
        if (length < 10) continue; // near a cusp the normal means nothing
        const double x = p.x - (b.y - a.y) / length * offset, y = p.y + (b.x - a.x) / length * offset;
        const double actual = distance_below(s, x, y, std::numeric_limits<double>::infinity());
        EXPECT_LE(actual, offset + 1e-6);
        EXPECT_NEAR(actual, offset, 1e-3 * offset + 1e-6) << round;
    }
}

TEST(Distance, cutoffAndRowsDoNotChangeTheAnswer) {
    test::RandomSceneOptions options;
    options.layers = 20;
    const Scene scene = test::random_scene(8, options);
    const GroundTruth truth(scene);
    Random random(6);
    for (int i = 0; i < 300; ++i) {
        const double x = random.between(-20, 120) * kUnit, y = random.between(-20, 120) * kUnit;
        double expected = std::numeric_limits<double>::infinity();
        for (const Segment& s : scene.segments)
            expected = distance_below(bezier::to_double(s), x, y, expected);
        EXPECT_NEAR(truth.distance_to_curves(x, y), expected, 1e-6);
        EXPECT_NEAR(truth.distance_to_curves_within(x, y, expected * 1.01 + 1), expected, 1e-6);
        EXPECT_EQ(truth.distance_to_curves_within(x, y, expected * 0.99), std::numeric_limits<double>::infinity());
    }
}

TEST(Distance, emptySceneIsInfinitelyFar) {
    const Scene scene = filled({});
    const GroundTruth truth(scene);
    EXPECT_EQ(truth.distance_to_curves(1, 1), std::numeric_limits<double>::infinity());
    EXPECT_TRUE(truth.inside(1, 1).empty());
}

/// A map of about 94,000 segments (as the largest real one) answers 100,000 queries within seconds.
TEST(Speed, manyQueriesOnALargeMap) {
    SceneBuilder builder(100, 100);
    builder.scene().paints.emplace_back(SolidPaint{{1, 0, 0, 1}});
    Random random(9);
    for (int country = 0; country < 200; ++country) {
        const double cx = random.between(5, 95), cy = random.between(5, 95), size = random.between(1, 15);
        std::vector<CanvasPoint> coast;
        for (int i = 0; i < 470; ++i) {
            const double angle = i * 2 * 3.14159265 / 470, r = size * random.between(0.9, 1);
            coast.push_back({cx + r * std::cos(angle), cy + r * std::sin(angle)});
        }
        Node node;
        node.shape = builder.add_shape({test::polygon(coast)}, FillRule::NonZero, kNone);
        node.paint = 0;
        builder.scene().nodes.push_back(node);
    }
    const Result<Scene> scene = builder.finish();
    ASSERT_TRUE(scene.ok());
    ASSERT_GT(scene.value().segments.size(), 90000u);
    const GroundTruth truth(scene.value());
    const auto start = std::chrono::steady_clock::now();
    std::size_t sum = 0, near = 0;
    for (int i = 0; i < 100000; ++i) {
        const double x = random.unit() * double(kLatticeSteps), y = random.unit() * double(kLatticeSteps);
        sum += truth.inside(x, y).size();
        near += truth.distance_to_curves_within(x, y, 32) < 32 ? 1 : 0;
    }
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    RecordProperty("milliseconds", static_cast<int>(elapsed.count() * 1000));
    EXPECT_GT(sum, 100000u);
    EXPECT_LT(near, 1000u);
    EXPECT_LT(elapsed.count(), 60.0); // seconds here; a missing index would take many minutes
}

} // namespace
} // namespace fetexc
