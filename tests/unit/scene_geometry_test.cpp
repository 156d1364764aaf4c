// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"
#include "compiler/scene/bezier.h"
#include "compiler/scene/ground_truth.h"
#include "compiler/scene/guard_box.h"
#include "compiler/scene/lattice.h"
#include "compiler/scene/scene_builder.h"
#include "tests/support/random_shapes.h"

namespace fetexc {
namespace {

using test::Contours;
using test::cubic;
using test::line;
using test::polygon;
using test::quadratic;

/// A builder whose canvas coordinates are lattice steps.
SceneBuilder lattice_builder() { return {static_cast<double>(kLatticeSteps), static_cast<double>(kLatticeSteps)}; }

void add_fill(SceneBuilder& builder, std::uint32_t shape) {
    Scene& scene = builder.scene();
    if (scene.paints.empty()) scene.paints.emplace_back(SolidPaint{{1, 0, 0, 1}});
    Node node;
    node.shape = shape;
    node.paint = 0;
    scene.nodes.push_back(node);
    scene.nodes.back().end = static_cast<std::uint32_t>(scene.nodes.size());
}

void add_filled(SceneBuilder& builder, const Contours& contours, FillRule rule = FillRule::NonZero) {
    add_fill(builder, builder.add_shape(contours, rule, kNone));
}

Scene finished(SceneBuilder& builder, bool cull = false) {
    Result<Scene> scene = builder.finish({cull});
    EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().message);
    return scene.ok() ? std::move(scene).value() : Scene{};
}

/// Every contour is closed exactly: the signed sum of end points vanishes for each point.
void expect_closed(const Scene& scene) {
    for (const Shape& shape : scene.shapes) {
        std::vector<LatticePoint> starts, ends;
        for (std::uint32_t k = shape.first; k < shape.first + shape.count; ++k) {
            starts.push_back(scene.segments[k].p[0]);
            ends.push_back(scene.segments[k].p[scene.segments[k].degree]);
        }
        std::sort(starts.begin(), starts.end());
        std::sort(ends.begin(), ends.end());
        EXPECT_EQ(starts, ends);
    }
}

// ---- lattice ----

struct ExtentCase {
    double width, height;
    std::int64_t lattice_w, lattice_h;
};

TEST(Lattice, largerSideHasAllSteps) {
    const std::int64_t full = kLatticeSteps;
    for (const ExtentCase& c : {ExtentCase{100, 100, full, full},
                                {200, 100, full, full / 2},
                                {100, 300, 22369621, full},
                                {1e-3, 1e9, 1, full},
                                {1e9, 1e-300, full, 1}}) {
        const Result<Extent> extent = make_extent(c.width, c.height);
        ASSERT_TRUE(extent.ok());
        EXPECT_EQ(extent.value().lattice_w, c.lattice_w);
        EXPECT_EQ(extent.value().lattice_h, c.lattice_h);
    }
}

TEST(Lattice, refusesImpossibleCanvases) {
    const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
    for (const auto& [w, h] :
         std::vector<std::pair<double, double>>{{0, 1}, {1, 0}, {-1, 1}, {1, inf}, {nan, 1}, {1e-320, 1e-320}}) {
        SceneBuilder builder(w, h);
        const Result<Scene> scene = builder.finish();
        ASSERT_FALSE(scene.ok()) << w << " x " << h;
        EXPECT_EQ(scene.error().code, diag::kSceneExtentInvalid);
    }
}

TEST(Lattice, canvasCornersMapExactly) {
    SceneBuilder builder(7, 3);
    add_filled(builder, {test::rectangle(0, 0, 7, 3)});
    const Scene scene = finished(builder);
    EXPECT_EQ(scene.segments[1].p[1], (LatticePoint{scene.extent.lattice_w, scene.extent.lattice_h}));
    EXPECT_EQ(scene.segments[0].p[0], (LatticePoint{0, 0}));
}

// ---- snapping and merging ----

TEST(Snap, roundsToTheNearestStep) {
    EXPECT_EQ(snap({0.5, -0.5}), (LatticePoint{1, -1}));
    EXPECT_EQ(snap({0.49, 1.51}), (LatticePoint{0, 2}));
}

TEST(Snap, refusesWhatIsNotANumber) {
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        SceneBuilder builder(10, 10);
        add_filled(builder, {{cubic({0, 0}, {bad, 1}, {2, 2}, {3, 0})}});
        const Result<Scene> scene = builder.finish();
        ASSERT_FALSE(scene.ok());
        EXPECT_EQ(scene.error().code, diag::kSceneCoordinateInvalid);
    }
}

struct MergeCase {
    double offset; ///< of the second shape's corners, steps
    bool merged;
};

