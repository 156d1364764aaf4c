// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "compiler/scene/blend.h"
#include "compiler/scene/paint.h"
#include "compiler/scene/stack.h"

namespace fetexc {
namespace {

constexpr double kTiny = 1e-12;

void expect_color(const Rgba& actual, const Rgba& expected, double tolerance = kTiny) {
    EXPECT_NEAR(actual.r, expected.r, tolerance);
    EXPECT_NEAR(actual.g, expected.g, tolerance);
    EXPECT_NEAR(actual.b, expected.b, tolerance);
    EXPECT_NEAR(actual.a, expected.a, tolerance);
}

// ---- blending: values worked out by hand from W3C Compositing 1 §10 ----

struct SeparableCase {
    Blend mode;
    double backdrop, source, result;
};

TEST(Blend, separableModesGiveTheFormulasValues) {
    const std::vector<SeparableCase> cases{
        {Blend::Normal, 0.3, 0.6, 0.6},       {Blend::Multiply, 0.3, 0.6, 0.18},
        {Blend::Screen, 0.3, 0.6, 0.72},      {Blend::Overlay, 0.3, 0.6, 0.36},
        {Blend::Overlay, 0.8, 0.6, 0.84},     {Blend::Darken, 0.3, 0.6, 0.3},
        {Blend::Lighten, 0.3, 0.6, 0.6},      {Blend::ColorDodge, 0.3, 0.6, 0.75},
        {Blend::ColorDodge, 0.0, 1.0, 0.0},   {Blend::ColorDodge, 0.3, 1.0, 1.0},
        {Blend::ColorDodge, 0.9, 0.6, 1.0},   {Blend::ColorBurn, 0.3, 0.6, 0.0},
        {Blend::ColorBurn, 0.3, 0.8, 0.125},  {Blend::ColorBurn, 1.0, 0.0, 1.0},
        {Blend::ColorBurn, 0.3, 0.0, 0.0},    {Blend::HardLight, 0.3, 0.6, 0.44},
        {Blend::HardLight, 0.3, 0.4, 0.24},   {Blend::SoftLight, 0.3, 0.6, 0.3 + 0.2 * (std::sqrt(0.3) - 0.3)},
        {Blend::SoftLight, 0.2, 0.6, 0.2496}, {Blend::SoftLight, 0.4, 0.25, 0.28},
        {Blend::Difference, 0.3, 0.6, 0.3},   {Blend::Exclusion, 0.3, 0.6, 0.54},
    };
    for (const SeparableCase& c : cases) {
        SCOPED_TRACE(static_cast<int>(c.mode));
        const Rgba b{c.backdrop, c.backdrop, c.backdrop, 1}, s{c.source, c.source, c.source, 1};
        expect_color(blend_over(b, s, c.mode), {c.result, c.result, c.result, 1});
    }
}

TEST(Blend, nonSeparableModesGiveTheFormulasValues) {
    const Rgba red{1, 0, 0, 1}, blue{0, 0, 1, 1}, brick{0.6, 0.4, 0.4, 1};
    expect_color(blend_over(red, blue, Blend::Luminosity), {0.11 / 0.3, 0, 0, 1});
    expect_color(blend_over(red, blue, Blend::Color), {0.3 - 0.11 * 0.7 / 0.89, 0.3 - 0.11 * 0.7 / 0.89, 1, 1});
    expect_color(blend_over(brick, blue, Blend::Hue), {0.438, 0.438, 0.638, 1});
    expect_color(blend_over(brick, blue, Blend::Saturation), {1, 0.46 - 0.3 * 0.54 / 0.7, 0.46 - 0.3 * 0.54 / 0.7, 1});
    const Rgba grey{0.5, 0.5, 0.5, 1};
    expect_color(blend_over(brick, grey, Blend::Saturation),
                 {0.46, 0.46, 0.46, 1}); // no saturation: only luminosity is left
}

TEST(Blend, translucentColoursMixAsTheGeneralFormulaSays) {
    const Rgba backdrop{0.3, 0, 0, 0.5}, source{0, 0.25, 0.25, 0.5};
    expect_color(blend_over(backdrop, source, Blend::Multiply), {0.15, 0.125, 0.125, 0.75});
    expect_color(over(backdrop, source), {0.15, 0.25, 0.25, 0.75});
}

TEST(Blend, everyModeOverTransparentGivesTheSourceAndTransparentSourceChangesNothing) {
    const Rgba color{0.3, 0.1, 0.2, 0.5};
    for (int mode = 0; mode < 16; ++mode) {
        SCOPED_TRACE(mode);
        expect_color(blend_over({}, color, static_cast<Blend>(mode)), color);
        expect_color(blend_over(color, {}, static_cast<Blend>(mode)), color);
    }
}

// ---- gradients ----

const Rgba kRed{1, 0, 0, 1}, kBlue{0, 0, 1, 1};

LinearPaint red_to_blue(Spread spread) {
    LinearPaint paint;
    paint.canvas_to_unit = {0.01, 0, 0, 0.01, 0, 0};
    paint.stops = {{0, kRed}, {1, kBlue}};
    paint.spread = spread;
    return paint;
}

TEST(LinearGradient, spreadsAsNamed) {
    const auto blue_at = [](Spread spread, double x) { return paint_color(red_to_blue(spread), {x, 7}).b; };
    for (const Spread spread : {Spread::Pad, Spread::Reflect, Spread::Repeat})
        expect_color(paint_color(red_to_blue(spread), {25, 3}), {0.75, 0, 0.25, 1});
    EXPECT_NEAR(blue_at(Spread::Pad, 125), 1, kTiny);
    EXPECT_NEAR(blue_at(Spread::Pad, -25), 0, kTiny);
    EXPECT_NEAR(blue_at(Spread::Reflect, 125), 0.75, kTiny);
    EXPECT_NEAR(blue_at(Spread::Reflect, -25), 0.25, kTiny);
    EXPECT_NEAR(blue_at(Spread::Reflect, 225), 0.25, kTiny);
    EXPECT_NEAR(blue_at(Spread::Repeat, 125), 0.25, kTiny);
    EXPECT_NEAR(blue_at(Spread::Repeat, -25), 0.75, kTiny);
}

TEST(LinearGradient, interpolatesStraightColours) {
    LinearPaint paint = red_to_blue(Spread::Pad);
    paint.stops[1].color.a = 0;
    expect_color(paint_color(paint, {50, 0}), {0.25, 0, 0.25, 0.5});
}

TEST(LinearGradient, hardEdgeTakesTheLaterStopFromItsOffsetOn) {
    LinearPaint paint = red_to_blue(Spread::Pad);
    const Rgba green{0, 1, 0, 1};
    paint.stops = {{0.25, kRed}, {0.5, kRed}, {0.5, green}, {0.75, kBlue}};
    expect_color(paint_color(paint, {49.999, 0}), kRed);
    expect_color(paint_color(paint, {50, 0}), green);
    expect_color(paint_color(paint, {62.5, 0}), {0, 0.5, 0.5, 1});
    expect_color(paint_color(paint, {10, 0}), kRed);
    expect_color(paint_color(paint, {90, 0}), kBlue);
}

RadialPaint radial(double fx, double fr) {
    RadialPaint paint;
    paint.cx = paint.cy = paint.r = 50;
    paint.fx = fx;
    paint.fy = 50;
    paint.fr = fr;
    paint.stops = {{0, kRed}, {1, kBlue}};
    return paint;
}

TEST(RadialGradient, parameterIsTheCircleThroughThePoint) {
    EXPECT_NEAR(paint_color(radial(50, 0), {75, 50}).b, 0.5, kTiny);
    EXPECT_NEAR(paint_color(radial(50, 0), {50, 50}).b, 0, kTiny);
    EXPECT_NEAR(paint_color(radial(50, 0), {50, 150}).b, 1, kTiny);
    EXPECT_NEAR(paint_color(radial(30, 0), {90, 50}).b, 6.0 / 7, kTiny);  // right side of the circles: 30 + 70t
    EXPECT_NEAR(paint_color(radial(30, 0), {10, 50}).b, 2.0 / 3, kTiny);  // left side: 30 − 30t
    EXPECT_NEAR(paint_color(radial(30, 10), {90, 50}).b, 5.0 / 6, kTiny); // 40 + 60t
    EXPECT_NEAR(paint_color(radial(30, 10), {30, 50}).b, 0, kTiny);       // inside the start circle, padded
}

TEST(RadialGradient, coneLeavesTheOutsideTransparent) {
    RadialPaint cone;
    cone.cx = 100, cone.r = 10;
    cone.stops = {{0, kRed}, {1, kBlue}};
    expect_color(paint_color(cone, {50, 50}), {});
    EXPECT_NEAR(paint_color(cone, {50, 1}).b, 10980.0 / 19800, kTiny); // (50−100t)² + 1 = (10t)²
    expect_color(paint_color(cone, {-50, 1}), {});                     // the cone's mirror image has negative radii
    EXPECT_FALSE(paint_is_opaque(cone));
}

TEST(RadialGradient, focusOnTheCircleIsLinearInTheEquation) {
    const RadialPaint paint = radial(0, 0); // centre 50t, radius 50t: p² = 100·t·p.x about (0,50)
    EXPECT_NEAR(paint_color(paint, {40, 50}).b, 0.4, kTiny);
    EXPECT_NEAR(paint_color(paint, {20, 60}).b, 500.0 / 2000, kTiny);
    expect_color(paint_color(paint, {-20, 50}), {});
}

TEST(RadialGradient, spreadRepeatsBeyondTheLastCircle) {
    RadialPaint paint = radial(50, 0);
    paint.spread = Spread::Repeat;
    EXPECT_NEAR(paint_color(paint, {50 + 62.5, 50}).b, 0.25, kTiny);
    paint.spread = Spread::Reflect;
    EXPECT_NEAR(paint_color(paint, {50 + 62.5, 50}).b, 0.75, kTiny);
}

TEST(PaintProperties, opaqueConstantAndInvisibleAreToldApart) {
    EXPECT_TRUE(paint_is_opaque(Paint{red_to_blue(Spread::Repeat)}));
    EXPECT_TRUE(paint_is_opaque(Paint{radial(30, 0)}));
    EXPECT_TRUE(paint_is_opaque(Paint{SolidPaint{kRed}}));
    LinearPaint fading = red_to_blue(Spread::Pad);
    fading.stops[0].color.a = 0.5;
    EXPECT_FALSE(paint_is_opaque(Paint{fading}));
    EXPECT_FALSE(constant_color(Paint{fading}).has_value());
    fading.stops[0].color.a = fading.stops[1].color.a = 0;
    EXPECT_TRUE(paint_is_invisible(Paint{fading}));
    RadialPaint same = radial(30, 0);
    same.stops[1].color = kRed;
    ASSERT_TRUE(constant_color(Paint{same}).has_value());
    expect_color(*constant_color(Paint{same}), kRed);
}

// ---- bitmaps ----

RasterPaint two_pixels(bool smooth) {
    RasterPaint paint;
    paint.width = 2, paint.height = 1;
    paint.rgba = {255, 0, 0, 255, 0, 0, 51, 51};
    paint.smooth = smooth;
    return paint;
}

TEST(Raster, interpolatesBetweenPixelCentresAndIsTransparentOutside) {
    expect_color(paint_color(two_pixels(true), {0.5, 0.5}), kRed);
    expect_color(paint_color(two_pixels(true), {0.1, 0.1}), kRed); // edge clamped
    expect_color(paint_color(two_pixels(true), {1.0, 0.5}), {0.5, 0, 0.1, 0.6});
    expect_color(paint_color(two_pixels(true), {1.25, 0.9}), {0.25, 0, 0.15, 0.4});
    expect_color(paint_color(two_pixels(false), {0.99, 0.5}), kRed);
    expect_color(paint_color(two_pixels(false), {1.01, 0.5}), {0, 0, 0.2, 0.2});
    for (const CanvasPoint p : {CanvasPoint{-0.01, 0.5}, {2.01, 0.5}, {1, -0.01}, {1, 1.01}})
        expect_color(paint_color(two_pixels(true), p), {});
}

// ---- masks ----

TEST(MaskValue, usesAlphaOrLuminanceTimesAlpha) {
    const Rgba half_green{0, 0.5, 0, 0.5};
    EXPECT_NEAR(mask_value(false, false, half_green), 0.5, kTiny);
    EXPECT_NEAR(mask_value(true, false, half_green), 0.7152 * 0.5, kTiny);
    EXPECT_NEAR(mask_value(true, false, {1, 1, 1, 1}), 1, kTiny);
    EXPECT_NEAR(mask_value(true, false, {}), 0, kTiny);
    // sRGB 0.5 is linear ((0.5+0.055)/1.055)^2.4 = 0.2140411
    EXPECT_NEAR(mask_value(true, true, {0.5, 0.5, 0.5, 1}), 0.21404114, 1e-7);
}

} // namespace
} // namespace fetexc
