// SPDX-License-Identifier: GPL-3.0-or-later
/// Bi-level textures: the GLSL sampler equals the CPU reference within 1/255 in every pixel whose colour is the same a
/// hair away, on every back end that this machine has, in every dialect that runs there.
#include <functional>

#include <gtest/gtest.h>

#include "formats/validate.h"
#include "tests/conformance/backend_fixture.h"
#include "tests/conformance/compare_renderers.h"
#include "tests/support/random_bilevel.h"

namespace fetexc::test {
namespace {

using fetex::BilevelFetch;
using fetex::BilevelPixel;
using fetex::BilevelRule;
using fetex::BilevelTexture;
using fetex::Filter;
using fetex::RenderSize;
using fetex::View;

constexpr std::uint32_t kSide = 192;
constexpr double kMagnifications[] = {1, 8, 64, 512};

/// Pixels that a hair may put on either side of an edge, or of the line where two squares of interpolation meet.
constexpr double kLargestEdgeShare = 1e-4;

class BilevelConformance : public BackendTest {
  protected:
    using Sample = std::function<fetex::FbtColor(double x, double y)>;

    static bool changes_nearby(const BilevelTexture& t, const Sample& sample, double x, double y) {
        x = std::clamp<double>(x, 0, t.width), y = std::clamp<double>(y, 0, t.height);
        const fetex::FbtColor center = sample(x, y);
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (color_distance(center, sample(x + dx * kEdgeHair, y + dy * kEdgeHair)) > kColorStep) return true;
        return false;
    }

    /// One sample a pixel.
    Comparison compare(const BilevelTexture& t, const View& view, const RenderSize& size) {
        Comparison result;
        const auto reference = fetex::render_cpu(t, view, size);
        const auto drawn = renderer_->render_bilevel(view, size);
        if (!reference.ok() || !drawn.ok()) {
            result.error = (reference.ok() ? drawn : reference).error().message;
            return result;
        }
        const fetex::PixelSides sides = fetex::pixel_sides(view, size, t.width, t.height);
        const bool mips = !t.mips.empty() && fetex::wants_mips(view, size, t.width, t.height);
        const BilevelPixel pixel =
            mips || size.filter != Filter::Point ? BilevelPixel{sides.x, sides.y} : BilevelPixel{};
        const Sample sample = [&](double x, double y) {
            return mips ? fetex::bilevel_sample_mip(t, x, y, pixel) : fetex::bilevel_sample_area(t, x, y, pixel);
        };
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
                if (difference > kColorStep && changes_nearby(t, sample, x, y)) {
                    ++result.on_edge;
                    continue;
                }
                result.largest = std::max(result.largest, difference);
                if (difference <= kColorStep) continue;
                ++result.wrong;
                if (result.first_wrong.empty())
                    result.first_wrong = "texel position (" + std::to_string(x) + ", " + std::to_string(y) + ")";
            }
        }
        return result;
    }

    void expect_equal(const BilevelTexture& t, const View& view, const RenderSize& size, const std::string& what) {
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

/// Around the middle of the texture and around its corner.
std::vector<View> views_at(const BilevelTexture& t, double pixels_per_texel) {
    const double w = kSide / pixels_per_texel / t.width, h = kSide / pixels_per_texel / t.height;
    return {{0.47 - w / 2, 0.52 - h / 2, w, h}, {1 - 0.7 * w, -0.2 * h, w, h}};
}

TEST_P(BilevelConformance, equalsTheReferenceOnRandomTextures) {
    std::uint64_t seed = 0;
    for (const BilevelRule rule : kBilevelRules) {
        for (const std::uint32_t image : {0u, 5u}) {
            const BilevelTexture texture = random_bilevel(
                ++seed, {.width = 24, .height = 17, .rule = rule, .image_width = image, .image_height = image});
            ASSERT_TRUE(fetex::validate_bilevel(texture).empty());
            ASSERT_FALSE(renderer_->upload_bilevel(texture).has_value());
            for (const double magnification : kMagnifications)
                for (const View& view : views_at(texture, magnification))
                    for (const Filter filter : {Filter::Point, Filter::Area})
                        expect_equal(texture, view, {kSide, kSide, 1, filter},
                                     "seed " + std::to_string(seed) + " at " + std::to_string(magnification));
        }
    }
    report("hard and soft");
}

TEST_P(BilevelConformance, equalsTheReferenceAtEveryScaleOfTheLevels) {
    for (const auto& [width, height] :
         {std::pair(64u, 64u), std::pair(37u, 90u), std::pair(1u, 33u), std::pair(1u, 1u)}) {
        for (const BilevelRule rule : {BilevelRule::Single, BilevelRule::Median}) {
            const BilevelTexture texture =
                random_bilevel(width + height, {.width = width, .height = height, .rule = rule, .mips = true});
            ASSERT_FALSE(renderer_->upload_bilevel(texture).has_value());
            for (const double texels : {1.0001, 1.3, 1.9, 2.0, 2.5, 3.0, 4.0, 7.7, 16.0, 33.0, 100.0}) {
                const double extent = texels * 61;
                const View view{0.5 - 0.53 * extent / width, 0.5 - 0.48 * extent / height, extent / width,
                                extent / height};
                expect_equal(texture, view, {61, 61, 1, Filter::Area, fetex::Minification::Mips},
                             std::to_string(width) + " at " + std::to_string(texels) + " texels a pixel");
                expect_equal(texture, {view.x, view.y, view.w, view.h / 3},
                             {61, 61, 1, Filter::Area, fetex::Minification::Mips},
                             std::to_string(width) + " at " + std::to_string(texels) + " texels a pixel, flat");
            }
        }
    }
    report("levels");
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
            ASSERT_FALSE(renderer_->upload_bilevel(t).has_value());
            for (const double magnification : {1.0, 8.0, 64.0})
                for (const View& view : views_at(t, magnification))
                    expect_equal(t, view, {kSide, kSide, 1, Filter::Area},
                                 "rule " + std::to_string(static_cast<int>(rule)) + ", pattern " +
                                     std::to_string(pattern) + " at " + std::to_string(magnification));
        }
    }
    report("slopes of nothing");
}