TEST(Merge, endPointsCloserThanTheDistanceBecomeOne) {
    for (const MergeCase& c : {MergeCase{0, true}, {1, true}, {45, true}, {63, true}, {64, false}, {100, false}}) {
        SceneBuilder builder = lattice_builder();
        add_filled(builder, {polygon({{1000, 1000}, {90000, 1000}, {1000, 90000}})});
        add_filled(builder, {polygon({{90000 + c.offset, 1000}, {90000, 90000}, {1000, 90000 + c.offset}})});
        const Scene scene = finished(builder);
        ASSERT_EQ(scene.segments.size(), 6u);
        EXPECT_EQ(scene.segments[3].p[0] == scene.segments[0].p[1], c.merged) << c.offset;
        EXPECT_EQ(scene.segments[5].p[0] == scene.segments[2].p[0], c.merged) << c.offset;
        EXPECT_EQ(scene.stats.vertices_merged, c.merged && c.offset > 0 ? 2u : 0u);
        expect_closed(scene);
    }
}

TEST(Merge, pointsSharedExactlyStayAndLonersMove) {
    SceneBuilder builder = lattice_builder();
    add_filled(builder, {polygon({{1040, 1000}, {50000, 1000}, {1000, 50000}})}); // comes first, but is alone
    add_filled(builder, {polygon({{1000, 1000}, {90000, 2000}, {90000, 90000}})});
    add_filled(builder, {polygon({{1000, 1000}, {2000, 90000}, {70000, 90000}})});
    const Scene scene = finished(builder);
    EXPECT_EQ(scene.segments[0].p[0], (LatticePoint{1000, 1000}));
    EXPECT_EQ(scene.segments[3].p[0], (LatticePoint{1000, 1000}));
    EXPECT_EQ(scene.stats.vertices_merged, 1u);
    EXPECT_DOUBLE_EQ(scene.stats.max_displacement, 40);
}

TEST(Merge, handlesFollowTheirEndPoint) {
    SceneBuilder builder = lattice_builder();
    add_filled(builder, {polygon({{1000, 1000}, {90000, 1000}, {50000, 90000}})});
    add_filled(builder,
               {{cubic({1010, 1020}, {3000, 5000}, {80000, 7000}, {89970, 1000}), line({89970, 1000}, {1010, 1020})}});
    add_filled(builder, {{quadratic({1010, 1020}, {3000, 5000}, {89970, 1000}), line({89970, 1000}, {1010, 1020})}});
    // the first shape's corners are used once each, the later ones twice: those lead
    const Scene scene = finished(builder);
    EXPECT_EQ(scene.segments[0].p[0], (LatticePoint{1010, 1020}));
    EXPECT_EQ(scene.segments[3].p[1], (LatticePoint{3000, 5000}));

    SceneBuilder other = lattice_builder();
    add_filled(other, {polygon({{1000, 1000}, {90000, 1000}, {50000, 90000}})});
    add_filled(other,
               {{cubic({1010, 1020}, {3000, 5000}, {80000, 7000}, {89970, 1000}), line({89970, 1000}, {1010, 1020})}});
    const Scene moved = finished(other);
    EXPECT_EQ(moved.segments[3].p[0], (LatticePoint{1000, 1000}));
    EXPECT_EQ(moved.segments[3].p[1], (LatticePoint{2990, 4980}));
    EXPECT_EQ(moved.segments[3].p[2], (LatticePoint{80030, 7000}));
    EXPECT_EQ(moved.segments[3].p[3], (LatticePoint{90000, 1000}));
}

TEST(Merge, curvesDrawnTwiceWithNoiseCoincide) {
    SceneBuilder builder = lattice_builder();
    add_filled(builder,
               {{cubic({1000, 1000}, {30000, 5000}, {60000, 7000}, {90000, 1000}), line({90000, 1000}, {1000, 1000})}});
    add_filled(builder,
               {{cubic({90003, 1001}, {60004, 7003}, {30001, 4990}, {1000, 1002}), line({1000, 1002}, {90003, 1001})}});
    const Scene scene = finished(builder);
    ASSERT_EQ(scene.segments.size(), 4u);
    for (int i = 0; i < 4; ++i)
        EXPECT_EQ(scene.segments[0].p[i], scene.segments[2].p[3 - i]) << i;
}

