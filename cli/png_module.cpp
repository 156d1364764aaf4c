// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/png_module.h"

#include <exception>
#include <string>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace {

/// Returns what went wrong, or nothing.
std::string encode(const std::uint8_t* rgba, std::uint32_t width, std::uint32_t height,
                   std::vector<std::uint8_t>& bytes) {
    const auto output = OIIO::ImageOutput::create("picture.png");
    if (!output) return OIIO::geterror();
    OIIO::ImageSpec spec(static_cast<int>(width), static_cast<int>(height), 4, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:UnassociatedAlpha", 1); // the pixels are straight already: write them as they are
    spec.attribute("oiio:ColorSpace", "sRGB");
    OIIO::Filesystem::IOVecOutput memory(bytes);
    if (!output->set_ioproxy(&memory)) return "no writing to memory";
    if (!output->open("picture.png", spec) || !output->write_image(OIIO::TypeDesc::UINT8, rgba) || !output->close())
        return output->geterror();
    return {};
}

} // namespace

extern "C" __attribute__((visibility("default"))) int fetexc_encode_png(const std::uint8_t* rgba, std::uint32_t width,
                                                                        std::uint32_t height, fetexc::cli::PngSink sink,
                                                                        void* context) {
    std::vector<std::uint8_t> bytes;
    std::string error;
    try {
        error = encode(rgba, width, height, bytes);
    } catch (const std::exception& e) {
        error = e.what();
        if (error.empty()) error = "unknown error";
    }
    if (error.empty()) {
        sink(context, bytes.data(), bytes.size());
        return 0;
    }
    sink(context, reinterpret_cast<const std::uint8_t*>(error.data()), error.size());
    return 1;
}
