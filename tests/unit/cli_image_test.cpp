// SPDX-License-Identifier: GPL-3.0-or-later
/// Images of many kinds, written here byte by byte.
#include <algorithm>
#include <bit>
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
        auto image = read_image(write(name, bytes), {.bright = bright}, diagnostics_);
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

void append_word(std::string& out, std::uint32_t v, int bytes) {
    for (int k = 0; k < bytes; ++k)
        out.push_back(static_cast<char>(v >> (8 * k)));
}

struct TiffField {
    std::uint32_t tag, value;
};

/// One page of grey bytes, uncompressed, black is 0; more fields come in between by their tags. `at`: in the file.
std::string tiff_page(std::uint32_t at, std::uint32_t width, std::uint32_t height, std::vector<TiffField> fields,
                      const std::string& data, bool last) {
    for (const TiffField& f : {TiffField{256, width}, {257, height}, {258, 8}, {259, 1}, {262, 1}, {277, 1}}) {
        if (std::ranges::none_of(fields, [&](const TiffField& g) { return g.tag == f.tag; })) fields.push_back(f);
    }
    const bool tiled = std::ranges::any_of(fields, [](const TiffField& f) { return f.tag == 322; });
    const auto size = static_cast<std::uint32_t>(data.size());
    if (!tiled) fields.push_back({273, 0}), fields.push_back({279, size});
    std::ranges::sort(fields, {}, &TiffField::tag);
    const std::uint32_t first = at + 2 + 12 * static_cast<std::uint32_t>(fields.size()) + 4;
    std::string out;
    append_word(out, static_cast<std::uint32_t>(fields.size()), 2);
    for (const TiffField& f : fields) {
        const bool offset = f.tag == 273 || f.tag == 324; // longs (4); else shorts (3), or longs for sizes
        append_word(out, f.tag, 2), append_word(out, offset || f.tag == 279 || f.tag == 325 ? 4 : 3, 2);
        append_word(out, 1, 4), append_word(out, offset ? first : f.value, 4);
    }
    append_word(out, last ? 0 : first + size, 4);
    return out + data;
}

std::string tiff_file(std::uint32_t width, std::uint32_t height, const std::vector<TiffField>& fields,
                      const std::string& data) {
    return bytes_of({'I', 'I', 42, 0, 8, 0, 0, 0}) + tiff_page(8, width, height, fields, data, true);
}

std::string tiff(std::uint16_t orientation) {
    return tiff_file(3, 2, {{274, orientation}}, bytes_of({0, 51, 102, 153, 204, 255}));
}

/// One row of 32-bit floats, uncompressed; the channels' names ascending, each pixel of channel k is values[k].
std::string exr(const std::vector<std::string>& names, const std::vector<float>& values, std::uint32_t width = 1,
                std::uint32_t height = 1) {
    std::string out = bytes_of({0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0});
    const auto attribute = [&](const std::string& name, const std::string& type, const std::string& data) {
        out += name + '\0' + type + '\0';
        append_word(out, static_cast<std::uint32_t>(data.size()), 4);
        out += data;
    };
    std::string channels, window, center(8, '\0'), one;
    for (const std::string& name : names) {
        channels += name + '\0';
        append_word(channels, 2, 4), append_word(channels, 0, 4), append_word(channels, 1, 4),
            append_word(channels, 1, 4);
    }
    channels.push_back('\0');
    append_word(window, 0, 4), append_word(window, 0, 4), append_word(window, width - 1, 4),
        append_word(window, height - 1, 4);
    append_word(one, std::bit_cast<std::uint32_t>(1.0f), 4);
    attribute("channels", "chlist", channels), attribute("compression", "compression", std::string(1, '\0'));
    attribute("dataWindow", "box2i", window), attribute("displayWindow", "box2i", window);
    attribute("lineOrder", "lineOrder", std::string(1, '\0')), attribute("pixelAspectRatio", "float", one);
    attribute("screenWindowCenter", "v2f", center), attribute("screenWindowWidth", "float", one);
    out.push_back('\0');
    if (values.empty())
        return out + std::string(std::size_t{8} * height, '\1'); // a header, and where rows are said to be
    const auto row = static_cast<std::uint32_t>(4 * width * values.size());
    const std::size_t table = out.size();
    for (std::uint32_t y = 0; y < height; ++y) {
        append_word(out, static_cast<std::uint32_t>(table + 8 * height + y * (8 + row)), 4);
        append_word(out, 0, 4);
    }
    for (std::uint32_t y = 0; y < height; ++y) {
        append_word(out, y, 4), append_word(out, row, 4);
        for (const float v : values) {
            for (std::uint32_t x = 0; x < width; ++x)
                append_word(out, std::bit_cast<std::uint32_t>(v), 4);
        }
    }
    return out;
}

