// SPDX-License-Identifier: GPL-3.0-or-later
/// Bi-level textures: the GLSL sampler equals the CPU reference within 1/255 in every pixel whose colour is the same a
/// hair away, on every back end that this machine has, in every dialect that runs there.
#include "formats/validate.h"
#include "tests/conformance/representation_fixture.h"
#include "tests/support/random_bilevel.h"

namespace fetexc::test {
namespace {

using fetex::BilevelFetch;
using fetex::BilevelPixel;
using fetex::BilevelRule;
using fetex::BilevelTexture;
using fetex::Filter;
using fetex::RenderSize;
using fetex::Sampler;
using fetex::View;

struct DrawnBilevel {
    using Texture = BilevelTexture;
    static constexpr std::uint32_t kSide = 192;
    /// Pixels that a hair may put on either side of an edge, or of the line where two squares of interpolation meet.
    static constexpr double kLargestEdgeShare = 1e-4;
    static constexpr Sampler kSamplers[] = {Sampler::Bilevel, Sampler::BilevelArea, Sampler::BilevelMips};

    static auto validate(const Texture& t) { return fetex::validate_bilevel(t); }
    static double step(const Texture&) { return kColorStep; }
    static auto upload(fetex::Renderer& renderer, const Texture& t) { return renderer.upload_bilevel(t); }
    static auto draw(fetex::Renderer& renderer, const View& view, const RenderSize& size) {
        return renderer.render_bilevel(view, size);
    }
    static auto reference(const Texture& t, const View& view, const RenderSize& size) {
        return fetex::render_cpu(t, view, size);
    }
    static ReferenceSampler sampler(const Texture& t, const View& view, const RenderSize& size) {
        const fetex::PixelSides sides = fetex::pixel_sides(view, size, t.width, t.height);
        const BilevelPixel pixel{sides.x, sides.y};
        if (!t.mips.empty() && fetex::wants_mips(view, size, t.width, t.height))
            return [=, &t](double x, double y) { return fetex::bilevel_sample_mip(t, x, y, pixel); };
        const BilevelPixel cut = size.filter == Filter::Point ? BilevelPixel{} : pixel;
        return [=, &t](double x, double y) { return fetex::bilevel_sample_area(t, x, y, cut); };
    }
};

using BilevelConformance = RepresentationConformance<DrawnBilevel>;

TEST_P(BilevelConformance, equalsTheReferenceOnRandomTextures) {
    std::uint64_t seed = 0;
    for (const BilevelRule rule : kBilevelRules) {
        for (const std::uint32_t image : {0u, 5u}) {
            const BilevelTexture t = random_bilevel(
                ++seed, {.width = 24, .height = 17, .rule = rule, .image_width = image, .image_height = image});
            upload(t);
            expect_equal(t, magnified_frames(t, DrawnBilevel::kSide), "seed " + std::to_string(seed));
        }
    }
    report("hard and soft");
}

TEST_P(BilevelConformance, equalsTheReferenceAtEveryScaleOfTheLevels) {
    for (const auto& [width, height] :
         {std::pair(64u, 64u), std::pair(37u, 90u), std::pair(1u, 33u), std::pair(1u, 1u)}) {
        for (const BilevelRule rule : {BilevelRule::Single, BilevelRule::Median}) {
            const BilevelTexture t =
                random_bilevel(width + height, {.width = width, .height = height, .rule = rule, .mips = true});
            upload(t);
            expect_equal(t, frames_of_levels(t), "rule " + std::to_string(static_cast<int>(rule)));
        }
    }
    report("levels");
}

/// Soft, at round places, where pixels' centres lie in the middle of what is level.
std::vector<Frame> round_frames(const BilevelTexture& t) {
    std::vector<Frame> frames;
    for (const double magnification : {1.0, 8.0, 64.0}) {
        const double w = DrawnBilevel::kSide / magnification / t.width,
                     h = DrawnBilevel::kSide / magnification / t.height;
        for (const View& view : {View{0.47 - w / 2, 0.52 - h / 2, w, h}, View{1 - 0.7 * w, -0.2 * h, w, h}})
            frames.push_back({view,
                              {DrawnBilevel::kSide, DrawnBilevel::kSide, 1, Filter::Area},
                              std::to_string(magnification) + " pixels a texel"});
    }
    return frames;
}

/// Slopes along one axis alone, none at all, saddles, and the least that there are: where quotients of 0 lie in wait.
TEST_P(BilevelConformance, equalsTheReferenceOnSlopesOfNothing) {
    using Byte = std::uint8_t (*)(std::uint32_t i, std::uint32_t j, std::uint32_t channel);
    const Byte patterns[] = {
        [](std::uint32_t i, std::uint32_t, std::uint32_t c) -> std::uint8_t { return (i + c) % 3 == 0 ? 255 : 40; },
        [](std::uint32_t, std::uint32_t j, std::uint32_t c) -> std::uint8_t { return (j + c) % 3 == 0 ? 255 : 40; },
        [](std::uint32_t i, std::uint32_t j, std::uint32_t c) -> std::uint8_t { return (i + j + c) % 2 ? 255 : 0; },
        [](std::uint32_t i, std::uint32_t j, std::uint32_t) -> std::uint8_t { return i + j > 9 ? 128 : 127; },
        [](std::uint32_t i, std::uint32_t, std::uint32_t c) -> std::uint8_t { return i < 4 ? 0 : 254 + c % 2; },
        [](std::uint32_t, std::uint32_t, std::uint32_t c) -> std::uint8_t { return c % 2 ? 127 : 128; },
    };
    for (const BilevelRule rule : kBilevelRules) {
        BilevelTexture t = random_bilevel(1, {.width = 12, .height = 10, .rule = rule});
        for (std::size_t pattern = 0; pattern < std::size(patterns); ++pattern) {
            for (std::uint32_t k = 0; k < t.texels.size(); ++k)
                t.texels[k] = patterns[pattern](k / t.channels % 12, k / t.channels / 12, k % t.channels);
            upload(t);
            expect_equal(t, round_frames(t),
                         "rule " + std::to_string(static_cast<int>(rule)) + ", pattern " + std::to_string(pattern));
        }
    }
    report("slopes of nothing");
}

/// fp32 has 10 bits left for the place in a texel at 16384; texel and offset have 32.
TEST_P(BilevelConformance, staysSharpFarFromTheOrigin) {
    const BilevelTexture t = random_bilevel(7, {.width = 16384, .height = 3});
    upload(t);
    expect_equal(t, frames_far_out(t, DrawnBilevel::kSide), "far out");
}

TEST_P(BilevelConformance, supersamplesAsTheReferenceDoes) {
    expect_supersampled(random_bilevel(11, {.rule = BilevelRule::Max}));
}

/// Textures of every kind take turns in one renderer.
TEST_P(BilevelConformance, dropsTheTextureBefore) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed)
        expect_equal_after_others(random_bilevel(seed, {.width = 20,
                                                        .height = 13,
                                                        .rule = kBilevelRules[seed % 4],
                                                        .mips = seed % 2 == 0,
                                                        .image_width = seed % 3 == 0 ? 4u : 0u,
                                                        .image_height = seed % 3 == 0 ? 2u : 0u}),
                                  "texture " + std::to_string(seed));
}