TEST(Merge, whatBecomesAPointVanishesAndLoopsStay) {
    SceneBuilder builder = lattice_builder();
    add_filled(builder, {polygon({{1000, 1000}, {1010, 1000}, {1000, 1010}})});                 // a point after merging
    add_filled(builder, {{cubic({5000, 5000}, {90000, 5000}, {5000, 90000}, {5000, 5000})}});   // a loop
    add_filled(builder, {{cubic({5000, 5000}, {90000, 90000}, {20000, 20000}, {5000, 5000})}}); // there and back
    add_filled(builder, {{quadratic({7000, 5000}, {90000, 5000}, {7000, 5000})}});              // there and back
    add_filled(builder, {polygon({{20000, 1000}, {90000, 1000}})});                             // there and back
    add_filled(builder, {{cubic({5000, 5000}, {5010, 5000}, {5000, 5010}, {5020, 5000})}});     // smaller than a vertex
    const Scene scene = finished(builder);
    ASSERT_EQ(scene.shapes.size(), 6u);
    const std::vector<std::uint32_t> counts{0, 1, 0, 0, 0, 0};
    for (std::size_t i = 0; i < counts.size(); ++i)
        EXPECT_EQ(scene.shapes[i].count, counts[i]) << i;
    EXPECT_EQ(scene.stats.segments_in, 3u + 1 + 1 + 1 + 2 + 1);
    EXPECT_EQ(scene.stats.segments_zero, 3u + 1 + 1 + 2 + 2); // the last one's closing line, too
}

TEST(Merge, openContoursAreClosedByALine) {
    SceneBuilder builder = lattice_builder();
    add_filled(builder, {{line({0, 0}, {50000, 0}), line({50000, 0}, {50000, 50000})}});
    const Scene scene = finished(builder);
    EXPECT_EQ(scene.segments.size(), 3u);
    expect_closed(scene);
}

TEST(Merge, isTheSameForEveryRun) {
    const auto build = [] {
        test::Random random(7);
        SceneBuilder builder(100, 70);
        for (int i = 0; i < 60; ++i)
            for (const Contours& c : test::random_shapes(random, {}, {100, 70, 6}))
                add_filled(builder, c);
        return finished(builder);
    };
    const Scene a = build(), b = build();
    ASSERT_EQ(a.segments.size(), b.segments.size());
    for (std::size_t i = 0; i < a.segments.size(); ++i)
        EXPECT_EQ(a.segments[i].p, b.segments[i].p);
    expect_closed(a);
}

/// Different vertices of the result are at least the merge distance apart.
TEST(Merge, leavesNoTwoVerticesClose) {
    test::Random random(11);
    SceneBuilder builder(100, 100);
    for (int i = 0; i < 80; ++i)
        for (const Contours& c : test::random_shapes(random, {}, {}))
            add_filled(builder, c);
    const Scene scene = finished(builder);
    std::vector<LatticePoint> vertices;
    for (const Segment& s : scene.segments)
        vertices.push_back(s.p[0]);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    ASSERT_GT(vertices.size(), 300u);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        for (std::size_t k = i + 1; k < vertices.size() && vertices[k].x - vertices[i].x < 64; ++k)
            EXPECT_GE(std::hypot(vertices[k].x - vertices[i].x, vertices[k].y - vertices[i].y), budget::kMergeDistance);
}

// ---- guard box ----

/// Winding number of a contour by summing the turned angle along dense samples; independent of any root finding.
/// `clear` is false when a sample step is too close to the point for the sum to be trusted.
int sampled_winding(const std::vector<CanvasSegment>& contour, CanvasPoint p, bool& clear) {
    constexpr int kSteps = 2000;
    double angle = 0;
    for (const CanvasSegment& s : contour)
        for (int i = 0; i < kSteps; ++i) {
            const CanvasPoint a = bezier::point_at(s, double(i) / kSteps),
                              b = bezier::point_at(s, double(i + 1) / kSteps);
            const double ax = a.x - p.x, ay = a.y - p.y, bx = b.x - p.x, by = b.y - p.y;
            if (std::min(std::hypot(ax, ay), std::hypot(bx, by)) < 0.05 * std::hypot(bx - ax, by - ay)) clear = false;
            angle += std::atan2(ax * by - ay * bx, ax * bx + ay * by);
        }
    return static_cast<int>(std::lround(angle / (2 * 3.14159265358979323846)));
}

CanvasPoint far_point(test::Random& random, double reach) {
    const double u = static_cast<double>(kLatticeSteps);
    return {random.between(-reach, reach) * u, random.between(-reach, reach) * u};
}

CanvasContour far_contour(test::Random& random, double reach) {
    CanvasContour out;
    const CanvasPoint start = far_point(random, reach);
    CanvasPoint pen = start;
    for (int i = 0; i < 4; ++i) {
        const CanvasPoint a = far_point(random, reach), b = far_point(random, reach);
        const CanvasPoint next = i == 3 ? start : far_point(random, reach);
        const int degree = random.integer(1, 3);
        out.push_back(degree == 1 ? line(pen, next) : degree == 2 ? quadratic(pen, a, next) : cubic(pen, a, b, next));
        pen = next;
    }
    return out;
}

