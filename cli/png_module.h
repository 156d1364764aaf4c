// SPDX-License-Identifier: GPL-3.0-or-later
/// The functions of the module fetexc_png. OpenImageIO brings some 250 libraries along, whose loading takes longer
/// than compiling a small drawing: only what draws a picture loads them.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fetexc::cli {

/// Takes the bytes of the file, or on failure the reason (UTF-8).
using PngSink = void (*)(void* context, const std::uint8_t* bytes, std::size_t size);

/// Straight-alpha sRGB RGBA8, rows from the top, width·height·4 bytes. Calls the sink once; 0: it got the file.
using EncodePng = int (*)(const std::uint8_t* rgba, std::uint32_t width, std::uint32_t height, PngSink sink,
                          void* context);

/// Takes straight-alpha sRGB RGBA8, rows from the top; on failure the reason as width bytes of UTF-8, height 0.
using PictureSink = void (*)(void* context, const std::uint8_t* bytes, std::uint32_t width, std::uint32_t height);

/// Any PNG: grey, palette, sixteen bits. Sides of more than max_side are refused before anything is decoded. Calls the
/// sink once; 0: it got the picture.
using DecodePng = int (*)(const std::uint8_t* bytes, std::size_t size, std::uint32_t max_side, PictureSink sink,
                          void* context);

/// How a picture of any kind was read.
enum class ImageOutcome : int { Read = 0, Unreadable, TooLarge, Unsupported };

/// What the user should know of a picture that was read.
struct ImageNotes {
    std::uint64_t clipped = 0; ///< pixels
    bool more_images = false;  ///< the file holds others: pages, parts, layers, frames
};

/// Takes premultiplied, sRGB-encoded RGBA floats, 65535 = 1, rows from the top; or on failure the reason as width bytes
/// of UTF-8, height 0.
using ImageSink = void (*)(void* context, const void* bytes, std::uint32_t width, std::uint32_t height,
                           const ImageNotes& notes);

/// Any image that OpenImageIO reads, of several the first; turned as its Orientation says; of an EXR the display
/// window. Colours are R, G and B, or Y, or a single channel; others are Unsupported. Refused before anything is
/// decoded: sides of more than max_side, more than max_pixels, more than 1 GiB to be unpacked at once. Straight,
/// encoded colours are clipped to 0 … most: at 1 they are rounded to 16 bits, above not. data: numbers are no colours,
/// and none is encoded. Calls the sink once.
using DecodeImage = ImageOutcome (*)(const char* path, std::uint32_t max_side, std::uint64_t max_pixels, double most,
                                     bool data, ImageSink sink, void* context);

inline constexpr const char* kPngModule = "libfetexc_png.so";
inline constexpr const char* kEncodePng = "fetexc_encode_png";
inline constexpr const char* kDecodePng = "fetexc_decode_png";
inline constexpr const char* kDecodeImage = "fetexc_decode_image";

} // namespace fetexc::cli
