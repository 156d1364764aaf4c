// SPDX-License-Identifier: GPL-3.0-or-later
/// The mip chain: what its samples are, what is read from them, and that nothing jumps while a picture is zoomed.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "compiler/svg/svg.h"
#include "formats/validate.h"
#include "tests/support/fbt_maker.h"
#include "tests/support/known_shapes.h"
#include "tests/support/mip_check.h"
#include "tests/support/random_fbt.h"
#include "tests/support/random_scene.h"

namespace fetexc {
namespace {

namespace fs = std::filesystem;
using fetex::FbtColor;
using fetex::FbtMipLevel;
using fetex::FbtTexture;

constexpr double kStep = 1.0 / 255;

FbtTexture compiled(const Scene& scene, GridSize size, unsigned threads = 1) {
    CompileOptions options{size, threads};
    options.mips = true;
    auto build = compile_fbt(scene, options);
    EXPECT_TRUE(build.ok()) << build.error().message;
    EXPECT_TRUE(fetex::validate_fbt(build.value().texture).empty());
    EXPECT_EQ(build.value().report.fbt.gpu_bytes, fetex::fbt_gpu_bytes(build.value().texture));
    return std::move(build.value().texture);
}

Scene from_svg(const std::string& text, std::uint32_t raster_pixels = 256) {
    std::vector<Diagnostic> diagnostics;
    SvgOptions options;
    options.raster_pixels = raster_pixels;
    auto scene =
        load_svg(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()), options, diagnostics);
    EXPECT_TRUE(scene.ok()) << scene.error().message;
    return std::move(scene).value();
}

Scene from_file(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return from_svg({std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()});
}

double channel(const FbtTexture& t, std::uint64_t sample, unsigned c) {
    return (t.mips[sample] >> (8 * c) & 0xffu) * kStep;
}

double distance(const FbtColor& a, const FbtColor& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b), std::abs(a.a - b.a)});
}

/// Largest difference between a level's samples and the drawing's means, in steps of 8 bits.
double worst_sample(const Scene& scene, const FbtTexture& t, std::uint32_t k) {
    const FbtMipLevel level = fetex::fbt_mip_level(t.width, t.height, k);
    const std::vector<Rgba> truth = test::area_means(scene, {level.width, level.height});
    double worst = 0;
    for (std::size_t n = 0; n < truth.size(); ++n) {
        const double means[] = {truth[n].r, truth[n].g, truth[n].b, truth[n].a};
        for (unsigned c = 0; c < 4; ++c)
            worst = std::max(worst, std::abs(channel(t, level.first + n, c) - means[c]) / kStep);
    }
    return worst;
}

TEST(MipLevels, areThoseOfGl) {
    EXPECT_EQ(fetex::fbt_mip_levels(1, 1), 1u);
    EXPECT_EQ(fetex::fbt_mip_levels(2, 1), 1u);
    EXPECT_EQ(fetex::fbt_mip_levels(3, 3), 1u);
    EXPECT_EQ(fetex::fbt_mip_levels(128, 96), 7u);
    EXPECT_EQ(fetex::fbt_mip_levels(127, 5), 6u);
    EXPECT_EQ(fetex::fbt_mip_levels(16384, 1), 14u);
    EXPECT_EQ(fetex::fbt_mip_samples(5, 3), 3u);
    EXPECT_EQ(fetex::fbt_mip_samples(128, 128), (16384u - 1) / 3);
    const FbtMipLevel level = fetex::fbt_mip_level(127, 5, 2);
    EXPECT_EQ(level.width, 31u);
    EXPECT_EQ(level.height, 1u);
    EXPECT_EQ(level.first, 63u * 2);
    for (std::uint32_t width = 1; width < 300; ++width) {
        for (std::uint32_t k = 1; k <= fetex::fbt_mip_levels(width, 17); ++k) {
            const double scale = fetex::fbt_mip_scale(width, 17, k);
            EXPECT_TRUE(scale >= std::exp2(k) && scale < std::exp2(k + 1)) << width << " " << k;
        }
    }
}

