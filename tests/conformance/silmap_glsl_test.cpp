// SPDX-License-Identifier: GPL-3.0-or-later
/// Silhouette-map textures: the GLSL sampler equals the CPU reference within 1/255 (of the brightest sample, if that
/// exceeds 1) in every pixel whose colour is the same a hair away, on every back end that this machine has, in every
/// dialect that runs there.
#include "formats/validate.h"
#include "tests/conformance/representation_fixture.h"
#include "tests/support/random_silmap.h"

namespace fetexc::test {
namespace {

using fetex::Filter;
using fetex::RenderSize;
using fetex::Sampler;
using fetex::SilmapFilter;
using fetex::SilmapSampleFormat;
using fetex::SilmapTexture;
using fetex::View;

constexpr SilmapFilter kFilters[] = {SilmapFilter::Nearest, SilmapFilter::Filtered};

struct DrawnSilmap {
    using Texture = SilmapTexture;
    static constexpr std::uint32_t kSide = 192;
    /// Pixels that a hair may put on either side of a link.
    static constexpr double kLargestEdgeShare = 1e-4;
    /// Of random halves (tests/support/random_silmap.cpp).
    static constexpr double kBrightest = 4;
    static constexpr Sampler kSamplers[] = {Sampler::Silmap, Sampler::SilmapArea, Sampler::SilmapMips};
    SilmapFilter filter = SilmapFilter::Filtered;

    static auto validate(const Texture& t) { return fetex::validate_silmap(t); }
    static double step(const Texture& t) {
        return kColorStep * (t.sample_format == SilmapSampleFormat::Rgba16F ? kBrightest : 1);
    }
    auto upload(fetex::Renderer& renderer, const Texture& t) const { return renderer.upload_silmap(t, filter); }
    static auto draw(fetex::Renderer& renderer, const View& view, const RenderSize& size) {
        return renderer.render_silmap(view, size);
    }
    auto reference(const Texture& t, const View& view, const RenderSize& size) const {
        return fetex::render_cpu(t, view, size, filter);
    }
    ReferenceSampler sampler(const Texture& t, const View& view, const RenderSize& size) const {
        const fetex::PixelSides sides = fetex::pixel_sides(view, size, t.width, t.height);
        const fetex::SilmapPixel pixel{sides.x, sides.y};
        if (!t.mips.empty() && fetex::wants_mips(view, size, t.width, t.height))
            return [=, this, &t](double x, double y) { return fetex::silmap_sample_mip(t, x, y, pixel, filter); };
        if (size.filter == Filter::Point)
            return [=, this, &t](double x, double y) { return fetex::silmap_sample(t, x, y, filter); };
        return [=, this, &t](double x, double y) { return fetex::silmap_sample_area(t, x, y, pixel, filter); };
    }
};

using SilmapConformance = RepresentationConformance<DrawnSilmap>;

TEST_P(SilmapConformance, equalsTheReferenceOnRandomTextures) {
    std::uint64_t seed = 0;
    for (const auto cells : kSilmapCellFormats) {
        for (const auto samples : kSilmapSampleFormats) {
            for (const SilmapFilter filter : kFilters) {
                drawn_.filter = filter;
                const SilmapTexture t =
                    random_silmap(++seed, {.width = 24, .height = 17, .cell_format = cells, .sample_format = samples});
                upload(t);
                expect_equal(t, magnified_frames(t, DrawnSilmap::kSide), "seed " + std::to_string(seed));
            }
        }
    }
    report("points and pixels");
}

TEST_P(SilmapConformance, equalsTheReferenceAtEveryScaleOfTheLevels) {
    for (const auto& [width, height] :
         {std::pair(64u, 64u), std::pair(37u, 90u), std::pair(1u, 33u), std::pair(1u, 1u)}) {
        for (const SilmapFilter filter : kFilters) {
            drawn_.filter = filter;
            const SilmapTexture t = random_silmap(width + height, {.width = width, .height = height, .mips = true});
            upload(t);
            expect_equal(t, frames_of_levels(t), filter == SilmapFilter::Nearest ? "nearest" : "filtered");
        }
    }
    report("levels");
}

/// fp32 has 10 bits left for the place in a texel at 16383; texel and offset have 32.
TEST_P(SilmapConformance, staysSharpFarFromTheOrigin) {
    constexpr std::uint32_t kWidth = 16383; // cells are one more
    const SilmapTexture t =
        random_silmap(7, {.width = kWidth, .height = 3, .cell_format = fetex::SilmapCellFormat::Bits16});
    upload(t);
    expect_equal(t, frames_far_out(t, DrawnSilmap::kSide), "far out");
}

TEST_P(SilmapConformance, supersamplesAsTheReferenceDoes) { expect_supersampled(random_silmap(11)); }

/// Textures of every kind take turns in one renderer.
TEST_P(SilmapConformance, dropsTheTextureBefore) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        drawn_.filter = kFilters[seed % 2];
        expect_equal_after_others(random_silmap(seed, {.width = 20,
                                                       .height = 13,
                                                       .cell_format = kSilmapCellFormats[seed / 2 % 2],
                                                       .sample_format = kSilmapSampleFormats[seed / 2 % 4],
                                                       .mips = seed % 3 == 0}),
                                  "texture " + std::to_string(seed));
    }
}

TEST_P(SilmapConformance, saysWhatIsMissing) {
    SilmapTexture wide = random_silmap(1);
    wide.width = 1u << 20, wide.height = 1;
    expect_errors(random_silmap(1), wide);
}

INSTANTIATE_TEST_SUITE_P(Backends, SilmapConformance, testing::ValuesIn(backend_variants()), variant_name);

} // namespace
} // namespace fetexc::test
