// SPDX-License-Identifier: GPL-3.0-or-later
/// Silhouette-map textures: the GLSL sampler equals the CPU reference within 1/255 (of the brightest sample, if that
/// exceeds 1) in every pixel whose colour is the same a hair away, on every back end that this machine has, in every
/// dialect that runs there.
#include <functional>

#include <gtest/gtest.h>

#include "formats/validate.h"
#include "tests/conformance/backend_fixture.h"
#include "tests/conformance/compare_renderers.h"
#include "tests/support/random_silmap.h"

namespace fetexc::test {
namespace {

using fetex::Filter;
using fetex::RenderSize;
using fetex::SilmapFilter;
using fetex::SilmapPixel;
using fetex::SilmapSampleFormat;
using fetex::SilmapTexture;
using fetex::View;

constexpr std::uint32_t kSide = 192;
constexpr double kMagnifications[] = {1, 8, 64, 512};
constexpr SilmapFilter kFilters[] = {SilmapFilter::Nearest, SilmapFilter::Filtered};

/// Pixels that a hair may put on either side of a link.
constexpr double kLargestEdgeShare = 1e-4;
/// Of random halves (tests/support/random_silmap.cpp).
constexpr double kBrightest = 4;

class SilmapConformance : public BackendTest {
  protected:
    using Sample = std::function<fetex::FbtColor(double x, double y)>;

    static bool changes_nearby(const SilmapTexture& t, const Sample& sample, double x, double y, double step) {
        x = std::clamp<double>(x, 0, t.width), y = std::clamp<double>(y, 0, t.height);
        const fetex::FbtColor center = sample(x, y);
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (color_distance(center, sample(x + dx * kEdgeHair, y + dy * kEdgeHair)) > step) return true;
        return false;
    }