/// Areas known in closed form, at a size of which no level's samples are whole blocks of texels.
TEST(MipChain, holdsTheShareOfADisc) {
    const CanvasPoint center{0.47, 0.52};
    const double radius = 0.37;
    const Scene scene = test::black_on_white({test::round_disc(center, radius)});
    const FbtTexture t = compiled(scene, {61, 53});
    for (std::uint32_t k = 1; k <= fetex::fbt_mip_levels(t.width, t.height); ++k) {
        const FbtMipLevel level = fetex::fbt_mip_level(t.width, t.height, k);
        const double w = 1.0 / level.width, h = 1.0 / level.height;
        for (std::uint64_t n = 0; n < level.samples(); ++n) {
            const double x = static_cast<double>(n % level.width) * w, y = static_cast<double>(n / level.width) * h;
            const double black = test::disc_area(center, radius, {x, y, x + w, y + h}) / (w * h);
            EXPECT_NEAR(channel(t, level.first + n, 0), 1 - black, (0.5 + 1e-3) * kStep) << "level " << k << " " << n;
            EXPECT_EQ(channel(t, level.first + n, 3), 1);
        }
    }
}

/// Stops a few texels apart, a focal point, alpha that changes with the colour: a quarter of a step besides rounding.
TEST(MipChain, integratesGradientsToAQuarterOfAStep) {
    const Scene scene = from_svg(
        "<svg xmlns='http://www.w3.org/2000/svg' width='40' height='40'><defs>"
        "<linearGradient id='a' gradientUnits='userSpaceOnUse' x1='3' y1='1' x2='11' y2='8' spreadMethod='reflect'>"
        "<stop offset='0' stop-color='#fff'/><stop offset='0.31' stop-color='#000'/>"
        "<stop offset='0.55' stop-color='#f80' stop-opacity='0.2'/><stop offset='1' "
        "stop-color='#08f'/></linearGradient>"
        "<radialGradient id='b' gradientUnits='userSpaceOnUse' cx='26' cy='22' r='13' fx='22' fy='24'>"
        "<stop offset='0' stop-color='#ff0'/><stop offset='0.3' stop-color='#00f'/><stop offset='0.7' "
        "stop-color='#fff'/>"
        "<stop offset='1' stop-color='#000' stop-opacity='0'/></radialGradient></defs>"
        "<path fill='url(#a)' d='M0,0H40V40H0Z'/><circle fill='url(#b)' cx='25' cy='23' r='12'/></svg>");
    for (const std::uint32_t side : {40u, 20u, 23u}) {
        const FbtTexture t = compiled(scene, {side, side});
        for (std::uint32_t k = 1; k <= fetex::fbt_mip_levels(side, side); ++k)
            EXPECT_LE(worst_sample(scene, t, k), 0.75) << side << " level " << k;
    }
}

TEST(MipChain, isTheSameForAnyNumberOfThreads) {
    const Scene scene = from_file(fs::path(FETEXC_ART_DIR) / "lighthouse.svg");
    for (const GridSize size : {GridSize{64, 64}, GridSize{63, 50}})
        EXPECT_EQ(compiled(scene, size, 1).mips, compiled(scene, size, 4).mips);
}

TEST(MipChain, countsWhatItSkips) {
    const Scene scene = test::black_on_white({test::round_disc({0.5, 0.5}, 0.3)});
    CompileOptions options{{64, 64}, 1};
    options.mips = true;
    const MipStats even = compile_fbt(scene, options).value().report.mips;
    EXPECT_EQ(even.levels, 6u);
    EXPECT_EQ(even.texels, 64u * 64);
    EXPECT_GT(even.texels_solid, 64u * 64 * 9 / 10);
    EXPECT_EQ(even.paint_samples, 0u);
    EXPECT_EQ(even.own_maps, 0u);
    EXPECT_EQ(even.gpu_bytes, 4 * fetex::fbt_mip_samples(64, 64));
    options.size = {62, 62}; // 31, 15, 7, 3, 1
    EXPECT_EQ(compile_fbt(scene, options).value().report.mips.own_maps, 2u);
}

