// SPDX-License-Identifier: GPL-3.0-or-later
/// The host library without a GPU: the sample grid, the CPU renderer, and errors that must be errors.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "runtime_glsl/host/renderer.h"
#include "runtime_glsl/host/sample_grid.h"
#include "tests/support/random_fbt.h"

namespace fetex {
namespace {

constexpr double kStep32 = 0x1p-32;

/// Against long double: within 2^-16 texel at 512 px per texel on 16384 texels, the promise, and far within.
TEST(SampleGrid, placesPixelCentresInDeepViews) {
    std::mt19937_64 random(3);
    double worst = 0;
    for (int n = 0; n < 200; ++n) {
        const std::uint32_t size = 16384, pixels = 2000, supersample = 1 + static_cast<std::uint32_t>(random() % 4);
        const double start = static_cast<double>(random() >> 11) * 0x1p-53, extent = pixels / 512.0 / size;
        const ImageAxis axis(start, extent, size, pixels, supersample);
        for (int k = 0; k < 100; ++k) {
            const auto pixel = static_cast<std::uint32_t>(random() % pixels);
            const auto sample = static_cast<std::uint32_t>(random() % supersample);
            const long double exact =
                (start + extent * ((static_cast<long double>(pixel) * supersample + sample + 0.5L) /
                                   (static_cast<long double>(pixels) * supersample))) *
                size;
            const long double placed = static_cast<long double>(axis.position(pixel, sample)) * kStep32;
            worst = std::max(worst, static_cast<double>(std::abs(placed - exact)));
        }
    }
    EXPECT_LT(worst, 0x1p-21);
}

TEST(SampleGrid, localOffsetsAreExactInFloat) {
    std::mt19937_64 random(5);
    for (int n = 0; n < 10000; ++n) {
        const auto position = static_cast<std::int64_t>(random() % (std::uint64_t{100} << 32));
        const BaseAndLocal at = base_and_local(position, 100);
        EXPECT_EQ(static_cast<double>(static_cast<float>(at.local)), at.local);
        EXPECT_NEAR(at.base + at.local, static_cast<double>(position) * kStep32, 0x1p-24);
    }
}

TEST(SampleGrid, clampsToTheTexture) {
    EXPECT_EQ(base_and_local(-1, 8).base, 0u);
    EXPECT_EQ(base_and_local(-1, 8).local, 0.0);
    EXPECT_EQ(base_and_local(std::int64_t{8} << 32, 8).base, 7u);
    EXPECT_EQ(base_and_local(std::int64_t{8} << 32, 8).local, kFbtFarBorder);
    EXPECT_EQ(base_and_local((std::int64_t{8} << 32) - 1, 8).base, 7u);
    EXPECT_LT(base_and_local((std::int64_t{8} << 32) - 1, 8).local, 1.0);
}

TEST(CpuRenderer, samplesAtPixelCentres) {
    const FbtTexture texture = fetexc::test::random_fbt(2, {.width = 7, .height = 5});
    const View view{0.1, -0.2, 0.7, 1.4};
    const auto image = render_cpu(texture, view, {31, 17, 1});
    ASSERT_TRUE(image.ok());
    int different = 0;
    for (std::uint32_t y = 0; y < 17; ++y) {
        for (std::uint32_t x = 0; x < 31; ++x) {
            const FbtColor c =
                fbt_sample(texture, (view.x + view.w * (x + 0.5) / 31) * 7, (view.y + view.h * (y + 0.5) / 17) * 5);
            const float* pixel = &image.value().rgba[(y * 31 + x) * 4];
            different += std::abs(pixel[0] - c.r) > 1e-5 || std::abs(pixel[3] - c.a) > 1e-5;
        }
    }
    EXPECT_LE(different, 1); // a centre may fall on an edge
}

TEST(CpuRenderer, doesNotDependOnThreads) {
    const FbtTexture texture = fetexc::test::random_fbt(8);
    const auto one = render_cpu(texture, {}, {200, 150, 3}, 1), many = render_cpu(texture, {}, {200, 150, 3}, 7);
    ASSERT_TRUE(one.ok() && many.ok());
    EXPECT_EQ(one.value().rgba, many.value().rgba);
}

/// A solid left half: the supersampled edge pixel has the share of its samples.
TEST(CpuRenderer, averagesTheSamplesOfAPixel) {
    const std::vector<std::uint8_t> bitmap = {255, 255, 255, 255, 0, 0, 0, 255};
    const auto image = render_bitmap_cpu(bitmap, 2, 1, {0.25, 0, 0.5, 1}, {1, 1, 16});
    ASSERT_TRUE(image.ok());
    EXPECT_NEAR(image.value().rgba[0], 0.5, 1e-6);
    EXPECT_NEAR(image.value().rgba[3], 1.0, 1e-6);
}

TEST(Views, outsideTheirLimitsAreErrors) {
    const FbtTexture texture = fetexc::test::random_fbt(1);
    const View bad_views[] = {{0, 0, 0, 1},        {0, 0, 1, -1},           {std::nan(""), 0, 1, 1},
                              {0, INFINITY, 1, 1}, {2 * kMaxView, 0, 1, 1}, {0, 0, 1e300, 1}};
    for (const View& view : bad_views) {
        const auto image = render_cpu(texture, view, {8, 8, 1});
        ASSERT_FALSE(image.ok());
        EXPECT_EQ(image.error().code, RuntimeErrc::BadView);
    }
    const RenderSize bad_sizes[] = {{0, 8, 1},
                                    {8, 0, 1},
                                    {8, 8, 0},
                                    {8, 8, kMaxSupersample + 1},
                                    {kMaxImageSide + 1, 1, 1},
                                    {kMaxImageSide, kMaxImageSide, 1}};
    for (const RenderSize& size : bad_sizes)
        EXPECT_FALSE(render_cpu(texture, {}, size).ok());
    EXPECT_TRUE(render_cpu(texture, {kMaxView, -kMaxView, kMaxView, kMaxView}, {8, 8, 1}).ok());
}

TEST(Rgba8, roundsToNearestAndClamps) {
    const Image image{2, 1, {0.0f, 1.0f, 0.5f, 2.0f, -1.0f, 0.499f / 255, 0.501f / 255, std::nanf("")}};
    EXPECT_EQ(to_rgba8(image), (std::vector<std::uint8_t>{0, 255, 128, 255, 0, 0, 1, 0}));
}

class RendererErrors : public testing::Test {
  protected:
    void SetUp() override {
        auto opened = Renderer::open(Backend::OSMesa);
        ASSERT_TRUE(opened.ok()) << opened.error().message;
        renderer_.emplace(std::move(opened.value()));
    }
    std::optional<Renderer> renderer_;
};

TEST_F(RendererErrors, renderingBeforeUploading) {
    EXPECT_EQ(renderer_->render({}, {8, 8, 1}).error().code, RuntimeErrc::NothingUploaded);
    EXPECT_EQ(renderer_->render_bitmap({}, {8, 8, 1}).error().code, RuntimeErrc::NothingUploaded);
}

TEST_F(RendererErrors, texturesBeyondTheDevice) {
    FbtTexture texture;
    texture.width = 16384;
    texture.height = 1;
    texture.texels.resize(16384, 0);
    texture.corners.resize(std::size_t{16385} * 2, 0); // llvmpipe takes 16384
    const auto bad = renderer_->upload(texture);
    ASSERT_TRUE(bad.has_value());
    EXPECT_EQ(bad->code, RuntimeErrc::TextureTooLarge);
    EXPECT_NE(bad->message.find("16385"), std::string::npos);
}

TEST_F(RendererErrors, bitmapsOfAnotherSizeThanTheirBytes) {
    const std::vector<std::uint8_t> bytes(16, 0);
    EXPECT_TRUE(renderer_->upload_bitmap(bytes, 3, 1).has_value());
    EXPECT_FALSE(renderer_->upload_bitmap(bytes, 2, 2).has_value());
}

TEST_F(RendererErrors, leaveTheRendererUsable) {
    const FbtTexture texture = fetexc::test::random_fbt(1);
    ASSERT_FALSE(renderer_->upload(texture).has_value());
    EXPECT_FALSE(renderer_->render({0, 0, 0, 0}, {8, 8, 1}).ok());
    EXPECT_TRUE(renderer_->render({}, {8, 8, 1}).ok());
}

/// A texture without a single record still draws: nothing of the record texture is needed.
TEST_F(RendererErrors, noneForATextureWithoutFeatures) {
    FbtTexture texture;
    texture.width = texture.height = 1;
    texture.texels = {0xff00ff00, 0};
    ASSERT_FALSE(renderer_->upload(texture).has_value());
    const auto image = renderer_->render({}, {1, 1, 1});
    ASSERT_TRUE(image.ok());
    EXPECT_EQ(to_rgba8(image.value()), (std::vector<std::uint8_t>{0, 255, 0, 255}));
}

TEST(Backends, sayWhyTheyAreMissing) {
    for (const Backend backend : kBackends) {
        const BackendStatus status = probe_backend(backend);
        EXPECT_FALSE(status.detail.empty()) << backend_name(backend);
        EXPECT_TRUE(status.available || status.detail.starts_with(backend_name(backend))) << status.detail;
    }
    EXPECT_FALSE(Renderer::open({.dialect = Dialect::Vulkan450}).ok());
}

} // namespace
} // namespace fetex