    /// One sample a pixel.
    Comparison compare(const SilmapTexture& t, const View& view, const RenderSize& size, SilmapFilter filter) {
        Comparison result;
        const auto reference = fetex::render_cpu(t, view, size, filter);
        const auto drawn = renderer_->render_silmap(view, size);
        if (!reference.ok() || !drawn.ok()) {
            result.error = (reference.ok() ? drawn : reference).error().message;
            return result;
        }
        const fetex::PixelSides sides = fetex::pixel_sides(view, size, t.width, t.height);
        const SilmapPixel pixel{sides.x, sides.y};
        const bool mips = !t.mips.empty() && fetex::wants_mips(view, size, t.width, t.height);
        const Sample sample = [&](double x, double y) {
            return mips                           ? fetex::silmap_sample_mip(t, x, y, pixel, filter)
                   : size.filter == Filter::Point ? fetex::silmap_sample(t, x, y, filter)
                                                  : fetex::silmap_sample_area(t, x, y, pixel, filter);
        };
        const double step = kColorStep * (t.sample_format == SilmapSampleFormat::Rgba16F ? kBrightest : 1);
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

    void expect_equal(const SilmapTexture& t, const View& view, const RenderSize& size, SilmapFilter filter,
                      const std::string& what) {
        const Comparison found = compare(t, view, size, filter);
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

/// Around the middle of the texture and around its corner. Columns and rows of pixels are apart by no multiple of an
/// eighth, or of a pixel: else whole diagonals of them would lie on links at 45 degrees.
std::vector<View> views_at(const SilmapTexture& t, double pixels_per_texel) {
    const double w = kSide / pixels_per_texel / t.width, h = kSide / pixels_per_texel / t.height;
    return {{0.4713 - w / 2, 0.5229 - h / 2, w, h}, {1 - 0.7013 * w, -0.2071 * h, w, h}};
}

TEST_P(SilmapConformance, equalsTheReferenceOnRandomTextures) {
    std::uint64_t seed = 0;
    for (const auto cells : kSilmapCellFormats) {
        for (const auto samples : kSilmapSampleFormats) {
            for (const SilmapFilter filter : kFilters) {
                const SilmapTexture texture =
                    random_silmap(++seed, {.width = 24, .height = 17, .cell_format = cells, .sample_format = samples});
                ASSERT_TRUE(fetex::validate_silmap(texture).empty());
                ASSERT_FALSE(renderer_->upload_silmap(texture, filter).has_value());
                for (const double magnification : kMagnifications)
                    for (const View& view : views_at(texture, magnification))
                        for (const Filter area : {Filter::Point, Filter::Area})
                            expect_equal(texture, view, {kSide, kSide, 1, area}, filter,
                                         "seed " + std::to_string(seed) + " at " + std::to_string(magnification));
            }
        }
    }
    report("points and pixels");
}

TEST_P(SilmapConformance, equalsTheReferenceAtEveryScaleOfTheLevels) {
    for (const auto& [width, height] :
         {std::pair(64u, 64u), std::pair(37u, 90u), std::pair(1u, 33u), std::pair(1u, 1u)}) {
        for (const SilmapFilter filter : kFilters) {
            const SilmapTexture texture =
                random_silmap(width + height, {.width = width, .height = height, .mips = true});
            ASSERT_FALSE(renderer_->upload_silmap(texture, filter).has_value());
            for (const double texels : {1.0001, 1.3, 1.9, 2.0, 2.5, 3.0, 4.0, 7.7, 16.0, 33.0, 100.0}) {
                const double extent = texels * 61;
                const View view{0.5 - 0.53 * extent / width, 0.5 - 0.48 * extent / height, extent / width,
                                extent / height};
                expect_equal(texture, view, {61, 61, 1, Filter::Area, fetex::Minification::Mips}, filter,
                             std::to_string(width) + " at " + std::to_string(texels) + " texels a pixel");
                expect_equal(texture, {view.x, view.y, view.w, view.h / 3},
                             {61, 61, 1, Filter::Area, fetex::Minification::Mips}, filter,
                             std::to_string(width) + " at " + std::to_string(texels) + " texels a pixel, flat");
            }
        }
    }
    report("levels");
}

/// fp32 has 10 bits left for the place in a texel at 16383; texel and offset have 32.
TEST_P(SilmapConformance, staysSharpFarFromTheOrigin) {
    constexpr std::uint32_t kWidth = 16383; // cells are one more
    const SilmapTexture texture =
        random_silmap(7, {.width = kWidth, .height = 3, .cell_format = fetex::SilmapCellFormat::Bits16});
    ASSERT_FALSE(renderer_->upload_silmap(texture).has_value());
    const double extent = kSide / 512.0;
    for (const double i : {16382.0, 16000.25, 12345.0})
        for (const Filter area : {Filter::Point, Filter::Area})
            expect_equal(texture, {i / kWidth, 1.0 / 3, extent / kWidth, extent / 3}, {kSide, kSide, 1, area},
                         SilmapFilter::Filtered, "texel " + std::to_string(i));
}

TEST_P(SilmapConformance, supersamplesAsTheReferenceDoes) {
    const SilmapTexture texture = random_silmap(11);
    ASSERT_FALSE(renderer_->upload_silmap(texture).has_value());
    for (const Filter area : {Filter::Point, Filter::Area}) {
        const RenderSize size{70, 50, 4, area};
        const auto reference = fetex::render_cpu(texture, {-0.25, 0.1, 1.5, 0.8}, size);
        const auto drawn = renderer_->render_silmap({-0.25, 0.1, 1.5, 0.8}, size);
        ASSERT_TRUE(reference.ok() && drawn.ok());
        EXPECT_LE(different_share(reference.value(), drawn.value()), kLargestEdgeShare);
    }
}

/// Textures of every kind take turns in one renderer.
TEST_P(SilmapConformance, dropsTheTextureBefore) {
    const RenderSize size{48, 48, 1, Filter::Area, fetex::Minification::Mips};
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        const SilmapFilter filter = kFilters[seed % 2];
        const SilmapTexture texture = random_silmap(seed, {.width = 20,
                                                           .height = 13,
                                                           .cell_format = kSilmapCellFormats[seed / 2 % 2],
                                                           .sample_format = kSilmapSampleFormats[seed / 2 % 4],
                                                           .mips = seed % 3 == 0});
        ASSERT_FALSE(renderer_->upload_silmap(texture, filter).has_value());
        if (!texture.mips.empty()) expect_equal(texture, {-1, -1, 20, 20}, size, filter, "levels");
        expect_equal(texture, {0.1, 0.1, 0.5, 0.5}, size, filter, "texture " + std::to_string(seed));
    }
}

TEST_P(SilmapConformance, saysWhatIsMissing) {
    EXPECT_EQ(renderer_->render_silmap({}, {4, 4, 1}).error().code, fetex::RuntimeErrc::NothingUploaded);
    for (const auto sampler : {fetex::Sampler::Silmap, fetex::Sampler::SilmapArea, fetex::Sampler::SilmapMips})
        EXPECT_EQ(renderer_->time_draws(sampler, {}, 16, 1).error().code, fetex::RuntimeErrc::NothingUploaded);
    EXPECT_EQ(renderer_->render_silmap({0, 0, -1, 1}, {4, 4, 1}).error().code, fetex::RuntimeErrc::BadView);
    ASSERT_FALSE(renderer_->upload_silmap(random_silmap(1)).has_value());
    EXPECT_FALSE(renderer_->time_draws(fetex::Sampler::SilmapMips, {}, 16, 1).ok()); // it has no levels
    SilmapTexture wide = random_silmap(1);
    wide.width = 1u << 20, wide.height = 1;
    EXPECT_EQ(renderer_->upload_silmap(wide)->code, fetex::RuntimeErrc::TextureTooLarge);
    EXPECT_TRUE(renderer_->render_silmap({}, {4, 4, 1}).ok()); // what was there stays
}

INSTANTIATE_TEST_SUITE_P(Backends, SilmapConformance, testing::ValuesIn(backend_variants()), variant_name);

} // namespace
} // namespace fetexc::test
