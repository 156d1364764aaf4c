// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "cli/compare_outcome.h"
#include "cli/difference_picture.h"
#include "cli/image_file.h"
#include "compiler/diagnostics.h"

namespace fetexc::cli {
namespace {

// Made with Python's zlib and struct.
const std::vector<std::uint8_t> kGrey = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00,
    0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x00, 0x00, 0x00, 0x00, 0xd1, 0x49, 0x20, 0x56, 0x00,
    0x00, 0x00, 0x0b, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0xe0, 0x3a, 0x01, 0x00, 0x00, 0xdf, 0x00,
    0xd3, 0x4b, 0x21, 0xa5, 0x49, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
const std::vector<std::uint8_t> kGreyAlpha16 = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00,
    0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x10, 0x04, 0x00, 0x00, 0x00, 0xe5, 0x8c, 0xd0, 0x41, 0x00, 0x00, 0x00,
    0x0d, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x68, 0x68, 0x70, 0x70, 0x00, 0x00, 0x04, 0x45, 0x01, 0x81,
    0x1d, 0xc7, 0xa2, 0xbf, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
const std::vector<std::uint8_t> kPalette = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00,
    0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x03, 0x00, 0x00, 0x00, 0xc3, 0xfc, 0x8f, 0xb8, 0x00,
    0x00, 0x00, 0x06, 0x50, 0x4c, 0x54, 0x45, 0xff, 0x00, 0x00, 0x00, 0x00, 0xff, 0x6c, 0xa1, 0xfd, 0x8e,
    0x00, 0x00, 0x00, 0x02, 0x74, 0x52, 0x4e, 0x53, 0xff, 0x80, 0x08, 0x0f, 0xb3, 0x6a, 0x00, 0x00, 0x00,
    0x0b, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x60, 0x60, 0x04, 0x00, 0x00, 0x04, 0x00, 0x02, 0xbf,
    0x7a, 0x3f, 0x4a, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
const std::vector<std::uint8_t> kRgb = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00, 0x00,
    0x01, 0x00, 0x00, 0x00, 0x02, 0x08, 0x02, 0x00, 0x00, 0x00, 0x16, 0xe3, 0x21, 0x70, 0x00, 0x00, 0x00, 0x10, 0x49,
    0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x60, 0x64, 0x62, 0x66, 0xf8, 0xf5, 0xfb, 0x0f, 0x00, 0x06, 0x0a, 0x02, 0xf8,
    0x4c, 0x28, 0xd9, 0xcd, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

using Bytes = std::vector<std::uint8_t>;

TEST(DecodedPng, spreadsGreyOverTheColours) {
    const auto picture = decode_png(kGrey);
    ASSERT_TRUE(picture.ok()) << picture.error().message;
    EXPECT_EQ(picture.value().width, 2u);
    EXPECT_EQ(picture.value().rgba, (Bytes{10, 10, 10, 255, 200, 200, 200, 255}));
}

TEST(DecodedPng, premultipliesAndTakesSixteenBits) {
    const auto picture = decode_png(kGreyAlpha16);
    ASSERT_TRUE(picture.ok()) << picture.error().message;
    EXPECT_EQ(picture.value().rgba, (Bytes{32, 32, 32, 64}));
}

TEST(DecodedPng, readsPalettesWithAlpha) {
    const auto picture = decode_png(kPalette);
    ASSERT_TRUE(picture.ok()) << picture.error().message;
    EXPECT_EQ(picture.value().rgba, (Bytes{255, 0, 0, 255, 0, 0, 128, 128}));
}

TEST(DecodedPng, keepsRowsInOrder) {
    const auto picture = decode_png(kRgb);
    ASSERT_TRUE(picture.ok()) << picture.error().message;
    EXPECT_EQ(picture.value().height, 2u);
    EXPECT_EQ(picture.value().rgba, (Bytes{1, 2, 3, 255, 250, 251, 252, 255}));
}

TEST(DecodedPng, gives8BitPicturesBackAsTheyWere) {
    fetex::Image image{16, 16, {}};
    for (int k = 0; k < 256; ++k)
        for (const int v : {k, 255 - k, k / 2, 255})
            image.rgba.push_back(static_cast<float>(v) / 255);
    const auto png = encode_png(image);
    ASSERT_TRUE(png.ok());
    const auto picture = decode_png(png.value());
    ASSERT_TRUE(picture.ok());
    EXPECT_EQ(picture.value().rgba, to_straight_rgba8(image));
}

/// Every cut before the picture's data ends, and a byte changed anywhere: an error or a picture, never a crash.
TEST(DecodedPng, survivesDamage) {
    for (std::size_t size = 0; size < 41; ++size) {
        const auto picture = decode_png(std::span(kRgb).first(size));
        ASSERT_FALSE(picture.ok()) << size;
        EXPECT_EQ(picture.error().code, diag::kBadPicture);
    }
    for (std::size_t k = 0; k < kPalette.size(); ++k) {
        Bytes damaged = kPalette;
        damaged[k] ^= 0x55;
        const auto picture = decode_png(damaged);
        if (!picture.ok()) continue;
        EXPECT_EQ(picture.value().rgba.size(), std::size_t{4} * picture.value().width * picture.value().height);
    }
}

TEST(DecodedPng, refusesHugePicturesUnread) {
    Bytes huge = kGrey; // the checksum of IHDR no longer fits either
    huge[16] = 0x7f;
    EXPECT_FALSE(decode_png(huge).ok());
}

CompareOutcome with_errors() {
    CompareOutcome o;
    o.texel_side = 0.1;
    measure::SizeErrors a, b;
    a.pixels = {10, 10}, b.pixels = {20, 20};
    a.misclassified_ppm = 5, b.misclassified_ppm = 7;
    a.psnr = 30, b.psnr = 40;
    a.to_truth.hausdorff = 0.05, b.to_picture.hausdorff = 0.02;
    a.away.max = 2.0 / 255, b.away.max = 1.0 / 255;
    a.islands.lost = 1, b.islands.invented = 2;
    o.errors = {a, b};
    return o;
}

TEST(Threshold, takesTheWorstOfAllSizes) {
    const auto checks =
        check(with_errors(), {.misclassified = 6, .distance = 0.6, .psnr = 35, .color = 2, .islands = 1});
    ASSERT_EQ(checks.size(), 5u);
    const double worst[] = {7, 0.5, 30, 2, 2};
    const bool passed[] = {false, true, false, true, false};
    const std::uint32_t width[] = {20, 10, 10, 10, 20};
    for (std::size_t k = 0; k < checks.size(); ++k) {
        EXPECT_NEAR(checks[k].worst, worst[k], 1e-12) << checks[k].option;
        EXPECT_EQ(checks[k].passed, passed[k]) << checks[k].option;
        EXPECT_EQ(checks[k].pixels.width, width[k]) << checks[k].option;
    }
    EXPECT_EQ(describe(checks[0]), "misclassified area 7 ppm at 20 x 20 pixels is beyond --max-misclassified 6");
}

TEST(Threshold, failsWhereDistancesAreBeyondTheReach) {
    CompareOutcome o = with_errors();
    o.errors[0].to_picture.beyond_reach = 1;
    const auto checks = check(o, {.distance = 1.5});
    ASSERT_EQ(checks.size(), 1u);
    EXPECT_FALSE(checks[0].passed);
    EXPECT_EQ(describe(checks[0]),
              "largest distance between edges beyond the reach at 10 x 10 pixels is beyond --max-distance 1.5");
}

TEST(Threshold, takesRoundingForNoDifferenceOfColours) {
    CompareOutcome o;
    measure::PictureDifference d;
    d.pixels = {1, 1}, d.max = 1e-12, d.psnr = 200;
    o.differences = {d};
    o.checks = check(o, {.psnr = 100, .color = 0});
    EXPECT_TRUE(all_passed(o));
    o.differences[0].max = 0.5 / 255;
    o.checks = check(o, {.color = 0});
    EXPECT_FALSE(all_passed(o));
}

TEST(DifferencePicture, darkensWithTheDifference) {
    const std::vector<Rgba> truth(4, Rgba{0, 0, 0, 1});
    std::vector<Rgba> other = truth;
    other[1].r = 2.0 / 255, other[2].g = 30.0 / 255, other[3].b = 1;
    const fetex::Image image = difference_picture(truth, other, {4, 1});
    const auto light = [&](std::size_t k) {
        return 0.2126f * image.rgba[4 * k] + 0.7152f * image.rgba[4 * k + 1] + 0.0722f * image.rgba[4 * k + 2];
    };
    EXPECT_EQ(image.rgba[0], image.rgba[1]);
    EXPECT_NE(image.rgba[4], image.rgba[6]);
    EXPECT_GT(light(1), light(2));
    EXPECT_GT(light(2), light(3));
}

} // namespace
} // namespace fetexc::cli