/// Where the pixels of a picture, stored as 0 1 2 / 3 4 5, are seen.
/// Floating point is linear light unless it is no light at all.
TEST_F(ImageFile, dataIsNeverEncoded) {
    const std::string bytes = exr({"B", "G", "R"}, {0.25f, 0.5f, 0.75f});
    const auto data = read_image(write("n.exr", bytes), {.data = true}, diagnostics_);
    ASSERT_TRUE(data.ok());
    expect_pixel(data.value(), 0, 0, {0.75, 0.5, 0.25, 1}, kWord);
    EXPECT_GT(read("c.exr", bytes).at(0, 0).r, 0.85);
}

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
        const auto image = read_image(write(name, bytes), {}, diagnostics_);
        return image.ok() ? 0 : image.error().code;
    };
    EXPECT_EQ(code("a.png", "no picture"), diag::kImageUnreadable);
    EXPECT_EQ(code("b.png", ""), diag::kImageUnreadable);
    EXPECT_EQ(code("c.tif", tiff(1).substr(0, 60)), diag::kImageUnreadable);
    EXPECT_EQ(code("d.pgm", "P5\n16385 1\n255\n"), diag::kImageTooLarge);
    EXPECT_EQ(code("e.pgm", "P5\n16384 16384\n255\n"), diag::kImageTooLarge);
}

/// Longer than the strips that are read at a time.
TEST_F(ImageFile, isReadInStrips) {
    std::string rows;
    for (int y = 0; y < 700; ++y)
        rows += bytes_of({y % 256, (y / 256) * 85});
    const RasterImage image = read("a.pgm", "P5\n2 700\n255\n" + rows);
    ASSERT_EQ(image.height, 700u);
    for (std::uint32_t y = 0; y < 700; ++y) {
        EXPECT_EQ(std::lround(255 * image.at(0, y).r), y % 256) << y;
        EXPECT_EQ(std::lround(3 * image.at(1, y).b), y / 256) << y;
    }
}

TEST_F(ImageFile, isReadByRowsOfTiles) {
    std::string tile;
    for (int k = 0; k < 16 * 16; ++k)
        tile.push_back(static_cast<char>(k));
    const RasterImage image = read("a.tif", tiff_file(13, 11, {{322, 16}, {323, 16}, {324, 0}, {325, 256}}, tile));
    ASSERT_EQ(image.width, 13u);
    ASSERT_EQ(image.height, 11u);
    for (std::uint32_t k = 0; k < 13 * 11; ++k)
        EXPECT_EQ(std::lround(255 * image.at(k % 13, k / 13).r), k % 13 + 16 * (k / 13)) << k;
}

TEST_F(ImageFile, greyMayHaveAlpha) {
    // ExtraSamples 2: straight.
    const RasterImage image = read("a.tif", tiff_file(1, 1, {{277, 2}, {338, 2}}, bytes_of({255, 51})));
    expect_pixel(image, 0, 0, {0.2, 0.2, 0.2, 0.2}, kWord);
}

