// SPDX-License-Identifier: GPL-3.0-or-later
/// The whole way: drawing, compiler, GLSL on OSMesa. Every pixel centre farther than kRegionTolerance from all curves
/// has the drawing's own colour, at 1 to 4096 pixels a texel. FETEXC_PIXEL_SIDE=1024 takes frames of 1,048,576 pixels.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>

#include "compiler/compile.h"
#include "compiler/error_budget.h"
#include "compiler/scene/ground_truth.h"
#include "compiler/svg/svg.h"
#include "runtime_glsl/host/renderer.h"
#include "runtime_glsl/host/sample_grid.h"

namespace fetexc::test {
namespace {

constexpr double kMagnifications[] = {1, 8, 64, 512, 4096};
/// Of a solid colour: rounding to RGBA8, and that of the drawing's own to bytes.
constexpr double kColorTolerance = 1.0 / 255;
constexpr std::uint32_t kTexels = 128;

std::uint32_t frame_side() {
    const char* side = std::getenv("FETEXC_PIXEL_SIDE");
    return side != nullptr ? static_cast<std::uint32_t>(std::stoul(side)) : 160;
}

Scene load(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(stream)), {});
    std::vector<Diagnostic> diagnostics;
    auto scene = load_svg(bytes, {}, diagnostics);
    EXPECT_TRUE(scene.ok()) << file;
    return std::move(scene).value();
}

/// A point on an edge, in texels: where the first run of some texel with features begins.
std::pair<double, double> point_on_edge(const fetex::FbtTexture& t, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    for (int tries = 0; tries < 1000000; ++tries) {
        const std::size_t texel = random() % t.texels.size();
        if (t.texels[texel] >> 30 != fetex::kFbtKindSingle) continue;
        const std::uint32_t* words = t.records.data() + std::size_t{4} * (t.texels[texel] & fetex::kFbtAddressMask);
        const std::uint32_t point = fetex::FbtEntry(words[0]).shared() ? t.records[words[2]] : words[2];
        return {static_cast<double>(texel % t.width) + fetex::fbt_dequantise(point & 0xffffu),
                static_cast<double>(texel / t.width) + fetex::fbt_dequantise(point >> 16)};
    }
    ADD_FAILURE() << "no texel with features";
    return {};
}

/// A view around an edge, inside the texture where it is smaller.
fetex::View busy_view(const fetex::FbtTexture& t, double extent, std::uint64_t seed) {
    const auto [x, y] = point_on_edge(t, seed);
    const auto start = [&](double at, std::uint32_t size) {
        return extent >= size ? 0 : std::clamp(at - extent / 2, 0.0, size - extent) / size;
    };
    return {start(x, t.width), start(y, t.height), extent / t.width, extent / t.height};
}

struct Count {
    std::uint64_t pixels = 0, beside = 0, wrong = 0; ///< beside: another colour within the tolerance of a curve
    std::string first;
};

class PixelCentres : public testing::TestWithParam<const char*> {
  protected:
    /// Premultiplied colour of the drawing at a pixel centre against what was drawn there.
    void check(const fetex::Image& image, const fetex::View& view, Count& count) {
        const fetex::ImageAxis columns(view.x, view.w, texture_.width, image.width, 1);
        const fetex::ImageAxis rows(view.y, view.h, texture_.height, image.height, 1);
        const double sx = static_cast<double>(scene_.extent.lattice_w) / texture_.width,
                     sy = static_cast<double>(scene_.extent.lattice_h) / texture_.height;
        const GroundTruth truth(scene_);
        for (std::uint32_t py = 0; py < image.height; ++py) {
            const double y = std::ldexp(static_cast<double>(rows.position(py, 0)), -32);
            for (std::uint32_t px = 0; px < image.width; ++px) {
                const double x = std::ldexp(static_cast<double>(columns.position(px, 0)), -32);
                if (x < 0 || y < 0 || x >= texture_.width || y >= texture_.height) continue;
                ++count.pixels;
                const Rgba c = truth.color_at(x * sx, y * sy);
                const float* drawn = image.rgba.data() + (std::size_t{py} * image.width + px) * 4;
                const double off = std::max({std::abs(drawn[0] - c.r), std::abs(drawn[1] - c.g),
                                             std::abs(drawn[2] - c.b), std::abs(drawn[3] - c.a)});
                if (off <= kColorTolerance) continue;
                const double radius = budget::kRegionTolerance * std::max(sx, sy);
                const bool near = truth.distance_to_curves_within(x * sx, y * sy, radius) < radius;
                ++(near ? count.beside : count.wrong);
                if (!near && count.first.empty()) count.first = std::to_string(x) + ", " + std::to_string(y);
            }
        }
    }

    Scene scene_;
    fetex::FbtTexture texture_;
};

TEST_P(PixelCentres, haveTheDrawingsColours) {
    scene_ = load(std::string(FETEXC_ART_DIR) + "/" + GetParam());
    CompileOptions options;
    const std::uint32_t side = frame_side();
    options.size = grid_for(scene_.extent, std::max(kTexels, side)); // a full frame at 1 px a texel, too
    auto build = compile_fbt(scene_, options);
    ASSERT_TRUE(build.ok());
    texture_ = std::move(build).value().texture;
    auto renderer = fetex::Renderer::open(fetex::Backend::OSMesa);
    ASSERT_TRUE(renderer.ok()) << renderer.error().message;
    ASSERT_FALSE(renderer.value().upload(texture_).has_value());
    for (const double magnification : kMagnifications) {
        const fetex::View view = busy_view(texture_, side / magnification, 20);
        const auto image = renderer.value().render(view, {side, side, 1});
        ASSERT_TRUE(image.ok()) << image.error().message;
        Count count;
        check(image.value(), view, count);
        std::printf("  %6.0f px a texel: %llu pixels, %llu beside an edge, %llu wrong\n", magnification,
                    static_cast<unsigned long long>(count.pixels), static_cast<unsigned long long>(count.beside),
                    static_cast<unsigned long long>(count.wrong));
        EXPECT_GT(count.pixels, std::uint64_t{side} * side / 3);
        const auto least = *std::min_element(image.value().rgba.begin(), image.value().rgba.end());
        EXPECT_LT(least, *std::max_element(image.value().rgba.begin(), image.value().rgba.end())); // the edge is there
        EXPECT_EQ(count.wrong, 0u) << "at " << magnification << " px a texel, texel position " << count.first;
    }
}

// Solid colours: what a gradient may be off is another test's matter (tests/quality).
INSTANTIATE_TEST_SUITE_P(Drawings, PixelCentres,
                         testing::Values("letters.svg", "partition.svg", "strokes.svg", "use_symbol.svg", "discs.svg",
                                         "fill_rules.svg", "stop_sign.svg"),
                         [](const auto& tested) {
                             const std::string name = tested.param;
                             return name.substr(0, name.find('.'));
                         });

} // namespace
} // namespace fetexc::test
