// SPDX-License-Identifier: GPL-3.0-or-later
/// Pinchmaps: the GLSL sampler equals the CPU reference within 1/255 (of the brightest sample, if that exceeds 1) in
/// every pixel whose colour is the same a hair away, on every back end that this machine has, in every dialect that
/// runs there. Through the hardware's filter it is as near as the filter is.
#include "formats/validate.h"
#include "tests/conformance/representation_fixture.h"
#include "tests/support/known_pinchmap.h"

namespace fetexc::test {
namespace {

using fetex::Filter;
using fetex::PinchmapFetch;
using fetex::PinchmapFormat;
using fetex::PinchmapSampleFormat;
using fetex::PinchmapTexture;
using fetex::RenderSize;
using fetex::Sampler;
using fetex::View;

struct DrawnPinchmap {
    using Texture = PinchmapTexture;
    static constexpr std::uint32_t kSide = 192;
    /// Pixels that a hair may put on either side of a discontinuity.
    static constexpr double kLargestEdgeShare = 2e-4;
    /// Of random halves (tests/support/known_pinchmap.cpp).
    static constexpr double kBrightest = 4;
    static constexpr Sampler kSamplers[] = {Sampler::Pinchmap, Sampler::PinchmapArea, Sampler::PinchmapMips};

    static auto validate(const Texture& t) { return fetex::validate_pinchmap(t); }
    static double step(const Texture& t) {
        return kColorStep * (t.sample_format == PinchmapSampleFormat::Rgba16F ? kBrightest : 1);
    }
    static auto upload(fetex::Renderer& renderer, const Texture& t) { return renderer.upload_pinchmap(t); }
    static auto draw(fetex::Renderer& renderer, const View& view, const RenderSize& size) {
        return renderer.render_pinchmap(view, size);
    }
    static auto reference(const Texture& t, const View& view, const RenderSize& size) {
        return fetex::render_cpu(t, view, size);
    }
    static ReferenceSampler sampler(const Texture& t, const View& view, const RenderSize& size) {
        const fetex::PixelSides sides = fetex::pixel_sides(view, size, t.width, t.height);
        const fetex::PinchmapPixel pixel{sides.x, sides.y};
        if (!t.mips.empty() &&
            fetex::wants_mips(view, size, fetex::pinchmap_signal_width(t), fetex::pinchmap_signal_height(t)))
            return [=, &t](double x, double y) { return fetex::pinchmap_sample_mip(t, x, y, pixel); };
        if (size.filter == Filter::Point) return [&t](double x, double y) { return fetex::pinchmap_sample(t, x, y); };
        return [=, &t](double x, double y) { return fetex::pinchmap_sample_area(t, x, y, pixel); };
    }
};

using PinchmapConformance = RepresentationConformance<DrawnPinchmap>;

struct Random {
    std::uint32_t width = 24, height = 17, scale = 0;
    PinchmapFormat map = PinchmapFormat::Bits8;
    PinchmapSampleFormat samples = PinchmapSampleFormat::Rgba8;
    double least_strength = 1, line = 0;
    bool mips = false;
};

PinchmapTexture random_pinchmap(std::uint64_t seed, const Random& r = {}) {
    PinchmapTexture t = pinchmap_of(random_mask(seed, r.width, r.height), {.scale = r.scale,
                                                                           .map_format = r.map,
                                                                           .sample_format = r.samples,
                                                                           .signal = KnownSignal::Random,
                                                                           .gamma_from = -0.6,
                                                                           .gamma_to = 0.6,
                                                                           .least_strength = r.least_strength,
                                                                           .mips = r.mips,
                                                                           .seed = seed});
    t.line_width = static_cast<std::uint32_t>(r.line * fetex::kPinchmapLineUnit);
    if (t.line_width != 0) t.line_color = 0xc0204060;
    return t;
}

TEST_P(PinchmapConformance, equalsTheReferenceOnRandomTextures) {
    std::uint64_t seed = 0;
    for (const PinchmapFormat map : kPinchmapFormats) {
        for (const PinchmapSampleFormat samples : kPinchmapSampleFormats) {
            for (const std::uint32_t scale : {0u, 2u}) {
                const PinchmapTexture t = random_pinchmap(seed + 1, {.scale = scale,
                                                                     .map = map,
                                                                     .samples = samples,
                                                                     .least_strength = seed % 3 == 0 ? 0.0 : 1.0,
                                                                     .line = seed % 4 == 1 ? 0.11 : 0.0});
                ++seed;
                upload(t);
                expect_equal(t, magnified_frames(t, DrawnPinchmap::kSide), "seed " + std::to_string(seed));
            }
        }
    }
    report("points and pixels");
}

/// Every valid neighbourhood, crosses too, as one picture each; no pixel lies on the discontinuity by design.
TEST_P(PinchmapConformance, equalsTheReferenceOnEveryNeighbourhood) {
    const std::vector<PinchmapMask> masks = all_valid_masks(4);
    std::vector<PinchmapMask> chosen = {mask_of({"..##", "..##", "##..", "##.."})};
    for (std::size_t k = 0; k < masks.size(); k += 6)
        chosen.push_back(masks[k]);
    std::uint64_t seed = 0;
    for (const PinchmapMask& mask : chosen) {
        const PinchmapTexture texture = pinchmap_of(mask, {.scale = static_cast<std::uint32_t>(seed % 2),
                                                           .map_format = PinchmapFormat::Bits8,
                                                           .signal = KnownSignal::Random,
                                                           .gamma_from = -0.99,
                                                           .gamma_to = 0.99,
                                                           .seed = ++seed});
        upload(texture);
        for (const Filter area : {Filter::Point, Filter::Area})
            expect_equal(texture, Frame{{0.0013, -0.0017, 1.0019, 0.9993}, {96, 96, 1, area}, "whole"},
                         "mask " + std::to_string(seed));
    }
    report("neighbourhoods");
}

TEST_P(PinchmapConformance, equalsTheReferenceAtEveryScaleOfTheLevels) {
    for (const auto& [width, height, scale] :
         {std::tuple(64u, 64u, 0u), std::tuple(37u, 50u, 1u), std::tuple(1u, 33u, 0u), std::tuple(1u, 1u, 0u)}) {
        const PinchmapTexture t = random_pinchmap(
            width + height,
            {.width = width, .height = height, .scale = scale, .line = width == 37 ? 0.3 : 0.0, .mips = true});
        upload(t);
        expect_equal(t, frames_of_levels(t, 1u << scale), "scale " + std::to_string(scale));
    }
    report("levels");
}

/// fp32 has 10 bits left for the place in a texel at 16382; texel and offset have 32.
TEST_P(PinchmapConformance, staysSharpFarFromTheOrigin) {
    constexpr std::uint32_t kWidth = 16383; // map texels are one more
    const PinchmapTexture t = random_pinchmap(7, {.width = kWidth, .height = 6, .map = PinchmapFormat::Bits16});
    upload(t);
    expect_equal(t, frames_far_out(t, DrawnPinchmap::kSide), "far out");
}

TEST_P(PinchmapConformance, supersamplesAsTheReferenceDoes) {
    expect_supersampled(random_pinchmap(11, {.scale = 1, .line = 0.2}));
}

/// One fetch of each texture. A filter whose weights have 8 bits moves edges by 1/256 of a texel and steps as much.
TEST_P(PinchmapConformance, throughTheFilterIsAsNearAsTheFilterIs) {
    constexpr double kStep = 12.0 / 255, kShare = 0.01;
    for (const PinchmapFormat map : kPinchmapFormats) {
        const PinchmapTexture texture = random_pinchmap(
            5, {.scale = 1, .map = map, .line = map == PinchmapFormat::Bits8 ? 0.2 : 0.0, .mips = true});
        const auto bad = renderer_->upload_pinchmap(texture, PinchmapFetch::Filtered);
        if (map == PinchmapFormat::Bits16 && GetParam().dialect == fetex::Dialect::Essl300 && bad) {
            EXPECT_EQ(bad->code, fetex::RuntimeErrc::GlTooOld);
            continue;
        }
        ASSERT_FALSE(bad.has_value()) << bad->message;
        const RenderSize sizes[] = {{DrawnPinchmap::kSide, DrawnPinchmap::kSide, 1, Filter::Point},
                                    {DrawnPinchmap::kSide, DrawnPinchmap::kSide, 1, Filter::Area},
                                    {13, 11, 1, Filter::Area, fetex::Minification::Mips}};
        for (const RenderSize& size : sizes) {
            const auto reference = fetex::render_cpu(texture, {}, size);
            const auto drawn = renderer_->render_pinchmap({}, size);
            ASSERT_TRUE(reference.ok() && drawn.ok());
            const double share = different_share(reference.value(), drawn.value(), kStep);
            std::printf("  %s, map %u, %ux%u: %.5f beyond 12/255\n", describe(GetParam()).c_str(),
                        static_cast<unsigned>(map), size.width, size.height, share);
            EXPECT_LE(share, kShare);
        }
    }
}

/// Textures of every kind take turns in one renderer.
TEST_P(PinchmapConformance, dropsTheTextureBefore) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed)
        expect_equal_after_others(random_pinchmap(seed, {.width = 20,
                                                         .height = 13,
                                                         .scale = static_cast<std::uint32_t>(seed % 2),
                                                         .map = kPinchmapFormats[seed / 2 % 2],
                                                         .samples = kPinchmapSampleFormats[seed / 2 % 4],
                                                         .mips = seed % 3 == 0}),
                                  "texture " + std::to_string(seed));
}

TEST_P(PinchmapConformance, saysWhatIsMissing) {
    PinchmapTexture fine = random_pinchmap(1);
    fine.scale = 14;
    expect_errors(random_pinchmap(1), fine);
}

INSTANTIATE_TEST_SUITE_P(Backends, PinchmapConformance, testing::ValuesIn(backend_variants()), variant_name);

} // namespace
} // namespace fetexc::test
