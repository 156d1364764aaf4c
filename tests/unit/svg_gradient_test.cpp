// SPDX-License-Identifier: GPL-3.0-or-later
/// Hard gradient edges become geometry, and nothing else about a gradient changes.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "compiler/diagnostics.h"
#include "compiler/scene/ground_truth.h"
#include "compiler/scene/paint.h"
#include "compiler/svg/gradient.h"
#include "compiler/svg/svg.h"

namespace fetexc {
namespace {

using svg::Band;
using svg::Box;
using svg::Gradient;

constexpr Rgba kRed{1, 0, 0, 1}, kGreen{0, 1, 0, 1}, kBlue{0, 0, 1, 1};
constexpr Box kCanvas{0, 0, 100, 100};

Gradient linear(std::vector<GradientStop> stops, Spread spread = Spread::Pad) {
    Gradient g;
    g.x1 = 20;
    g.x2 = 60;
    g.y2 = 30;
    g.stops = std::move(stops);
    g.spread = spread;
    return g;
}

Gradient radial(std::vector<GradientStop> stops, Spread spread = Spread::Pad) {
    Gradient g;
    g.radial = true;
    g.cx = 45;
    g.cy = 50;
    g.r = 30;
    g.fx = 55;
    g.fy = 45;
    g.fr = 4;
    g.stops = std::move(stops);
    g.spread = spread;
    return g;
}

const std::vector<GradientStop> kHard{{0, kRed}, {0.3, kGreen}, {0.3, kBlue}, {0.8, kRed}, {0.8, kGreen}, {1, kGreen}};

bool paint_has_jump(const Paint& paint) {
    const auto jump = [](const std::vector<GradientStop>& stops) {
        for (std::size_t i = 1; i < stops.size(); ++i)
            if (stops[i].offset == stops[i - 1].offset && !(stops[i].color == stops[i - 1].color)) return true;
        return false;
    };
    if (const auto* p = std::get_if<LinearPaint>(&paint)) return jump(p->stops) || p->spread != Spread::Pad;
    if (const auto* p = std::get_if<RadialPaint>(&paint)) return jump(p->stops) || p->spread != Spread::Pad;
    return false;
}

/// Scene of a canvas-sized rectangle for each band, clipped to it: built like the front end does.
Scene scene_of(const std::vector<Band>& bands) {
    SceneBuilder builder(100, 100);
    const auto line = [](double x0, double y0, double x1, double y1) {
        return CanvasSegment{1, {{{x0, y0}, {x1, y1}}}};
    };
    const CanvasContour rect{line(0, 0, 100, 0), line(100, 0, 100, 100), line(100, 100, 0, 100), line(0, 100, 0, 0)};
    const std::uint32_t all = builder.add_shape({rect}, FillRule::NonZero, kNone);
    for (const Band& band : bands) {
        const std::uint32_t region = builder.add_shape(band.region, band.rule, kNone);
        builder.scene().clips.push_back({{{region, kNone}}, kNone});
        builder.scene().paints.push_back(band.paint);
        Node node;
        node.shape = all;
        node.paint = static_cast<std::uint32_t>(builder.scene().paints.size() - 1);
        node.clip = static_cast<std::uint32_t>(builder.scene().clips.size() - 1);
        node.end = static_cast<std::uint32_t>(builder.scene().nodes.size() + 1);
        builder.scene().nodes.push_back(node);
    }
    builder.scene().root_end = static_cast<std::uint32_t>(builder.scene().nodes.size());
    Result<Scene> scene = builder.finish();
    EXPECT_TRUE(scene.ok());
    return std::move(scene.value());
}

double difference(const Rgba& a, const Rgba& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b), std::abs(a.a - b.a)});
}

