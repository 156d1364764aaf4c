// SPDX-License-Identifier: GPL-3.0-or-later
/// Pictures out and in: PNG through OpenImageIO, in a module that is loaded with the first picture.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/result.h"
#include "runtime_glsl/host/image.h"

namespace fetexc::cli {

/// Straight-alpha RGBA8, as PNG stores it: colours divided by alpha and rounded once, transparent pixels 0.
std::vector<std::uint8_t> to_straight_rgba8(const fetex::Image& image);

/// The bytes of a PNG file, sRGB, straight alpha. Error E8031.
Result<std::vector<std::uint8_t>> encode_png(const fetex::Image& image);

/// A PNG of any kind as 8 bits a channel.
struct DecodedPicture {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba; ///< premultiplied, row-major, top row first
};
/// Sides of at most kMaxSide. Error E8032.
Result<DecodedPicture> decode_png(std::span<const std::uint8_t> bytes);

/// Two pictures of equal height, side by side, `gap` pixels of a dark line between.
fetex::Image side_by_side(const fetex::Image& left, const fetex::Image& right, std::uint32_t gap);

/// A function of the module (png_module.h), which is loaded now if it isn't yet. Error kNoModule.
Result<void*> module_symbol(const char* name);

} // namespace fetexc::cli
