// SPDX-License-Identifier: GPL-3.0-or-later
/// Images of many kinds, written here byte by byte.
#include <cmath>
#include <filesystem>
#include <fstream>

#include <unistd.h>

#include <gtest/gtest.h>

#include "cli/compile_image.h"
#include "cli/image_file.h"
#include "compiler/diagnostics.h"

namespace fetexc::cli {
namespace {

class ImageFile : public testing::Test {
  protected:
    ~ImageFile() override { std::filesystem::remove_all(folder_); }

    std::string write(const std::string& name, const std::string& bytes) {
        std::filesystem::create_directories(folder_);
        const std::filesystem::path path = folder_ / name;
        std::ofstream(path, std::ios::binary) << bytes;
        return path.string();
    }
    RasterImage read(const std::string& name, const std::string& bytes, bool bright = false) {
        auto image = read_image(write(name, bytes), bright, diagnostics_);
        if (!image.ok()) throw std::runtime_error(image.error().message);
        return std::move(image).value();
    }

    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("fetexc_cli_image_test." + std::to_string(getpid()));
    std::vector<Diagnostic> diagnostics_;
};

std::string bytes_of(std::initializer_list<int> values) {
    std::string out;
    for (const int v : values)
        out.push_back(static_cast<char>(v));
    return out;
}

void expect_pixel(const RasterImage& image, std::uint32_t x, std::uint32_t y, const Rgba& wanted, double tolerance) {
    const Rgba c = image.at(x, y);
    EXPECT_NEAR(c.r, wanted.r, tolerance);
    EXPECT_NEAR(c.g, wanted.g, tolerance);
    EXPECT_NEAR(c.b, wanted.b, tolerance);
    EXPECT_NEAR(c.a, wanted.a, tolerance);
}

constexpr double kWord = 1.0 / 65535;

TEST_F(ImageFile, greyOfEightAndSixteenBits) {
    const RasterImage eight = read("a.pgm", "P5\n2 1\n255\n" + bytes_of({51, 255}));
    ASSERT_EQ(eight.width, 2u);
    ASSERT_EQ(eight.height, 1u);
    expect_pixel(eight, 0, 0, {0.2, 0.2, 0.2, 1}, kWord);
    expect_pixel(eight, 1, 0, {1, 1, 1, 1}, 0);
    const RasterImage sixteen = read("b.pgm", "P5\n1 2\n65535\n" + bytes_of({0x12, 0x34, 0xff, 0x00}));
    expect_pixel(sixteen, 0, 0, {0x1234 * kWord, 0x1234 * kWord, 0x1234 * kWord, 1}, 1.5 * kWord);
    expect_pixel(sixteen, 0, 1, {0xff00 * kWord, 0xff00 * kWord, 0xff00 * kWord, 1}, 1.5 * kWord);
}

TEST_F(ImageFile, straightAlphaIsPremultiplied) {
    fetex::Image image{2, 1, {0.4f, 0.2f, 0.1f, 0.4f, 0, 0, 0, 0}}; // premultiplied; written straight: 1, 1/2, 1/4
    const auto png = encode_png(image);
    ASSERT_TRUE(png.ok());
    const RasterImage back = read("a.png", std::string(png.value().begin(), png.value().end()));
    expect_pixel(back, 0, 0, {0.4, 0.4 * 128 / 255, 0.4 * 64 / 255, 0.4}, kWord);
    expect_pixel(back, 1, 0, {0, 0, 0, 0}, 0);
}

/// Radiance: mantissas of eight bits and an exponent; linear light.
TEST_F(ImageFile, floatsAreLinearAndClipped) {
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
    const RasterImage image = read("a.hdr", header + bytes_of({128, 64, 32, 128, 128, 128, 0, 131}));
    const auto encoded = [](double c) { return 1.055 * std::pow(c, 1 / 2.4) - 0.055; };
    expect_pixel(image, 0, 0, {encoded(0.5), encoded(0.25), encoded(0.125), 1}, 0.004);
    expect_pixel(image, 1, 0, {1, 1, 0, 1}, 0.004); // 4, 4, 0
    ASSERT_EQ(diagnostics_.size(), 1u);
    EXPECT_EQ(diagnostics_[0].code, diag::kImageClipped);
    EXPECT_EQ(diagnostics_[0].message.substr(0, 2), "1 ");
}

TEST_F(ImageFile, floatsMayStayBrighterThanWhite) {
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n";
    const RasterImage image = read("a.hdr", header + bytes_of({128, 64, 32, 128, 128, 128, 0, 141}), true);
    const auto encoded = [](double c) { return 1.055 * std::pow(c, 1 / 2.4) - 0.055; };
    expect_pixel(image, 0, 0, {encoded(0.5), encoded(0.25), encoded(0.125), 1}, 0.004);
    expect_pixel(image, 1, 0, {encoded(4096), encoded(4096), 0, 1}, 0.1);
    EXPECT_TRUE(diagnostics_.empty());
    // Integers end at 1, and keep what 16 bits say.
    const RasterImage sixteen = read("b.pgm", "P5\n1 1\n65535\n" + bytes_of({0x12, 0x34}), true);
    expect_pixel(sixteen, 0, 0, {0x1234 / 65535.0, 0x1234 / 65535.0, 0x1234 / 65535.0, 1}, 1e-6);
}

std::string tiff(std::uint16_t orientation) {
    std::string out = bytes_of({'I', 'I', 42, 0, 8, 0, 0, 0});
    const auto word = [&](std::uint32_t v, int bytes) {
        for (int k = 0; k < bytes; ++k)
            out.push_back(static_cast<char>(v >> (8 * k)));
    };
    constexpr std::uint32_t entries = 9, data = 8 + 2 + 12 * entries + 4;
    word(entries, 2);
    // Width, height, bits, uncompressed, black is 0, where, orientation, samples, bytes: shorts (3) and longs (4).
    const std::uint32_t fields[entries][3] = {{256, 3, 3},           {257, 3, 2}, {258, 3, 8},
                                              {259, 3, 1},           {262, 3, 1}, {273, 4, data},
                                              {274, 3, orientation}, {277, 3, 1}, {279, 4, 6}};
    for (const auto& f : fields)
        word(f[0], 2), word(f[1], 2), word(1, 4), word(f[2], 4);
    word(0, 4);
    return out + bytes_of({0, 51, 102, 153, 204, 255}); // 3 wide, 2 high
}

/// Where the pixels of a picture, stored as 0 1 2 / 3 4 5, are seen.
TEST_F(ImageFile, isTurnedAsItsOrientationSays) {
    const std::vector<std::vector<int>> seen = {{0, 1, 2, 3, 4, 5}, {2, 1, 0, 5, 4, 3}, {5, 4, 3, 2, 1, 0},
                                                {3, 4, 5, 0, 1, 2}, {0, 3, 1, 4, 2, 5}, {3, 0, 4, 1, 5, 2},
                                                {5, 2, 4, 1, 3, 0}, {2, 5, 1, 4, 0, 3}};
    for (std::uint16_t orientation = 1; orientation <= 8; ++orientation) {
        const RasterImage image = read("a.tif", tiff(orientation));
        ASSERT_EQ(image.width, orientation < 5 ? 3u : 2u);
        ASSERT_EQ(image.height, orientation < 5 ? 2u : 3u);
        for (std::uint32_t k = 0; k < 6; ++k)
            EXPECT_EQ(std::lround(5 * image.at(k % image.width, k / image.width).g), seen[orientation - 1u][k])
                << orientation << ", " << k;
    }
}

TEST_F(ImageFile, refusesWhatItCantTake) {
    const auto code = [&](const std::string& name, const std::string& bytes) {
        const auto image = read_image(write(name, bytes), false, diagnostics_);
        return image.ok() ? 0 : image.error().code;
    };
    EXPECT_EQ(code("a.png", "no picture"), diag::kImageUnreadable);
    EXPECT_EQ(code("b.png", ""), diag::kImageUnreadable);
    EXPECT_EQ(code("c.tif", tiff(1).substr(0, 60)), diag::kImageUnreadable);
    EXPECT_EQ(code("d.pgm", "P5\n16385 1\n255\n"), diag::kImageTooLarge);
    EXPECT_EQ(code("e.pgm", "P5\n16384 16384\n255\n"), diag::kImageTooLarge);
}

} // namespace
} // namespace fetexc::cli
