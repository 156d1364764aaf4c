// SPDX-License-Identifier: GPL-3.0-or-later
/// Minified views: the GLSL sampler of the mip chain equals the CPU reference within 1/255, on every back end that this
/// machine has, in every dialect that runs there.
#include <gtest/gtest.h>

#include "formats/validate.h"
#include "tests/conformance/backend_fixture.h"
#include "tests/conformance/compare_renderers.h"
#include "tests/support/random_fbt.h"

namespace fetexc::test {
namespace {

using fetex::FbtTexture;

/// Between 1 and the scale of level 1 a pixel has area samples among its terms, up to 8, which may differ
/// (fbt_glsl_test.cpp); one channel of a frame here is 7e-5. Measured on Mesa 22.3: none in any frame on any back end,
/// nor in 120 more of 24 other textures.
constexpr double kLargestAreaShare = 1.5e-4;

class MipConformance : public BackendTest {
  protected:
    /// Share of channels that differ by more than 1/255.
    double different(const FbtTexture& texture, const fetex::View& view, fetex::RenderSize size) {
        size.minification = fetex::Minification::Mips;
        const auto reference = fetex::render_cpu(texture, view, size);
        const auto drawn = renderer_->render(view, size);
        EXPECT_TRUE(reference.ok() && drawn.ok());
        if (!reference.ok() || !drawn.ok()) return 1;
        return different_share(reference.value(), drawn.value());
    }
};

TEST_P(MipConformance, equalsTheReferenceAtEveryScale) {
    for (const auto& [width, height] :
         {std::pair(64u, 64u), std::pair(37u, 90u), std::pair(1u, 33u), std::pair(1u, 1u)}) {
        const FbtTexture texture = random_fbt(width, {.width = width, .height = height, .mips = true});
        ASSERT_TRUE(fetex::validate_fbt(texture).empty());
        ASSERT_FALSE(renderer_->upload(texture).has_value());
        for (const double texels : {1.0001, 1.3, 1.9, 2.0, 2.5, 3.0, 4.0, 7.7, 16.0, 33.0, 100.0}) {
            const auto filter = texels < 1.5 ? fetex::Filter::Area : fetex::Filter::ExactArea;
            const std::uint32_t side = 61;
            const double extent = texels * side;
            // Off the texture's middle, so that borders are repeated too.
            const fetex::View view{0.5 - 0.53 * extent / width, 0.5 - 0.48 * extent / height, extent / width,
                                   extent / height};
            EXPECT_LE(different(texture, view, {side, side, 4, filter}), texels < 3 ? kLargestAreaShare : 0)
                << width << "x" << height << " at " << texels << " texels a pixel";
        }
    }
}

TEST_P(MipConformance, equalsTheReferenceWherePixelsAreNotSquare) {
    const FbtTexture texture = random_fbt(3, {.width = 96, .height = 80, .mips = true});
    ASSERT_FALSE(renderer_->upload(texture).has_value());
    for (const auto& [x, y] : {std::pair(3.0, 4.5), std::pair(12.0, 3.0), std::pair(4.0, 64.0), std::pair(40.0, 9.0)}) {
        const fetex::View view{0.05, -0.1, x * 24 / 96, y * 24 / 80};
        EXPECT_EQ(different(texture, view, {24, 24, 1}), 0) << x << " x " << y;
    }
    EXPECT_LE(different(texture, {0, 0, 1, 1}, {400, 20, 1}), kLargestAreaShare);
}

TEST_P(MipConformance, magnifiedViewsAreThoseOfTheFeatures) {
    const FbtTexture texture = random_fbt(5, {.width = 8, .height = 8, .mips = true});
    ASSERT_FALSE(renderer_->upload(texture).has_value());
    const fetex::View view{0.1, 0.2, 0.5, 0.5};
    const auto with = renderer_->render(view, {64, 64, 2, fetex::Filter::Point, fetex::Minification::Mips});
    const auto without = renderer_->render(view, {64, 64, 2});
    ASSERT_TRUE(with.ok() && without.ok());
    EXPECT_EQ(with.value().rgba, without.value().rgba);
}

/// Textures with and without a chain take turns in one renderer.
TEST_P(MipConformance, dropsTheChainOfTheTextureBefore) {
    const FbtTexture chain = random_fbt(6, {.width = 20, .height = 20, .mips = true}), none = random_fbt(7);
    for (const FbtTexture* texture : {&chain, &none, &chain}) {
        ASSERT_FALSE(renderer_->upload(*texture).has_value());
        EXPECT_LE(different(*texture, {}, {5, 5, 4}), kLargestAreaShare);
    }
}

INSTANTIATE_TEST_SUITE_P(Backends, MipConformance, testing::ValuesIn(backend_variants()), variant_name);

} // namespace
} // namespace fetexc::test
