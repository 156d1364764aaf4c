// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of the module fetexc_png that reads images of any kind.
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include "cli/png_module.h"

namespace {

using fetexc::cli::ImageOutcome;

struct Failure {
    ImageOutcome outcome = ImageOutcome::Unreadable;
    std::string why;
};

/// Which of the file's channels are what; −1: none. Grey: all three are one.
struct ChannelPlan {
    int r = -1, g = -1, b = -1, a = -1;
};

ChannelPlan plan_channels(const OIIO::ImageSpec& spec) {
    ChannelPlan plan{spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B"), spec.alpha_channel};
    if (plan.a < 0) plan.a = spec.channelindex("A");
    if (plan.r >= 0 && plan.g >= 0 && plan.b >= 0) return plan;
    std::vector<int> colors;
    for (int c = 0; c < spec.nchannels; ++c) {
        if (c != plan.a && c != spec.z_channel) colors.push_back(c);
    }
    if (colors.empty()) return plan;
    const bool grey = colors.size() < 3;
    plan.r = colors[0], plan.g = colors[grey ? 0 : 1], plan.b = colors[grey ? 0 : 2];
    return plan;
}

/// Integers are sRGB unless they say otherwise, floating point is linear unless it says otherwise.
bool is_linear(const OIIO::ImageSpec& spec) {
    const std::string space = OIIO::Strutil::lower(spec.get_string_attribute("oiio:ColorSpace"));
    if (space.empty()) return spec.format.is_floating_point();
    return space == "linear" || space.rfind("lin_", 0) == 0 || space == "scene_linear" || space == "raw";
}

/// Above 1 the same formula goes on.
double encode_srgb(double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055; }

/// In place, to 0 … most; whether the channel had to be clipped.
bool clip(double& c, double most) {
    constexpr double tolerance = 1e-4; // what resampling in linear light leaves of 0 and 1
    const bool beyond = !(c >= -tolerance && c <= most + tolerance);
    c = std::isnan(c) ? 0 : std::clamp(c, 0.0, most);
    return beyond;
}

class ImageReader {
  public:
    ImageReader(const char* path, std::uint32_t max_side, std::uint64_t max_pixels, double most)
        : path_(path), max_side_(max_side), max_pixels_(max_pixels), most_(most) {}

    std::optional<Failure> read() {
        OIIO::ImageSpec wish;
        wish.attribute("oiio:UnassociatedAlpha", 1); // straight stays straight: no rounding to eight bits
        const auto input = OIIO::ImageInput::open(path_, &wish);
        if (!input) return Failure{ImageOutcome::Unreadable, OIIO::geterror()};
        spec_ = input->spec();
        if (const auto failure = check()) return failure;
        const ChannelPlan plan = plan_channels(spec_);
        if (plan.r < 0) return Failure{ImageOutcome::Unsupported, "there is no colour channel"};
        std::vector<float> pixels(static_cast<std::size_t>(spec_.image_pixels()) * spec_.nchannels);
        if (!input->read_image(0, 0, 0, spec_.nchannels, OIIO::TypeDesc::FLOAT, pixels.data()))
            return Failure{ImageOutcome::Unreadable, input->geterror()};
        convert(pixels, plan, straight(*input));
        turn(spec_.get_int_attribute("Orientation", 1));
        return {};
    }

    std::uint32_t width = 0, height = 0;
    std::vector<float> rgba;
    std::uint64_t clipped = 0;

  private:
    /// Display and data window.
    [[nodiscard]] std::optional<Failure> check() {
        if (spec_.deep) return Failure{ImageOutcome::Unsupported, "it holds deep data"};
        if (spec_.depth > 1 || spec_.full_depth > 1) return Failure{ImageOutcome::Unsupported, "it is a volume"};
        if (spec_.full_width < 1 || spec_.full_height < 1)
            spec_.full_x = spec_.x, spec_.full_y = spec_.y, spec_.full_width = spec_.width,
            spec_.full_height = spec_.height;
        if (spec_.width < 1 || spec_.height < 1 || spec_.nchannels < 1)
            return Failure{ImageOutcome::Unreadable, "it is empty"};
        for (const auto& [w, h] : {std::pair(spec_.width, spec_.height), {spec_.full_width, spec_.full_height}}) {
            const auto uw = static_cast<std::uint64_t>(w), uh = static_cast<std::uint64_t>(h);
            if (uw > max_side_ || uh > max_side_ || uw * uh > max_pixels_)
                return Failure{ImageOutcome::TooLarge, std::to_string(w) + " x " + std::to_string(h) + " pixels; " +
                                                           std::to_string(max_side_) + " on a side and " +
                                                           std::to_string(max_pixels_) + " in all are the most"};
        }
        return {};
    }

    /// PNG, whose alpha is straight by definition, doesn't say so.
    [[nodiscard]] bool straight(const OIIO::ImageInput& input) const {
        return spec_.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0 ||
               std::string_view(input.format_name()) == "png";
    }

    /// What lies outside the data window is transparent.
    void convert(const std::vector<float>& pixels, const ChannelPlan& plan, bool straight) {
        width = static_cast<std::uint32_t>(spec_.full_width), height = static_cast<std::uint32_t>(spec_.full_height);
        rgba.assign(std::size_t{4} * width * height, 0);
        const bool linear = is_linear(spec_);
        for (int y = 0; y < spec_.height; ++y) {
            for (int x = 0; x < spec_.width; ++x) {
                const int to_x = spec_.x + x - spec_.full_x, to_y = spec_.y + y - spec_.full_y;
                if (to_x < 0 || to_y < 0 || to_x >= spec_.full_width || to_y >= spec_.full_height) continue;
                const std::size_t from = (static_cast<std::size_t>(y) * spec_.width + x) * spec_.nchannels;
                const std::size_t to = 4 * (static_cast<std::size_t>(to_y) * width + static_cast<std::size_t>(to_x));
                convert_pixel(pixels.data() + from, plan, straight, linear, rgba.data() + to);
            }
        }
    }

    void convert_pixel(const float* from, const ChannelPlan& plan, bool straight, bool linear, float* to) {
        double alpha = plan.a >= 0 ? static_cast<double>(from[plan.a]) : 1;
        bool beyond = clip(alpha, 1);
        int k = 0;
        for (const int channel : {plan.r, plan.g, plan.b}) {
            double c = static_cast<double>(from[channel]);
            if (!straight && plan.a >= 0) c = alpha > 0 ? c / alpha : 0;
            beyond = clip(c, most_ > 1 ? std::numeric_limits<double>::infinity() : 1) || beyond;
            if (linear) c = encode_srgb(c);
            if (most_ > 1) beyond = clip(c, most_) || beyond;
            to[k++] = to_value(c * alpha);
        }
        to[3] = to_value(alpha);
        clipped += beyond ? 1 : 0;
    }

    [[nodiscard]] float to_value(double c) const {
        return static_cast<float>(most_ > 1 ? c * 65535 : static_cast<double>(std::lround(c * 65535)));
    }

    /// EXIF orientation: 5 to 8 swap the sides.
    void turn(int orientation) {
        if (orientation < 2 || orientation > 8) return;
        const std::uint32_t w = width, h = height;
        if (orientation >= 5) std::swap(width, height);
        std::vector<float> out(rgba.size());
        for (std::uint32_t y = 0; y < height; ++y) {
            for (std::uint32_t x = 0; x < width; ++x) {
                std::uint32_t sx = orientation >= 5 ? y : x, sy = orientation >= 5 ? x : y;
                if (orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8) sx = w - 1 - sx;
                if (orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7) sy = h - 1 - sy;
                std::copy_n(rgba.begin() + static_cast<std::ptrdiff_t>(4 * (std::size_t{sy} * w + sx)), 4,
                            out.begin() + static_cast<std::ptrdiff_t>(4 * (std::size_t{y} * width + x)));
            }
        }
        rgba = std::move(out);
    }

    std::string path_;
    std::uint32_t max_side_;
    std::uint64_t max_pixels_;
    double most_;
    OIIO::ImageSpec spec_;
};

} // namespace

extern "C" __attribute__((visibility("default"))) ImageOutcome
fetexc_decode_image(const char* path, std::uint32_t max_side, std::uint64_t max_pixels, double most,
                    fetexc::cli::ImageSink sink, void* context) {
    ImageReader reader(path, max_side, max_pixels, most);
    std::optional<Failure> failure;
    try {
        failure = reader.read();
    } catch (const std::exception& e) {
        failure = Failure{ImageOutcome::Unreadable, e.what()};
    }
    if (!failure) {
        sink(context, reader.rgba.data(), reader.width, reader.height, reader.clipped);
        return ImageOutcome::Read;
    }
    if (failure->why.empty()) failure->why = "unknown error";
    sink(context, failure->why.data(), static_cast<std::uint32_t>(failure->why.size()), 0, 0);
    return failure->outcome;
}
