// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/image_file.h"

#include <algorithm>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "compiler/diagnostics.h"

namespace fetexc::cli {

void unpremultiply(Picture& picture) {
    for (std::size_t i = 0; i + 3 < picture.rgba.size(); i += 4) {
        const unsigned alpha = picture.rgba[i + 3];
        for (std::size_t channel = 0; channel < 3; ++channel) {
            std::uint8_t& value = picture.rgba[i + channel];
            value = alpha == 0 ? 0 : static_cast<std::uint8_t>(std::min(255u, (value * 255u + alpha / 2) / alpha));
        }
    }
}

Result<std::vector<std::uint8_t>> encode_png(Picture picture) {
    unpremultiply(picture);
    const auto failed = [](const std::string& why) {
        return Error{ErrorClass::Runtime, diag::kCannotEncodePicture, "can't encode the PNG: " + why, {}};
    };
    const auto output = OIIO::ImageOutput::create("picture.png");
    if (!output) return failed(OIIO::geterror());
    OIIO::ImageSpec spec(static_cast<int>(picture.width), static_cast<int>(picture.height), 4, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:UnassociatedAlpha", 1); // the pixels are straight already: write them as they are
    spec.attribute("oiio:ColorSpace", "sRGB");
    std::vector<std::uint8_t> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    if (!output->set_ioproxy(&memory)) return failed("no writing to memory");
    if (!output->open("picture.png", spec) || !output->write_image(OIIO::TypeDesc::UINT8, picture.rgba.data()) ||
        !output->close())
        return failed(output->geterror());
    return bytes;
}

} // namespace fetexc::cli