TEST_F(ImageFile, channelsAreKnownByTheirNames) {
    const double half = 1.055 * std::pow(0.5, 1 / 2.4) - 0.055;
    expect_pixel(read("a.exr", exr({"anything"}, {0.5f})), 0, 0, {half, half, half, 1}, kWord);
    expect_pixel(read("b.exr", exr({"X", "Y", "foo"}, {1, 0.5f, 1})), 0, 0, {half, half, half, 1}, kWord);
    expect_pixel(read("c.exr", exr({"A", "X", "Z"}, {0.5f, 0.5f, 7})), 0, 0, {0.5, 0.5, 0.5, 0.5}, kWord);
    std::vector<std::string> names = {"B", "G"}; // and R far away
    std::vector<float> values = {0, 0.5f};
    for (int k = 10; k < 60; ++k)
        names.push_back("Layer." + std::to_string(k)), values.push_back(9);
    names.emplace_back("R"), values.push_back(1);
    expect_pixel(read("d.exr", exr(names, values, 3, 2)), 2, 1, {1, half, 0, 1}, kWord);
    EXPECT_TRUE(diagnostics_.empty());
}

TEST_F(ImageFile, channelsWithoutAMeaningAreRefusedByName) {
    const auto refused = [&](const std::vector<std::string>& names) {
        const auto image =
            read_image(write("a.exr", exr(names, std::vector<float>(names.size(), 1))), {}, diagnostics_);
        return image.ok() ? Error{} : image.error();
    };
    EXPECT_EQ(refused({"foo", "fur"}).code, diag::kImageUnsupported);
    EXPECT_EQ(refused({"foo", "fur"}).cls, ErrorClass::Unsupported);
    EXPECT_NE(refused({"foo", "fur"}).message.find("foo, fur"), std::string::npos);
    EXPECT_EQ(refused({"G", "R"}).code, diag::kImageUnsupported);
    EXPECT_EQ(refused({"BY", "RY", "Y"}).code, diag::kImageUnsupported);
    EXPECT_EQ(refused({"a.B", "a.G", "a.R", "b.B", "b.G", "b.R"}).code, diag::kImageUnsupported);
}

/// Some 70,000 bytes for 48 GiB.
TEST_F(ImageFile, thousandsOfChannelsAreRefusedBeforeTheyAreRead) {
    std::vector<std::string> names;
    for (int k = 0; k < 3000; ++k)
        names.push_back("c" + std::to_string(1000 + k));
    names.insert(names.begin(), {"B", "G", "R"});
    const std::string header = exr(names, {}, 16384, 256);
    const auto image = read_image(write("a.exr", header), {}, diagnostics_);
    ASSERT_FALSE(image.ok());
    EXPECT_EQ(image.error().code, diag::kImageTooLarge);
}

TEST_F(ImageFile, otherPagesAreToldOf) {
    std::string file = bytes_of({'I', 'I', 42, 0, 8, 0, 0, 0});
    file += tiff_page(8, 1, 1, {}, bytes_of({51, 0}), false); // a byte of padding: pages begin at even places
    file += tiff_page(static_cast<std::uint32_t>(file.size()), 1, 1, {}, bytes_of({255}), true);
    expect_pixel(read("a.tif", file), 0, 0, {0.2, 0.2, 0.2, 1}, kWord);
    ASSERT_EQ(diagnostics_.size(), 1u);
    EXPECT_EQ(diagnostics_[0].code, diag::kMoreImages);
    EXPECT_EQ(diagnostics_[0].severity, Severity::Warning);
}

/// A step of 8 bits or more is told of, less than half a step of 12 isn't.
TEST_F(ImageFile, littleOvershootIsNotCalledClipping) {
    expect_pixel(read("a.exr", exr({"Y"}, {1.00005f})), 0, 0, {1, 1, 1, 1}, 0);
    expect_pixel(read("a.exr", exr({"Y"}, {-0.00005f})), 0, 0, {0, 0, 0, 1}, 0);
    EXPECT_TRUE(diagnostics_.empty());
    expect_pixel(read("a.exr", exr({"Y"}, {1.004f})), 0, 0, {1, 1, 1, 1}, 0);
    ASSERT_EQ(diagnostics_.size(), 1u);
    EXPECT_EQ(diagnostics_[0].code, diag::kImageClipped);
}

} // namespace
} // namespace fetexc::cli
