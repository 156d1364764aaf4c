// SPDX-License-Identifier: GPL-3.0-or-later
/// Pictures out: PNG through OpenImageIO.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/result.h"

namespace fetexc::cli {

/// Row-major, top row first, premultiplied sRGB RGBA8.
struct Picture {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
};

/// Divides the colours by alpha (rounded to nearest, clamped; transparent pixels become 0): what PNG stores.
void unpremultiply(Picture& picture);

/// The bytes of a PNG file with straight alpha. Error E8031.
Result<std::vector<std::uint8_t>> encode_png(Picture picture);

} // namespace fetexc::cli