TEST(MipChain, isMadeOnlyWhenAskedForAndCountsInTheBytes) {
    const Scene scene = test::black_on_white({test::round_disc({0.5, 0.5}, 0.31)});
    const auto without = compile_fbt_at_chosen_size(scene, {}, 3072);
    ASSERT_TRUE(without.ok());
    EXPECT_TRUE(without.value().texture.mips.empty());
    EXPECT_EQ(without.value().report.mips.levels, 0u);
    CompileOptions options;
    options.mips = true;
    const auto with = compile_fbt_at_chosen_size(scene, options, 3072);
    ASSERT_TRUE(with.ok());
    EXPECT_FALSE(with.value().texture.mips.empty());
    EXPECT_LE(fetex::fbt_gpu_bytes(with.value().texture), 3072u);
    EXPECT_LT(with.value().texture.width, without.value().texture.width);
}

/// The bar of minification: 45 dB against exact areas where pixels are the samples of a level, for every drawing.
TEST(MipChain, isAsGoodAsExactAreas) {
    for (const char* folder : {".", "alternatives"}) {
        for (const auto& entry : fs::directory_iterator(fs::path(FETEXC_ART_DIR) / folder)) {
            if (entry.path().extension() != ".svg") continue;
            const Scene scene = from_file(entry.path());
            const FbtTexture t = compiled(scene, grid_for(scene.extent, 128));
            const auto psnr = test::minified_psnr(scene, t);
            std::printf("  %-22s %.1f %.1f %.1f %.1f dB at 1/2, 1/4, 1/8, 1/16\n", entry.path().filename().c_str(),
                        psnr[0], psnr[1], psnr[2], psnr[3]);
            for (const double dB : psnr)
                EXPECT_GE(dB, 45) << entry.path();
        }
    }
}

TEST(MipSampler, showsASampleWhereAPixelCoversIt) {
    for (const auto& [width, height] :
         {std::pair(16u, 16u), std::pair(21u, 50u), std::pair(7u, 1u), std::pair(1u, 1u)}) {
        const FbtTexture t = test::random_fbt(width, {.width = width, .height = height, .mips = true});
        for (std::uint32_t k = 1; k <= fetex::fbt_mip_levels(width, height); ++k) {
            const FbtMipLevel level = fetex::fbt_mip_level(width, height, k);
            for (std::uint64_t n = 0; n < level.samples(); ++n) {
                const double x = (static_cast<double>(n % level.width) + 0.5) / level.width * width,
                             y = (static_cast<double>(n / level.width) + 0.5) / level.height * height;
                const FbtColor c = fetex::fbt_sample_mip(t, x, y, fetex::fbt_mip_scale(width, height, k));
                EXPECT_NEAR(c.r, channel(t, level.first + n, 0), 1e-9);
                EXPECT_NEAR(c.a, channel(t, level.first + n, 3), 1e-9);
            }
        }
    }
}

TEST(MipSampler, isTheFeaturesWhereItIsNotTheChain) {
    const FbtTexture t = test::random_fbt(3, {.width = 12, .height = 9, .mips = true});
    for (const double side : {0.25, 1.0}) {
        for (const bool exact : {false, true}) {
            EXPECT_LE(distance(fetex::fbt_sample_mip(t, 5.3, 4.7, side, exact),
                               fetex::fbt_sample_area(t, 5.3, 4.7, {side / 2, side / 2, exact})),
                      1e-12);
        }
    }
    EXPECT_LE(distance(fetex::fbt_sample_mip(t, 5.3, 4.7, 0), fetex::fbt_sample(t, 5.3, 4.7)), 1e-12);
}

