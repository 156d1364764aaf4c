// SPDX-License-Identifier: GPL-3.0-or-later
/// Every generator of hard drawings, under every check: on several grids, mirrored, turned, reversed, permuted, scaled,
/// moved far away. See README.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "compiler/svg/svg.h"
#include "tests/stress/seeds.h"
#include "tests/stress/watchdog.h"
#include "tests/support/stress_case.h"
#include "tests/support/stress_drawings.h"

namespace fetexc::test {
namespace {

std::string how_to_shrink(const char* generator, std::uint64_t seed, const std::string& failure) {
    return "\nshrink it: minimize --generator " + std::string(generator) + " --seed " + std::to_string(seed) +
           " --predicate " + failure.substr(0, failure.find(':'));
}

class Drawings : public testing::TestWithParam<StressGenerator> {};

TEST_P(Drawings, HoldEveryInvariant) {
    const StressGenerator& generator = GetParam();
    for (std::uint64_t seed : stress_seeds(8)) {
        const Watchdog watchdog(generator.name, seed);
        const Drawing drawing = stress_drawing(generator, seed);
        const Failure failure = first_failure(drawing, seed);
        EXPECT_FALSE(failure) << generator.name << ", seed " << seed << ": " << *failure
                              << how_to_shrink(generator.name, seed, *failure);
    }
}

INSTANTIATE_TEST_SUITE_P(Stress, Drawings, testing::ValuesIn(stress_generators().begin(), stress_generators().end()),
                         [](const auto& generator) { return std::string(generator.param.name); });

TEST(WideRange, CoordinatesOfAnySizeHoldEveryInvariant) {
    for (std::uint64_t seed : stress_seeds(100)) {
        const Watchdog watchdog("wide_range", seed);
        const CanvasDrawing drawing = wide_range_drawing(seed);
        SceneBuilder builder(drawing.width, drawing.height);
        for (const std::vector<CanvasContour>& contours : drawing.shapes) {
            const std::uint32_t k = builder.add_shape(contours, drawing.rule, kNone);
            builder.scene().paints.emplace_back(SolidPaint{{0.1 * (k % 9), 0.5, 0.5, 1}});
            Node node;
            node.end = k + 1, node.shape = k, node.paint = k;
            builder.scene().nodes.push_back(node);
        }
        const Result<Scene> scene = builder.finish();
        ASSERT_TRUE(scene.ok()) << "seed " << seed << ": " << scene.error().message;
        const Failure failure = first_scene_failure(scene.value(), seed, false);
        EXPECT_FALSE(failure) << "wide_range, seed " << seed << ": " << *failure;
    }
}

void expect_map_holds(const Drawing& drawing, const char* what) {
    const Watchdog watchdog(what, curve_count(drawing));
    const int points = std::clamp(static_cast<int>(100000 / curve_count(drawing)), 4, 100); // each asks every curve
    const MapCheck check = check_map(scene_of(drawing), {{4, 4}, points, 0, lies_inside(drawing)});
    EXPECT_FALSE(check.failure) << what << ", " << curve_count(drawing) << " curves: " << *check.failure;
}

bool full_count() { return stress_seeds(1).size() >= 10000; }

/// Lines that end in one point need no test of their pairs.
TEST(ManyLines, EndInAPoint) {
    expect_map_holds(rays_from_a_point(full_count() ? 100000 : 10000), "rays_from_a_point");
}

/// Each pair of lines through a point is one crossing, so this grows with the square of their number.
TEST(ManyLines, CrossInAPoint) {
    Random random(1);
    expect_map_holds(lines_through_a_point(random, full_count() ? 2000 : 300), "lines_through_a_point");
}

/// The drawing as an SVG whose canvas starts at (offset, offset).
std::string svg_of(const Drawing& drawing, double offset) {
    std::ostringstream out;
    out << std::setprecision(17);
    out << "<svg xmlns='http://www.w3.org/2000/svg' width='512' height='512' viewBox='" << offset << ' ' << offset
        << " 512 512'>";
    for (const CanvasContour& contour : contours_of(drawing, 512.0 / static_cast<double>(kLatticeSteps))) {
        out << "<path fill-rule='" << (drawing.rule == FillRule::EvenOdd ? "evenodd" : "nonzero") << "' d='";
        const CanvasSegment* before = nullptr;
        for (const CanvasSegment& s : contour) {
            const auto put = [&](const CanvasPoint& p) { out << p.x + offset << ' ' << p.y + offset << ' '; };
            const char* pen = before == nullptr ? "M" : "L";
            out << pen, put(s.p[0]);
            out << " LQC"[s.degree];
            for (int i = 1; i <= s.degree; ++i)
                put(s.p[static_cast<std::size_t>(i)]);
            before = &s;
        }
        out << "Z'/>";
    }
    out << "</svg>";
    return out.str();
}

std::vector<Segment> lattice_image(const std::string& svg, std::string& error) {
    std::vector<Diagnostic> diagnostics;
    const Result<Scene> scene =
        load_svg({reinterpret_cast<const std::uint8_t*>(svg.data()), svg.size()}, {}, diagnostics);
    if (!scene) error = scene.error().message;
    return scene ? scene.value().segments : std::vector<Segment>{};
}

/// The parser below the front end computes in single precision, 1/16 of a unit there, and drops what has no length in
/// it, or no width: consecutive control points have to be four times as far apart, or equal, and so have the sides of
/// a path's box.
bool is_coarse(const Drawing& drawing) {
    constexpr std::int64_t apart = kLatticeSteps / 512 / 4;
    const auto near = [](LatticePoint p, LatticePoint q) {
        return p != q && std::abs(p.x - q.x) < apart && std::abs(p.y - q.y) < apart;
    };
    for (const Path& path : drawing.paths) {
        std::vector<LatticePoint> points;
        for (const auto& curve : path)
            points.insert(points.end(), curve.begin(), curve.end());
        if (points.empty()) continue;
        points.push_back(points.front());
        if (std::adjacent_find(points.begin(), points.end(), near) != points.end()) return false;
        const auto [left, right] = std::ranges::minmax(points, {}, &LatticePoint::x);
        const auto [top, bottom] = std::ranges::minmax(points, {}, &LatticePoint::y);
        if (right.x - left.x < apart || bottom.y - top.y < apart) return false;
    }
    return true;
}

TEST(FarAway, AnOffsetOfAMillionChangesNothing) {
    const auto equal = [](const Segment& p, const Segment& q) { return p.degree == q.degree && p.p == q.p; };
    std::size_t drawings = 0, compared = 0;
    for (const StressGenerator& generator : stress_generators()) {
        for (std::uint64_t seed : stress_seeds(10)) {
            const Watchdog watchdog(generator.name, seed);
            const Drawing drawing = stress_drawing(generator, seed);
            ++drawings;
            if (!is_coarse(drawing)) continue;
            ++compared;
            std::string error;
            const std::vector<Segment> here = lattice_image(svg_of(drawing, 0), error),
                                       there = lattice_image(svg_of(drawing, 1e6), error);
            EXPECT_EQ(error, "") << generator.name << ", seed " << seed;
            EXPECT_TRUE(std::equal(here.begin(), here.end(), there.begin(), there.end(), equal))
                << generator.name << ", seed " << seed << ": " << here.size() << " and " << there.size() << " segments";
        }
    }
    EXPECT_GT(2 * compared, drawings) << "too few drawings are coarse enough to be compared";
    std::cout << compared << " of " << drawings << " drawings are coarse enough to be compared\n";
}

} // namespace
} // namespace fetexc::test