/// The banded scene shows the gradient itself, except where a sample falls within rounding of a jump.
void expect_same_picture(const Gradient& g) {
    const std::vector<Band> bands = svg::bands_of(g, kCanvas, kCanvas, 1000);
    ASSERT_FALSE(bands.empty());
    for (const Band& band : bands)
        EXPECT_FALSE(paint_has_jump(band.paint));
    const Scene scene = scene_of(bands);
    const GroundTruth truth(scene);
    const Paint whole = svg::as_paint(g);
    const double unit = static_cast<double>(scene.extent.lattice_w) / 100;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> coordinate(0, 100);
    int wrong = 0;
    for (int i = 0; i < 20000; ++i) {
        const double x = coordinate(random), y = coordinate(random);
        const Rgba expected = paint_color(whole, {x, y}), got = truth.color_at(x * unit, y * unit);
        if (difference(expected, got) > 1e-3 && truth.distance_to_curves(x * unit, y * unit) > 128) ++wrong;
    }
    EXPECT_EQ(wrong, 0);
}

TEST(GradientBands, linearPad) { expect_same_picture(linear(kHard)); }
TEST(GradientBands, linearRepeat) { expect_same_picture(linear(kHard, Spread::Repeat)); }
TEST(GradientBands, linearReflect) { expect_same_picture(linear(kHard, Spread::Reflect)); }
TEST(GradientBands, radialPad) { expect_same_picture(radial(kHard)); }
TEST(GradientBands, radialRepeat) { expect_same_picture(radial(kHard, Spread::Repeat)); }
TEST(GradientBands, radialReflect) { expect_same_picture(radial(kHard, Spread::Reflect)); }

TEST(GradientBands, skewedGradientSpace) {
    Gradient g = linear(kHard, Spread::Repeat);
    g.canvas_to_gradient = {0.7, 0.4, -0.9, 1.3, 5, -8};
    expect_same_picture(g);
    Gradient r = radial(kHard, Spread::Repeat);
    r.canvas_to_gradient = {0.7, 0.4, -0.9, 1.3, 30, 0};
    expect_same_picture(r);
}

TEST(GradientBands, repeatOfASmoothGradientJumpsAtItsEnds) {
    const std::vector<GradientStop> smooth{{0.1, kRed}, {0.9, kBlue}};
    EXPECT_FALSE(svg::has_hard_edges(linear(smooth)));
    EXPECT_FALSE(svg::has_hard_edges(linear(smooth, Spread::Reflect)));
    EXPECT_TRUE(svg::has_hard_edges(linear(smooth, Spread::Repeat)));
    EXPECT_FALSE(svg::has_hard_edges(linear({{0, kRed}, {0.5, kBlue}, {1, kRed}}, Spread::Repeat)));
    expect_same_picture(linear(smooth, Spread::Repeat));
    expect_same_picture(radial(smooth, Spread::Repeat));
}

TEST(GradientBands, jumpsAtTheVeryEnds) {
    // Outside of [0,1] the first and the last colour hold (SVG 2 §14.2.2), however short their own stretch is.
    const std::vector<GradientStop> stops{{0, kRed}, {0, kGreen}, {1, kGreen}, {1, kBlue}};
    Gradient g = linear(stops);
    g.x1 = 30;
    g.x2 = 60;
    g.y2 = 0;
    const Scene strips = scene_of(svg::bands_of(g, kCanvas, kCanvas, 100));
    const double unit = static_cast<double>(strips.extent.lattice_w) / 100;
    const GroundTruth truth(strips);
    EXPECT_EQ(truth.color_at(29.9 * unit, 50 * unit), kRed);
    EXPECT_EQ(truth.color_at(30.1 * unit, 50 * unit), kGreen);
    EXPECT_EQ(truth.color_at(59.9 * unit, 50 * unit), kGreen);
    EXPECT_EQ(truth.color_at(60.1 * unit, 50 * unit), kBlue);
    const Scene rings = scene_of(svg::bands_of(radial(stops), kCanvas, kCanvas, 100));
    const GroundTruth ring(rings);
    EXPECT_EQ(ring.color_at(55 * unit, 45 * unit), kRed) << "inside the focal circle";
    EXPECT_EQ(ring.color_at(45 * unit, 60 * unit), kGreen);
    EXPECT_EQ(ring.color_at(5 * unit, 5 * unit), kBlue);
}

