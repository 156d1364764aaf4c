// SPDX-License-Identifier: GPL-3.0-or-later
/// Stroke outlines and arcs of the SVG front end against what geometry says they must be.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "compiler/error_budget.h"
#include "compiler/scene/ground_truth.h"
#include "compiler/svg/svg.h"

namespace fetexc {
namespace {

constexpr double kPi = std::numbers::pi;

Scene load(const std::string& body, double side = 100) {
    const std::string size = std::to_string(side);
    const std::string svg =
        "<svg xmlns='http://www.w3.org/2000/svg' width='" + size + "' height='" + size + "'>" + body + "</svg>";
    std::vector<Diagnostic> diagnostics;
    Result<Scene> scene = load_svg({reinterpret_cast<const std::uint8_t*>(svg.data()), svg.size()}, {}, diagnostics);
    EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().message);
    EXPECT_TRUE(diagnostics.empty()) << diagnostics.front().message;
    return scene.ok() ? std::move(scene.value()) : Scene{};
}

CanvasPoint at(const Segment& s, double t, CanvasPoint& derivative) {
    std::array<double, 4> x{}, y{};
    for (std::size_t i = 0; i < 4; ++i) {
        x[i] = static_cast<double>(s.p[i].x);
        y[i] = static_cast<double>(s.p[i].y);
    }
    const int n = s.degree;
    for (int level = 1; level < n; ++level)
        for (std::size_t i = 0; i + static_cast<std::size_t>(level) <= static_cast<std::size_t>(n); ++i) {
            x[i] += t * (x[i + 1] - x[i]);
            y[i] += t * (y[i + 1] - y[i]);
        }
    derivative = {n * (x[1] - x[0]), n * (y[1] - y[0])};
    return {x[0] + t * (x[1] - x[0]), y[0] + t * (y[1] - y[0])};
}

/// Signed area of a shape in square user units; three Gauss points are exact for cubics (x·dy has degree 5).
double signed_area(const Scene& scene, const Shape& shape) {
    const double unit = scene.extent.width / static_cast<double>(scene.extent.lattice_w);
    const std::array<double, 3> nodes{0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)},
        weights{5. / 18, 8. / 18, 5. / 18};
    double area = 0;
    for (std::uint32_t i = shape.first; i < shape.first + shape.count; ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            CanvasPoint d;
            const CanvasPoint p = at(scene.segments[i], nodes[k], d);
            area += weights[k] * (p.x * d.y - p.y * d.x) / 2;
        }
    return area * unit * unit;
}

/// Of outlines that don't overlap themselves.
double area(const Scene& scene) {
    double total = 0;
    for (const Shape& shape : scene.shapes)
        total += std::abs(signed_area(scene, shape));
    return total;
}

/// Area of what is visible, whatever overlaps: samples on a grid of n × n.
double sampled_area(const Scene& scene, int n = 1000) {
    const GroundTruth truth(scene);
    const double w = static_cast<double>(scene.extent.lattice_w), h = static_cast<double>(scene.extent.lattice_h);
    long inside = 0;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            inside += truth.inside((i + 0.5) * w / n, (j + 0.5) * h / n).empty() ? 0 : 1;
    return static_cast<double>(inside) * scene.extent.width * scene.extent.height / (1.0 * n * n);
}

bool only_lines(const Scene& scene) {
    for (const Segment& s : scene.segments)
        if (s.degree != 1) return false;
    return true;
}

std::string stroke(const std::string& d, const std::string& more) {
    return "<path fill='none' stroke='#000' d='" + d + "' " + more + "/>";
}

// The lattice moves each point by up to a step and merges those within 64: 1e-4 user units here, times the perimeter.
constexpr double kAreaError = 0.02;

TEST(SvgStroke, buttLineIsARectangle) {
    const Scene s = load(stroke("M20 50H80", "stroke-width='10'"));
    EXPECT_NEAR(area(s), 600, kAreaError);
    EXPECT_TRUE(only_lines(s));
    EXPECT_EQ(s.segments.size(), 4u);
}

TEST(SvgStroke, squareCapsAddTheirSquares) {
    const Scene s = load(stroke("M20 50H80", "stroke-width='10' stroke-linecap='square'"));
    EXPECT_NEAR(area(s), 700, kAreaError);
    EXPECT_TRUE(only_lines(s));
}

TEST(SvgStroke, roundCapsAddADisc) {
    const Scene s = load(stroke("M20 50H80", "stroke-width='10' stroke-linecap='round'"));
    EXPECT_NEAR(area(s), 600 + 25 * kPi, kAreaError);
}

