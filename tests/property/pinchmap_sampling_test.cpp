// SPDX-License-Identifier: GPL-3.0-or-later
/// What holds for every pinchmap: where the signal is read is a one-to-one image of the drawing off the discontinuities
/// (Tarini and Cignoni 2005, §4.1), and nothing steps elsewhere, or while pixels grow or move.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/pinchmap.h"
#include "tests/support/known_pinchmap.h"
#include "tests/support/random.h"

namespace fetexc::test {
namespace {

using namespace fetex;

constexpr std::uint32_t kSide = 4;
/// SPEC 8.5: within this, and with turns rounded, the map is one-to-one.
constexpr double kSafeGamma = 0.25;

double difference(const FbtColor& a, const FbtColor& b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b), std::abs(a.a - b.a)});
}

struct Image {
    double x = 0, y = 0;
    bool above = false;
};
Image image_of(const PinchmapTexture& t, double x, double y) {
    const PinchmapPlace place = pinchmap_place(t, x, y);
    return {place.i + place.x, place.j + place.y, place.cut.coverage > 0};
}

double cross(const Image& a, const Image& b, const Image& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Triangles of a fine grid over the drawing, moved; those that a discontinuity cuts are left out.
class MovedGrid {
  public:
    static constexpr int kCuts = 24; ///< of a cluster; a multiple of 2: triangles don't cross diagonals

    explicit MovedGrid(const PinchmapTexture& t) {
        for (int j = 0; j <= kRow - 1; ++j)
            for (int i = 0; i <= kRow - 1; ++i)
                points_.push_back(image_of(t, double(i) / kCuts, double(j) / kCuts));
    }

    /// Calls see(a, b, c) for each.
    template <class See> void for_each(const See& see) const {
        for (int j = 0; j + 1 < kRow; ++j)
            for (int i = 0; i + 1 < kRow; ++i) {
                const Image &a = at(i, j), &b = at(i + 1, j), &c = at(i, j + 1), &d = at(i + 1, j + 1);
                // Parallel to the diagonals of both kinds in turns, so that the bends of step 3 fall on edges.
                const int x = i % kCuts, y = j % kCuts;
                const bool falling = x == y || (x + y + 1 != kCuts && (x + y) % 2 == 0);
                const std::array<std::array<const Image*, 3>, 2> two =
                    falling ? std::array<std::array<const Image*, 3>, 2>{{{&a, &b, &d}, {&a, &d, &c}}}
                            : std::array<std::array<const Image*, 3>, 2>{{{&a, &b, &c}, {&b, &d, &c}}};
                for (const auto& [p, q, r] : two)
                    if (p->above == q->above && q->above == r->above) see(*p, *q, *r);
            }
    }

  private:
    static constexpr int kRow = int{kSide} * kCuts + 1;
    [[nodiscard]] const Image& at(int i, int j) const { return points_[static_cast<std::size_t>(j * kRow + i)]; }
    std::vector<Image> points_;
};

/// How often triangles hold a place.
int times_read(const MovedGrid& grid, double x, double y) {
    int times = 0;
    const Image p{x, y, false};
    grid.for_each([&](const Image& a, const Image& b, const Image& c) {
        times += cross(a, b, p) > 0 && cross(b, c, p) > 0 && cross(c, a, p) > 0;
    });
    return times;
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

/// Of all valid neighbourhoods and random gamma: no triangle turns over, every place outside undesired fexels is read
/// once, none in them is.
TEST(PinchmapProperty, isOneToOneOffTheDiscontinuity) {
    Random random(1);
    constexpr double kMargin = 2.0 / MovedGrid::kCuts; // triangles on the discontinuity are missing
    std::uint64_t seed = 0, triangles = 0, outside = 0, inside = 0;
    for (const PinchmapMask& mask : all_valid_masks(kSide)) {
        const PinchmapTexture t = pinchmap_of(mask, {.scale = static_cast<std::uint32_t>(seed % 3),
                                                     .gamma_from = -kSafeGamma,
                                                     .gamma_to = kSafeGamma,
                                                     .turns_round = true,
                                                     .seed = ++seed});
        const MovedGrid grid(t);
        grid.for_each([&](const Image& a, const Image& b, const Image& c) {
            ++triangles;
            ASSERT_GT(cross(a, b, c), -1e-9) << seed;
        });
        for (int n = 0; n < 8; ++n) {
            const double x = random.between(0, kSide), y = random.between(0, kSide);
            if (!near_both_sides(mask, x, y, pinchmap_h(t.scale) + kMargin)) {
                ++outside;
                ASSERT_EQ(times_read(grid, x, y), 1) << seed << ": " << x << ", " << y;
            } else if (near_both_sides(mask, x, y, pinchmap_h(t.scale) - 1e-6)) {
                ++inside;
                ASSERT_EQ(times_read(grid, x, y), 0) << seed << ": " << x << ", " << y;
            }
        }
    }
    std::printf("  %llu triangles, %llu places outside, %llu inside\n", static_cast<unsigned long long>(triangles),
                static_cast<unsigned long long>(outside), static_cast<unsigned long long>(inside));
    EXPECT_GT(outside, 500u);
    EXPECT_GT(inside, 500u);
}

/// On straight lines any gamma will do: each pinch crosses the line once.
TEST(PinchmapProperty, isOneToOneOnStraightLinesForAnyGamma) {
    std::uint64_t seed = 100;
    for (const auto& rows :
         {std::vector<std::string>{"..##", "..##", "..##", "..##"}, {"....", "....", "####", "####"}})
        for (int n = 0; n < 20; ++n) {
            const PinchmapTexture t = pinchmap_of(
                mask_of(rows),
                {.scale = static_cast<std::uint32_t>(seed % 3), .gamma_from = -0.99, .gamma_to = 0.99, .seed = ++seed});
            MovedGrid(t).for_each(
                [&](const Image& a, const Image& b, const Image& c) { ASSERT_GT(cross(a, b, c), -1e-9) << seed; });
        }
}

/// Without rounded turns a pinch may cross the discontinuity more than once: the paper's claim for any gamma doesn't
/// hold. Undesired fexels aren't read even so (unit/formats_pinchmap_cases_test).
TEST(PinchmapProperty, isNotOneToOneWhereTurnsBendInwards) {
    std::uint64_t turned = 0, all = 0, seed = 0;
    for (const PinchmapMask& mask : all_valid_masks(kSide)) {
        const PinchmapTexture t = pinchmap_of(mask, {.gamma_from = -0.5, .gamma_to = 0.5, .seed = ++seed});
        MovedGrid(t).for_each([&](const Image& a, const Image& b, const Image& c) {
            ++all;
            turned += cross(a, b, c) < -1e-6;
        });
    }
    std::printf("  %.4f of the drawing is read backwards\n", static_cast<double>(turned) / static_cast<double>(all));
    EXPECT_GT(turned, 100u);
    EXPECT_LT(static_cast<double>(turned), 0.02 * static_cast<double>(all));
}

/// Across the borders of clusters, and inside them, places follow the point, but for the discontinuity.
TEST(PinchmapProperty, stepsOnlyOnTheDiscontinuity) {
    Random random(2);
    constexpr double kHair = 1e-7, kSteepest = 400;
    std::uint64_t seed = 0;
    for (const PinchmapMask& mask : all_valid_masks(kSide)) {
        const PinchmapTexture t = pinchmap_of(mask, {.scale = static_cast<std::uint32_t>(seed % 3),
                                                     .gamma_from = -0.5,
                                                     .gamma_to = 0.5,
                                                     .least_strength = seed % 2 == 0 ? 0.0 : 1.0,
                                                     .seed = ++seed});
        for (int n = 0; n < 400; ++n) {
            double x = random.between(0.001, kSide - 0.001), y = random.between(0.001, kSide - 0.001);
            if (n % 4 == 1) x = random.integer(1, kSide - 1); // on a border
            if (n % 4 == 2) y = random.integer(1, kSide - 1);
            if (n % 4 == 3) y = std::floor(y) + (x - std::floor(x)); // on a diagonal
            const double angle = random.between(0, 6.28), dx = kHair * std::cos(angle), dy = kHair * std::sin(angle);
            const Image a = image_of(t, x - dx, y - dy), b = image_of(t, x + dx, y + dy);
            if (a.above != b.above) continue;
            ASSERT_LT(std::hypot(a.x - b.x, a.y - b.y), kSteepest * kHair) << seed << ": " << x << ", " << y;
        }
    }
}

/// While the pixel grows from nothing to beyond the texture, through all levels; lines too.
TEST(PinchmapProperty, nothingStepsWhilePixelsGrow) {
    Random random(5);
    for (const std::uint32_t scale : {0u, 1u}) {
        PinchmapTexture t = pinchmap_of(
            random_mask(6, 9, 7),
            {.scale = scale, .signal = KnownSignal::Random, .gamma_from = -0.4, .gamma_to = 0.4, .mips = true});
        t.line_width = 6000;
        for (int k = 0; k < 300; ++k) {
            const double x = random.between(0, 9), y = random.between(0, 7);
            FbtColor before = pinchmap_sample_mip(t, x, y, {0.05, 0.05});
            for (double side = 0.05; side < 20; side *= 1.002) {
                const FbtColor now = pinchmap_sample_mip(t, x, y, {side, side});
                ASSERT_LT(difference(now, before), 0.03) << side;
                before = now;
            }
        }
    }
}

/// A soft edge hides the step: colours change no faster than an edge does that crosses a pixel, but where the edge's
/// slope changes from cluster to cluster.
TEST(PinchmapProperty, nothingStepsWhilePixelsMoveAlongAStraightEdge) {
    const PinchmapTexture t = pinchmap_of(
        mask_of({"..##", "..##"}), {.scale = 1, .signal = KnownSignal::Random, .gamma_from = 0.2, .gamma_to = 0.2});
    for (const double side : {0.02, 0.1, 0.5}) {
        const double step = side / 200;
        FbtColor before = pinchmap_sample_area(t, 0, 0.8, {side, side});
        for (double x = 0; x < 4; x += step) {
            const FbtColor now = pinchmap_sample_area(t, x, 0.8, {side, side});
            ASSERT_LT(difference(now, before), 0.012) << x;
            before = now;
        }
    }
}

/// Premultiplied colours stay so.
TEST(PinchmapProperty, colorsStayPremultiplied) {
    Random random(7);
    PinchmapTexture t = pinchmap_of(random_mask(9, 9, 7), {.scale = 1,
                                                           .signal = KnownSignal::Random,
                                                           .gamma_from = -0.9,
                                                           .gamma_to = 0.9,
                                                           .least_strength = 0,
                                                           .mips = true});
    t.line_width = 9000, t.line_color = 0x40001020;
    for (int k = 0; k < 20000; ++k) {
        const double x = random.between(-1, 10), y = random.between(-1, 8), side = random.between(0, 3);
        const FbtColor c = pinchmap_sample_mip(t, x, y, {side, side / 2});
        EXPECT_LE(std::max({c.r, c.g, c.b}), c.a + 1e-12);
        EXPECT_LE(c.a, 1 + 1e-12);
        EXPECT_GE(std::min({c.r, c.g, c.b}), -1e-12);
    }
}

} // namespace
} // namespace fetexc::test