TEST(GradientBands, tooManyOrNotNestedGiveNothing) {
    Gradient fine = linear(kHard, Spread::Repeat);
    fine.x2 = 20.001;
    fine.y2 = 0;
    EXPECT_TRUE(svg::bands_of(fine, kCanvas, kCanvas, 256).empty());
    Gradient cone = radial(kHard);
    cone.fx = 120;
    EXPECT_TRUE(svg::bands_of(cone, kCanvas, kCanvas, 256).empty());
}

TEST(GradientStops, parserNudgesBecomeHardEdges) {
    const auto stops = svg::normalised_stops({{0, kRed}, {0.49999988, kRed}, {0.5, kBlue}, {0.4, kGreen}, {1.5, kRed}});
    ASSERT_EQ(stops.size(), 4u) << "of three at one offset the middle one goes";
    EXPECT_EQ(stops[1].offset, stops[2].offset);
    EXPECT_EQ(stops[2].color, kGreen);
    EXPECT_EQ(stops[3].offset, 1);
}

TEST(GradientPaint, degenerateCases) {
    Gradient point = linear({{0, kRed}, {1, kBlue}});
    point.x2 = point.x1;
    point.y2 = point.y1;
    EXPECT_EQ(std::get<SolidPaint>(svg::as_paint(point)).color, kBlue) << "the last stop's colour";
    EXPECT_EQ(std::get<SolidPaint>(svg::as_paint(linear({{0.3, kGreen}}))).color, kGreen);
    EXPECT_TRUE(std::holds_alternative<LinearPaint>(svg::as_paint(linear({{0, kRed}, {1, kBlue}}))));
}

// ---- through the whole front end ----

Result<Scene> load(const std::string& body, std::vector<Diagnostic>& diagnostics) {
    const std::string svg = "<svg xmlns='http://www.w3.org/2000/svg' width='100' height='100'>" + body + "</svg>";
    return load_svg({reinterpret_cast<const std::uint8_t*>(svg.data()), svg.size()}, {}, diagnostics);
}

TEST(SvgGradient, hardStopIsAnEdgeOfTheScene) {
    std::vector<Diagnostic> d;
    const Result<Scene> scene =
        load("<linearGradient id='a'><stop offset='.5' stop-color='#f00'/><stop offset='.5' "
             "stop-color='#00f'/></linearGradient><rect width='100' height='100' fill='url(#a)'/>",
             d);
    ASSERT_TRUE(scene.ok());
    EXPECT_TRUE(d.empty());
    const GroundTruth truth(scene.value());
    const double half = static_cast<double>(scene.value().extent.lattice_w) / 2;
    EXPECT_EQ(truth.color_at(half - 70, half), kRed);
    EXPECT_EQ(truth.color_at(half + 70, half), kBlue);
    EXPECT_LT(truth.distance_to_curves(half + 0.25, half), 1.5);
    for (const Paint& paint : scene.value().paints)
        EXPECT_TRUE(std::holds_alternative<SolidPaint>(paint));
}

TEST(SvgGradient, manyShapesShareOneSetOfBands) {
    std::vector<Diagnostic> d;
    std::string body = "<linearGradient id='a' gradientUnits='userSpaceOnUse' x2='100'><stop offset='.5' "
                       "stop-color='#f00'/><stop offset='.5' stop-color='#00f'/></linearGradient><g fill='url(#a)'>";
    for (int i = 0; i < 10; ++i)
        body += "<rect x='10' y='" + std::to_string(10 * i) + "' width='80' height='5'/>";
    const Result<Scene> scene = load(body + "</g>", d);
    ASSERT_TRUE(scene.ok());
    EXPECT_EQ(scene.value().shapes.size(), 12u);
}

TEST(SvgGradient, tooManyBandsAreReported) {
    std::vector<Diagnostic> d;
    const Result<Scene> scene =
        load("<linearGradient id='a' x2='.0001' spreadMethod='repeat'><stop stop-color='#f00'/><stop "
             "offset='1' stop-color='#00f'/></linearGradient><rect id='box' width='100' "
             "height='100' fill='url(#a)'/>",
             d);
    ASSERT_TRUE(scene.ok());
    ASSERT_EQ(d.size(), 1u);
    EXPECT_EQ(d[0].code, diag::kSvgGradientBands);
    EXPECT_EQ(d[0].place, "rect#box");
}

} // namespace
} // namespace fetexc
