// SPDX-License-Identifier: GPL-3.0-or-later
/// Every valid neighbourhood of the map (Tarini and Cignoni 2005, §4.4, §5.1), enumerated: steps 3 and 4 against linear
/// interpolation over triangles, and which fexels are read.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "formats/pinchmap.h"
#include "formats/validate.h"
#include "tests/support/known_pinchmap.h"
#include "tests/support/random.h"

namespace fetex {
namespace {

using fetexc::test::all_valid_masks;
using fetexc::test::mask_of;
using fetexc::test::pinchmap_of;
using fetexc::test::PinchmapMask;
using fetexc::test::Random;

constexpr std::uint32_t kSide = 4; ///< clusters; the least in which two lines are beside each other
constexpr std::size_t kMasks = 379;

const std::vector<PinchmapMask>& masks() {
    static const std::vector<PinchmapMask> all = all_valid_masks(kSide);
    return all;
}

/// Whether clusters of both sides are within a distance along the axes: of h, an undesired fexel holds the place.
bool near_both_sides(const PinchmapMask& mask, double x, double y, double distance) {
    const auto side = [&](double u, double v) {
        return mask.at(static_cast<int>(std::floor(u)), static_cast<int>(std::floor(v)));
    };
    const int first = side(x - distance, y - distance);
    return first != side(x + distance, y - distance) || first != side(x - distance, y + distance) ||
           first != side(x + distance, y + distance);
}

/// The constraints, read from the mask, are what the validator reads from the map alone.
TEST(PinchmapNeighbourhoods, areThoseOfTheValidator) {
    std::size_t valid = 0;
    for (std::uint32_t bits = 0; bits < 1u << 15; ++bits) {
        PinchmapMask m{kSide, kSide, {1}};
        for (std::uint32_t k = 0; k < 15; ++k)
            m.sides.push_back(bits >> k & 1 ? 1 : -1);
        const bool expected = is_valid(m);
        ASSERT_EQ(validate_pinchmap(pinchmap_of(m), 1).empty(), expected) << bits;
        valid += expected && !has_cross(m);
    }
    EXPECT_EQ(valid, kMasks);
    EXPECT_EQ(masks().size(), kMasks);
}

/// k and direction that are linear on each of two triangles; they meet in the diagonal through the odd corner.
struct Triangular {
    double k = 0, du = 0, dv = 0;
};
Triangular triangular(const PinchmapTexture& t, std::uint32_t i, std::uint32_t j, double fx, double fy) {
    const PinchmapTexel nw = pinchmap_texel(t, i, j), ne = pinchmap_texel(t, i + 1, j),
                        sw = pinchmap_texel(t, i, j + 1), se = pinchmap_texel(t, i + 1, j + 1);
    const bool falling = (ne.k == 0) == (sw.k == 0); // from the upper left to the lower right
    const bool upper = falling ? fx >= fy : fx + fy <= 1;
    double w_nw = 0, w_ne = 0, w_sw = 0, w_se = 0;
    if (falling && upper) w_nw = 1 - fx, w_ne = fx - fy, w_se = fy;
    if (falling && !upper) w_nw = 1 - fy, w_sw = fy - fx, w_se = fx;
    if (!falling && upper) w_nw = 1 - fx - fy, w_ne = fx, w_sw = fy;
    if (!falling && !upper) w_se = fx + fy - 1, w_ne = 1 - fy, w_sw = 1 - fx;
    const auto sum = [&](double PinchmapTexel::*m) {
        return w_nw * nw.*m + w_ne * ne.*m + w_sw * sw.*m + w_se * se.*m;
    };
    return {sum(&PinchmapTexel::k), sum(&PinchmapTexel::du), sum(&PinchmapTexel::dv)};
}

std::uint32_t active_corners(const PinchmapTexture& t, std::uint32_t i, std::uint32_t j) {
    std::uint32_t count = 0;
    for (std::uint32_t c = 0; c < 4; ++c)
        count += pinchmap_texel(t, i + c % 2, j + c / 2).k == 0;
    return count;
}

/// SPEC 8.2. Of two active corners both interpolations of k are one, and the direction is the bilinear one.
TEST(PinchmapSteps, areLinearOnTriangles) {
    Random random(1);
    std::size_t tested = 0;
    for (const PinchmapMask& mask : masks()) {
        const PinchmapTexture t = pinchmap_of(mask);
        for (std::uint32_t cluster = 0; cluster < kSide * kSide; ++cluster) {
            const std::uint32_t i = cluster % kSide, j = cluster / kSide, active = active_corners(t, i, j);
            if (active == 0) continue;
            for (int n = 0; n < 8; ++n) {
                const double fx = random.unit(), fy = random.unit();
                const PinchmapTexel blend = pinchmap_blend(t, i, j, fx, fy).at;
                const Triangular wanted = triangular(t, i, j, fx, fy);
                const double k = pinchmap_rectified_k(blend, fx, fy);
                ASSERT_NEAR(k, active == 2 ? blend.k : wanted.k, 1e-14);
                const PinchmapVector d = pinchmap_direction(blend, k);
                const double length = 1 - std::abs(k);
                ASSERT_NEAR(d.x, (active == 2 ? blend.du : wanted.du) / length, 1e-11);
                ASSERT_NEAR(d.y, (active == 2 ? blend.dv : wanted.dv) / length, 1e-11);
                ++tested;
            }
        }
    }
    EXPECT_GT(tested, 20000u);
}

/// k = gamma says the same as the interpolated values do (§5.1).
TEST(PinchmapSteps, keepTheDiscontinuityWhereTheInterpolatedValuesMeet) {
    Random random(2);
    const PinchmapTexture t = pinchmap_of(masks()[kMasks / 2], {.gamma_from = -0.5, .gamma_to = 0.5});
    for (int n = 0; n < 5000; ++n) {
        const double x = random.between(0, kSide), y = random.between(0, kSide);
        const PinchmapPlace place = pinchmap_place(t, x, y);
        const PinchmapTexel blend = pinchmap_blend(t, place.i, place.j, x - place.i, y - place.j).at;
        EXPECT_NEAR(place.k - place.gamma, blend.k - blend.gamma, 1e-14);
        EXPECT_EQ(place.cut.coverage, blend.k > blend.gamma ? 1 : 0);
    }
}

/// Any gamma within (−1, 1), any ratio of resolutions: no place inside an undesired fexel is ever read, and colours of
/// two sides are never mixed.
TEST(PinchmapPlaces, areNeverInUndesiredFexels) {
    Random random(3);
    std::uint64_t seed = 0;
    for (const PinchmapMask& mask : masks())
        for (const std::uint32_t scale : {0u, 1u, 2u}) {
            const double gamma = scale == 0 ? 0.99 : 0.5;
            const PinchmapTexture t =
                pinchmap_of(mask, {.scale = scale, .gamma_from = -gamma, .gamma_to = gamma, .seed = ++seed});
            for (int n = 0; n < 600; ++n) {
                const double x = random.between(0, kSide), y = random.between(0, kSide);
                const PinchmapPlace place = pinchmap_place(t, x, y);
                ASSERT_FALSE(near_both_sides(mask, place.i + place.x, place.j + place.y, pinchmap_h(scale) - 1e-9))
                    << x << " " << y;
                const FbtColor color = pinchmap_sample(t, x, y);
                ASSERT_NEAR(color.r, place.cut.coverage, 1e-9) << x << " " << y;
                ASSERT_NEAR(color.b, 1 - place.cut.coverage, 1e-9);
            }
        }
}

/// What the paper's divisor, 1 − |kB| everywhere, leaves: inside turns the pinch falls short and undesired fexels show.
TEST(PinchmapPlaces, needTheCorrectionInsideTurns) {
    const PinchmapMask mask = mask_of({"....", "....", "..##", "..##"});
    const PinchmapTexture t = pinchmap_of(mask);
    constexpr double kDeep = 0.02;
    int deep = 0;
    Random random(4);
    for (int n = 0; n < 20000; ++n) {
        const double x = random.between(2, 3), y = random.between(2, 3); // the cluster inside the turn
        const PinchmapTexel blend = pinchmap_blend(t, 2, 2, x - 2, y - 2).at;
        const double k = pinchmap_rectified_k(blend, x - 2, y - 2), length = 1 - std::abs(blend.k);
        const double p = pinchmap_shift(k, blend.k, 0.5, {1, 0});
        deep += near_both_sides(mask, x + p * blend.du / length, y + p * blend.dv / length, 0.5 - kDeep);
        const PinchmapPlace place = pinchmap_place(t, x, y);
        ASSERT_FALSE(near_both_sides(mask, place.i + place.x, place.j + place.y, 0.5 - 1e-9));
    }
    EXPECT_GT(deep, 500);
}

/// The divisor of step 4 vanishes where no texel is active, and so does what it divides.
TEST(PinchmapPlaces, stayWhereThePinchEnds) {
    for (const double gamma : {-126.0 / 127, 0.0, 126.0 / 127}) {
        const PinchmapTexture t =
            pinchmap_of(mask_of({"....", ".##.", ".##.", "...."}),
                        {.map_format = PinchmapFormat::Bits8, .gamma_from = gamma, .gamma_to = gamma});
        ASSERT_TRUE(validate_pinchmap(t).empty());
        for (std::uint32_t cluster = 0; cluster < 16; ++cluster)
            for (const double hair : {0.0, 1e-300, 1e-30, 1e-16, 1e-9, 1e-6})
                for (const double along : {0.0, 1e-20, 0.3, 1.0})
                    for (std::uint32_t side = 0; side < 4; ++side) {
                        const double across = side % 2 == 0 ? hair : 1 - hair, fx = side / 2 ? along : across,
                                     fy = side / 2 ? across : along;
                        const PinchmapPlace p = pinchmap_place_local(t, cluster % 4, cluster / 4, fx, fy);
                        ASSERT_LE(std::abs(p.x - fx), 1.5) << fx << " " << fy; // h + |gamma|, and a number
                        ASSERT_LE(std::abs(p.y - fy), 1.5);
                        if (std::abs(p.k) > 1 - 1e-6 && gamma == 0) {
                            ASSERT_LT(std::abs(p.x - fx) + std::abs(p.y - fy), 1e-5);
                        }
                    }
    }
}

/// A cross has no strength: nothing is pinched in it, what is around is partly, and nothing steps away from the lines.
TEST(PinchmapCrosses, fadeTheirPinch) {
    const PinchmapMask mask = mask_of({"..##", "..##", "##..", "##.."});
    ASSERT_TRUE(has_cross(mask) && is_valid(mask));
    const PinchmapTexture t = pinchmap_of(mask);
    EXPECT_TRUE(validate_pinchmap(t).empty());
    EXPECT_EQ(pinchmap_texel(t, 2, 2), (PinchmapTexel{0, 0, 0, 0}));
    EXPECT_NEAR(pinchmap_sample(t, 2 + 1e-9, 2 - 1e-9).r, 0.5, 1e-6);
    EXPECT_NEAR(pinchmap_sample(t, 2 + 1e-9, 0.5).r, 1, 1e-6);
    for (const double y : {0.3, 1.4, 1.9}) {
        double before = pinchmap_sample(t, 2.0001, y).r;
        for (double x = 2.0001; x < 4; x += 0.001) {
            const double now = pinchmap_sample(t, x, y).r;
            EXPECT_NEAR(now, before, 0.01);
            before = now;
        }
    }
}

} // namespace
} // namespace fetex