TEST(SvgStroke, zeroLengthSubpathsAreDots) {
    EXPECT_NEAR(area(load(stroke("M50 50z", "stroke-width='10' stroke-linecap='round'"))), 25 * kPi, kAreaError);
    EXPECT_NEAR(area(load(stroke("M50 50h0", "stroke-width='10' stroke-linecap='square'"))), 100, kAreaError);
    EXPECT_TRUE(load(stroke("M50 50h0", "stroke-width='10' stroke-linecap='butt'")).shapes.empty());
}

TEST(SvgStroke, miterJoinOfARightAngle) {
    // Two arms of 40 and 10 wide, and the corner square.
    const Scene s = load(stroke("M20 70V30H60", "stroke-width='10'"));
    EXPECT_NEAR(area(s), 2 * 40 * 10, kAreaError) << "the arms overlap in 5 x 5, the miter adds 5 x 5";
    EXPECT_TRUE(only_lines(s));
    EXPECT_EQ(s.segments.size(), 6u) << "the inner corner is one point";
}

TEST(SvgStroke, bevelJoinCutsTheCorner) {
    const Scene s = load(stroke("M20 70V30H60", "stroke-width='10' stroke-linejoin='bevel'"));
    EXPECT_NEAR(area(s), 800 - 12.5, kAreaError);
    EXPECT_TRUE(only_lines(s));
}

TEST(SvgStroke, roundJoinAddsAQuarterDisc) {
    const Scene s = load(stroke("M20 70V30H60", "stroke-width='10' stroke-linejoin='round'"));
    EXPECT_NEAR(area(s), 800 - 25 + 25 * kPi / 4, kAreaError);
}

TEST(SvgStroke, miterLimitFallsBackToBevel) {
    // A right angle has a miter of 1.414 widths.
    const Scene over = load(stroke("M20 70V30H60", "stroke-width='10' stroke-miterlimit='1.41'"));
    EXPECT_NEAR(area(over), 787.5, kAreaError);
    const Scene under = load(stroke("M20 70V30H60", "stroke-width='10' stroke-miterlimit='1.42'"));
    EXPECT_NEAR(area(under), 800, kAreaError);
}

TEST(SvgStroke, miterClipCutsAtHalfTheLimit) {
    // At a right angle the corner is an isosceles triangle of height 5√2; the clip is 1.2·5 from the vertex.
    const Scene s =
        load(stroke("M20 70V30H60", "stroke-width='10' stroke-linejoin='miter-clip' stroke-miterlimit='1.2'"));
    const double rest = 5 * std::sqrt(2.0) - 6;
    EXPECT_NEAR(area(s), 800 - rest * rest, kAreaError);
}

TEST(SvgStroke, closedRectIsAFrameOfLines) {
    const Scene s = load("<rect x='20' y='20' width='60' height='40' fill='none' stroke='#000' stroke-width='10'/>");
    EXPECT_NEAR(area(s), 70 * 50 - 50 * 30, kAreaError);
    EXPECT_TRUE(only_lines(s));
    EXPECT_EQ(s.segments.size(), 8u);
}

TEST(SvgStroke, circleIsARingOfTwoCircles) {
    const Scene s = load("<circle cx='50' cy='50' r='30' fill='none' stroke='#000' stroke-width='10'/>");
    EXPECT_NEAR(area(s), kPi * (35 * 35 - 25 * 25), kAreaError);
}

TEST(SvgStroke, strokeWiderThanTheCircleHasNoHole) {
    const Scene s = load("<circle cx='50' cy='50' r='10' fill='none' stroke='#000' stroke-width='40'/>");
    EXPECT_NEAR(area(s), kPi * 900, kAreaError);
}

TEST(SvgStroke, strokeWiderThanAnEllipseHasNoHole) {
    const Scene s = load("<ellipse cx='50' cy='50' rx='9' ry='6' fill='none' stroke='#000' stroke-width='40'/>");
    const Scene solid = load("<ellipse cx='50' cy='50' rx='9' ry='6' stroke='#000' stroke-width='40'/>");
    EXPECT_NEAR(sampled_area(s), sampled_area(solid), 1e-9) << "filling adds nothing";
    EXPECT_GT(sampled_area(s), kPi * 26 * 29 * 0.98);
}

TEST(SvgStroke, dashesAreCutByArcLength) {
    const Scene line = load(stroke("M10 50H90", "stroke-width='4' stroke-dasharray='10 5' stroke-dashoffset='3'"));
    // Dashes: 7, then four of 10 at 12, 27, 42, 57, and 8 from 72.
    EXPECT_NEAR(area(line), 4 * (7 + 4 * 10 + 8), kAreaError);
    const Scene arc =
        load("<circle cx='50' cy='50' r='30' fill='none' stroke='#000' stroke-width='4' stroke-dasharray='10 5'/>");
    const double length = 60 * kPi, whole = std::floor(length / 15);
    EXPECT_NEAR(area(arc), 4 * (whole * 10 + std::min(10.0, length - whole * 15)), kAreaError);
}

