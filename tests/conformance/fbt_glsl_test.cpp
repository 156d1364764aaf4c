// SPDX-License-Identifier: GPL-3.0-or-later
/// The GLSL sampler equals the CPU reference within 1/255 in every pixel that isn't on an edge, on every back end that
/// this machine has, in every dialect that runs there.
#include <array>

#include <gtest/gtest.h>

#include "formats/fbt_samples.h"
#include "formats/validate.h"
#include "tests/conformance/backend_fixture.h"
#include "tests/conformance/compare_renderers.h"
#include "tests/support/fbt_maker.h"
#include "tests/support/random_fbt.h"

namespace fetexc::test {
namespace {

using fetex::Backend;
using fetex::FbtTexture;
using fetex::Renderer;

constexpr double kMagnifications[] = {1, 8, 64, 512};

/// Edge pixels may go either way, but in random textures only about perimeter·hair of the area is edge. Measured on
/// every back end of Mesa 22.3: at most 1.5e-5 here, 1.4e-5 in 104 frames of 26 textures; a pixel is 2.7e-5 at most.
constexpr double kLargestEdgeShare = 3e-5;

/// Of the channels of an area sampled frame; one is 6e-5. Measured: none here, none in 520 frames of 65 textures.
constexpr double kLargestAreaShare = 1.25e-4;

/// Largest channel of a random half. Areas are right to about 1.6e-3 of the pixel (where a cubic enters it is found to
/// 2e-3), so the error of a mean grows with the contrast: up to 6.5e-3 measured in halves.
constexpr double kLargestHalf = 4;

/// Largest difference in wide samples of up to 4: eight bits would leave hundred times as much. A place in a texel is
/// good to 2^-19 (20 texels in fp32, fixed point beyond), over which such a gradient changes by 4·2^-18.
constexpr double kWideStep = kLargestHalf * 0x1p-18;

class Conformance : public BackendTest {
  protected:
    void expect_equal(const FbtTexture& texture, double magnification, std::uint32_t side, std::uint64_t seed) {
        const auto bad = renderer_->upload(texture);
        ASSERT_FALSE(bad.has_value()) << bad->message;
        const Comparison found = compare_at(texture, *renderer_, magnification, side, 3, seed);
        EXPECT_TRUE(found.equal()) << found.wrong << " of " << found.pixels << " pixels wrong at " << magnification
                                   << " px/texel, seed " << seed << "; " << found.first_wrong << found.error;
        EXPECT_LE(static_cast<double>(found.on_edge), kLargestEdgeShare * static_cast<double>(found.pixels));
        total_.add(found);
    }

    Comparison total_;
};

TEST_P(Conformance, equalsTheReferenceOnRandomTextures) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const FbtTexture texture = random_fbt(seed, {.width = 24, .height = 17});
        ASSERT_TRUE(fetex::validate_fbt(texture).empty());
        for (const double magnification : kMagnifications)
            expect_equal(texture, magnification, 192, seed);
    }
    RecordProperty("pixels_on_edge", std::to_string(total_.on_edge));
    std::printf("  %s: %llu pixels, %llu on an edge, largest difference %.2e\n", describe(GetParam()).c_str(),
                static_cast<unsigned long long>(total_.pixels), static_cast<unsigned long long>(total_.on_edge),
                total_.largest);
}

/// Each trait switched off leaves code out of the shader; what stays must still be right.
TEST_P(Conformance, equalsTheReferenceWhenSpecialised) {
    for (std::uint32_t trait = 0; trait < 13; ++trait) {
        RandomFbtOptions options{.width = 9, .height = 9};
        if (trait < 4) options.degrees = (0b1110u & (2u << trait)) | (trait == 3 ? 0 : 0); // one degree, then none
        if (trait >= 4 && trait < 8) options.directions = 1u << (trait - 4);
        options.bands = trait != 8;
        options.corners = trait != 9 && trait != 12;
        options.patches = trait != 1 && trait != 12;
        options.translucent = trait != 10;
        if (trait == 11) options.max_features = 40;
        const FbtTexture texture = random_fbt(100 + trait, options);
        ASSERT_TRUE(fetex::validate_fbt(texture).empty()) << fetex::validate_fbt(texture)[0].message;
        expect_equal(texture, 8, 96, trait);
        expect_equal(texture, 512, 96, trait);
    }
}