/// fp32 has 10 bits left for the place in a texel at 16384; texel and offset have 32.
TEST_P(BilevelConformance, staysSharpFarFromTheOrigin) {
    const BilevelTexture texture = random_bilevel(7, {.width = 16384, .height = 3});
    ASSERT_FALSE(renderer_->upload_bilevel(texture).has_value());
    const double extent = kSide / 512.0;
    for (const double i : {16383.0, 16000.25, 12345.0})
        for (const Filter filter : {Filter::Point, Filter::Area})
            expect_equal(texture, {i / 16384, 1.0 / 3, extent / 16384, extent / 3}, {kSide, kSide, 1, filter},
                         "texel " + std::to_string(i));
}

TEST_P(BilevelConformance, supersamplesAsTheReferenceDoes) {
    const BilevelTexture texture = random_bilevel(11, {.rule = BilevelRule::Max});
    ASSERT_FALSE(renderer_->upload_bilevel(texture).has_value());
    const View view{-0.25, 0.1, 1.5, 0.8};
    for (const Filter filter : {Filter::Point, Filter::Area}) {
        const RenderSize size{70, 50, 4, filter};
        const auto reference = fetex::render_cpu(texture, view, size);
        const auto drawn = renderer_->render_bilevel(view, size);
        ASSERT_TRUE(reference.ok() && drawn.ok());
        std::size_t different = 0;
        for (std::size_t k = 0; k < reference.value().rgba.size(); ++k)
            different += std::abs(reference.value().rgba[k] - drawn.value().rgba[k]) > kColorStep;
        EXPECT_LE(static_cast<double>(different), kLargestEdgeShare * reference.value().rgba.size());
    }
}

/// Textures of every kind take turns in one renderer.
TEST_P(BilevelConformance, dropsTheTextureBefore) {
    const RenderSize size{48, 48, 1, Filter::Area, fetex::Minification::Mips};
    const View small{-1, -1, 20, 20};
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const BilevelTexture texture = random_bilevel(seed, {.width = 20,
                                                             .height = 13,
                                                             .rule = kBilevelRules[seed % 4],
                                                             .mips = seed % 2 == 0,
                                                             .image_width = seed % 3 == 0 ? 4u : 0u,
                                                             .image_height = 2});
        BilevelTexture valid = texture;
        if (valid.image_width == 0) valid.image_height = 0;
        ASSERT_TRUE(fetex::validate_bilevel(valid).empty());
        ASSERT_FALSE(renderer_->upload_bilevel(valid).has_value());
        if (!valid.mips.empty()) expect_equal(valid, small, size, "levels " + std::to_string(seed));
        expect_equal(valid, {0.1, 0.1, 0.5, 0.5}, size, "texture " + std::to_string(seed));
    }
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
    EXPECT_EQ(renderer_->render_bilevel({}, {4, 4, 1}).error().code, fetex::RuntimeErrc::NothingUploaded);
    const auto time = renderer_->time_draws(fetex::Sampler::BilevelMips, {}, 16, 1);
    ASSERT_FALSE(time.ok());
    EXPECT_EQ(renderer_->render_bilevel({0, 0, -1, 1}, {4, 4, 1}).error().code, fetex::RuntimeErrc::BadView);
    BilevelTexture wide = random_bilevel(1);
    wide.width = 1u << 20, wide.height = 1;
    EXPECT_EQ(renderer_->upload_bilevel(wide)->code, fetex::RuntimeErrc::TextureTooLarge);
}

INSTANTIATE_TEST_SUITE_P(Backends, BilevelConformance, testing::ValuesIn(backend_variants()), variant_name);

} // namespace
} // namespace fetexc::test
