// SPDX-License-Identifier: GPL-3.0-or-later
/// Area sampling of compiled drawings against the mean of many point samples: better than four rotated samples, turned
/// pixels included, and all but exact where every texel is looked at.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <random>

#include "compiler/compile.h"
#include "compiler/svg/svg.h"

namespace fetexc::test {
namespace {

using fetex::FbtColor;
using fetex::FbtTexture;

FbtTexture compiled(const std::string& name, std::uint32_t size) {
    std::ifstream file(std::string(FETEXC_ART_DIR) + "/" + name, std::ios::binary);
    const std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(file)), {});
    std::vector<Diagnostic> diagnostics;
    const auto scene = load_svg(bytes, {}, diagnostics);
    EXPECT_TRUE(scene.ok()) << name;
    CompileOptions options;
    options.size = grid_for(scene.value().extent, size);
    auto build = compile_fbt(scene.value(), options);
    EXPECT_TRUE(build.ok()) << name;
    return std::move(build).value().texture;
}

double square(const FbtColor& a, const FbtColor& b) {
    return ((a.r - b.r) * (a.r - b.r) + (a.g - b.g) * (a.g - b.g) + (a.b - b.b) * (a.b - b.b)) / 3;
}

void add(FbtColor& sum, const FbtColor& c, double weight) {
    sum.r += weight * c.r, sum.g += weight * c.g, sum.b += weight * c.b, sum.a += weight * c.a;
}

struct Errors {
    double area = 0, exact = 0, rotated = 0; ///< root mean square, over pixels with an edge
    int pixels = 0;
};

/// Pixels of 1/magnification texel, turned by an angle, at random places where the picture isn't constant.
Errors errors(const FbtTexture& t, double magnification, double angle, std::uint64_t seed) {
    constexpr int kPixels = 250, kSide = 24;
    std::mt19937_64 random(seed);
    const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    const double step = 1 / magnification, c = step * std::cos(angle), s = step * std::sin(angle);
    Errors e;
    for (int tries = 0; e.pixels < kPixels && tries < 400000; ++tries) {
        const double x = 1 + unit() * (t.width - 2), y = 1 + unit() * (t.height - 2);
        const auto at = [&](double u, double v) { return fbt_sample(t, x + c * u - s * v, y + s * u + c * v); };
        double spread = 0;
        for (const double u : {-0.45, 0.0, 0.45})
            for (const double v : {-0.45, 0.0, 0.45})
                spread = std::max(spread, square(at(0, 0), at(u, v)));
        if (spread < 1e-4) continue;
        FbtColor truth, rotated;
        for (int k = 0; k < kSide * kSide; ++k)
            add(truth, at((k % kSide + 0.5) / kSide - 0.5, (k / kSide + 0.5) / kSide - 0.5), 1.0 / (kSide * kSide));
        for (const auto& [u, v] : {std::pair(-0.375, -0.125), {0.125, -0.375}, {0.375, 0.125}, {-0.125, 0.375}})
            add(rotated, at(u, v), 0.25);
        e.area += square(fbt_sample_area(t, x, y, {step / 2, step / 2}), truth);
        e.exact += square(fbt_sample_area(t, x, y, {step / 2, step / 2, true}), truth);
        e.rotated += square(rotated, truth);
        ++e.pixels;
    }
    for (double* sum : {&e.area, &e.exact, &e.rotated})
        *sum = std::sqrt(*sum / std::max(e.pixels, 1));
    return e;
}

class AreaSampling : public testing::TestWithParam<const char*> {};

TEST_P(AreaSampling, isBetterThanFourRotatedSamples) {
    const FbtTexture t = compiled(GetParam(), 48);
    for (const double angle : {0.0, 0.4, 0.785}) {
        for (const double magnification : {2.0, 3.0, 8.0, 32.0}) {
            const Errors e = errors(t, magnification, angle, 7);
            std::printf("  %5.1f px a texel, turned by %.2f: area %.4f, exact %.4f, 4 rotated %.4f (%d pixels)\n",
                        magnification, angle, e.area, e.exact, e.rotated, e.pixels);
            ASSERT_GE(e.pixels, 100);
            EXPECT_LT(e.area, e.rotated) << magnification << " " << angle;
            // What 24 x 24 samples don't know of a pixel, and that a colour is taken in the middle of a region's pixel.
            if (angle == 0) {
                EXPECT_LT(e.exact, 0.01) << magnification;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Drawings, AreaSampling,
                         testing::Values("gear.svg", "letters.svg", "yin_yang.svg", "partition.svg", "star_burst.svg",
                                         "strokes.svg", "stop_sign.svg", "lighthouse.svg"),
                         [](const auto& tested) {
                             const std::string name = tested.param;
                             return name.substr(0, name.find('.'));
                         });

} // namespace
} // namespace fetexc::test