TEST(SvgStroke, dashesOfACurveAddUpToItsLength) {
    // Quarter-like cubic; dashes and gaps swapped cover it exactly once.
    const std::string d = "M10 90C10 40 40 10 90 10";
    const double on = area(load(stroke(d, "stroke-width='2' stroke-dasharray='7 3'")));
    const double off = area(load(stroke(d, "stroke-width='2' stroke-dasharray='0 7 3 0'")));
    const double all = area(load(stroke(d, "stroke-width='2'")));
    EXPECT_NEAR(on + off, all, kAreaError);
    EXPECT_GT(on, off);
}

TEST(SvgStroke, zeroLengthDashesAreDots) {
    const Scene s = load(stroke("M10 50H85", "stroke-width='6' stroke-linecap='round' stroke-dasharray='0 20'"));
    EXPECT_NEAR(area(s), 4 * 9 * kPi, kAreaError);
}

TEST(SvgStroke, dashThroughTheStartOfAClosedPathIsJoined) {
    // Perimeter 160, dashes of 30 and gaps of 50 from 15 before the corner: the corner is inside a dash.
    const Scene s = load("<rect x='20' y='20' width='40' height='40' fill='none' stroke='#000' stroke-width='10' "
                         "stroke-dasharray='30 50' stroke-dashoffset='15'/>");
    EXPECT_NEAR(area(s), 2 * 30 * 10, kAreaError) << "with a miter a bent dash has the area of a straight one";
}

TEST(SvgStroke, pathLengthScalesDashes) {
    const Scene s = load(stroke("M10 50H90", "stroke-width='4' stroke-dasharray='1' pathLength='8'"));
    EXPECT_NEAR(area(s), 4 * 40, kAreaError);
    EXPECT_EQ(s.segments.size(), 16u);
}

TEST(SvgStroke, nonUniformScaleIsAppliedAfterStroking) {
    const Scene s = load("<g transform='scale(1 3)'>" + stroke("M20 15H80", "stroke-width='4'") + "</g>");
    EXPECT_NEAR(area(s), 60 * 12, kAreaError);
    const Scene fixed = load("<g transform='scale(1 3)'>" +
                             stroke("M20 15H80", "stroke-width='4' vector-effect='non-scaling-stroke'") + "</g>");
    EXPECT_NEAR(area(fixed), 60 * 4, kAreaError);
}

TEST(SvgStroke, cubicOutlineStaysWithinTolerance) {
    const std::string d = "M10 80C30 0 70 0 90 80";
    const Scene line = load("<path d='" + d + "' fill='#000'/>");
    const Scene s = load(stroke(d, "stroke-width='8'"));
    const GroundTruth axis(line), outline(s);
    const double unit = static_cast<double>(s.extent.lattice_w) / s.extent.width;
    // Every outline curve point is half a width from the axis (caps aside).
    int checked = 0;
    for (const Segment& segment : s.segments) {
        if (segment.degree == 1) continue;
        for (int i = 0; i <= 20; ++i) {
            CanvasPoint ignored;
            const CanvasPoint p = at(segment, i / 20.0, ignored);
            if (p.y > 74 * unit) continue; // the closing line of the fill is an edge of `axis` as well
            EXPECT_NEAR(axis.distance_to_curves(p.x, p.y), 4 * unit, budget::kStrokeTolerance + budget::kMergeDistance);
            ++checked;
        }
    }
    EXPECT_GT(checked, 100);
    EXPECT_LT(s.segments.size(), 80u) << "not hundreds of pieces for one curve";
}

/// A random path of cubics and lines as `d`, and points along it 0.02 apart or closer.
struct RandomPath {
    std::string d;
    std::vector<CanvasPoint> samples;
};

RandomPath random_path(std::mt19937& random) {
    std::uniform_real_distribution<double> coordinate(25, 75);
    const auto point = [&] { return CanvasPoint{std::round(coordinate(random)), std::round(coordinate(random))}; };
    const auto text = [](CanvasPoint p) { return std::to_string(p.x) + " " + std::to_string(p.y) + " "; };
    RandomPath path;
    CanvasPoint p0 = point();
    const CanvasPoint start = p0;
    path.d = "M" + text(p0);
    const auto curve = [&](CanvasPoint p1, CanvasPoint p2, CanvasPoint p3) {
        for (int i = 0; i <= 5000; ++i) {
            const double t = i / 5000.0, u = 1 - t, a = u * u * u, b = 3 * u * u * t, c = 3 * u * t * t, e = t * t * t;
            path.samples.push_back(
                {a * p0.x + b * p1.x + c * p2.x + e * p3.x, a * p0.y + b * p1.y + c * p2.y + e * p3.y});
        }
        p0 = p3;
    };
    const int count = 1 + static_cast<int>(random() % 3);
    for (int k = 0; k < count; ++k) {
        const CanvasPoint p1 = point(), p2 = point(), p3 = point();
        const bool line = random() % 4 == 0;
        path.d += line ? "L" + text(p3) : "C" + text(p1) + text(p2) + text(p3);
        line ? curve(p0, p3, p3) : curve(p1, p2, p3);
    }
    if (random() % 3 == 0) {
        path.d += "z";
        curve(p0, start, start);
    }
    return path;
}