/// Corners and patches of two words a sample; some textures translucent, some opaque, some with only one of both.
TEST_P(Conformance, equalsTheReferenceInWideSamples) {
    for (const fetex::FbtSampleFormat format : {fetex::FbtSampleFormat::Rgba16, fetex::FbtSampleFormat::Rgba16F}) {
        for (std::uint32_t trait = 0; trait < 4; ++trait) {
            const FbtTexture texture = random_fbt(300 + trait, {.width = 20,
                                                                .height = 13,
                                                                .corners = trait != 1,
                                                                .patches = trait != 2,
                                                                .translucent = trait != 3,
                                                                .sample_format = format});
            ASSERT_TRUE(fetex::validate_fbt(texture).empty()) << fetex::validate_fbt(texture)[0].message;
            for (const double magnification : {1.0, 8.0, 512.0})
                expect_equal(texture, magnification, 128, trait);
        }
    }
    EXPECT_LE(total_.largest, kWideStep);
}

/// All halves that may be a colour, each at a corner where a pixel's centre lies: exact, subnormal numbers too.
TEST_P(Conformance, decodesEveryHalf) {
    constexpr std::uint32_t columns = 256, rows = fetex::kFbtHalfInfinity / columns;
    FbtTexture texture;
    texture.sample_format = fetex::FbtSampleFormat::Rgba16F;
    texture.width = columns, texture.height = rows; // the far border isn't sampled exactly
    texture.texels.assign(std::size_t{texture.width} * texture.height, shaded_texel({fetex::kFbtModelCorners, 0}));
    for (std::uint32_t j = 0; j <= rows; ++j) {
        for (std::uint32_t i = 0; i <= columns; ++i) {
            const std::uint32_t half = i < columns && j < rows ? j * columns + i : 0;
            texture.corners.insert(texture.corners.end(), {half | half << 16, half | fetex::kFbtHalfOne << 16});
        }
    }
    texture.traits = fetex::fbt_traits(texture);
    ASSERT_TRUE(fetex::validate_fbt(texture).empty()) << fetex::validate_fbt(texture)[0].message;
    ASSERT_FALSE(renderer_->upload(texture).has_value());
    const double w = texture.width, h = texture.height;
    const auto drawn = renderer_->render({-0.5 / w, -0.5 / h, columns / w, rows / h}, {columns, rows});
    ASSERT_TRUE(drawn.ok()) << drawn.error().message;
    std::size_t wrong = 0;
    for (std::uint32_t half = 0; half < columns * rows; ++half) {
        const double wanted = fetex::fbt_half_value(half);
        for (std::size_t k = 0; k < 3; ++k)
            wrong += static_cast<double>(drawn.value().rgba[4 * std::size_t{half} + k]) != wanted;
    }
    EXPECT_EQ(wrong, 0u);
}

/// fp32 has 10 bits left for the place in a texel at 16384; fixed point has 32.
TEST_P(Conformance, staysSharpFarFromTheOrigin) {
    const FbtTexture texture = random_fbt(7, {.width = 16384, .height = 3, .corners = false});
    ASSERT_FALSE(renderer_->upload(texture).has_value());
    const double extent = 192.0 / 512;
    for (const double i : {16383.0, 16000.25, 12345.0}) {
        const fetex::View view{i / 16384, 1.0 / 3, extent / 16384, extent / 3};
        const Comparison found = compare_frame(texture, *renderer_, view, 192, 192);
        EXPECT_TRUE(found.equal()) << found.wrong << " wrong; " << found.first_wrong << found.error;
    }
}

