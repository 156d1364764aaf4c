// SPDX-License-Identifier: GPL-3.0-or-later
/// The GLSL sampler equals the CPU reference on the texture of an image with features.
#include <gtest/gtest.h>

#include "cli/compile_image.h"
#include "formats/validate.h"
#include "tests/conformance/compare_renderers.h"

namespace fetexc::test {
namespace {

const std::string kPhoto = std::string(FETEXC_ART_DIR) + "/photo/";

fetex::FbtTexture still_life(bool trace) {
    cli::ImageOptions options;
    options.image = kPhoto + "still_life.png";
    if (!trace) options.features = kPhoto + "still_life_edges.svg";
    options.trace = trace;
    std::vector<Diagnostic> diagnostics;
    const auto loaded = cli::load_image(options, {}, 1, diagnostics);
    if (!loaded.ok()) throw std::runtime_error(loaded.error().message);
    auto built = compile_fbt(loaded.value().picture, {{96, 0}, 1});
    if (!built.ok()) throw std::runtime_error(built.error().message);
    return std::move(built.value().texture);
}

class ImageConformance : public testing::TestWithParam<bool> {};

TEST_P(ImageConformance, equalsTheReference) {
    const fetex::FbtTexture texture = still_life(GetParam());
    ASSERT_TRUE(fetex::validate_fbt(texture).empty());
    EXPECT_TRUE(texture.traits.corners && texture.traits.patches && texture.traits.max_degree == 3);
    EXPECT_FALSE(texture.traits.translucent);
    for (const fetex::Backend backend : {fetex::Backend::OSMesa, fetex::Backend::EglSurfaceless}) {
        auto renderer = fetex::Renderer::open({.backend = backend});
        ASSERT_TRUE(renderer.ok()) << renderer.error().message;
        ASSERT_FALSE(renderer.value().upload(texture).has_value());
        for (const double magnification : {1.0, 16.0, 256.0}) {
            const Comparison found = compare_at(texture, renderer.value(), magnification, 192, 6, 1);
            EXPECT_TRUE(found.equal()) << found.wrong << " wrong at " << magnification << "; " << found.first_wrong
                                       << found.error;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Features, ImageConformance, testing::Bool(),
                         [](const auto& tested) { return tested.param ? "traced" : "drawn"; });

} // namespace
} // namespace fetexc::test