TEST_P(BilevelConformance, measuresTheFilterOfTheHardware) {
    const auto error = renderer_->linear_filter_error();
    ASSERT_TRUE(error.ok()) << error.error().message;
    std::printf("  %s: LINEAR is off by %.3e (%s), %s\n", describe(GetParam()).c_str(), error.value(),
                error.value() <= fetex::kGoodFilterError ? "good enough" : "too much",
                renderer_->description().c_str());
    EXPECT_LT(error.value(), 1.0 / 64); // it filters at all
    EXPECT_GT(error.value(), 0);
}

/// Through the filter the picture is the same but for what the filter rounds: edges move by its error over the slope.
TEST_P(BilevelConformance, drawsWithOneFetchWhatTheFilterAllows) {
    const double error = renderer_->linear_filter_error().value();
    BilevelTexture texture = random_bilevel(3, {.width = 12, .height = 12, .rule = BilevelRule::Median});
    texture.below = 0xff000000, texture.above = 0xffffffff;
    ASSERT_FALSE(renderer_->upload_bilevel(texture, BilevelFetch::Filtered).has_value());
    for (const std::uint32_t supersample : {1u, 4u}) {
        for (const Filter filter : {Filter::Point, Filter::Area}) {
            const RenderSize size{96, 96, supersample, filter};
            const auto reference = fetex::render_cpu(texture, {}, size);
            const auto drawn = renderer_->render_bilevel({}, size);
            ASSERT_TRUE(reference.ok() && drawn.ok());
            double sum = 0;
            for (std::size_t k = 0; k < drawn.value().rgba.size(); k += 4)
                sum += std::abs(reference.value().rgba[k] - drawn.value().rgba[k]);
            sum /= 96 * 96;
            EXPECT_LT(sum, 0.01 + error) << supersample;
            EXPECT_GT(sum, 0) << "the filter isn't used";
        }
    }
}

TEST_P(BilevelConformance, saysWhatIsMissing) {
    BilevelTexture wide = random_bilevel(1);
    wide.width = 1u << 20, wide.height = 1;
    expect_errors(random_bilevel(1), wide);
}

INSTANTIATE_TEST_SUITE_P(Backends, BilevelConformance, testing::ValuesIn(backend_variants()), variant_name);

} // namespace
} // namespace fetexc::test