/// What isn't a number, or is beyond the texture, gives a colour.
TEST(MipSampler, takesAnyPosition) {
    const FbtTexture t = test::random_fbt(3, {.width = 12, .height = 9, .mips = true});
    for (const double side : {-1.0, 0.0, 3.0, 1e30, double{NAN}, double{INFINITY}}) {
        for (const double x : {-1e9, 0.0, 12.0, 1e9, double{NAN}}) {
            const FbtColor c = fetex::fbt_sample_mip(t, x, 2, side);
            EXPECT_TRUE(c.a >= 0 && c.a <= 1 + 1e-12) << side << " " << x;
            const FbtColor d = fetex::fbt_sample_mip_aniso(t, x, 2, {side, 1}, {0, 2});
            EXPECT_TRUE(d.a >= 0 && d.a <= 1 + 1e-12) << side << " " << x;
        }
    }
}

/// Stripes along x under pixels that are long along them stay; they don't under square pixels of that length.
TEST(MipSampler, keepsStripesUnderLongPixels) {
    std::vector<CanvasContour> stripes;
    for (int k = 0; k < 8; ++k)
        stripes.push_back(test::closed_polygon({{0, k / 8.0}, {1, k / 8.0}, {1, (k + 0.5) / 8}, {0, (k + 0.5) / 8}}));
    const FbtTexture t = compiled(test::black_on_white(stripes), {128, 128});
    const auto contrast = [&](fetex::FbtVector dx, fetex::FbtVector dy) {
        return std::abs(fetex::fbt_sample_mip_aniso(t, 64, 36, dx, dy).r -
                        fetex::fbt_sample_mip_aniso(t, 64, 44, dx, dy).r);
    };
    EXPECT_GT(contrast({16, 0}, {0, 2}), 0.99);
    EXPECT_GT(contrast({0, 2}, {-16, 0}), 0.99); // the picture turned
    EXPECT_GT(contrast({16, 0}, {15, 2}), 0.99); // a sheared pixel
    EXPECT_LT(contrast({16, 0}, {0, 16}), 0.01);
    EXPECT_LT(contrast({2, 0}, {0, 16}), 0.01);
}

/// From 64 texels a pixel to 1/16 texel in steps of a sixteenth of an octave: no step changes the picture by more
/// than twice what the larger of the steps beside it does.
TEST(MipSampler, zoomsWithoutJumps) {
    constexpr int kStepsPerOctave = 16, kFrames = 10 * kStepsPerOctave + 1, kPoints = 20000;
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const Scene scene = test::random_scene(seed, test::everything());
        const FbtTexture t = compiled(scene, {128, seed == 2 ? 77u : 128u});
        std::vector<double> change;
        std::vector<FbtColor> before(kPoints), now = before;
        for (int frame = 0; frame < kFrames; ++frame) {
            const double side = 64 * std::exp2(-static_cast<double>(frame) / kStepsPerOctave);
            double sum = 0;
            for (int k = 0; k < kPoints; ++k) {
                // Roberts' sequence: evenly spread, in step with no edge.
                const double x = std::fmod(k * 0.7548776662466927, 1) * t.width,
                             y = std::fmod(k * 0.5698402909980532, 1) * t.height;
                const FbtColor c = fetex::fbt_sample_mip(t, x, y, side);
                now[static_cast<std::size_t>(k)] = c;
                const FbtColor& b = before[static_cast<std::size_t>(k)];
                sum += measure::square_error({b.r, b.g, b.b, b.a}, {c.r, c.g, c.b, c.a});
            }
            if (frame > 0) change.push_back(std::sqrt(sum / kPoints));
            std::swap(before, now);
        }
        double worst = 0;
        for (std::size_t n = 1; n + 1 < change.size(); ++n)
            worst = std::max(worst, change[n] / std::max(change[n - 1], change[n + 1]));
        std::printf("  seed %llu: largest step %.2f of its neighbours; from %.4f to %.4f\n",
                    static_cast<unsigned long long>(seed), worst, *std::min_element(change.begin(), change.end()),
                    *std::max_element(change.begin(), change.end()));
        EXPECT_LE(worst, 2);
        EXPECT_GT(*std::min_element(change.begin(), change.end()), 0); // the picture did change
    }
}

} // namespace
} // namespace fetexc
