// SPDX-License-Identifier: GPL-3.0-or-later
/// Pinchmaps: the GLSL sampler equals the CPU reference within 1/255 (of the brightest sample, if that exceeds 1) in
/// every pixel whose colour is the same a hair away, on every back end that this machine has, in every dialect that
/// runs there. Through the hardware's filter it is as near as the filter is.
#include <functional>

#include <gtest/gtest.h>

#include "formats/validate.h"
#include "tests/conformance/backend_fixture.h"
#include "tests/conformance/compare_renderers.h"
#include "tests/support/known_pinchmap.h"

namespace fetexc::test {
namespace {

using fetex::Filter;
using fetex::PinchmapFetch;
using fetex::PinchmapFormat;
using fetex::PinchmapPixel;
using fetex::PinchmapSampleFormat;
using fetex::PinchmapTexture;
using fetex::RenderSize;
using fetex::View;

constexpr std::uint32_t kSide = 192;
constexpr double kMagnifications[] = {1, 8, 64, 512};

/// Pixels that a hair may put on either side of a discontinuity.
constexpr double kLargestEdgeShare = 2e-4;
/// Of random halves (tests/support/known_pinchmap.cpp).
constexpr double kBrightest = 4;

class PinchmapConformance : public BackendTest {
  protected:
    using Sample = std::function<fetex::FbtColor(double x, double y)>;

    static bool changes_nearby(const PinchmapTexture& t, const Sample& sample, double x, double y, double step) {
        x = std::clamp<double>(x, 0, t.width), y = std::clamp<double>(y, 0, t.height);
        const fetex::FbtColor center = sample(x, y);
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (color_distance(center, sample(x + dx * kEdgeHair, y + dy * kEdgeHair)) > step) return true;
        return false;
    }

    /// One sample a pixel.
    Comparison compare(const PinchmapTexture& t, const View& view, const RenderSize& size) {
        Comparison result;
        const auto reference = fetex::render_cpu(t, view, size);
        const auto drawn = renderer_->render_pinchmap(view, size);
        if (!reference.ok() || !drawn.ok()) {
            result.error = (reference.ok() ? drawn : reference).error().message;
            return result;
        }
        const fetex::PixelSides sides = fetex::pixel_sides(view, size, t.width, t.height);
        const PinchmapPixel pixel{sides.x, sides.y};
        const bool mips = !t.mips.empty() && fetex::wants_mips(view, size, fetex::pinchmap_signal_width(t),
                                                               fetex::pinchmap_signal_height(t));
        const Sample sample = [&](double x, double y) {
            return mips                           ? fetex::pinchmap_sample_mip(t, x, y, pixel)
                   : size.filter == Filter::Point ? fetex::pinchmap_sample(t, x, y)
                                                  : fetex::pinchmap_sample_area(t, x, y, pixel);
        };
        const double step = kColorStep * (t.sample_format == PinchmapSampleFormat::Rgba16F ? kBrightest : 1);
        const fetex::ImageAxis columns(view.x, view.w, t.width, size.width, 1);
        const fetex::ImageAxis rows(view.y, view.h, t.height, size.height, 1);
        result.pixels = std::uint64_t{size.width} * size.height;
        for (std::uint32_t py = 0; py < size.height; ++py) {
            for (std::uint32_t px = 0; px < size.width; ++px) {
                const std::size_t at = (std::size_t{py} * size.width + px) * 4;
                double difference = 0;
                for (std::size_t c = at; c < at + 4; ++c)
                    difference =
                        std::max<double>(difference, std::abs(reference.value().rgba[c] - drawn.value().rgba[c]));
                const double x = std::ldexp(static_cast<double>(columns.position(px, 0)), -32);
                const double y = std::ldexp(static_cast<double>(rows.position(py, 0)), -32);
                if (!(difference <= step) && changes_nearby(t, sample, x, y, step)) {
                    ++result.on_edge;
                    continue;
                }
                result.largest = std::max(result.largest, difference);
                if (difference <= step) continue;
                ++result.wrong;
                if (result.first_wrong.empty())
                    result.first_wrong = "texel position (" + std::to_string(x) + ", " + std::to_string(y) + ")";
            }
        }
        return result;
    }

