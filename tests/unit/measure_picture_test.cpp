// SPDX-License-Identifier: GPL-3.0-or-later
/// PSNR, colour errors and islands of pictures with planted defects; and what is compiled from the scene itself.
#include <gtest/gtest.h>

#include <cmath>

#include "compiler/error_budget.h"
#include "compiler/measure/pictures.h"
#include "tests/support/fbt_maker.h"
#include "tests/support/known_shapes.h"
#include "tests/support/measured.h"
#include "tests/support/random.h"

namespace fetexc::measure {
namespace {

using test::black_where;
using test::errors_at;
using test::FunctionPicture;
using test::Random;

constexpr GridSize kTexels{64, 64};

fetex::FbtTexture compiled(const Scene& scene, std::uint32_t size) {
    const Result<FbtBuild> build = compile_fbt(scene, {{size, size}, 1});
    if (!build) throw std::runtime_error(build.error().message);
    return build.value().texture;
}

Scene left_half(const Rgba& color) {
    return test::layered(
        {{{test::canvas_box()}, {1, 1, 1, 1}}, {{test::closed_polygon({{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}})}, color}});
}

TEST(Psnr, ofAUniformOffsetIsItsSize) {
    const Scene scene = test::layered({{{test::canvas_box()}, {0.4, 0.4, 0.4, 1}}});
    const double delta = 0.01;
    // one channel of three, over both backgrounds
    const SizeErrors red = errors_at(scene,
                                     FunctionPicture(kTexels,
                                                     [=](TexturePoint) {
                                                         return Rgba{0.4 + delta, 0.4, 0.4, 1};
                                                     }),
                                     32);
    EXPECT_NEAR(red.psnr, 10 * std::log10(3 / (delta * delta)), 1e-6);
    EXPECT_NEAR(red.away.max, delta, 1e-12);
    EXPECT_NEAR(red.away.mean, delta, 1e-12);
    EXPECT_EQ(red.away.points, 1024u);
    // alpha shows in all three, over white only
    const SizeErrors alpha = errors_at(scene,
                                       FunctionPicture(kTexels,
                                                       [=](TexturePoint) {
                                                           return Rgba{0.4, 0.4, 0.4, 1 - delta};
                                                       }),
                                       32);
    EXPECT_NEAR(alpha.psnr, 10 * std::log10(2 / (delta * delta)), 1e-6);
    const SizeErrors none = errors_at(scene,
                                      FunctionPicture(kTexels,
                                                      [](TexturePoint) {
                                                          return Rgba{0.4, 0.4, 0.4, 1};
                                                      }),
                                      32);
    EXPECT_GT(none.psnr, 300);
}

TEST(Psnr, ofAnUprightEdgeMovedByPartOfAPixel) {
    const double part = 0.37;
    const SizeErrors e = errors_at(left_half({0, 0, 0, 1}),
                                   black_where(kTexels, [=](TexturePoint p) { return p.u < 0.5 + part / 64; }), 64);
    EXPECT_NEAR(e.psnr, 10 * std::log10(64 / (part * part)), 0.01);
}

TEST(Psnr, ofMovedHalfPlanesAtRandomAngles) {
    Random random(9);
    for (int k = 0; k < 6; ++k) {
        const double angle = random.between(0, 2 * test::kPi),
                     offset = 0.5 * (std::cos(angle) + std::sin(angle)) + 0.05, by = random.between(0.1, 1.5) / 64;
        const std::vector<CanvasPoint> truth = test::polygon_of({angle, offset}),
                                       moved = test::polygon_of({angle, offset + by});
        double mse = 0;
        for (int j = 0; j < 64; ++j) {
            for (int i = 0; i < 64; ++i) {
                const test::Rectangle box{i / 64.0, j / 64.0, (i + 1) / 64.0, (j + 1) / 64.0};
                const double off = (test::clipped_area(moved, box) - test::clipped_area(truth, box)) / box.area();
                mse += off * off / 4096;
            }
        }
        const test::HalfPlane plane{angle, offset + by};
        const SizeErrors e = errors_at(test::black_on_white({test::closed_polygon(truth)}),
                                       black_where(kTexels,
                                                   [&](TexturePoint p) {
                                                       return plane.depth({p.u, p.v}) > 0;
                                                   }),
                                       64);
        EXPECT_NEAR(e.psnr, -10 * std::log10(mse), 0.02);
    }
}

TEST(Psnr, ofAPictureThatIsRightIsFarAboveThatOfRasterisers) {
    const CanvasPoint center{0.47, 0.53};
    const Scene scene = test::black_on_white({test::round_disc(center, 0.31)});
    const SizeErrors e = errors_at(
        scene, black_where(kTexels, [&](TexturePoint p) { return std::hypot(p.u - center.x, p.v - center.y) < 0.31; }),
        256);
    EXPECT_GT(e.psnr, 80);
}

TEST(ColorError, ofAWrongTexelIsReportedWithItsPlace) {
    const Scene scene = left_half({0.2, 0.4, 0.6, 1});
    fetex::FbtTexture texture = compiled(scene, 16);
    const SizeErrors right = errors_at(scene, FbtPicture(texture), 256);
    EXPECT_LT(right.away.max, 1e-12);
    const std::uint32_t i = 12, j = 3; // white
    texture.texels[j * 16 + i] = test::solid_texel(0xff80ffffu);
    const SizeErrors wrong = errors_at(scene, FbtPicture(texture), 256);
    EXPECT_NEAR(wrong.away.max, 127.0 / 255, 1e-12);
    EXPECT_NEAR(wrong.away.place.u, (i + 0.5) / 16, 0.5 / 16);
    EXPECT_NEAR(wrong.away.place.v, (j + 0.5) / 16, 0.5 / 16);
    EXPECT_NEAR(wrong.away.mean, 127.0 / 255 * 256 / static_cast<double>(wrong.away.points), 1e-12);
    EXPECT_NEAR(static_cast<double>(wrong.away.points), 256 * 256 * 14 / 16.0,
                256); // a texel on both sides is left out
    EXPECT_LT(wrong.psnr, 40);
    EXPECT_EQ(wrong.misclassified_ppm, 0);
}

TEST(Islands, aLostOneAndAFalseOneAreFoundWithTheirSizes) {
    const auto disc = [](TexturePoint p, double x, double y, double r) { return std::hypot(p.u - x, p.v - y) < r; };
    const Scene scene = test::black_on_white({test::round_disc({0.3, 0.3}, 0.1), test::round_disc({0.7, 0.7}, 0.02)});
    const auto both = [&](TexturePoint p) { return disc(p, 0.3, 0.3, 0.1) || disc(p, 0.7, 0.7, 0.02); };
    const SizeErrors right = errors_at(scene, black_where(kTexels, both), 512);
    EXPECT_EQ(right.islands.lost, 0u);
    EXPECT_EQ(right.islands.invented, 0u);
    EXPECT_EQ(right.islands.largest_ppm, 0);

    const SizeErrors lost =
        errors_at(scene, black_where(kTexels, [&](TexturePoint p) { return disc(p, 0.3, 0.3, 0.1); }), 512);
    EXPECT_EQ(lost.islands.lost, 1u);
    EXPECT_EQ(lost.islands.invented, 0u);
    EXPECT_NEAR(lost.islands.largest_ppm, 1e6 * test::kPi * 0.02 * 0.02, 50);
    EXPECT_NEAR(lost.islands.place.u, 0.7, 0.02);
    EXPECT_NEAR(lost.islands.place.v, 0.7, 0.02);

    // close to the large disc, within reach of its edge, but not touching it
    const SizeErrors invented = errors_at(
        scene, black_where(kTexels, [&](TexturePoint p) { return both(p) || disc(p, 0.413, 0.3, 0.008); }), 512);
    EXPECT_EQ(invented.islands.lost, 0u);
    EXPECT_EQ(invented.islands.invented, 1u);
    EXPECT_NEAR(invented.islands.largest_ppm, 1e6 * test::kPi * 0.008 * 0.008, 20);
    EXPECT_NEAR(invented.islands.place.u, 0.413, 0.008);
}

TEST(Islands, aHairlineMovedByPartOfItsWidthIsNotLost) {
    // a line of a fifth of a pixel: sampled as single points, other ones in the picture
    const auto line = [](double x) {
        return test::closed_polygon({{x, 0.1}, {x + 0.0008, 0.1}, {x + 0.1008, 0.9}, {x + 0.1, 0.9}});
    };
    const Scene scene = test::black_on_white({line(0.4)});
    const auto texture = compiled(test::black_on_white({line(0.4002)}), 64);
    const SizeErrors e = errors_at(scene, FbtPicture(texture), 256);
    EXPECT_GT(e.misclassified_ppm, 0);
    EXPECT_EQ(e.islands.lost, 0u);
    EXPECT_EQ(e.islands.invented, 0u);
}

TEST(Fbt, compiledFromTheSceneItselfIsRight) {
    const std::vector<Scene> scenes = {
        test::black_on_white({test::round_disc({0.47, 0.53}, 0.31)}),
        test::black_on_white({test::closed_polygon(test::polygon_of({0.7, 0.6}))}),
        test::black_on_white({test::round_disc({0.5, 0.5}, 0.4), test::round_disc({0.5, 0.5}, 0.399)}),
        test::layered({{{test::round_disc({0.4, 0.5}, 0.3)}, {1, 0, 0, 0.5}},
                       {{test::round_disc({0.6, 0.5}, 0.3)}, {0, 0, 1, 0.5}},
                       {{test::closed_polygon({{0.1, 0.2}, {0.9, 0.3}, {0.5, 0.8}})}, {0, 1, 0, 1}}})};
    for (const Scene& scene : scenes) {
        const fetex::FbtTexture texture = compiled(scene, 64);
        const SizeErrors e = errors_at(scene, FbtPicture(texture), 512);
        EXPECT_EQ(e.misclassified_ppm, 0);
        EXPECT_LT(e.to_truth.hausdorff, budget::kRegionTolerance / 64);
        EXPECT_LT(e.to_picture.hausdorff, budget::kRegionTolerance / 64);
        EXPECT_GT(e.to_picture.points, 500u);
        EXPECT_EQ(e.islands.lost + e.islands.invented, 0u);
        EXPECT_LT(e.away.max, 1e-12);
        EXPECT_GT(e.psnr, 75);
    }
}

TEST(Fbt, aStripHalfwayBetweenItsNeighboursColoursHasTwoEdges) {
    // sample points step over it: where the colour changes from one neighbour's to the other's is a tie all over it
    const auto grey = [](int v) { return Rgba{v / 255.0, v / 255.0, v / 255.0, 1}; };
    const Scene scene = test::layered({{{test::canvas_box()}, grey(255)},
                                       {{test::closed_polygon({{0.4, 0}, {1, 0}, {1, 1}, {0.5, 1}})}, grey(204)},
                                       {{test::closed_polygon({{0.402, 0}, {1, 0}, {1, 1}, {0.502, 1}})}, grey(153)}});
    const fetex::FbtTexture texture = compiled(scene, 16);
    const SizeErrors e = errors_at(scene, FbtPicture(texture), 256);
    EXPECT_GT(e.to_truth.points, 256u);
    EXPECT_LT(e.to_truth.hausdorff, budget::kRegionTolerance / 16);
    EXPECT_LT(e.to_picture.hausdorff, budget::kRegionTolerance / 16);
}

TEST(BitmapPicture, showsItsTexelsAtTheirCentresAndClampsItsBorders) {
    const std::vector<std::uint8_t> rgba{0, 0, 0, 255, 255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255};
    const BitmapPicture smooth({2, 2}, rgba, BitmapPicture::Filter::Bilinear),
        nearest({2, 2}, rgba, BitmapPicture::Filter::Nearest);
    for (const BitmapPicture* picture : {&smooth, &nearest}) {
        EXPECT_EQ(picture->at({0.25, 0.25}), (Rgba{0, 0, 0, 1}));
        EXPECT_EQ(picture->at({0.75, 0.75}), (Rgba{0, 0, 1, 1}));
        EXPECT_EQ(picture->at({0, -3}), (Rgba{0, 0, 0, 1}));
        EXPECT_EQ(picture->at({1, 1}), (Rgba{0, 0, 1, 1}));
        EXPECT_EQ(picture->gpu_bytes(), 16u);
    }
    EXPECT_EQ(smooth.at({0.5, 0.25}), (Rgba{0.5, 0, 0, 1}));
    EXPECT_EQ(smooth.at({0.5, 0.5}), (Rgba{0.25, 0.25, 0.25, 1}));
    EXPECT_EQ(nearest.at({0.5, 0.25}), (Rgba{1, 0, 0, 1}));
}

} // namespace
} // namespace fetexc::measure