TEST(GuardBox, keepsEveryWindingNumberInside) {
    const Extent extent = make_extent(1, 1).value();
    const GuardBox box = guard_box(extent);
    test::Random random(3);
    int compared = 0, wound = 0;
    for (int round = 0; round < 300; ++round) {
        const CanvasContour contour = far_contour(random, round % 2 == 0 ? 4 : 12);
        std::vector<CanvasSegment> clipped;
        for (const CanvasSegment& s : contour)
            clip_to_guard_box(s, box, clipped);
        for (int i = 0; i < 4; ++i) {
            const CanvasPoint p{random.between(box.x0, box.x1), random.between(box.y0, box.y1)};
            bool clear = true;
            const int before = sampled_winding(contour, p, clear), after = sampled_winding(clipped, p, clear);
            if (!clear) continue;
            EXPECT_EQ(before, after) << "round " << round;
            ++compared;
            wound += before != 0 ? 1 : 0;
        }
    }
    EXPECT_GT(compared, 800);
    EXPECT_GT(wound, 100);
}

TEST(GuardBox, outputIsClosedAndWithinTheLimits) {
    const GuardBox box = guard_box(make_extent(3, 1).value());
    test::Random random(5);
    for (int round = 0; round < 2000; ++round) {
        std::vector<CanvasSegment> out;
        for (const CanvasSegment& s : far_contour(random, std::exp2(random.between(0, 30))))
            clip_to_guard_box(s, box, out);
        for (std::size_t i = 0; i < out.size(); ++i) {
            const CanvasPoint end = out[i].p[out[i].degree], next = out[(i + 1) % out.size()].p[0];
            EXPECT_EQ(end.x, next.x);
            EXPECT_EQ(end.y, next.y);
            EXPECT_TRUE(end.x >= box.x0 && end.x <= box.x1 && end.y >= box.y0 && end.y <= box.y1);
            for (int k = 0; k <= out[i].degree; ++k)
                EXPECT_TRUE(std::abs(out[i].p[k].x) <= double(kLatticeLimit) &&
                            std::abs(out[i].p[k].y) <= double(kLatticeLimit));
        }
    }
}

TEST(GuardBox, crossingTheBorderAtAnInflectionIsSeen) {
    // x = border + 8e7·(t − 1/2)³: the derivative vanishes where the curve crosses
    const GuardBox box = guard_box(make_extent(1, 1).value());
    for (const double k : {1e7, -1e7}) {
        const CanvasSegment s = cubic({box.x1 - k, 0}, {box.x1 + k, 1e6}, {box.x1 - k, 2e6}, {box.x1 + k, 3e6});
        std::vector<CanvasSegment> out;
        clip_to_guard_box(s, box, out);
        EXPECT_EQ(out.size(), 2u);
        for (const CanvasSegment& part : out)
            for (int i = 0; i <= 16; ++i)
                EXPECT_LE(bezier::point_at(part, i / 16.0).x, box.x1 + 1e-6);
    }
}

TEST(GuardBox, curvesInsideAreNotTouched) {
    const GuardBox box = guard_box(make_extent(1, 1).value());
    std::vector<CanvasSegment> out;
    const CanvasSegment s = cubic({1, 2}, {3e7, 4e7}, {-5e7, 6e7}, {7, 8});
    clip_to_guard_box(s, box, out);
    ASSERT_EQ(out.size(), 1u);
    for (int i = 0; i < 4; ++i)
        EXPECT_TRUE(out[0].p[i].x == s.p[i].x && out[0].p[i].y == s.p[i].y);
}

TEST(GuardBox, hugeCoordinatesKeepTheirShape) {
    for (const double huge : {1e4, 1e9, 1e20, 1e100, 1e300}) {
        SceneBuilder builder(100, 100);
        add_filled(builder, {polygon({{0, 0}, {huge, huge}, {0, huge}})});
        add_filled(builder, {polygon({{-huge, -huge}, {huge, -huge}, {0, huge}})});
        add_filled(builder, {{cubic({-huge, 50}, {-huge / 3, 50}, {huge / 3, 50}, {huge, 50}),
                              line({huge, 50}, {0, huge}), line({0, huge}, {-huge, 50})}});
        const Scene scene = finished(builder);
        const GroundTruth truth(scene);
        const double unit = double(kLatticeSteps) / 100;
        EXPECT_EQ(truth.inside(10 * unit, 20 * unit), (std::vector<std::uint32_t>{0, 1})) << huge;
        EXPECT_EQ(truth.inside(20 * unit, 10 * unit), (std::vector<std::uint32_t>{1})) << huge;
        EXPECT_EQ(truth.inside(20 * unit, 60 * unit), (std::vector<std::uint32_t>{0, 1, 2})) << huge;
    }
}

} // namespace
} // namespace fetexc