    void expect_equal(const PinchmapTexture& t, const View& view, const RenderSize& size, const std::string& what) {
        const Comparison found = compare(t, view, size);
        EXPECT_TRUE(found.equal()) << what << ": " << found.wrong << " of " << found.pixels
                                   << " pixels wrong, by up to " << found.largest << "; " << found.first_wrong
                                   << found.error;
        EXPECT_LE(static_cast<double>(found.on_edge), kLargestEdgeShare * static_cast<double>(found.pixels)) << what;
        total_.add(found);
    }

    void report(const char* what) const {
        std::printf("  %s, %s: %llu pixels, %llu on an edge, largest difference %.2e\n", describe(GetParam()).c_str(),
                    what, static_cast<unsigned long long>(total_.pixels),
                    static_cast<unsigned long long>(total_.on_edge), total_.largest);
    }

    Comparison total_;
};

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
    EXPECT_TRUE(fetex::validate_pinchmap(t).empty());
    return t;
}

/// Around the middle of the texture and around its corner. Columns and rows of pixels are apart by no multiple of an
/// eighth, or of a pixel.
std::vector<View> views_at(const PinchmapTexture& t, double pixels_per_texel) {
    const double w = kSide / pixels_per_texel / t.width, h = kSide / pixels_per_texel / t.height;
    return {{0.4713 - w / 2, 0.5229 - h / 2, w, h}, {1 - 0.7013 * w, -0.2071 * h, w, h}};
}

TEST_P(PinchmapConformance, equalsTheReferenceOnRandomTextures) {
    std::uint64_t seed = 0;
    for (const PinchmapFormat map : kPinchmapFormats) {
        for (const PinchmapSampleFormat samples : kPinchmapSampleFormats) {
            for (const std::uint32_t scale : {0u, 2u}) {
                const PinchmapTexture texture = random_pinchmap(++seed, {.scale = scale,
                                                                         .map = map,
                                                                         .samples = samples,
                                                                         .least_strength = seed % 3 == 0 ? 0.0 : 1.0,
                                                                         .line = seed % 4 == 1 ? 0.11 : 0.0});
                ASSERT_FALSE(renderer_->upload_pinchmap(texture).has_value());
                for (const double magnification : kMagnifications)
                    for (const View& view : views_at(texture, magnification))
                        for (const Filter area : {Filter::Point, Filter::Area})
                            expect_equal(texture, view, {kSide, kSide, 1, area},
                                         "seed " + std::to_string(seed) + " at " + std::to_string(magnification));
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
        ASSERT_FALSE(renderer_->upload_pinchmap(texture).has_value());
        expect_equal(texture, {0.0013, -0.0017, 1.0019, 0.9993}, {96, 96, 1, Filter::Point}, "points");
        expect_equal(texture, {0.0013, -0.0017, 1.0019, 0.9993}, {96, 96, 1, Filter::Area}, "pixels");
    }
    report("neighbourhoods");
}

TEST_P(PinchmapConformance, equalsTheReferenceAtEveryScaleOfTheLevels) {
    for (const auto& [width, height, scale] :
         {std::tuple(64u, 64u, 0u), std::tuple(37u, 50u, 1u), std::tuple(1u, 33u, 0u), std::tuple(1u, 1u, 0u)}) {
        const PinchmapTexture texture = random_pinchmap(
            width + height,
            {.width = width, .height = height, .scale = scale, .line = width == 37 ? 0.3 : 0.0, .mips = true});
        ASSERT_FALSE(renderer_->upload_pinchmap(texture).has_value());
        for (const double samples : {1.0001, 1.3, 1.9, 2.0, 2.5, 3.0, 4.0, 7.7, 16.0, 33.0, 100.0}) {
            const double extent = std::ldexp(samples * 61, -static_cast<int>(scale));
            const View view{0.5 - 0.53 * extent / width, 0.5 - 0.48 * extent / height, extent / width, extent / height};
            const std::string what = std::to_string(width) + " at " + std::to_string(samples) + " samples a pixel";
            expect_equal(texture, view, {61, 61, 1, Filter::Area, fetex::Minification::Mips}, what);
            expect_equal(texture, {view.x, view.y, view.w, view.h / 3},
                         {61, 61, 1, Filter::Area, fetex::Minification::Mips}, what + ", flat");
        }
    }
    report("levels");
}

/// fp32 has 10 bits left for the place in a texel at 16382; texel and offset have 32.
TEST_P(PinchmapConformance, staysSharpFarFromTheOrigin) {
    constexpr std::uint32_t kWidth = 16383; // map texels are one more
    const PinchmapTexture texture = random_pinchmap(7, {.width = kWidth, .height = 6, .map = PinchmapFormat::Bits16});
    ASSERT_FALSE(renderer_->upload_pinchmap(texture).has_value());
    const double extent = kSide / 512.0;
    for (const double i : {16382.0, 16000.25, 12345.0})
        for (const Filter area : {Filter::Point, Filter::Area})
            expect_equal(texture, {i / kWidth, 1.0 / 3, extent / kWidth, extent / 6}, {kSide, kSide, 1, area},
                         "texel " + std::to_string(i));
}

TEST_P(PinchmapConformance, supersamplesAsTheReferenceDoes) {
    const PinchmapTexture texture = random_pinchmap(11, {.scale = 1, .line = 0.2});
    ASSERT_FALSE(renderer_->upload_pinchmap(texture).has_value());
    for (const Filter area : {Filter::Point, Filter::Area}) {
        const RenderSize size{70, 50, 4, area};
        const auto reference = fetex::render_cpu(texture, {-0.25, 0.1, 1.5, 0.8}, size);
        const auto drawn = renderer_->render_pinchmap({-0.25, 0.1, 1.5, 0.8}, size);
        ASSERT_TRUE(reference.ok() && drawn.ok());
        EXPECT_LE(different_share(reference.value(), drawn.value()), kLargestEdgeShare);
    }
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
        const RenderSize sizes[] = {{kSide, kSide, 1, Filter::Point},
                                    {kSide, kSide, 1, Filter::Area},
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
    const RenderSize size{48, 48, 1, Filter::Area, fetex::Minification::Mips};
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        const PinchmapTexture texture = random_pinchmap(seed, {.width = 20,
                                                               .height = 13,
                                                               .scale = static_cast<std::uint32_t>(seed % 2),
                                                               .map = kPinchmapFormats[seed / 2 % 2],
                                                               .samples = kPinchmapSampleFormats[seed / 2 % 4],
                                                               .mips = seed % 3 == 0});
        ASSERT_FALSE(renderer_->upload_pinchmap(texture).has_value());
        if (!texture.mips.empty()) expect_equal(texture, {-1, -1, 20, 20}, size, "levels");
        expect_equal(texture, {0.1, 0.1, 0.5, 0.5}, size, "texture " + std::to_string(seed));
    }
}

TEST_P(PinchmapConformance, saysWhatIsMissing) {
    EXPECT_EQ(renderer_->render_pinchmap({}, {4, 4, 1}).error().code, fetex::RuntimeErrc::NothingUploaded);
    for (const auto sampler : {fetex::Sampler::Pinchmap, fetex::Sampler::PinchmapArea, fetex::Sampler::PinchmapMips})
        EXPECT_EQ(renderer_->time_draws(sampler, {}, 16, 1).error().code, fetex::RuntimeErrc::NothingUploaded);
    EXPECT_EQ(renderer_->render_pinchmap({0, 0, -1, 1}, {4, 4, 1}).error().code, fetex::RuntimeErrc::BadView);
    ASSERT_FALSE(renderer_->upload_pinchmap(random_pinchmap(1)).has_value());
    EXPECT_FALSE(renderer_->time_draws(fetex::Sampler::PinchmapMips, {}, 16, 1).ok()); // it has no levels
    PinchmapTexture fine = random_pinchmap(1);
    fine.scale = 14;
    EXPECT_EQ(renderer_->upload_pinchmap(fine)->code, fetex::RuntimeErrc::TextureTooLarge);
    EXPECT_TRUE(renderer_->render_pinchmap({}, {4, 4, 1}).ok()); // what was there stays
}

INSTANTIATE_TEST_SUITE_P(Backends, PinchmapConformance, testing::ValuesIn(backend_variants()), variant_name);

} // namespace
} // namespace fetexc::test