TEST_P(Conformance, supersamplesAsTheReferenceDoes) {
    const FbtTexture texture = random_fbt(11);
    ASSERT_FALSE(renderer_->upload(texture).has_value());
    const fetex::View view{-0.25, 0.1, 1.5, 0.8};
    const fetex::RenderSize size{70, 50, 4};
    const auto reference = fetex::render_cpu(texture, view, size);
    const auto drawn = renderer_->render(view, size);
    ASSERT_TRUE(reference.ok() && drawn.ok());
    // One of the 16 samples of a pixel may lie on an edge: measured none, and a channel is 7e-5.
    EXPECT_LE(different_share(reference.value(), drawn.value()), 16 * kLargestEdgeShare);
}

/// Random chains cross and end anywhere: what area sampling makes of them has no meaning, but is the same. A pixel may
/// differ where two texels have equal parts of it, or a random chain's area changes its sign.
TEST_P(Conformance, areaSamplesAsTheReferenceDoes) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        RandomFbtOptions options{.width = 12, .height = 9};
        if (seed == 2) options.max_features = 12;
        if (seed == 3) options.degrees = 2, options.corners = options.patches = options.bands = false;
        if (seed >= 4)
            options.sample_format = seed == 4 ? fetex::FbtSampleFormat::Rgba16 : fetex::FbtSampleFormat::Rgba16F;
        const FbtTexture texture = random_fbt(200 + seed, options);
        ASSERT_FALSE(renderer_->upload(texture).has_value());
        for (const fetex::Filter filter : {fetex::Filter::Area, fetex::Filter::ExactArea}) {
            for (const double magnification : {1.0, 2.5, 100.0, 3000.0}) {
                const double extent = 64 / magnification;
                const fetex::View view{0.3, 0.4, extent / texture.width, extent / texture.height};
                const fetex::RenderSize size{64, 64, 1, filter};
                const auto reference = fetex::render_cpu(texture, view, size);
                const auto drawn = renderer_->render(view, size);
                ASSERT_TRUE(reference.ok() && drawn.ok()) << (drawn.ok() ? "" : drawn.error().message);
                const bool halves = options.sample_format == fetex::FbtSampleFormat::Rgba16F;
                const double step = halves ? kLargestHalf * kColorStep : kColorStep;
                EXPECT_LE(different_share(reference.value(), drawn.value(), step), kLargestAreaShare)
                    << "seed " << seed << ", " << magnification << " px/texel, filter " << static_cast<int>(filter);
            }
        }
    }
}

/// What touches the far border, and what is beyond it: the tip of a wedge above a pixel's centre (random texture 6: at
/// 2^-24 texel from it single precision can't say which of its sides a point is on), and curves along the border.
TEST_P(Conformance, drawsWhatTouchesTheFarBorder) {
    using Points = std::vector<std::array<double, 2>>;
    struct Case {
        std::uint32_t degree;
        Points points;
    };
    for (const Case& c : {Case{1, {{0.78, -0.196}, {0.4375, 1}, {0.857, 0.125}}}, Case{1, {{0, 1}, {1, 1}}},
                          Case{2, {{0, 1}, {0.5, 1}, {1, 1}}}, Case{3, {{0, 1}, {0.25, 1}, {0.75, 1}, {1, 1}}}}) {
        for (const bool right : {false, true}) {
            std::vector<std::uint32_t> points;
            for (const auto& [x, y] : c.points)
                points.push_back(right ? fetex::fbt_pack_point(y, x) : fetex::fbt_pack_point(x, y));
            // Rays towards the border cross what lies along it; rays along it the wedge.
            const bool along = c.points.size() == 3 && c.degree == 1;
            const std::uint32_t ray = right != along ? fetex::kFbtRayPosX : fetex::kFbtRayPosY;
            const auto pieces = static_cast<std::uint32_t>(points.size() - 1) / c.degree;
            FbtTexture t;
            t.width = t.height = 1;
            t.texels = {fetex::kFbtKindSingle << 30 |
                        append_list(t.records,
                                    {{c.degree, ray, pieces, points, 0, true, {fetex::kFbtModelSolid, 0xff0000ff}}},
                                    {fetex::kFbtModelSolid, 0xffff0000})};
            t.traits = fetex::fbt_traits(t);
            ASSERT_TRUE(fetex::validate_fbt(t).empty()) << fetex::validate_fbt(t)[0].message;
            ASSERT_FALSE(renderer_->upload(t).has_value());
            const Comparison found = compare_frame(t, *renderer_, {-0.5, -0.5, 2, 2}, 16, 16);
            EXPECT_TRUE(found.equal()) << c.degree << right << found.first_wrong;
        }
    }
}

