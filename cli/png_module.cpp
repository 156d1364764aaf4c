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

struct Decoded {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
};

/// Grey and grey with alpha become colours, what has no alpha is opaque.
void spread_channels(const std::vector<std::uint8_t>& pixels, int channels, std::vector<std::uint8_t>& rgba) {
    const auto step = static_cast<std::size_t>(channels);
    const bool grey = channels < 3, alpha = channels == 2 || channels == 4;
    rgba.resize(pixels.size() / step * 4);
    for (std::size_t k = 0; k * step < pixels.size(); ++k) {
        const std::uint8_t* from = pixels.data() + k * step;
        for (std::size_t c = 0; c < 3; ++c)
            rgba[4 * k + c] = from[grey ? 0 : c];
        rgba[4 * k + 3] = alpha ? from[step - 1] : 255;
    }
}

/// Returns what went wrong, or nothing.
std::string decode(const std::uint8_t* bytes, std::size_t size, std::uint32_t max_side, Decoded& out) {
    OIIO::Filesystem::IOMemReader memory(bytes, size);
    OIIO::ImageSpec wish;
    wish.attribute("oiio:UnassociatedAlpha", 1); // straight alpha is what the file has: no rounding twice
    void* const proxy = &memory;
    wish.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    const auto input = OIIO::ImageInput::open("picture.png", &wish);
    if (!input) return OIIO::geterror();
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.nchannels > 4) return "no picture";
    out.width = static_cast<std::uint32_t>(spec.width), out.height = static_cast<std::uint32_t>(spec.height);
    if (out.width > max_side || out.height > max_side)
        return std::to_string(out.width) + " x " + std::to_string(out.height) + " pixels, more than " +
               std::to_string(max_side) + " on a side";
    std::vector<std::uint8_t> pixels(std::size_t{out.width} * out.height * static_cast<std::size_t>(spec.nchannels));
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, pixels.data())) return input->geterror();
    spread_channels(pixels, spec.nchannels, out.rgba);
    return {};
}

template <class Work> std::string without_exceptions(const Work& work) {
    try {
        return work();
    } catch (const std::exception& e) {
        const std::string what = e.what();
        return what.empty() ? "unknown error" : what;
    }
}

} // namespace

extern "C" __attribute__((visibility("default"))) int fetexc_encode_png(const std::uint8_t* rgba, std::uint32_t width,
                                                                        std::uint32_t height, fetexc::cli::PngSink sink,
                                                                        void* context) {
    std::vector<std::uint8_t> bytes;
    const std::string error = without_exceptions([&] { return encode(rgba, width, height, bytes); });
    if (error.empty()) {
        sink(context, bytes.data(), bytes.size());
        return 0;
    }
    sink(context, reinterpret_cast<const std::uint8_t*>(error.data()), error.size());
    return 1;
}

extern "C" __attribute__((visibility("default"))) int fetexc_decode_png(const std::uint8_t* bytes, std::size_t size,
                                                                        std::uint32_t max_side,
                                                                        fetexc::cli::PictureSink sink, void* context) {
    Decoded picture;
    const std::string error = without_exceptions([&] { return decode(bytes, size, max_side, picture); });
    if (error.empty()) {
        sink(context, picture.rgba.data(), picture.width, picture.height);
        return 0;
    }
    sink(context, reinterpret_cast<const std::uint8_t*>(error.data()), static_cast<std::uint32_t>(error.size()), 0);
    return 1;
}
