// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/image_file.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "cli/options.h"
#include "cli/png_module.h"
#include "compiler/diagnostics.h"
#include "compiler/module/module.h"

namespace fetexc::cli {
namespace {

std::uint8_t to_byte(double value) { return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255)); }

Error encode_error(const std::string& why) {
    return {ErrorClass::Runtime, diag::kCannotEncodePicture, "can't encode the PNG: " + why, {}};
}

/// Straight alpha to premultiplied, rounded once.
void premultiply(std::vector<std::uint8_t>& rgba) {
    for (std::size_t k = 0; k < rgba.size(); k += 4) {
        for (std::size_t c = 0; c < 3; ++c)
            rgba[k + c] = static_cast<std::uint8_t>((rgba[k + c] * rgba[k + 3] + 127) / 255);
    }
}

} // namespace

Result<void*> module_symbol(const char* name) {
    static const Module module(kPngModule);
    return module.symbol(name);
}

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
    const auto encode = module_symbol(kEncodePng);
    if (!encode) return encode_error(encode.error().message);
    const std::vector<std::uint8_t> pixels = to_straight_rgba8(image);
    std::vector<std::uint8_t> bytes;
    const auto take = [](void* context, const std::uint8_t* data, std::size_t size) {
        static_cast<std::vector<std::uint8_t>*>(context)->assign(data, data + size);
    };
    if (reinterpret_cast<EncodePng>(encode.value())(pixels.data(), image.width, image.height, take, &bytes) != 0)
        return encode_error(std::string(bytes.begin(), bytes.end()));
    return bytes;
}

Result<DecodedPicture> decode_png(std::span<const std::uint8_t> bytes) {
    const auto decode = module_symbol(kDecodePng);
    if (!decode) return decode.error();
    DecodedPicture picture;
    const auto take = [](void* context, const std::uint8_t* data, std::uint32_t width, std::uint32_t height) {
        const std::size_t size = height == 0 ? width : std::size_t{4} * width * height;
        *static_cast<DecodedPicture*>(context) = {width, height, {data, data + size}};
    };
    if (reinterpret_cast<DecodePng>(decode.value())(bytes.data(), bytes.size(), kMaxSide, take, &picture) != 0)
        return Error{ErrorClass::InvalidInput,
                     diag::kBadPicture,
                     "can't decode the PNG: " + std::string(picture.rgba.begin(), picture.rgba.end()),
                     {}};
    premultiply(picture.rgba);
    return picture;
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