/// A monotone cubic and a level, that of a row of pixels, between which Laguerre's step goes from t = 1/4 to 1 and back.
TEST_P(Conformance, solvesCubicsOnWhichTheStepCycles) {
    const std::vector<std::uint32_t> points = {
        fetex::fbt_pack_point(0, 0.464447), fetex::fbt_pack_point(0.156403, 0.595184),
        fetex::fbt_pack_point(0.056152, 0.464447), fetex::fbt_pack_point(0.25, 0.856659)};
    FbtTexture t;
    t.width = t.height = 1;
    t.texels = {fetex::kFbtKindSingle << 30 |
                append_list(t.records,
                            {{3, fetex::kFbtRayPosX, 1, points, 0, true, {fetex::kFbtModelSolid, 0xff0000ff}}},
                            {fetex::kFbtModelSolid, 0xffff0000})};
    t.traits = fetex::fbt_traits(t);
    ASSERT_TRUE(fetex::validate_fbt(t).empty()) << fetex::validate_fbt(t)[0].message;
    ASSERT_FALSE(renderer_->upload(t).has_value());
    const Comparison found = compare_frame(t, *renderer_, {}, 8, 8); // a row at 9/16
    EXPECT_TRUE(found.equal()) << found.first_wrong << found.error;
}

TEST_P(Conformance, drawsTilesWithoutSeams) {
    const FbtTexture texture = random_fbt(12, {.width = 40, .height = 33});
    ASSERT_FALSE(renderer_->upload(texture).has_value());
    const Comparison found = compare_frame(texture, *renderer_, {}, 2 * fetex::kTileSide + 37, fetex::kTileSide + 1);
    EXPECT_TRUE(found.equal()) << found.wrong << " wrong; " << found.first_wrong << found.error;
}

TEST_P(Conformance, drawsBitmapsAsTheReferenceDoes) {
    std::vector<std::uint8_t> bitmap(std::size_t{13} * 9 * 4);
    for (std::size_t k = 0; k < bitmap.size(); ++k)
        bitmap[k] = static_cast<std::uint8_t>(k * 197 % 251);
    ASSERT_FALSE(renderer_->upload_bitmap(bitmap, 13, 9).has_value());
    const fetex::View view{-0.1, -0.2, 1.3, 1.1};
    const fetex::RenderSize size{600, 200, 2};
    const auto reference = fetex::render_bitmap_cpu(bitmap, 13, 9, view, size);
    const auto drawn = renderer_->render_bitmap(view, size);
    ASSERT_TRUE(reference.ok() && drawn.ok());
    double largest = 0;
    for (std::size_t k = 0; k < reference.value().rgba.size(); ++k)
        largest = std::max<double>(largest, std::abs(reference.value().rgba[k] - drawn.value().rgba[k]));
    EXPECT_LE(largest, 0.02 * kColorStep);
}

INSTANTIATE_TEST_SUITE_P(Backends, Conformance, testing::ValuesIn(backend_variants()), variant_name);

/// Renderers of different libraries live side by side: each call makes its own context current and releases it.
TEST(Backends, takeTurns) {
    const FbtTexture texture = random_fbt(5);
    std::vector<Renderer> renderers;
    for (const Backend backend : fetex::kBackends) {
        auto opened = Renderer::open(backend);
        if (!opened.ok()) continue;
        ASSERT_FALSE(opened.value().upload(texture).has_value());
        renderers.push_back(std::move(opened.value()));
    }
    ASSERT_GE(renderers.size(), 2u);
    for (int round = 0; round < 3; ++round)
        for (Renderer& renderer : renderers)
            EXPECT_TRUE(compare_frame(texture, renderer, {}, 64, 64).equal());
}

} // namespace
} // namespace fetexc::test
