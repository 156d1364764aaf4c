// SPDX-License-Identifier: GPL-3.0-or-later
/// Known answers of what others would pick: where a box threshold and a distance field put straight edges and corners,
/// sizes of equal bytes, and scenes that they can't hold.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "compiler/measure/alternatives.h"
#include "tests/support/drawn_scene.h"
#include "tests/support/measured.h"
#include "tests/support/random.h"

namespace fetexc::measure {
namespace {

using test::box;
using test::closed;
using test::Path;
using test::scene_of;
using test::truth_of;

constexpr std::uint32_t kSide = 16; ///< texels, of 32 units each
constexpr GridSize kGrid{kSide, kSide};
constexpr double kUnit = 1.0 / 512;
/// A distance field's byte is at most half a step off, and its slope is one.
constexpr double kHalfStep = kDistanceRange / 255 / 2; ///< texels

std::unique_ptr<Picture> make(const Truth& truth, Alternative kind, GridSize size = kGrid) {
    auto made = make_alternative(truth, kind, size, 1);
    EXPECT_TRUE(made.ok()) << made.error().message;
    return std::move(made).value();
}

/// Parameter in [0, 1] where the picture's colour changes along a line that starts inside and ends outside.
double change_along(const Picture& picture, TexturePoint from, TexturePoint to) {
    double inside = 0, outside = 1;
    const auto opaque = [&](double s) {
        return picture.at({std::lerp(from.u, to.u, s), std::lerp(from.v, to.v, s)}).a > 0.5;
    };
    EXPECT_TRUE(opaque(0) && !opaque(1));
    for (int k = 0; k < 50; ++k) {
        const double middle = (inside + outside) / 2;
        (opaque(middle) ? inside : outside) = middle;
    }
    return inside;
}

TEST(GridOfBytes, isTheLargestThatFits) {
    struct Case {
        double aspect;
        std::uint64_t bytes;
        unsigned per_texel;
        std::uint32_t width, height;
    };
    for (const Case& c : {Case{1, 768, 4, 13, 13},
                          {1, 768, 1, 27, 27},
                          {1, 3072, 1, 55, 55},
                          {1, 12288, 1, 110, 110},
                          {1, 12288, 4, 55, 55},
                          {1, 49152, 4, 110, 110},
                          {0.5, 3200, 1, 80, 40},
                          {2, 3200, 1, 40, 80},
                          {1, 0, 4, 1, 1},
                          {1, 3, 4, 1, 1},
                          {1, 4, 4, 1, 1},
                          {0.001, 100, 1, 100, 1},
                          {1000, 100, 1, 1, 1000},
                          {1, std::uint64_t{1} << 40, 1, 16384, 16384}}) {
        const GridSize size = grid_of_bytes(c.aspect, c.bytes, c.per_texel);
        EXPECT_EQ(size.width, c.width) << c.aspect << ' ' << c.bytes;
        EXPECT_EQ(size.height, c.height) << c.aspect << ' ' << c.bytes;
    }
}

TEST(GridOfBytes, hasNoLargerNeighbourThatFits) {
    test::Random random(5);
    for (int n = 0; n < 2000; ++n) {
        const double aspect = std::exp2(random.between(-4, 4));
        const auto bytes = static_cast<std::uint64_t>(std::exp2(random.between(8, 24)));
        const GridSize size = grid_of_bytes(aspect, bytes, 4);
        EXPECT_LE(std::uint64_t{size.width} * size.height * 4, bytes);
        EXPECT_GT((size.width + 1) * std::max(1.0, std::round((size.width + 1) * aspect)) * 4,
                  static_cast<double>(bytes));
        EXPECT_NEAR(size.height, size.width * aspect, 0.5 + 1e-9);
    }
}

/// An upright edge f of a texel into a texel. A box filter's ramp is not the edge's distance: with the texel's coverage
/// f below one half the cut lies at (1 − 2f)/(2 − 2f) of a texel before its centre, up to (3/2 − √2) = 0.086 off.
TEST(BoxThreshold, putsUprightEdgesWhereTheRampIsHalf) {
    for (int k = 0; k <= 32; ++k) {
        const Scene scene = scene_of({box(-100, -100, 224 + k, 612)});
        const auto truth = truth_of(scene);
        const auto picture = make(*truth, Alternative::BoxThreshold);
        const double found = change_along(*picture, {0.2, 0.37}, {0.8, 0.37}) * 0.6 * kSide + 0.2 * kSide - 7;
        const double f = k / 32.0, expected = f <= 0.5 ? 0.5 - (1 - 2 * f) / (2 - 2 * f) : 0.5 + (2 * f - 1) / (2 * f);
        EXPECT_NEAR(found, expected, 1.0 / 127) << k; // a byte, where the ramp is flattest
        EXPECT_NEAR(found, f, 1.5 - std::sqrt(2) + 1.0 / 127) << k;
        if (k % 32 == 0) {
            EXPECT_NEAR(found, f, 1e-9);
        }
    }
}

/// Distances are linear and so is the interpolation: only the bytes' rounding is left, and it is none when both
/// neighbours are rounded alike.
TEST(DistanceField, reproducesUprightEdges) {
    for (int k = 0; k <= 32; ++k) {
        const Scene scene = scene_of({box(-100, -100, 224 + k, 612)});
        const auto truth = truth_of(scene);
        const auto picture = make(*truth, Alternative::DistanceField);
        const double found = change_along(*picture, {0.2, 0.37}, {0.8, 0.37}) * 0.6 * kSide + 0.2 * kSide - 7;
        EXPECT_NEAR(found, k / 32.0, kHalfStep) << k;
        if (k % 32 == 0) {
            EXPECT_NEAR(found, k / 32.0, 1e-9);
        }
    }
}

/// Away from where the edge leaves the canvas: beyond, it doesn't exist for a texture.
TEST(DistanceField, reproducesHalfPlanesAtRandomAngles) {
    test::Random random(7);
    std::uint32_t near = 0;
    for (int n = 0; n < 20; ++n) {
        const double angle = random.between(0, 2 * M_PI), offset = random.between(-60, 60);
        const auto place = [&](double along, double out) {
            return LatticePoint{std::lround(256 + along * std::cos(angle) - (offset + out) * std::sin(angle)),
                                std::lround(256 + along * std::sin(angle) + (offset + out) * std::cos(angle))};
        };
        const Scene scene = scene_of({closed(
            {{place(-900, 0), place(900, 0)}, {place(900, 0), place(900, 900)}, {place(900, 900), place(-900, 900)}})});
        const auto truth = truth_of(scene);
        const auto picture = make(*truth, Alternative::DistanceField);
        for (int k = 0; k < 4000; ++k) {
            const double along = random.between(-150, 150), out = random.between(-4, 4);
            const TexturePoint p{(256 + along * std::cos(angle) - (offset + out) * std::sin(angle)) * kUnit,
                                 (256 + along * std::sin(angle) + (offset + out) * std::cos(angle)) * kUnit};
            const EdgePoint edge = truth->nearest_edge(p, 1);
            ASSERT_NE(edge.edge, kNone);
            near += edge.distance * kSide < 4 * kHalfStep;
            if (edge.distance * kSide < kHalfStep + 1e-6) continue;
            EXPECT_EQ(picture->at(p), truth->color(truth->result_at(p), p)) << n << ' ' << p.u << ' ' << p.v;
        }
    }
    EXPECT_GT(near, 1000u) << "points close enough to tell";
}

/// At a square's corner on a corner of the grid the four samples around it are 1, 0, 0, 0: the cut on the diagonal is
/// where (1 − s)² = 1/2.
TEST(BoxThreshold, dentsCorners) {
    const Scene scene = scene_of({box(-100, -100, 256, 256)});
    const auto picture = make(*truth_of(scene), Alternative::BoxThreshold);
    const double s = change_along(*picture, {7.5 / kSide, 7.5 / kSide}, {8.5 / kSide, 8.5 / kSide});
    EXPECT_NEAR(s, 1 - std::sqrt(0.5), 1.0 / 255);
}

/// Distances 1/2, −1/2, −1/2, −√½: the cut is where ½(1 − s)² − s(1 − s) − √½ s² = 0, 0.31 texels from the corner.
TEST(DistanceField, dentsCorners) {
    const Scene scene = scene_of({box(-100, -100, 256, 256)});
    const auto picture = make(*truth_of(scene), Alternative::DistanceField);
    const double s = change_along(*picture, {7.5 / kSide, 7.5 / kSide}, {8.5 / kSide, 8.5 / kSide});
    const double a = 1.5 - std::sqrt(0.5);
    EXPECT_NEAR(s, (2 - std::sqrt(4 - 2 * a)) / (2 * a), 2 * kHalfStep);
    EXPECT_NEAR((0.5 - s) * std::sqrt(2), 0.309, 0.01);
}

/// A far edge has no influence: values beyond the range are clamped.
TEST(DistanceField, clampsBeyondItsRange) {
    const Scene scene = scene_of({box(-100, -100, 256, 612)});
    const auto made = make(*truth_of(scene), Alternative::DistanceField);
    const auto* field = dynamic_cast<const FieldPicture*>(made.get());
    ASSERT_NE(field, nullptr);
    EXPECT_EQ(field->range(), kDistanceRange);
    EXPECT_EQ(field->gpu_bytes(), std::uint64_t{kSide} * kSide);
    const std::uint8_t expected[kSide] = {255, 255, 255, 255, 255, 255, 223, 159, 96, 32, 0, 0, 0, 0, 0, 0};
    for (std::size_t k = 0; k < field->values().size(); ++k)
        EXPECT_EQ(field->values()[k], expected[k % kSide]) << k;
}

TEST(Bitmap, isTheExactPictureInBytes) {
    const Scene scene = scene_of({box(37, 41, 301, 459), box(101, 7, 203, 333)});
    const auto truth = truth_of(scene);
    const GridSize size{23, 19};
    const auto picture = make(*truth, Alternative::Bitmap, size);
    const auto exact = truth->picture(size, 1);
    ASSERT_TRUE(exact.ok());
    EXPECT_EQ(picture->gpu_bytes(), 23u * 19 * 4);
    for (std::uint32_t j = 0; j < size.height; ++j)
        for (std::uint32_t i = 0; i < size.width; ++i) {
            const Rgba a = picture->at({(i + 0.5) / size.width, (j + 0.5) / size.height});
            const Rgba b = exact.value()[j * size.width + i];
            for (const auto channel : {&Rgba::r, &Rgba::g, &Rgba::b, &Rgba::a})
                EXPECT_NEAR(a.*channel, b.*channel, 0.5 / 255 + 1e-12);
        }
}

/// Ink is above: opaque over transparent, dark over light.
TEST(Fields, callTheInkAbove) {
    Scene scene = scene_of({box(-100, -100, 612, 612), box(100, 100, 400, 400)});
    for (const bool dark_inside : {false, true}) {
        for (std::size_t k = 0; k < 2; ++k)
            std::get<SolidPaint>(scene.paints[k]).color = (k == 1) == dark_inside ? Rgba{0, 0, 0, 1} : Rgba{1, 1, 1, 1};
        const auto picture = make(*truth_of(scene), Alternative::BoxThreshold);
        const auto& field = dynamic_cast<const FieldPicture&>(*picture);
        EXPECT_EQ(field.above(), (Rgba{0, 0, 0, 1}));
        EXPECT_EQ(field.below(), (Rgba{1, 1, 1, 1}));
        EXPECT_EQ(field.at({0.5, 0.5}).r, dark_inside ? 0 : 1);
        EXPECT_EQ(field.at({0.05, 0.5}).r, dark_inside ? 1 : 0);
    }
}

TEST(Fields, needTwoSolidColors) {
    const Scene one = scene_of({box(-100, -100, 612, 612)}),
                three = scene_of({box(0, 0, 100, 100), box(200, 0, 300, 90)});
    Scene varying = scene_of({box(100, 100, 300, 300)});
    varying.paints[0] = LinearPaint{{0.002, 0, 0, 0.002, 0, 0}, {{0, {1, 0, 0, 1}}, {1, {0, 0, 1, 1}}}, Spread::Pad};
    const Scene two = scene_of({box(100, 100, 300, 300)});
    for (const Alternative kind : {Alternative::BoxThreshold, Alternative::DistanceField}) {
        EXPECT_EQ(why_not(*truth_of(one), kind), "not applicable: 1 colour");
        EXPECT_EQ(why_not(*truth_of(three), kind), "not applicable: 3 colours");
        EXPECT_EQ(why_not(*truth_of(varying), kind), "not applicable: colours that vary");
        EXPECT_EQ(why_not(*truth_of(two), kind), "");
        const auto made = make_alternative(*truth_of(three), kind, kGrid, 1);
        ASSERT_FALSE(made.ok());
        EXPECT_EQ(made.error().message, "not applicable: 3 colours");
    }
    for (const Scene* scene : std::initializer_list<const Scene*>{&one, &three, &varying})
        EXPECT_EQ(why_not(*truth_of(*scene), Alternative::Bitmap), "");
}

TEST(Fields, areTheSameOnAnyNumberOfThreads) {
    const Scene scene = scene_of({box(37, 41, 301, 459)});
    const auto truth = truth_of(scene);
    for (const Alternative kind : {Alternative::BoxThreshold, Alternative::DistanceField}) {
        const auto a = make_alternative(*truth, kind, {61, 47}, 1), b = make_alternative(*truth, kind, {61, 47}, 0);
        ASSERT_TRUE(a.ok() && b.ok());
        const auto x = dynamic_cast<const FieldPicture&>(*a.value()).values(),
                   y = dynamic_cast<const FieldPicture&>(*b.value()).values();
        EXPECT_TRUE(std::equal(x.begin(), x.end(), y.begin(), y.end()));
    }
}

} // namespace
} // namespace fetexc::measure
