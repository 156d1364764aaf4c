// SPDX-License-Identifier: GPL-3.0-or-later
/// Area sampling on textures made by hand, where the area is known without it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "formats/validate.h"
#include "tests/support/fbt_maker.h"

namespace fetex {
namespace {

using fetexc::test::append_directory;
using fetexc::test::append_list;
using fetexc::test::append_patch;
using fetexc::test::MadeRegion;
using fetexc::test::MadeRun;
using fetexc::test::shaded_texel;
using fetexc::test::solid_texel;

constexpr std::uint32_t kRed = 0xff0000ff, kGreen = 0xff00ff00, kBlue = 0xffff0000;
/// Points are rounded to 2^-16 texel; a pixel of these tests is at least 1/8.
constexpr double kRounding = 8 * 0x1p-16;

struct P {
    double x, y;
};

MadeRun run(std::uint32_t degree, std::uint32_t direction, const std::vector<P>& points, std::uint32_t inside,
            std::uint32_t depth = 0) {
    MadeRun out{degree,
                direction,
                static_cast<std::uint32_t>(points.size() - 1) / degree,
                {},
                0,
                true,
                {kFbtModelSolid, inside}};
    out.depth = depth;
    for (const P& p : points)
        out.points.push_back(fbt_pack_point(p.x, p.y));
    return out;
}

std::uint32_t single(FbtTexture& t, const std::vector<MadeRun>& runs, std::uint32_t rest) {
    return kFbtKindSingle << 30 | append_list(t.records, runs, {kFbtModelSolid, rest});
}

FbtTexture finished(FbtTexture t) {
    t.traits = fbt_traits(t);
    const auto findings = validate_fbt(t);
    EXPECT_TRUE(findings.empty()) << finding_id(findings[0].code) << " " << findings[0].message;
    return t;
}

/// One texel.
FbtTexture texture_of(const std::vector<MadeRun>& runs, std::uint32_t rest) {
    FbtTexture t;
    t.width = t.height = 1;
    t.texels = {single(t, runs, rest)};
    return finished(std::move(t));
}

void expect_color(const FbtColor& c, double r, double g, double b, double tolerance = kRounding) {
    EXPECT_NEAR(c.r, r, tolerance);
    EXPECT_NEAR(c.g, g, tolerance);
    EXPECT_NEAR(c.b, b, tolerance);
    EXPECT_NEAR(c.a, 1, tolerance);
}

TEST(Area, ofALineIsExact) {
    // x = 1/4 + y/2, red on its left; under each of its two rays.
    for (const std::uint32_t direction : {kFbtRayPosX, kFbtRayNegX}) {
        const bool left = direction == kFbtRayPosX;
        const FbtTexture t =
            texture_of({run(1, direction, {{0.25, 0}, {0.75, 1}}, left ? kRed : kBlue)}, left ? kBlue : kRed);
        expect_color(fbt_sample_area(t, 0.5, 0.5, {0.25, 0.25}), 0.5, 0, 0.5);
        expect_color(fbt_sample_area(t, 0.5, 0.5, {0.5, 0.5}), 0.5, 0, 0.5);
        // x from 1/4 to 1/2, y from 1/4 to 1/2: the line goes from 3/8 to 1/2.
        expect_color(fbt_sample_area(t, 0.375, 0.375, {0.125, 0.125}), 0.75, 0, 0.25);
        // Cut by the pixel's left side: x from 3/8, y from 0 to 1/2: a triangle of height 1/4 and width 1/8.
        expect_color(fbt_sample_area(t, 0.625, 0.25, {0.25, 0.25}), 1.0 / 16, 0, 15.0 / 16);
        expect_color(fbt_sample_area(t, 0.1, 0.9, {0.05, 0.05}), 1, 0, 0);
        expect_color(fbt_sample_area(t, 0.9, 0.1, {0.05, 0.05}), 0, 0, 1);
    }
}

TEST(Area, ofLinesUnderVerticalRaysIsExact) {
    for (const std::uint32_t direction : {kFbtRayPosY, kFbtRayNegY}) {
        const bool above = direction == kFbtRayPosY;
        const FbtTexture t =
            texture_of({run(1, direction, {{0, 0.25}, {1, 0.75}}, above ? kRed : kBlue)}, above ? kBlue : kRed);
        expect_color(fbt_sample_area(t, 0.375, 0.375, {0.125, 0.125}), 0.75, 0, 0.25);
        expect_color(fbt_sample_area(t, 0.25, 0.625, {0.25, 0.25}), 1.0 / 16, 0, 15.0 / 16);
    }
}

TEST(Area, ofACornerIsExact) {
    // A right angle at (1/2,1/2) that opens to the left.
    const FbtTexture t = texture_of({run(1, kFbtRayPosX, {{0, 0}, {0.5, 0.5}, {0, 1}}, kRed)}, kBlue);
    expect_color(fbt_sample_area(t, 0.5, 0.5, {0.5, 0.5}), 0.25, 0, 0.75);
    expect_color(fbt_sample_area(t, 0.5, 0.5, {0.125, 0.125}), 0.25, 0, 0.75);
    expect_color(fbt_sample_area(t, 0.375, 0.5, {0.125, 0.125}), 0.75, 0, 0.25);
}

TEST(Area, ofAHairlineIsItsWidth) {
    // 1/64 texel wide, between two features each around the other: left of the right line, less left of the left one.
    const FbtTexture t = texture_of({run(1, kFbtRayPosX, {{0.5, 0}, {0.5, 1}}, kBlue, 1),
                                     run(1, kFbtRayPosX, {{0.5 + 1.0 / 64, 0}, {0.5 + 1.0 / 64, 1}}, kRed, 0)},
                                    kBlue);
    expect_color(fbt_sample_area(t, 0.5, 0.5, {0.125, 0.125}), 1.0 / 16, 0, 15.0 / 16);
    expect_color(fbt_sample_area(t, 0.3, 0.5, {0.125, 0.125}), 0, 0, 1);
}

/// A disc of four cubic quarters: the pixel around it, and one that cuts it.
TEST(Area, ofADiscIsItsArea) {
    constexpr double kR = 0.25, kH = kR * 0.5522847498307936;
    const std::vector<P> quarters = {{0.75, 0.5},      {0.75, 0.5 + kH}, {0.5 + kH, 0.75}, {0.5, 0.75},
                                     {0.5 - kH, 0.75}, {0.25, 0.5 + kH}, {0.25, 0.5},      {0.25, 0.5 - kH},
                                     {0.5 - kH, 0.25}, {0.5, 0.25},      {0.5 + kH, 0.25}, {0.75, 0.5 - kH},
                                     {0.75, 0.5}};
    for (const std::uint32_t direction : {kFbtRayPosX, kFbtRayNegX, kFbtRayPosY, kFbtRayNegY}) {
        const FbtTexture t = texture_of({run(3, direction, quarters, kRed)}, kBlue);
        constexpr double kBezierArea = 3e-4; // the cubics' against a circle's
        const double disc = std::numbers::pi * kR * kR;
        expect_color(fbt_sample_area(t, 0.5, 0.5, {0.5, 0.5}), disc, 0, 1 - disc, kBezierArea);
        expect_color(fbt_sample_area(t, 0.75, 0.75, {0.25, 0.25}), disc, 0, 1 - disc, kBezierArea); // a quarter of it
        // The half beyond x = 5/8: a segment of half angle 60 degrees.
        const double segment = kR * kR * (std::numbers::pi / 3 - std::sqrt(3.0) / 4);
        expect_color(fbt_sample_area(t, 0.8125, 0.5, {0.1875, 0.5}), segment / 0.375, 0, 1 - segment / 0.375,
                     kBezierArea);
    }
}

TEST(Area, ofAParabolaIsExact) {
    // x = y^2: red on its left; under it lies a third.
    const FbtTexture t = texture_of({run(2, kFbtRayPosX, {{0, 0}, {0, 0.5}, {1, 1}}, kRed)}, kBlue);
    expect_color(fbt_sample_area(t, 0.5, 0.5, {0.5, 0.5}), 1.0 / 3, 0, 2.0 / 3);
    // x from 1/4 to 3/4, y from 1/4 to 3/4: from y = 1/2 on, y^2 - 1/4.
    expect_color(fbt_sample_area(t, 0.5, 0.5, {0.25, 0.25}), 4 * (0.421875 / 3 - 0.125 / 3 - 0.0625), 0,
                 1 - 4 * (0.421875 / 3 - 0.125 / 3 - 0.0625));
}

/// A region between others is never blended with what lies behind both: no seams.
TEST(Area, neighboursLeaveNoSeam) {
    // Left of 3/8 red, from there to 5/8 green, then blue; a pixel over the first line knows nothing of blue.
    const FbtTexture t = texture_of({run(1, kFbtRayPosX, {{0.375, 0}, {0.375, 1}}, kRed, 1),
                                     run(1, kFbtRayPosX, {{0.625, 0}, {0.625, 1}}, kGreen, 0)},
                                    kBlue);
    expect_color(fbt_sample_area(t, 0.375, 0.5, {0.125, 0.125}), 0.5, 0.5, 0);
    expect_color(fbt_sample_area(t, 0.625, 0.5, {0.125, 0.125}), 0, 0.5, 0.5);
    expect_color(fbt_sample_area(t, 0.5, 0.5, {0.25, 0.25}), 0.25, 0.5, 0.25);
}

/// Siblings: two corners cut off, both inside a third feature.
TEST(Area, siblingsAddUp) {
    const FbtTexture t = texture_of({run(1, kFbtRayPosX, {{0, 0.25}, {0.25, 0}}, kRed, 1),
                                     run(1, kFbtRayPosX, {{0, 0.75}, {0.25, 1}}, kRed, 1),
                                     run(1, kFbtRayPosX, {{0.5, 0}, {0.5, 1}}, kGreen, 0)},
                                    kBlue);
    expect_color(fbt_sample_area(t, 0.5, 0.5, {0.5, 0.5}), 2 / 32.0, 0.5 - 2 / 32.0, 0.5);
}

TEST(Area, depthsBeyondTheLastAreTakenForNested) {
    std::vector<MadeRun> runs;
    for (std::uint32_t k = 0; k < 12; ++k) {
        const double x = (k + 1) / 13.0;
        runs.push_back(
            run(1, kFbtRayPosX, {{x, 0}, {x, 1}}, k % 2 == 0 ? kRed : kBlue, std::min(11 - k, kFbtMaxDepth)));
    }
    const FbtTexture t = texture_of(runs, kRed);
    expect_color(fbt_sample_area(t, 0.5, 0.5, {0.5, 0.5}), 7.0 / 13, 0, 6.0 / 13, 1e-4);
}

TEST(Area, goesThroughTheBands) {
    FbtTexture t;
    t.width = t.height = 1;
    const std::uint32_t upper =
        append_list(t.records, {run(1, kFbtRayPosX, {{0.25, 0}, {0.25, 0.5}}, kRed)}, {0, kBlue});
    const std::uint32_t lower = append_list(t.records, {}, {0, kGreen});
    t.texels = {kFbtKindBanded << 30 |
                append_directory(t.records, {{fbt_quantise(0.5), upper}, {fbt_quantise(1), lower}})};
    t = finished(std::move(t));
    expect_color(fbt_sample_area(t, 0.25, 0.5, {0.25, 0.25}), 0.25, 0.5, 0.25);
    expect_color(fbt_sample_area(t, 0.5, 0.5, {0.5, 0.5}), 0.125, 0.5, 0.375);
    expect_color(fbt_sample_area(t, 0.25, 0.75, {0.25, 0.25}), 0, 1, 0);
}

/// Texels without features: exact shares; beyond the texture there is nothing.
TEST(Area, sharesAmongPlainTexels) {
    FbtTexture t;
    t.width = 2, t.height = 2;
    t.texels = {solid_texel(kRed), solid_texel(kGreen), solid_texel(kBlue),
                shaded_texel({kFbtModelPatch, append_patch(t.records, 0, 0, 0, 0)})};
    t = finished(std::move(t));
    const FbtColor c = fbt_sample_area(t, 0.9, 1.1, {0.25, 0.5});
    EXPECT_NEAR(c.r, 0.7 * 0.4, 1e-12);
    EXPECT_NEAR(c.g, 0.3 * 0.4, 1e-12);
    EXPECT_NEAR(c.b, 0.7 * 0.6, 1e-12);
    EXPECT_NEAR(c.a, 1 - 0.3 * 0.6, 1e-12);
    expect_color(fbt_sample_area(t, 0, 0, {0.5, 0.5}), 1, 0, 0, 1e-12);
    expect_color(fbt_sample_area(t, -3, 0, {0.5, 0.5}), 1, 0, 0, 1e-12);
}

/// A feature texel between plain ones: its own part is exact, and so are theirs.
TEST(Area, isExactBesidePlainTexels) {
    FbtTexture t;
    t.width = 3, t.height = 1;
    const std::uint32_t features = single(t, {run(1, kFbtRayPosX, {{0.25, 0}, {0.75, 1}}, kRed)}, kBlue);
    t.texels = {solid_texel(kGreen), features, solid_texel(kBlue)};
    t = finished(std::move(t));
    for (const bool exact : {false, true}) {
        // From inside the green texel and from inside the other: the same pixel but for a step.
        for (const double x : {1 - 1e-9, 1 + 1e-9}) {
            const FbtColor c = fbt_sample_area(t, x, 0.5, {0.5, 0.5, exact});
            expect_color(c, 0.5 * 0.875, 0.5, 0.5 * 0.125, 1e-4);
        }
    }
}

/// A line through two feature texels: one speaks for both, and its line goes on as the other has it.
TEST(Area, linesGoOnBeyondTheTexel) {
    FbtTexture t;
    t.width = 2, t.height = 1;
    t.texels = {0, 0};
    t.texels[0] = single(t, {run(1, kFbtRayPosY, {{0, 0.25}, {1, 0.5}}, kRed)}, kBlue);
    t.texels[1] = single(t, {run(1, kFbtRayPosY, {{0, 0.5}, {1, 0.75}}, kRed)}, kBlue);
    t = finished(std::move(t));
    for (const double x : {0.8, 0.95, 1.0, 1.1, 1.2}) {
        const double y = 0.25 + 0.25 * x;
        expect_color(fbt_sample_area(t, x, y, {0.25, 0.25}), 0.5, 0, 0.5, 1e-4);
        expect_color(fbt_sample_area(t, x, y, {0.25, 0.25, true}), 0.5, 0, 0.5, 1e-4);
    }
}

/// A corner on the border of two texels: only looking at both gets it right.
TEST(Area, exactLooksAtEveryTexel) {
    FbtTexture t;
    t.width = 2, t.height = 1;
    t.texels = {0, 0};
    t.texels[0] = single(t, {run(1, kFbtRayPosY, {{0, 0}, {1, 0.5}}, kRed)}, kBlue);
    t.texels[1] = single(t, {run(1, kFbtRayPosY, {{0, 0.5}, {1, 0}}, kRed)}, kBlue);
    t = finished(std::move(t));
    expect_color(fbt_sample_area(t, 1, 0.5, {0.5, 0.5, true}), 0.375, 0, 0.625, 1e-4);
    expect_color(fbt_sample_area(t, 1, 0.5, {0.5, 0.5}), 0.5, 0, 0.5, 1e-4); // as if it went on straight
}

/// Pixels of no size are of the least: the colour of the point, but beside an edge.
TEST(Area, ofNothingIsThePoint) {
    const FbtTexture t = texture_of({run(1, kFbtRayPosX, {{0.5, 0}, {0.5, 1}}, kRed)}, kBlue);
    for (const double half : {0.0, 1e-300, 1e-12, -1.0}) {
        expect_color(fbt_sample_area(t, 0.4999, 0.3, {half, half}), 1, 0, 0);
        expect_color(fbt_sample_area(t, 0.5001, 0.3, {half, half, true}), 0, 0, 1);
    }
    expect_color(fbt_sample_area(t, 0.5, 0.5, {7, 7}), 0.5, 0, 0.5);
}

TEST(Area, ofGradientsIsTheirMiddle) {
    FbtTexture t;
    t.width = 1, t.height = 1;
    t.corners = {0xff000000, 0xff0000ff, 0xff000000, 0xff0000ff};
    t.texels = {shaded_texel({kFbtModelCorners, 0})};
    t = finished(std::move(t));
    expect_color(fbt_sample_area(t, 0.4, 0.5, {0.25, 0.25}), 0.4, 0, 0, 1e-12);
}

} // namespace
} // namespace fetex