TEST(SvgStroke, roundStrokeIsEveryPointNearThePath) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> coordinate(0, 100);
    long wrong = 0, checked = 0;
    for (int k = 0; k < 150; ++k) {
        const RandomPath path = random_path(random);
        const double width = std::array{2.0, 8.0, 20.0, 45.0}[static_cast<std::size_t>(k % 4)];
        const Scene scene = load(stroke(path.d, "stroke-linecap='round' stroke-linejoin='round' stroke-width='" +
                                                    std::to_string(width) + "'"));
        const GroundTruth truth(scene);
        const double unit = static_cast<double>(scene.extent.lattice_w) / 100;
        for (int i = 0; i < 300; ++i) {
            const double x = coordinate(random), y = coordinate(random);
            double nearest = INFINITY;
            for (const CanvasPoint& s : path.samples)
                nearest = std::min(nearest, (s.x - x) * (s.x - x) + (s.y - y) * (s.y - y));
            nearest = std::sqrt(nearest);
            if (std::abs(nearest - width / 2) < 0.05) continue; // too near the border for the samples
            const bool inside = !truth.inside(x * unit, y * unit).empty();
            ++checked;
            if (inside == (nearest < width / 2)) continue;
            ++wrong;
            if (wrong < 20)
                ADD_FAILURE() << path.d << " width " << width << " at " << x << " " << y << ": "
                              << (inside ? "inside" : "outside") << ", distance " << nearest;
        }
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(checked, 40000);
}

TEST(SvgStroke, collinearCubicIsLines) {
    EXPECT_TRUE(only_lines(load(stroke("M20 50C40 50 60 50 80 50", "stroke-width='6'"))));
    // Control points beyond the ends: the curve turns back.
    const Scene s = load(stroke("M40 50C120 50 -20 50 60 50", "stroke-width='6'"));
    EXPECT_TRUE(only_lines(s));
    EXPECT_NEAR(sampled_area(s), 6 * 31.34, 0.6);
}

TEST(SvgArc, circleStaysWithinAStep) {
    const Scene s = load("<circle cx='50' cy='50' r='40'/>");
    const double unit = static_cast<double>(s.extent.lattice_w) / 100, c = 50 * unit, r = 40 * unit;
    for (const Segment& segment : s.segments)
        for (int i = 0; i <= 50; ++i) {
            CanvasPoint ignored;
            const CanvasPoint p = at(segment, i / 50.0, ignored);
            // One step for the curve, one for rounding its control points.
            EXPECT_NEAR(std::hypot(p.x - c, p.y - c), r, 2 * budget::kArcTolerance);
        }
    EXPECT_LE(s.segments.size(), 24u);
}

TEST(SvgArc, pathArcOfAnEllipse) {
    const Scene s = load("<path transform='rotate(20 50 50)' d='M20 50A30 15 0 0 1 80 50A30 15 0 0 1 20 50z'/>");
    EXPECT_NEAR(area(s), kPi * 30 * 15, kAreaError);
}

TEST(SvgArc, coordinatesKeepDoublePrecision) {
    // In f32 the second square would lie up to a quarter unit off.
    const std::string svg = "<svg xmlns='http://www.w3.org/2000/svg' width='100' height='100' "
                            "viewBox='4470000.125 445000.0625 100 100'>"
                            "<rect x='4470010.375' y='445010.3125' width='20.5' height='20.25'/></svg>";
    std::vector<Diagnostic> d;
    const Result<Scene> scene = load_svg({reinterpret_cast<const std::uint8_t*>(svg.data()), svg.size()}, {}, d);
    ASSERT_TRUE(scene.ok());
    const double unit = static_cast<double>(scene.value().extent.lattice_w) / 100;
    double x0 = INFINITY, x1 = -INFINITY;
    for (const Segment& s : scene.value().segments) {
        x0 = std::min(x0, static_cast<double>(s.p[0].x) / unit);
        x1 = std::max(x1, static_cast<double>(s.p[0].x) / unit);
    }
    EXPECT_NEAR(x0, 10.25, 1e-5);
    EXPECT_NEAR(x1, 30.75, 1e-5);
}

} // namespace
} // namespace fetexc
