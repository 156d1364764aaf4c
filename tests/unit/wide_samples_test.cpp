// SPDX-License-Identifier: GPL-3.0-or-later
/// What the compiler makes of gradients and images where samples have 16 bits a channel.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "compiler/compile.h"
#include "compiler/fbt/fbt_builder.h"
#include "compiler/svg/svg.h"
#include "formats/fbt_mip.h"
#include "formats/fbt_samples.h"
#include "formats/validate.h"
#include "tests/support/raster_picture.h"

namespace fetexc {
namespace {

using fetex::FbtColor;
using fetex::FbtSampleFormat;
using fetex::FbtTexture;
using test::featured;
using test::grey;
using test::image_of;
using test::polyline;

constexpr double kStep = 1.0 / 255;
constexpr FbtSampleFormat kFormats[] = {FbtSampleFormat::Rgba8, FbtSampleFormat::Rgba16, FbtSampleFormat::Rgba16F};

Scene from_svg(const std::string& body) {
    const std::string text =
        "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 64 64' width='64' height='64'>" + body + "</svg>";
    std::vector<Diagnostic> diagnostics;
    auto scene =
        load_svg(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()), SvgOptions{}, diagnostics);
    EXPECT_TRUE(scene.ok()) << scene.error().message;
    return std::move(scene).value();
}

FbtBuild build(const Scene& scene, FbtSampleFormat format, FbtRegions* regions = nullptr, unsigned threads = 1) {
    CompileOptions options{{16, 16}, threads};
    options.sample_format = format;
    auto built = build_fbt(scene, options, {}, regions);
    EXPECT_TRUE(built.ok()) << built.error().message;
    const auto findings = fetex::validate_fbt(built.value().texture);
    EXPECT_TRUE(findings.empty()) << findings[0].message;
    EXPECT_EQ(built.value().texture.sample_format, format);
    EXPECT_EQ(built.value().report.fbt.gpu_bytes, fetex::fbt_gpu_bytes(built.value().texture));
    return std::move(built).value();
}

/// Largest difference of a channel from the drawing's paints, in steps of 8 bits.
double largest_error(const Scene& scene, FbtSampleFormat format) {
    FbtRegions regions;
    const FbtTexture t = build(scene, format, &regions).texture;
    double largest = 0;
    for (double y = 0.013; y < t.height; y += 0.137) {
        for (double x = 0.017; x < t.width; x += 0.139) {
            const fetex::FbtRegion region = fetex::fbt_locate(t, x, y);
            const Rgba wanted = regions.compositor->color(regions.result_of(region, t.width), {x * 4, y * 4});
            const FbtColor got = fetex::fbt_shade(t, region, x - region.i, y - region.j);
            largest = std::max({largest, std::abs(got.r - wanted.r), std::abs(got.g - wanted.g),
                                std::abs(got.b - wanted.b), std::abs(got.a - wanted.a)});
        }
    }
    return largest / kStep;
}

/// A gradient of four steps of 8 bits over little more than the picture, under a disc of another: corners and patches.
/// Neither bends: what differs from the paints is rounding.
TEST(WideDrawings, holdAGentleGradientMoreFinely) {
    const Scene scene =
        from_svg("<linearGradient id='a' gradientUnits='userSpaceOnUse' x1='-8' y1='0' x2='80' y2='40'>"
                 "<stop stop-color='rgb(40,80,120)'/><stop offset='1' stop-color='rgb(44,84,124)'/></linearGradient>"
                 "<linearGradient id='b' gradientUnits='userSpaceOnUse' x1='-40' y1='104' x2='104' y2='-40'>"
                 "<stop stop-color='rgb(140,80,20)'/><stop offset='1' stop-color='rgb(144,84,24)'/></linearGradient>"
                 "<path fill='url(#a)' d='M0 0H64V64H0Z'/><circle cx='30' cy='34' r='19' fill='url(#b)'/>");
    double error[3] = {};
    for (const FbtSampleFormat format : kFormats)
        error[static_cast<std::size_t>(format)] = largest_error(scene, format);
    std::printf("  largest error in 1/255: %.4f with 8 bits, %.4f with 16, %.4f with halves\n", error[0], error[1],
                error[2]);
    EXPECT_GT(error[0], 0.4); // rounding: half a step
    EXPECT_LT(error[1], 0.5 / 257 * 1.01);
    EXPECT_LT(error[2], 255 * 0x1p-12 * 1.01); // half a step of halves from 1/2 up
}

/// A colour that 8 bits round is a patch of four equal samples; one that they hold stays a solid colour.
TEST(WideDrawings, keepSolidColoursAsFineAsGradients) {
    const Scene scene = from_svg("<path fill='#123456' d='M0 0H64V64H0Z'/>"
                                 "<path fill='#fff' fill-opacity='0.3' d='M8 0H40V64H8Z'/>");
    const FbtTexture t[] = {build(scene, FbtSampleFormat::Rgba8).texture, build(scene, FbtSampleFormat::Rgba16).texture,
                            build(scene, FbtSampleFormat::Rgba16F).texture};
    const double wanted = 0.3 + 0.7 * 0x12 * kStep;
    const auto error = [&](FbtSampleFormat format) {
        return std::abs(fetex::fbt_sample(t[static_cast<std::size_t>(format)], 5.5, 5.5).r - wanted) / kStep;
    };
    EXPECT_GT(error(FbtSampleFormat::Rgba8), 0.09); // 89.1
    EXPECT_LT(error(FbtSampleFormat::Rgba16), 0.5 / 257 * 1.01);
    EXPECT_LT(error(FbtSampleFormat::Rgba16F), 255 * 0x1p-13 * 1.01);
    EXPECT_FALSE(t[0].traits.patches);
    EXPECT_TRUE(t[1].traits.patches);
    EXPECT_EQ(t[1].texels[0], 0x01563412u);
    EXPECT_EQ(t[1].records.size(), 16u * 8); // once a row of texels
    const Scene exact = from_svg("<path fill='#123456' d='M0 0H64V64H0Z'/><circle cx='30' cy='34' r='19' fill='red'/>");
    EXPECT_EQ(build(exact, FbtSampleFormat::Rgba16).texture.records,
              build(exact, FbtSampleFormat::Rgba8).texture.records);
}

/// An edge between colours that 8 bits don't tell apart is invisible to them alone.
TEST(WideDrawings, keepEdgesThatEightBitsDoNotShow) {
    const Scene scene = from_svg("<path fill='#123456' d='M0 0H64V64H0Z'/>"
                                 "<circle cx='30' cy='34' r='19' fill='#123476' fill-opacity='0.01'/>");
    EXPECT_EQ(build(scene, FbtSampleFormat::Rgba8).texture.traits.max_entries, 0u);
    const FbtTexture t = build(scene, FbtSampleFormat::Rgba16).texture;
    EXPECT_GT(t.traits.max_entries, 0u);
    EXPECT_NEAR(fetex::fbt_sample(t, 7.5, 8.5).b / kStep, 0x56 + 0.01 * 0x20, 0.01);
    EXPECT_NEAR(fetex::fbt_sample(t, 1.5, 8.5).b / kStep, 0x56, 1e-9);
}

TEST(WideDrawings, areTheSameForAnyNumberOfThreads) {
    const Scene scene = from_svg(
        "<radialGradient id='a'><stop stop-color='red' stop-opacity='.3'/><stop offset='1' stop-color='#08f'/>"
        "</radialGradient><circle cx='30' cy='34' r='27' fill='url(#a)'/><path fill='url(#a)' d='M3 5L60 9L12 60Z'/>");
    for (const FbtSampleFormat format : kFormats) {
        const FbtTexture one = build(scene, format).texture, many = build(scene, format, nullptr, 3).texture;
        EXPECT_EQ(one.texels, many.texels);
        EXPECT_EQ(one.corners, many.corners);
        EXPECT_EQ(one.records, many.records);
    }
}

FbtBuild build(const FeaturedImage& picture, FbtSampleFormat format) {
    CompileOptions options{{picture.image.width, picture.image.height}, 1};
    options.sample_format = format;
    options.mips = true;
    auto built = compile_fbt(picture, options);
    EXPECT_TRUE(built.ok()) << built.error().message;
    const auto findings = fetex::validate_fbt(built.value().texture);
    EXPECT_TRUE(findings.empty()) << findings[0].message;
    return std::move(built).value();
}

double plane_error(const FeaturedImage& picture, FbtSampleFormat format, double a, double b) {
    const FbtTexture t = build(picture, format).texture;
    double largest = 0;
    for (double y = 2; y < t.height - 2; y += 0.31) {
        for (double x = 2; x < t.width - 2; x += 0.29)
            largest = std::max(largest, std::abs(fetex::fbt_sample(t, x, y).g - (a + b * (x + y))));
    }
    return largest / kStep;
}

/// An image of 16 bits with a slope of three steps of 8 bits.
TEST(WideImages, holdAGentleSlopeMoreFinely) {
    constexpr double a = 0.3, b = 3 * kStep / 48;
    const auto picture = featured(image_of(24, 24, [](double x, double y) { return grey(a + b * (x + y)); }),
                                  {polyline({{-1, 11.3}, {25, 12.7}})});
    const double eight = plane_error(picture, FbtSampleFormat::Rgba8, a, b),
                 sixteen = plane_error(picture, FbtSampleFormat::Rgba16, a, b),
                 half = plane_error(picture, FbtSampleFormat::Rgba16F, a, b);
    std::printf("  largest error in 1/255: %.4f with 8 bits, %.4f with 16, %.4f with halves\n", eight, sixteen, half);
    EXPECT_GT(eight, 0.4);
    EXPECT_LT(sixteen, 0.05);
    EXPECT_LT(half, 0.1);
}

/// Brighter than white on one side of a feature: kept as halves, to 65504; clipped to alpha by the other formats and in
/// the mip chain.
TEST(WideImages, keepWhatIsBrighterThanWhite) {
    for (const double bright : {6.5, 60000.0}) {
        auto picture =
            featured(image_of(16, 16, [](double, double) { return grey(0.25); }), {polyline({{-1, 8.25}, {17, 8.25}})});
        for (std::size_t k = 0; k < std::size_t{4} * 16 * 8; ++k) {
            if (k % 4 != 3) picture.image.rgba[k] = static_cast<float>(bright * 65535);
        }
        const FbtTexture t = build(picture, FbtSampleFormat::Rgba16F).texture;
        for (const double y : {0.5, 4.0, 8.2})
            EXPECT_NEAR(fetex::fbt_sample(t, 5.3, y).r, bright, bright * 0x1p-11) << y;
        for (const double y : {8.3, 12.0})
            EXPECT_NEAR(fetex::fbt_sample(t, 5.3, y).r, 0.25, 0x1p-12) << y;
        EXPECT_EQ(t.mips[0], 0xffffffffu);
        const FbtTexture narrow = build(picture, FbtSampleFormat::Rgba16).texture;
        EXPECT_EQ(fetex::fbt_sample(narrow, 5.3, 4).r, 1);
    }
}

} // namespace
} // namespace fetexc
