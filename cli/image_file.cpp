// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/image_file.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "compiler/diagnostics.h"

namespace fetexc::cli {
namespace {

std::uint8_t to_byte(double value) { return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255)); }

Error encode_error(const std::string& why) {
    return {ErrorClass::Runtime, diag::kCannotEncodePicture, "can't encode the PNG: " + why, {}};
}

} // namespace

std::vector<std::uint8_t> to_straight_rgba8(const fetex::Image& image) {
    std::vector<std::uint8_t> bytes(image.rgba.size());
    for (std::size_t i = 0; i + 3 < bytes.size(); i += 4) {
        bytes[i + 3] = to_byte(image.rgba[i + 3]);
        if (bytes[i + 3] == 0) continue;
        for (std::size_t channel = 0; channel < 3; ++channel)
            bytes[i + channel] = to_byte(static_cast<double>(image.rgba[i + channel]) / image.rgba[i + 3]);
    }
    return bytes;
}

Result<std::vector<std::uint8_t>> encode_png(const fetex::Image& image) {
    const std::vector<std::uint8_t> pixels = to_straight_rgba8(image);
    const auto output = OIIO::ImageOutput::create("picture.png");
    if (!output) return encode_error(OIIO::geterror());
    OIIO::ImageSpec spec(static_cast<int>(image.width), static_cast<int>(image.height), 4, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:UnassociatedAlpha", 1); // the pixels are straight already: write them as they are
    spec.attribute("oiio:ColorSpace", "sRGB");
    std::vector<std::uint8_t> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    if (!output->set_ioproxy(&memory)) return encode_error("no writing to memory");
    if (!output->open("picture.png", spec) || !output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) ||
        !output->close())
        return encode_error(output->geterror());
    return bytes;
}

fetex::Image side_by_side(const fetex::Image& left, const fetex::Image& right, std::uint32_t gap) {
    assert(left.height == right.height);
    fetex::Image both{left.width + gap + right.width, left.height, {}};
    const std::vector<float> line = {0.1f, 0.1f, 0.1f, 1.0f};
    const auto append_row = [&](const fetex::Image& image, std::uint32_t y) {
        const auto row = image.rgba.begin() + std::ptrdiff_t{4} * image.width * y;
        both.rgba.insert(both.rgba.end(), row, row + std::ptrdiff_t{4} * image.width);
    };
    both.rgba.reserve(std::size_t{4} * both.width * both.height);
    for (std::uint32_t y = 0; y < both.height; ++y) {
        append_row(left, y);
        for (std::uint32_t x = 0; x < gap; ++x)
            both.rgba.insert(both.rgba.end(), line.begin(), line.end());
        append_row(right, y);
    }
    return both;
}

} // namespace fetexc::cli
