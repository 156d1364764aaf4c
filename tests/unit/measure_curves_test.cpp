// SPDX-License-Identifier: GPL-3.0-or-later
/// What networks of curves should show, and how far textures with feature curves are from it.
#include <gtest/gtest.h>

#include <cmath>

#include "compiler/feature_curves/feature_curves_builder.h"
#include "compiler/measure/curve_errors.h"
#include "compiler/measure/pictures.h"
#include "tests/support/random.h"

namespace fetexc::measure {
namespace {

using fetex::FeatureKind;
using test::Random;

NetworkCurve line(CanvasPoint a, CanvasPoint b, std::string profile = "") {
    return {"", {{1, {a, b}}}, false, std::move(profile), {}, {}};
}

/// From left to right at half the height, beyond both borders.
Network level_line(double y = 10) { return {40, 20, {line({-5, y}, {45, y})}}; }

CurveTruth truth_of(const Network& network, const FeatureProfile& profile, const CurveTruthOptions& options = {}) {
    return {network, curve_profiles(network, profile), options};
}

RasterImage image_of(std::uint32_t width, std::uint32_t height, const auto& color_at) {
    RasterImage image{width, height, {}};
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x)
            for (const double v : color_at(x + 0.5, y + 0.5))
                image.rgba.push_back(static_cast<float>(65535 * v));
    return image;
}

FeatureCurvesBuild built(const Network& network, FeatureCurvesOptions options) {
    auto build = compile_feature_curves(network, options);
    EXPECT_TRUE(build.ok()) << build.error().message;
    return std::move(build).value();
}

FeatureCurvesOptions exact_options(GridSize size, const FeatureProfile& profile) {
    FeatureCurvesOptions options;
    options.size = size, options.profile = profile, options.smooth = 0;
    options.numbers = fetex::FeatureNumberFormat::Float;
    options.sample_format = fetex::FeatureSampleFormat::Rgba16;
    return options;
}

/// Over a flat base: (1 − b)·h' against b·sqrt(1 + h'²) + (1 − b) is the tangent of the normal's angle.
TEST(CurveTruth, bendsNormalsAwayFromCurvesAsEquationOneSays) {
    const FeatureProfile crease = *preset_profile("crease", 4);
    const CurveTruth truth = truth_of(level_line(), crease);
    for (double y = 0.25; y < 20; y += 0.5) {
        const double d = std::abs(y - 10), b = profile_blend(crease, d), slope = profile_slope(crease, d);
        const double lean = (1 - b) * slope / (b * std::hypot(slope, 1.0) + 1 - b);
        const Rgba c = truth.at({0.3, y / 20});
        EXPECT_NEAR(2 * c.r - 1, 0, 1e-12);
        EXPECT_NEAR(2 * c.g - 1, (y < 10 ? 1 : -1) * lean / std::hypot(lean, 1.0), 1e-9)
            << y; // a valley: uphill is away
        EXPECT_NEAR(2 * c.b - 1, 1 / std::hypot(lean, 1.0), 1e-9) << y;
        EXPECT_EQ(c.a, 1);
    }
}

TEST(CurveTruth, mixesTheColoursOfProfileAndBase) {
    FeatureProfile seam = *preset_profile("seam", 4);
    seam.colors = {{0, {1, 0, 0, 1}}, {4, {0, 0, 1, 0.5}}};
    CurveTruthOptions options;
    options.kind = FeatureKind::Color, options.base_color = {0, 1, 0, 0.5};
    const CurveTruth truth = truth_of(level_line(), seam, options);
    const double b = profile_blend(seam, 2);
    const Rgba c = truth.at({0.5, 0.6}); // two units below: (0.5, 0, 0.5) of alpha 0.75
    EXPECT_NEAR(c.r, (1 - b) * 0.375, 1e-9);
    EXPECT_NEAR(c.g, b * 0.5, 1e-9);
    EXPECT_NEAR(c.b, (1 - b) * 0.375, 1e-9);
    EXPECT_NEAR(c.a, (1 - b) * 0.75 + b * 0.5, 1e-9);
    EXPECT_NEAR(truth.at({0.5, 0.9}).g, 0.5, 1e-12);
}

TEST(CurveTruth, heightsAreGreyAroundTheMiddleOrOfTheBase) {
    const FeatureProfile ridge = *preset_profile("ridge", 4); // two high
    CurveTruthOptions options;
    options.kind = FeatureKind::Height;
    EXPECT_NEAR(truth_of(level_line(), ridge, options).at({0.5, 0.5}).r, 1, 1e-9);
    EXPECT_NEAR(truth_of(level_line(), ridge, options).at({0.5, 0.9}).r, 0.5, 1e-12);
    options.white_height = 16;
    EXPECT_NEAR(truth_of(level_line(), ridge, options).at({0.5, 0.5}).r, 0.5 + 2.0 / 16, 1e-9);
    const RasterImage image = image_of(2, 2, [](double, double) { return std::array{0.5, 0.0, 0.0, 1.0}; });
    options.base = {&image, BaseImageKind::Height, true, 8}, options.white_height = 0;
    EXPECT_NEAR(truth_of(level_line(), ridge, options).at({0.5, 0.5}).r, 2.0 / 8, 1e-9);
    EXPECT_NEAR(truth_of(level_line(), ridge, options).at({0.5, 0.9}).r, 0.5, 1e-5);
}

TEST(CurveTruth, everyCurveHasItsOwnProfile) {
    const Network network{40, 20, {line({-5, 5}, {45, 5}, "crease"), line({-5, 15}, {45, 15}, "ridge")}};
    const CurveTruth truth(network, curve_profiles(network, std::nullopt), {});
    const double near_crease = truth.at({0.5, 5.1 / 20}).g, near_ridge = truth.at({0.5, 15.1 / 20}).g;
    EXPECT_LT(near_crease, 0.45);
    EXPECT_NEAR(near_crease + near_ridge, 1, 1e-9);
    const CurveTruth one(network, curve_profiles(network, preset_profile("crease", 1)), {});
    EXPECT_NEAR(one.at({0.5, 5.1 / 20}).g, one.at({0.5, 15.1 / 20}).g, 1e-9);
}

TEST(CurveTruth, basesOfNormalsAndHeightsAgree) {
    const Network far{40, 20, {line({-90, -90}, {-80, -90})}};
    const FeatureProfile crease = *preset_profile("crease", 1);
    // Rising by 20 units over a width of 40: 1 in 2.
    const RasterImage heights = image_of(64, 32, [](double x, double) { return std::array{x / 64, 0.0, 0.0, 1.0}; });
    const RasterImage normals = image_of(5, 3, [](double, double) {
        const double length = std::hypot(0.5, 1.0);
        return std::array{(1 - 0.5 / length) / 2, 0.5, (1 + 1 / length) / 2, 1.0};
    });
    CurveTruthOptions of_heights, of_normals;
    of_heights.base = {&heights, BaseImageKind::Height, true, 20},
    of_normals.base = {&normals, BaseImageKind::Normal, true, 1};
    const CurveTruth a = truth_of(far, crease, of_heights), b = truth_of(far, crease, of_normals);
    for (const TexturePoint p : {TexturePoint{0.5, 0.5}, {0.3, 0.8}, {0.01, 0.01}}) {
        EXPECT_NEAR(a.at(p).r, b.at(p).r, 1e-4);
        EXPECT_NEAR(a.at(p).g, b.at(p).g, 1e-4);
        EXPECT_NEAR(a.at(p).b, b.at(p).b, 1e-4);
    }
    EXPECT_LT(a.at({0.5, 0.5}).r, 0.3);
}

TEST(CurveErrors, areNextToNothingForAStraightLine) {
    const FeatureProfile crease = *preset_profile("crease", 3);
    const FeatureCurvesBuild b = built(level_line(10.3), exact_options({40, 20}, crease));
    const CurveTruth truth = truth_of(level_line(10.3), crease);
    const CurveErrors e = curve_errors(truth, FeatureCurvesPicture(b.texture), &b.texture, {160, 80}, {1.5, 2, {}});
    EXPECT_EQ(e.pixels_per_texel, 4);
    EXPECT_EQ(e.colors.different_ppm, 0);
    EXPECT_LT(e.angle->max, 0.5); // the table of the profile has steps of a fiftieth of a texel
    EXPECT_EQ(e.angle->points, 160u * 80);
    EXPECT_LT(e.to_picture->hausdorff, 1e-6);
    EXPECT_LT(e.to_truth->hausdorff, 1e-6);
    EXPECT_GT(e.to_truth->points, 100u);
    EXPECT_LT(e.distance->max, 1e-5);
    EXPECT_GT(e.distance->points, 500u); // two of twenty rows of texels
}

/// By a quarter of a texel.
TEST(CurveErrors, tellHowFarCurvesAreOff) {
    const FeatureProfile crease = *preset_profile("crease", 3);
    const FeatureCurvesBuild b = built(level_line(10.5), exact_options({80, 40}, crease)); // half a unit a texel
    const CurveTruth truth = truth_of(level_line(10.375), crease);
    const CurveErrors e = curve_errors(truth, FeatureCurvesPicture(b.texture), &b.texture, {320, 160}, {1.5, 1, {}});
    const double texel = 1.0 / 80;
    for (const Distances& d : {*e.to_picture, *e.to_truth}) {
        EXPECT_NEAR(d.mean / texel, 0.25, 1e-5);
        EXPECT_NEAR(d.p95 / texel, 0.25, 1e-5);
        EXPECT_NEAR(d.hausdorff / texel, 0.25, 1e-5);
        EXPECT_EQ(d.beyond_reach, 0u);
    }
    EXPECT_NEAR(e.distance->p99, 0.25, 1e-4); // but between the two curves
    EXPECT_GT(e.colors.max, 0.2);             // there normals lean the other way
    EXPECT_GT(e.angle->max, 45);
    EXPECT_LT(e.angle->mean, 10);
}

TEST(CurveErrors, findCurvesThatAreLostAndFalseOnes) {
    const FeatureProfile crease = *preset_profile("crease", 1);
    Network two = level_line(5);
    two.curves.push_back(line({-5, 15}, {45, 15}));
    const FeatureCurvesBuild less = built(level_line(5), exact_options({40, 20}, crease)),
                             more = built(two, exact_options({40, 20}, crease));
    const CurveErrors lost =
        curve_errors(truth_of(two, crease), FeatureCurvesPicture(less.texture), &less.texture, {80, 40}, {2, 1, {}});
    EXPECT_NEAR(static_cast<double>(lost.to_picture->beyond_reach) / static_cast<double>(lost.to_picture->points), 0.5,
                0.02);
    EXPECT_NEAR(lost.to_picture->hausdorff, 2.0 / 40, 1e-9); // the reach, in widths
    EXPECT_EQ(lost.to_truth->beyond_reach, 0u);
    const CurveErrors invented = curve_errors(truth_of(level_line(5), crease), FeatureCurvesPicture(more.texture),
                                              &more.texture, {80, 40}, {2, 1, {}});
    EXPECT_EQ(invented.to_picture->beyond_reach, 0u);
    EXPECT_GT(invented.to_truth->beyond_reach, 0u);
}

TEST(CurveErrors, doNotDependOnThreads) {
    Random random(5);
    Network network{32, 32, {}};
    for (int k = 0; k < 6; ++k)
        network.curves.push_back({"",
                                  {{2,
                                    {CanvasPoint{random.between(0, 32), random.between(0, 32)},
                                     {random.between(0, 32), random.between(0, 32)},
                                     {random.between(0, 32), random.between(0, 32)}}}},
                                  false,
                                  "",
                                  {},
                                  {}});
    const FeatureProfile crease = *preset_profile("crease", 2);
    const FeatureCurvesBuild b = built(network, exact_options({32, 32}, crease));
    const CurveTruth truth = truth_of(network, crease);
    const FeatureCurvesPicture picture(b.texture);
    const CurveErrors one = curve_errors(truth, picture, &b.texture, {96, 96}, {1.5, 1, {}}),
                      three = curve_errors(truth, picture, &b.texture, {96, 96}, {1.5, 3, {}});
    EXPECT_EQ(one.colors.psnr, three.colors.psnr);
    EXPECT_EQ(one.angle->mean, three.angle->mean);
    EXPECT_EQ(one.distance->mean, three.distance->mean);
    EXPECT_EQ(one.to_picture->mean, three.to_picture->mean);
    EXPECT_EQ(one.to_truth->mean, three.to_truth->mean);
}

TEST(CurveErrors, ofColoursSeenInAnotherWayAreThoseOfTheResult) {
    const FeatureProfile crease = *preset_profile("crease", 3);
    const FeatureCurvesBuild b = built(level_line(10.5), exact_options({40, 20}, crease));
    const CurveTruth truth = truth_of(level_line(10.25), crease);
    const CurveMeasureOptions black{1.5, 1, [](const Rgba&) { return Rgba{0, 0, 0, 1}; }};
    const CurveErrors e = curve_errors(truth, FeatureCurvesPicture(b.texture), &b.texture, {80, 40}, black);
    EXPECT_EQ(e.colors.max, 0);
    EXPECT_GT(e.angle->max, 1); // of the normals themselves
}

} // namespace
} // namespace fetexc::measure
