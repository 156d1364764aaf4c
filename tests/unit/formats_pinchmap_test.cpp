// SPDX-License-Identifier: GPL-3.0-or-later
/// The pinch function and the steps of the fragment program (Tarini and Cignoni 2005, §4.1, §5.2, §6), against the
/// paper's formulas and values computed by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "formats/fbt_mip.h"
#include "formats/fbt_samples.h"
#include "formats/pinchmap.h"
#include "formats/validate.h"
#include "tests/support/known_pinchmap.h"
#include "tests/support/random.h"

namespace fetex {
namespace {

using fetexc::test::KnownPinchmapOptions;
using fetexc::test::KnownSignal;
using fetexc::test::kPinchmapFormats;
using fetexc::test::kPinchmapSampleFormats;
using fetexc::test::mask_of;
using fetexc::test::pinchmap_of;
using fetexc::test::Random;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A line straight down between columns 1 and 2 of four; red on the right, blue on the left.
PinchmapTexture straight(double gamma, std::uint32_t scale, double least_strength = 1) {
    const PinchmapTexture t =
        pinchmap_of(mask_of({"..##", "..##", "..##"}),
                    {.scale = scale, .gamma_from = gamma, .gamma_to = gamma, .least_strength = least_strength});
    EXPECT_TRUE(validate_pinchmap(t).empty());
    return t;
}

/// Equation 1 as it stands.
double equation_1(double k, double gamma, double h) {
    if (k <= -1) return 0;
    if (k <= gamma) return -(1 + k) * (h + gamma) / (gamma + 1);
    if (k <= 1) return -(1 - k) * (h - gamma) / (gamma - 1);
    return 0;
}

double hard_shift(double k, double gamma, double h) {
    return pinchmap_shift(k, k - gamma, h, {k > gamma ? 1.0 : 0.0, 0});
}

TEST(PinchmapTexels, haveZeroInTheMiddleOfTheirSteps) {
    EXPECT_EQ(pinchmap_pack(PinchmapFormat::Bits8, {0, 0, 0, 0})[0], 0x7f7f7f7fu);
    EXPECT_EQ(pinchmap_pack(PinchmapFormat::Bits8, {-1, 1, 0, 64.0 / 127})[0], 0xbf7ffe00u);
    EXPECT_EQ(pinchmap_pack(PinchmapFormat::Bits16, {-1, 1, 0, 1.0 / 32767}),
              (std::array<std::uint32_t, 2>{0xfffe0000u, 0x80007fffu}));
    EXPECT_EQ(pinchmap_pack(PinchmapFormat::Bits8, {-7, 7, kNan, 0})[0], 0x7f00fe00u);
    for (const PinchmapFormat format : kPinchmapFormats) {
        const std::uint32_t zero = pinchmap_zero(format);
        for (std::uint32_t stored = 0; stored <= 2 * zero; stored += format == PinchmapFormat::Bits8 ? 1 : 97) {
            const double v = (stored - static_cast<double>(zero)) / zero;
            const PinchmapTexel texel{v, -v, v / 2, 0};
            const auto words = pinchmap_pack(format, texel);
            const PinchmapTexel back = pinchmap_unpack(format, words.data());
            EXPECT_EQ(back.du, v);
            EXPECT_EQ(back.dv, -v);
            EXPECT_NEAR(back.k, v / 2, 0.5 / zero + 1e-15);
            EXPECT_EQ(back.gamma, 0);
        }
    }
}

TEST(PinchFunction, isEquation1) {
    for (const double h : {0.5, 0.25, 0.125})
        for (double gamma = -0.98; gamma < 1; gamma += 0.07)
            for (double k = -1; k <= 1; k += 1.0 / 64)
                EXPECT_NEAR(hard_shift(k, gamma, h), equation_1(k, gamma, h), 1e-13) << h << " " << gamma << " " << k;
}

/// The ends stay, the middle jumps over the fexel, and k + p grows: §4.1.
TEST(PinchFunction, takesTheFexelAway) {
    for (const double h : {0.5, 0.25, 0.0625})
        for (const double gamma : {-0.9, -0.5, -0.25, 0.0, 0.3, 0.5, 0.9}) {
            EXPECT_EQ(hard_shift(-1, gamma, h), 0);
            EXPECT_EQ(hard_shift(1, gamma, h), 0);
            EXPECT_NEAR(hard_shift(gamma, gamma, h), -h - gamma, 1e-15);
            EXPECT_NEAR(hard_shift(std::nextafter(gamma, 2), gamma, h), h - gamma, 1e-14);
            double before = -2;
            for (double k = -1; k <= 1; k += 1.0 / 256) {
                const double now = k + hard_shift(k, gamma, h);
                EXPECT_GT(now, before);
                EXPECT_GE(std::abs(now), h - 1e-15);
                before = now;
            }
        }
}

/// Quotients of nothing: gamma at an end together with k, and beyond it.
TEST(PinchFunction, hasNoNumberThatIsNone) {
    for (const double h : {0.5, 0.25})
        for (const double end : {-1.0, 1.0})
            for (const double k : {end, end * (1 - 1e-16), end * (1 - 1e-300)})
                for (const double side : {-1e-300, 0.0, 1e-300}) {
                    const double p = pinchmap_shift(k, side, h, {side > 0 ? 1.0 : 0.0, 0});
                    EXPECT_LE(std::abs(p), 2) << k;
                }
}

/// The soft form goes from one side of the fexel to the other as the coverage does, and on to the ends.
TEST(PinchFunction, isSoftByTheCoverage) {
    const PinchmapCut half{0.5, 0.1}, most{0.75, 0.1}, all{1, 0.1};
    EXPECT_NEAR(pinchmap_shift(0.25, 0, 0.5, half), -0.25, 1e-15); // the fexel's middle
    EXPECT_NEAR(pinchmap_shift(0.3, 0.05, 0.25, most), 0.125 - 0.3, 1e-15);
    EXPECT_NEAR(pinchmap_shift(0.35, 0.1, 0.25, all), 0.25 - 0.35, 1e-15);
    EXPECT_NEAR(pinchmap_shift(0.675, 0.425, 0.5, all), 0.75 - 0.675, 1e-15); // half of the way to 1
    EXPECT_NEAR(pinchmap_shift(1, 0.75, 0.5, all), 0, 1e-15);
    EXPECT_NEAR(pinchmap_shift(-1, -1.25, 0.5, {0, 0.1}), 0, 1e-15);
}

TEST(PinchmapSteps, interpolateAndKnowTheGradientOfTheSide) {
    const PinchmapTexture t = pinchmap_of(mask_of({"....", "..##", "..##"}), {.gamma_from = -0.4, .gamma_to = 0.4});
    for (std::uint32_t j = 0; j < t.height; ++j)
        for (std::uint32_t i = 0; i < t.width; ++i)
            for (const double fx : {0.0, 0.3, 0.9})
                for (const double fy : {0.1, 0.75, 1.0}) {
                    const PinchmapTexel a = pinchmap_texel(t, i, j), b = pinchmap_texel(t, i + 1, j),
                                        c = pinchmap_texel(t, i, j + 1), d = pinchmap_texel(t, i + 1, j + 1);
                    const auto mean = [&](double PinchmapTexel::*m) {
                        return (1 - fx) * (1 - fy) * a.*m + fx * (1 - fy) * b.*m + (1 - fx) * fy * c.*m +
                               fx * fy * d.*m;
                    };
                    const PinchmapBlend found = pinchmap_blend(t, i, j, fx, fy);
                    EXPECT_NEAR(found.at.du, mean(&PinchmapTexel::du), 1e-15);
                    EXPECT_NEAR(found.at.dv, mean(&PinchmapTexel::dv), 1e-15);
                    EXPECT_NEAR(found.at.k, mean(&PinchmapTexel::k), 1e-15);
                    EXPECT_NEAR(found.at.gamma, mean(&PinchmapTexel::gamma), 1e-15);
                    const auto side = [&](double x, double y) {
                        const PinchmapTexel at = pinchmap_blend(t, i, j, x, y).at;
                        return at.k - at.gamma;
                    };
                    constexpr double kStep = 1e-3; // bilinear: differences are exact
                    EXPECT_NEAR(found.dfdx, (side(fx + kStep, fy) - side(fx - kStep, fy)) / (2 * kStep), 1e-11);
                    EXPECT_NEAR(found.dfdy, (side(fx, fy + kStep) - side(fx, fy - kStep)) / (2 * kStep), 1e-11);
                }
}

/// Figure 6: one texel is active, the interpolated k is curved, the one we need is the larger distance.
TEST(PinchmapSteps, rectifyTheClusterOfFigure6) {
    for (const double fx : {0.1, 0.5, 0.8})
        for (const double fy : {0.05, 0.5, 0.99}) {
            const double weight = (1 - fx) * (1 - fy), k = 1 - weight;
            EXPECT_NEAR(pinchmap_rectified_k({weight, weight, k, 0}, fx, fy), std::max(fx, fy), 1e-15);
            EXPECT_NEAR(pinchmap_rectified_k({-weight, -weight, -k, 0}, fx, fy), -std::max(fx, fy), 1e-15);
            // The active texel at the upper right, and a strength below 1.
            EXPECT_NEAR(pinchmap_rectified_k({-weight / 2, weight / 2, k, 0}, 1 - fx, fy), std::max(fx, fy), 1e-15);
        }
    EXPECT_EQ(pinchmap_rectified_k({0.4, 0, 0.6, 0}, 0.6, 0.2), 0.6); // a straight one
}

/// §6.4: a place in the second cluster from the line, by hand. gamma = 1/4, h = 1/2: at x = 2.5, k = 1/2 lies
/// 1/3 of the way from gamma to 1, and so is read 1/3 of the way from 1/2 to 1.
TEST(PinchmapPlaces, areWhereEquation1MovesThem) {
    const auto read_at = [](double gamma, std::uint32_t scale, double x) {
        const PinchmapPlace place = pinchmap_place(straight(gamma, scale), x, 1.3);
        EXPECT_EQ(place.j + place.y, 1.3);
        return place.i + place.x;
    };
    EXPECT_NEAR(read_at(0.25, 0, 2.5), 2 + 0.5 + 0.5 / 3, 2e-5);
    EXPECT_NEAR(read_at(0.25, 0, 2.1), 1 + 1.1 / 1.25 * 0.5, 2e-5); // left of gamma, though right of the line's texels
    EXPECT_NEAR(read_at(0.25, 1, 2.5), 2 + 0.25 + 0.75 / 3, 2e-5);
    EXPECT_NEAR(read_at(0.25, 3, 2.5), 2 + 0.0625 + 0.9375 / 3, 2e-5);
    EXPECT_EQ(read_at(0.25, 0, 0.7), 0.7); // two clusters away
    EXPECT_EQ(read_at(0.25, 0, 3.2), 3.2);
    EXPECT_EQ(read_at(0.25, 0, 1), 1); // where the pinch ends
    EXPECT_EQ(read_at(0.25, 0, 3), 3);
}

TEST(PinchmapSampling, cutsWhereGammaIs) {
    for (const std::uint32_t scale : {0u, 1u, 3u})
        for (const double gamma : {-0.9, -0.5, 0.0, 0.25, 0.75}) {
            const PinchmapTexture t = straight(gamma, scale);
            const double edge = 2 + pinchmap_texel(t, 2, 1).gamma;
            for (const double y : {0.0, 0.4, 1.7, 3.0}) {
                EXPECT_NEAR(pinchmap_sample(t, edge - 1e-9, y).b, 1, 1e-9) << gamma;
                EXPECT_NEAR(pinchmap_sample(t, edge - 1e-9, y).r, 0, 1e-9);
                EXPECT_NEAR(pinchmap_sample(t, edge + 1e-9, y).r, 1, 1e-9);
                EXPECT_NEAR(pinchmap_sample(t, edge + 1e-9, y).b, 0, 1e-9);
            }
        }
}

/// Beyond the border, and where there is no place at all.
TEST(PinchmapSampling, takesAnyPoint) {
    const PinchmapTexture t = straight(0.1, 1);
    EXPECT_EQ(pinchmap_sample(t, -5, 1).b, 1);
    EXPECT_EQ(pinchmap_sample(t, 50, 1).r, 1);
    EXPECT_EQ(pinchmap_sample(t, kNan, kNan).b, 1);
    EXPECT_EQ(pinchmap_sample_area(t, 3.5, 1, {kNan, kNan}).r, 1);
}

/// Strength 0 everywhere, and clusters without active texels: a plain bilinear lookup.
TEST(PinchmapSampling, withoutStrengthIsBilinear) {
    PinchmapTexture t = pinchmap_of(mask_of({"..##", "..##", "..##"}), {.scale = 1, .signal = KnownSignal::Random});
    for (std::uint32_t j = 0; j <= 3; ++j) {
        const auto words = pinchmap_pack(t.map_format, {0, 0, 0, 0.3});
        std::ranges::copy(words, t.map.begin() + (std::size_t{j} * 5 + 2) * 2);
    }
    EXPECT_TRUE(validate_pinchmap(t).empty());
    EXPECT_TRUE(pinchmap_is_open(t));
    Random random(5);
    const auto red = [&](int i, int j) {
        return (t.signal[static_cast<std::size_t>(std::clamp(j, 0, 5) * 8 + std::clamp(i, 0, 7))] & 255) / 255.0;
    };
    for (int n = 0; n < 2000; ++n) {
        const double x = random.between(0, 4), y = random.between(0, 3), a = 2 * x - 0.5, b = 2 * y - 0.5;
        const int i = static_cast<int>(std::floor(a)), j = static_cast<int>(std::floor(b));
        const double u = a - i, v = b - j;
        EXPECT_NEAR(pinchmap_sample(t, x, y).r,
                    (1 - u) * (1 - v) * red(i, j) + u * (1 - v) * red(i + 1, j) + (1 - u) * v * red(i, j + 1) +
                        u * v * red(i + 1, j + 1),
                    1e-14);
    }
}

/// §6.2: half the strength moves half as far.
TEST(PinchmapStrength, scalesTheDisplacement) {
    PinchmapTexture t = straight(0.25, 0);
    const PinchmapTexture whole = t;
    EXPECT_FALSE(pinchmap_is_open(t));
    for (std::uint32_t j = 0; j <= 3; ++j) {
        PinchmapTexel texel = pinchmap_texel(t, 2, j);
        texel.du = 0.5;
        std::ranges::copy(pinchmap_pack(t.map_format, texel), t.map.begin() + (std::size_t{j} * 5 + 2) * 2);
    }
    EXPECT_TRUE(pinchmap_is_open(t));
    for (const double x : {1.2, 1.9, 2.2, 2.3, 2.9}) {
        const double moved = pinchmap_place(whole, x, 1.5).x - (x - std::floor(x)),
                     half = pinchmap_place(t, x, 1.5).x - (x - std::floor(x));
        EXPECT_NEAR(half, moved / 2, 2e-5);
    }
}

/// A straight edge covers exactly what it covers of a pixel, whatever gamma and the ratio of resolutions, of pixels up
/// to where the fexel would be as wide unpinched; the paper's equation 3 is off by up to half a pixel.
TEST(PinchmapPixels, haveTheExactCoverageOfStraightEdges) {
    for (const std::uint32_t scale : {0u, 1u, 2u})
        for (const double gamma : {-0.5, 0.0, 0.25, 0.5}) {
            const PinchmapTexture t = straight(gamma, scale);
            const double edge = 2 + pinchmap_texel(t, 2, 1).gamma;
            for (const double side : {1.0 / 256, 0.03, 0.12})
                for (double x = edge - side; x < edge + side; x += side / 7) {
                    const double covered = std::clamp((x - edge) / side + 0.5, 0.0, 1.0);
                    EXPECT_NEAR(pinchmap_sample_area(t, x, 1.1, {side, 0.2}).r, covered, 1e-9);
                    EXPECT_NEAR(pinchmap_place(t, x, 1.1, {side, 0.2}).cut.coverage, covered, 1e-9);
                }
        }
}

/// Of a pixel larger than the fexel the picture is as if it weren't pinched: gamma is 0, so nothing moves at all.
TEST(PinchmapPixels, beyondTheFexelAreNotPinched) {
    const PinchmapTexture t = straight(0, 1);
    for (double x = 1; x <= 3; x += 0.07) {
        const PinchmapPlace place = pinchmap_place(t, x, 1.5, {0.5, 0.5});
        EXPECT_NEAR(place.i + place.x, x, 1e-12);
    }
}

/// A pixel of no size is a point, one of more than a texel counts as one.
TEST(PinchmapPixels, ofNoSizeArePoints) {
    Random random(8);
    const PinchmapTexture t =
        pinchmap_of(fetexc::test::random_mask(8, 12, 12),
                    {.scale = 1, .signal = KnownSignal::Random, .gamma_from = -0.4, .gamma_to = 0.4});
    for (int n = 0; n < 3000; ++n) {
        const double x = random.between(0, 12), y = random.between(0, 12);
        EXPECT_EQ(pinchmap_sample_area(t, x, y, {}).g, pinchmap_sample(t, x, y).g);
        EXPECT_EQ(pinchmap_sample_area(t, x, y, {-1, 5}).g, pinchmap_sample_area(t, x, y, {0, 1}).g);
    }
}

TEST(PinchmapSampling, isTheSameFromTexelAndOffset) {
    for (const PinchmapFormat format : kPinchmapFormats)
        for (const PinchmapSampleFormat samples : kPinchmapSampleFormats) {
            const PinchmapTexture t = pinchmap_of(fetexc::test::random_mask(7, 6, 4), {.scale = 1,
                                                                                       .map_format = format,
                                                                                       .sample_format = samples,
                                                                                       .signal = KnownSignal::Random,
                                                                                       .gamma_from = -0.4,
                                                                                       .gamma_to = 0.4});
            ASSERT_TRUE(validate_pinchmap(t).empty());
            for (std::uint32_t j = 0; j < 4; ++j)
                for (std::uint32_t i = 0; i < 6; ++i)
                    for (const double f : {0.0, 0.25, 0.5, 0.875}) {
                        const double e = 1 - f - 0x1p-10;
                        EXPECT_EQ(pinchmap_sample(t, i + f, j + e).g, pinchmap_sample_local(t, i, j, f, e).g);
                        EXPECT_EQ(pinchmap_sample_area(t, i + f, j + e, {0.5, 0.25}).b,
                                  pinchmap_sample_area_local(t, i, j, f, e, {0.5, 0.25}).b);
                    }
        }
}

/// §6.5: as wide as it says, in the middle of the discontinuity, of its colour.
TEST(PinchmapLines, areAsWideAsTheySay) {
    PinchmapTexture t = straight(0.25, 1);
    t.line_color = 0xff00ff00, t.line_width = static_cast<std::uint32_t>(0.125 * kPinchmapLineUnit);
    ASSERT_TRUE(validate_pinchmap(t).empty());
    const double edge = 2 + pinchmap_texel(t, 2, 1).gamma;
    for (const double side : {-1.0, 1.0}) {
        EXPECT_EQ(pinchmap_sample(t, edge + side * 0.0624, 1).g, 1);
        EXPECT_EQ(pinchmap_sample(t, edge + side * 0.0626, 1).g, 0);
        EXPECT_NEAR(pinchmap_sample_area(t, edge + side * 0.0625, 1, {0.03125, 0.03125}).g, 0.5, 1e-9);
        EXPECT_NEAR(pinchmap_sample_area(t, edge, 1, {0.25, 0.1}).g, 0.5, 1e-9); // thinner than the pixel
    }
    EXPECT_EQ(pinchmap_sample(t, 0.5, 0.5).g, 0);
}

/// At an angle too: the distance counts, not the difference of k.
TEST(PinchmapLines, haveTheirWidthAtAnAngle) {
    PinchmapTexture t = straight(0, 0);
    for (std::uint32_t j = 0; j <= 3; ++j)
        for (std::uint32_t i = 0; i <= 4; ++i) {
            PinchmapTexel texel = pinchmap_texel(t, i, j);
            texel.gamma = 0.3 * (j - 1.5);
            std::ranges::copy(pinchmap_pack(t.map_format, texel), t.map.begin() + (std::size_t{j} * 5 + i) * 2);
        }
    t.line_color = 0xff00ff00, t.line_width = static_cast<std::uint32_t>(0.1 * kPinchmapLineUnit);
    const double slant = std::hypot(1, 0.3);
    EXPECT_EQ(pinchmap_sample(t, 2 + 0.049 * slant, 1.5).g, 1);
    EXPECT_EQ(pinchmap_sample(t, 2 + 0.051 * slant, 1.5).g, 0);
}

/// A line starts as smoothly as its discontinuity.
TEST(PinchmapLines, fadeWithTheStrength) {
    PinchmapTexture t = straight(0, 0, 0.25);
    t.line_color = 0xff00ff00, t.line_width = 6553;
    for (std::uint32_t j = 0; j <= 3; ++j)
        EXPECT_NEAR(pinchmap_sample(t, 2, j).g, pinchmap_texel(t, 2, j).du, 1e-9);
}

TEST(PinchmapColors, areThoseOfTheirFormat) {
    PinchmapTexture t = pinchmap_of(mask_of({"."}));
    t.signal = {0x80402010};
    EXPECT_EQ(pinchmap_sample(t, 0.5, 0.5).b, 64 / 255.0);
    t.sample_format = PinchmapSampleFormat::Rgba16;
    t.signal = {0x20001000, 0x80004000};
    EXPECT_EQ(pinchmap_sample(t, 0.5, 0.5).a, 0x8000 / 65535.0);
    t.sample_format = PinchmapSampleFormat::Rgba16F;
    t.signal = {0x3c004200, 0x38003400}; // 3, 1, 0.25, 0.5
    EXPECT_EQ(pinchmap_sample(t, 0.5, 0.5).r, 3);
}

TEST(PinchmapMips, areMeansOfTheSignal) {
    PinchmapTexture t = pinchmap_of(mask_of({".."}), {.scale = 1});
    t.signal = {0xff000000, 0xff000010, 0xff000020, 0xff000030, 0xff000040, 0xff000050, 0xff000060, 0xff000070};
    t.mips = pinchmap_make_mips(t);
    ASSERT_EQ(t.mips.size(), fbt_mip_samples(4, 2));
    EXPECT_EQ(t.mips[0] & 255, 0x28u); // (0 + 10 + 40 + 50) / 4
    EXPECT_EQ(t.mips[1] & 255, 0x48u);
    EXPECT_EQ(t.mips[2] & 255, 0x38u);
    EXPECT_TRUE(validate_pinchmap(t).empty());
}

/// A pixel as long as a sample of a level, around its middle, has its colour.
TEST(PinchmapMips, areWhatMinifiedPixelsShow) {
    const PinchmapTexture t = pinchmap_of(mask_of({"....", "....", "....", "...."}),
                                          {.scale = 1, .signal = KnownSignal::Random, .mips = true});
    for (const std::uint32_t level : {1u, 2u, 3u}) {
        const FbtMipLevel l = fbt_mip_level(8, 8, level);
        const double side = 4.0 / l.width;
        for (std::uint32_t j = 0; j < l.height; ++j)
            for (std::uint32_t i = 0; i < l.width; ++i)
                EXPECT_NEAR(pinchmap_sample_mip(t, (i + 0.5) * side, (j + 0.5) * side, {side, side}).r,
                            (t.mips[l.first + j * l.width + i] & 255) / 255.0, 1e-12);
    }
    EXPECT_EQ(pinchmap_sample_mip(t, 1.2, 2.3, {0.3, 0.5}).g, pinchmap_sample(t, 1.2, 2.3).g); // to one sample a pixel
}

/// §3: levels are read where the pinch says.
TEST(PinchmapMips, arePinchedToo) {
    PinchmapTexture t = pinchmap_of(mask_of({"..##", "..##", "..##", "..##"}),
                                    {.scale = 2, .gamma_from = 0.25, .gamma_to = 0.25, .mips = true});
    const double side = 0.5; // level 1: samples of half a cluster
    const PinchmapPlace place = pinchmap_place(t, 2.2, 1.75, {side, side});
    EXPECT_LT(place.i + place.x, 2.2);
    EXPECT_NEAR(pinchmap_sample_mip(t, 2.2, 1.75, {side, side}).r,
                fbt_mip_color(t.mips, 16, 16, 1, 4 * (place.i + place.x), 7).r, 1e-12);
}

TEST(PinchmapSizes, areCounted) {
    const PinchmapTexture t = pinchmap_of(
        mask_of({"....", "...."}),
        {.scale = 1, .map_format = PinchmapFormat::Bits8, .sample_format = PinchmapSampleFormat::Rgb8, .mips = true});
    EXPECT_EQ(pinchmap_gpu_bytes(t), 4u * 15 + 3u * 32 + 4u * (8 + 2 + 1));
    EXPECT_EQ(pinchmap_h(0), 0.5);
    EXPECT_EQ(pinchmap_h(2), 0.125);
}

} // namespace
} // namespace fetex
