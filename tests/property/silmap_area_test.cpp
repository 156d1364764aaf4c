// SPDX-License-Identifier: GPL-3.0-or-later
/// Areas of the silhouette-map builder against points: what it says is wrong is what the reference sampler shows wrong.
#include <gtest/gtest.h>

#include <cmath>

#include "compiler/scene/ground_truth.h"
#include "compiler/silmap/silmap_builder.h"
#include "tests/support/random.h"
#include "tests/support/random_scene.h"

namespace fetexc::test {
namespace {

using namespace fetex;

/// Points, one at random in each cell of a grid, and those whose texel has another result than the drawing there.
class WrongPoints {
  public:
    WrongPoints(const Scene& scene, const SilmapTexture& t)
        : scene_(scene), texture_(t), truth_(scene), compositor_(scene) {
        for (std::uint32_t j = 0; j < t.height; ++j) {
            for (std::uint32_t i = 0; i < t.width; ++i)
                results_.push_back(result_at((i + 0.5) / t.width, (j + 0.5) / t.height));
        }
    }

    /// An edge passes through the middle of a texel: which side is the texel's is the builder's choice.
    [[nodiscard]] bool open() const {
        constexpr double kNear = 0x1p-6; // lattice steps
        const Extent& e = scene_.extent;
        for (std::uint32_t j = 0; j < texture_.height; ++j) {
            for (std::uint32_t i = 0; i < texture_.width; ++i) {
                const double u = (i + 0.5) / texture_.width, v = (j + 0.5) / texture_.height;
                if (std::isfinite(truth_.distance_to_curves_within(u * static_cast<double>(e.lattice_w),
                                                                   v * static_cast<double>(e.lattice_h), kNear)))
                    return true;
            }
        }
        return false;
    }

    [[nodiscard]] double part(std::uint32_t side, Random& random) {
        std::uint64_t wrong = 0;
        for (std::uint32_t k = 0; k < side * side; ++k) {
            const double u = (k % side + random.between(0, 1)) / side, v = (k / side + random.between(0, 1)) / side;
            const SilmapRegion r = silmap_locate(texture_, u * texture_.width, v * texture_.height);
            const std::uint32_t i = std::min(std::max(r.i + (r.corner & 1), 1u) - 1, texture_.width - 1),
                                j = std::min(std::max(r.j + (r.corner >> 1), 1u) - 1, texture_.height - 1);
            wrong += results_[j * texture_.width + i] != result_at(u, v) ? 1 : 0;
        }
        return static_cast<double>(wrong) / side / side;
    }

  private:
    [[nodiscard]] ResultId result_at(double u, double v) {
        const Extent& e = scene_.extent;
        return truth_.result_at(compositor_, u * static_cast<double>(e.lattice_w),
                                v * static_cast<double>(e.lattice_h));
    }

    const Scene& scene_;
    const SilmapTexture& texture_;
    GroundTruth truth_;
    Compositor compositor_;
    std::vector<ResultId> results_;
};

class SilmapArea : public testing::TestWithParam<SilmapCellFormat> {};

/// Of scenes with everything in them; odd sizes, and sizes of a texel, at which most cells are border cells.
TEST_P(SilmapArea, isTheShareOfWrongPoints) {
    constexpr std::uint32_t kSide = 200;
    Random random(7);
    double worst = 0;
    int compared = 0;
    for (std::uint64_t seed = 1; seed <= 140; ++seed) {
        const Scene scene = random_scene(seed, seed % 2 == 0 ? RandomSceneOptions{} : opaque_solids(6));
        SilmapOptions options;
        options.cell_format = GetParam(), options.threads = 0, options.lend = false;
        const std::uint32_t size = seed % 10 == 0 ? 1 : static_cast<std::uint32_t>(random.integer(2, 40));
        options.size = grid_for(scene.extent, size);
        const auto made = compile_silmap(scene, options);
        ASSERT_TRUE(made.ok()) << seed;
        WrongPoints points(scene, made.value().texture);
        if (points.open()) continue;
        ++compared;
        const double said = made.value().stats.wrong_area, seen = points.part(kSide, random);
        // One point in a square errs less than one anywhere would.
        const double deviation = std::sqrt(std::max(said, 1e-4) * (1 - said)) / kSide;
        EXPECT_NEAR(said, seen, 2.5 * deviation) << "seed " << seed << ", size " << size;
        worst = std::max(worst, std::abs(said - seen) / deviation);
    }
    std::printf("  %d scenes, worst: %.2f deviations\n", compared, worst);
    EXPECT_GE(compared, 40);
}

/// Where texels have the results of regions beside their middles, by colours.
TEST_P(SilmapArea, isTheShareOfWrongPointsWhereTexelsAreLent) {
    constexpr std::uint32_t kSide = 200;
    Random random(3);
    std::uint64_t lent = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const Scene scene = random_scene(seed, opaque_solids(8));
        SilmapOptions options;
        options.cell_format = GetParam(), options.threads = 0;
        options.size = grid_for(scene.extent, static_cast<std::uint32_t>(random.integer(5, 30)));
        const auto made = compile_silmap(scene, options);
        ASSERT_TRUE(made.ok()) << seed;
        const SilmapTexture& t = made.value().texture;
        lent += made.value().stats.texels_lent;
        const GroundTruth truth(scene);
        int wrong = 0;
        for (std::uint32_t k = 0; k < kSide * kSide; ++k) {
            const double u = (k % kSide + random.between(0, 1)) / kSide, v = (k / kSide + random.between(0, 1)) / kSide;
            const Rgba is = truth.color_at(u * static_cast<double>(scene.extent.lattice_w),
                                           v * static_cast<double>(scene.extent.lattice_h));
            const FbtColor shows = silmap_sample(t, u * t.width, v * t.height, SilmapFilter::Nearest);
            wrong += std::max({std::abs(is.r - shows.r), std::abs(is.g - shows.g), std::abs(is.b - shows.b),
                               std::abs(is.a - shows.a)}) > 1.0 / 255;
        }
        const double said = made.value().stats.wrong_area,
                     deviation = std::sqrt(std::max(said, 1e-4) * (1 - said)) / kSide;
        EXPECT_NEAR(said, static_cast<double>(wrong) / kSide / kSide, 2.5 * deviation) << "seed " << seed;
    }
    EXPECT_GT(lent, 100u);
}

INSTANTIATE_TEST_SUITE_P(Formats, SilmapArea, testing::Values(SilmapCellFormat::Bits8, SilmapCellFormat::Bits16));

} // namespace
} // namespace fetexc::test
