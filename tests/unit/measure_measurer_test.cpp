// SPDX-License-Identifier: GPL-3.0-or-later
/// Several pictures against one truth, and figures that aren't wanted.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/known_shapes.h"
#include "tests/support/measured.h"

namespace fetexc::measure {
namespace {

void expect_same(const Distances& a, const Distances& b) {
    EXPECT_EQ(a.mean, b.mean);
    EXPECT_EQ(a.p95, b.p95);
    EXPECT_EQ(a.hausdorff, b.hausdorff);
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.beyond_reach, b.beyond_reach);
}

void expect_not_measured(const Distances& d) {
    EXPECT_TRUE(std::isnan(d.mean) && std::isnan(d.p95) && std::isnan(d.hausdorff));
    EXPECT_EQ(d.points, 0u);
}

/// A figure is the full measurement's, or says that it isn't measured.
void expect_figure(bool wanted, double figure, double full) {
    if (wanted)
        EXPECT_EQ(figure, full);
    else
        EXPECT_TRUE(std::isnan(figure));
}

void expect_distances(bool wanted, const Distances& d, const Distances& full) {
    wanted ? expect_same(d, full) : expect_not_measured(d);
}

void expect_only(const Figures& wanted, const SizeErrors& e, const SizeErrors& all) {
    EXPECT_EQ(e.pixels.width, all.pixels.width);
    EXPECT_EQ(e.pixels_per_texel, all.pixels_per_texel);
    expect_figure(wanted.misclassified, e.misclassified_ppm, all.misclassified_ppm);
    expect_figure(wanted.misclassified, e.misclassified_error_ppm, all.misclassified_error_ppm);
    expect_figure(wanted.psnr, e.psnr, all.psnr);
    expect_distances(wanted.boundary, e.to_truth, all.to_truth);
    expect_distances(wanted.boundary, e.to_picture, all.to_picture);
    EXPECT_EQ(e.edges_without_contrast, wanted.boundary ? all.edges_without_contrast : 0u);
    expect_figure(wanted.away, e.away.max, all.away.max);
    expect_figure(wanted.away, e.away.mean, all.away.mean);
    EXPECT_EQ(e.away.points, wanted.away ? all.away.points : 0u);
    expect_figure(wanted.islands, e.islands.largest_ppm, all.islands.largest_ppm);
    EXPECT_EQ(e.islands.lost, wanted.islands ? all.islands.lost : 0u);
    EXPECT_EQ(e.islands.invented, wanted.islands ? all.islands.invented : 0u);
}

class MeasurerTest : public testing::Test {
  protected:
    MeasurerTest() : scene_(test::black_on_white({test::round_disc({0.5, 0.5}, 0.3)})), truth_(test::truth_of(scene_)) {
        options_.sizes = {{96, 96}, {64, 64}};
        options_.threads = 1;
    }
    /// With a false island, a moved edge and a wrong colour.
    [[nodiscard]] static test::FunctionPicture disc(GridSize texels, double radius) {
        return {texels, [radius](TexturePoint p) {
                    if (std::hypot(p.u - 0.06, p.v - 0.06) < 0.04) return Rgba{1, 0.9, 1, 1};
                    return std::hypot(p.u - 0.5, p.v - 0.5) < radius ? test::kBlack : test::kWhite;
                }};
    }
    [[nodiscard]] Measurer measurer() const {
        Result<Measurer> made = Measurer::of(*truth_, options_);
        if (!made) throw std::runtime_error(made.error().message);
        return std::move(made).value();
    }

    Scene scene_;
    std::unique_ptr<Truth> truth_;
    MeasureOptions options_;
};

TEST_F(MeasurerTest, measuresEachPictureAsIfItWereTheOnlyOne) {
    const Measurer shared = measurer();
    for (const test::FunctionPicture& picture : {disc({16, 16}, 0.31), disc({64, 64}, 0.293), disc({16, 16}, 0.31)}) {
        const std::vector<SizeErrors> together = shared.measure(picture);
        const auto alone = measure(*truth_, picture, options_);
        ASSERT_TRUE(alone.ok());
        ASSERT_EQ(together.size(), 2u);
        ASSERT_EQ(alone.value().size(), 2u);
        for (std::size_t k = 0; k < 2; ++k) {
            EXPECT_GT(together[k].misclassified_ppm, 0);
            EXPECT_NEAR(together[k].away.max, 0.1, 1e-9);
            expect_only({}, together[k], alone.value()[k]);
        }
    }
}

TEST_F(MeasurerTest, leavesOutWhatIsNotWanted) {
    const test::FunctionPicture picture = disc({32, 32}, 0.29);
    const std::vector<SizeErrors> all = measurer().measure(picture);
    for (unsigned set = 0; set < 32; ++set) {
        SCOPED_TRACE(set);
        options_.figures = {(set & 1) != 0, (set & 2) != 0, (set & 4) != 0, (set & 8) != 0, (set & 16) != 0};
        const std::vector<SizeErrors> some = measurer().measure(picture);
        ASSERT_EQ(some.size(), all.size());
        for (std::size_t k = 0; k < all.size(); ++k)
            expect_only(options_.figures, some[k], all[k]);
    }
}

TEST_F(MeasurerTest, samplesNoPictureForNothing) {
    options_.figures = Figures::none();
    std::uint64_t asked = 0;
    const test::FunctionPicture picture({8, 8}, [&asked](TexturePoint) { return ++asked, test::kBlack; });
    EXPECT_EQ(measurer().measure(picture).size(), 2u);
    EXPECT_EQ(asked, 0u);
}

TEST_F(MeasurerTest, refusesASizeOutOfRange) {
    options_.sizes = {{64, 64}, {64, 0}};
    EXPECT_FALSE(Measurer::of(*truth_, options_).ok());
    EXPECT_FALSE(measure(*truth_, disc({8, 8}, 0.3), options_).ok());
}

} // namespace
} // namespace fetexc::measure
