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
#include "compiler/error_budget.h"

namespace {

namespace budget = fetexc::budget;
using fetexc::cli::ImageNotes;
using fetexc::cli::ImageOutcome;

struct Failure {
    ImageOutcome outcome = ImageOutcome::Unreadable;
    std::string why;
};

/// Which of the file's channels are what; −1: none. Grey: all three are one.
struct ChannelPlan {
    int r = -1, g = -1, b = -1, a = -1;
};

/// R, G and B, or Y, or the only one besides alpha and depth, which is grey then whatever its name. Formats that don't
/// name channels get such names from OpenImageIO. None: what the others mean can't be told.
ChannelPlan plan_channels(const OIIO::ImageSpec& spec) {
    ChannelPlan plan{spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B"), spec.alpha_channel};
    if (plan.a < 0) plan.a = spec.channelindex("A");
    if (plan.r >= 0 && plan.g >= 0 && plan.b >= 0) return plan;
    int grey = spec.channelindex("RY") < 0 && spec.channelindex("BY") < 0 ? spec.channelindex("Y") : -1;
    const bool depth = spec.z_channel >= 0 && spec.z_channel != plan.a;
    if (grey < 0 && spec.nchannels == 1 + (plan.a >= 0 ? 1 : 0) + (depth ? 1 : 0)) {
        grey = 0;
        while (grey == plan.a || grey == spec.z_channel)
            ++grey;
    }
    plan.r = plan.g = plan.b = grey;
    return plan;
}

/// The first of them.
std::string channel_names(const OIIO::ImageSpec& spec) {
    constexpr int most = 8;
    std::string names;
    for (int c = 0; c < std::min(spec.nchannels, most); ++c)
        names += (c > 0 ? ", " : std::string()) + std::string(spec.channel_name(c).substr(0, 64));
    return spec.nchannels > most ? names + " and " + std::to_string(spec.nchannels - most) + " more" : names;
}

/// What has to be read for a plan: channels from begin on, and where they go among `step` floats of a pixel.
struct ChannelReads {
    struct Range {
        int begin = 0, end = 0, to = 0;
    };
    std::vector<Range> ranges;
    int step = 0;
    ChannelPlan plan; ///< places among the floats
};

/// At once where they are close together, else one by one.
ChannelReads reads_of(const ChannelPlan& plan) {
    constexpr int close = 8;
    ChannelReads out;
    std::vector<int> wanted{plan.r, plan.g, plan.b};
    if (plan.a >= 0) wanted.push_back(plan.a);
    std::ranges::sort(wanted);
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    if (wanted.back() - wanted.front() < close) {
        out.step = wanted.back() - wanted.front() + 1;
        out.ranges.push_back({wanted.front(), wanted.back() + 1, 0});
    } else {
        for (const int c : wanted)
            out.ranges.push_back({c, c + 1, out.step++});
    }
    const auto place = [&](int channel) {
        if (channel < 0) return -1;
        const auto range = std::ranges::find_if(out.ranges, [&](const auto& r) { return channel < r.end; });
        return range->to + channel - range->begin;
    };
    out.plan = {place(plan.r), place(plan.g), place(plan.b), place(plan.a)};
    return out;
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
    const bool beyond = !(c >= -budget::kSampleOvershoot && c <= most + budget::kSampleOvershoot);
    c = std::isnan(c) ? 0 : std::clamp(c, 0.0, most);
    return beyond;
}

class ImageReader {
  public:
    ImageReader(const char* path, std::uint32_t max_side, std::uint64_t max_pixels, double most, bool data)
        : path_(path), max_side_(max_side), max_pixels_(max_pixels), most_(most), data_(data) {}

    std::optional<Failure> read() {
        OIIO::ImageSpec wish;
        wish.attribute("oiio:UnassociatedAlpha", 1); // straight stays straight: no rounding to eight bits
        const auto input = OIIO::ImageInput::open(path_, &wish);
        if (!input) return Failure{ImageOutcome::Unreadable, OIIO::geterror()};
        spec_ = input->spec();
        if (const auto failure = check()) return failure;
        const ChannelPlan plan = plan_channels(spec_);
        if (plan.r < 0)
            return Failure{ImageOutcome::Unsupported,
                           "of its channels (" + channel_names(spec_) + ") none are R, G and B, or Y"};
        width = static_cast<std::uint32_t>(spec_.full_width), height = static_cast<std::uint32_t>(spec_.full_height);
        rgba.assign(std::size_t{4} * width * height, 0);
        if (!read_strips(*input, reads_of(plan))) return Failure{ImageOutcome::Unreadable, input->geterror()};
        turn(spec_.get_int_attribute("Orientation", 1));
        notes.more_images = input->seek_subimage(1, 0);
        return {};
    }

    std::uint32_t width = 0, height = 0;
    std::vector<float> rgba;
    ImageNotes notes;

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
        // What the libraries below unpack at a time, of all channels.
        const std::uint64_t at_once =
            tiled() ? static_cast<std::uint64_t>(spec_.tile_width) * static_cast<std::uint64_t>(spec_.tile_height)
                    : static_cast<std::uint64_t>(spec_.width) *
                          static_cast<std::uint64_t>(std::min(spec_.height, kStripRows));
        if (at_once > kMostAtOnce / spec_.pixel_bytes(true))
            return Failure{ImageOutcome::TooLarge, std::to_string(spec_.nchannels) + " channels of " +
                                                       std::to_string(at_once) + " pixels have to be read at once"};
        return {};
    }

    static constexpr int kStripRows = 256; ///< a multiple of the rows that any format packs together
    static constexpr std::uint64_t kMostAtOnce = std::uint64_t{1}
                                                 << 30; ///< bytes: a tile of 2^26 pixels of RGBA floats

    [[nodiscard]] bool tiled() const { return spec_.tile_width > 0 && spec_.tile_height > 0; }

    /// Whole rows of tiles, or of pixels, so that never more than the result is held for long.
    bool read_strips(OIIO::ImageInput& input, const ChannelReads& reads) {
        const int rows = tiled() ? spec_.tile_height : kStripRows;
        const bool is_straight = straight(input), linear = !data_ && is_linear(spec_);
        const auto step = static_cast<std::size_t>(reads.step), row = step * static_cast<std::size_t>(spec_.width);
        std::vector<float> pixels(row * static_cast<std::size_t>(std::min(rows, spec_.height)));
        for (int y = 0; y < spec_.height; y += std::min(rows, spec_.height - y)) {
            const int end = y + std::min(rows, spec_.height - y);
            for (const ChannelReads::Range& range : reads.ranges) {
                if (!read_rows(input, range, y, end, static_cast<OIIO::stride_t>(step), pixels.data() + range.to))
                    return false;
            }
            for (int k = y; k < end; ++k)
                convert(pixels.data() + static_cast<std::size_t>(k - y) * row, k, reads, is_straight, linear);
        }
        return true;
    }

    bool read_rows(OIIO::ImageInput& input, const ChannelReads::Range& range, int first, int end, OIIO::stride_t step,
                   float* to) const {
        const auto size = static_cast<OIIO::stride_t>(sizeof(float));
        const OIIO::stride_t x_stride = step * size, y_stride = x_stride * spec_.width;
        if (!tiled())
            return input.read_scanlines(0, 0, spec_.y + first, spec_.y + end, spec_.z, range.begin, range.end,
                                        OIIO::TypeDesc::FLOAT, to, x_stride, y_stride);
        return input.read_tiles(0, 0, spec_.x, spec_.x + spec_.width, spec_.y + first, spec_.y + end, spec_.z,
                                spec_.z + 1, range.begin, range.end, OIIO::TypeDesc::FLOAT, to, x_stride, y_stride);
    }

    /// PNG, whose alpha is straight by definition, doesn't say so.
    [[nodiscard]] bool straight(const OIIO::ImageInput& input) const {
        return spec_.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0 ||
               std::string_view(input.format_name()) == "png";
    }

    /// Row y of the data window. What lies outside the window is transparent.
    void convert(const float* from, int y, const ChannelReads& reads, bool straight, bool linear) {
        const int to_y = spec_.y + y - spec_.full_y;
        if (to_y < 0 || to_y >= spec_.full_height) return;
        for (int x = 0; x < spec_.width; ++x, from += reads.step) {
            const int to_x = spec_.x + x - spec_.full_x;
            if (to_x < 0 || to_x >= spec_.full_width) continue;
            const std::size_t to = 4 * (static_cast<std::size_t>(to_y) * width + static_cast<std::size_t>(to_x));
            convert_pixel(from, reads.plan, straight, linear, rgba.data() + to);
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
        notes.clipped += beyond ? 1 : 0;
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
    bool data_;
    OIIO::ImageSpec spec_;
};

} // namespace

extern "C" __attribute__((visibility("default"))) ImageOutcome
fetexc_decode_image(const char* path, std::uint32_t max_side, std::uint64_t max_pixels, double most, bool data,
                    fetexc::cli::ImageSink sink, void* context) {
    ImageReader reader(path, max_side, max_pixels, most, data);
    std::optional<Failure> failure;
    try {
        failure = reader.read();
    } catch (const std::exception& e) {
        failure = Failure{ImageOutcome::Unreadable, e.what()};
    }
    if (!failure) {
        sink(context, reader.rgba.data(), reader.width, reader.height, reader.notes);
        return ImageOutcome::Read;
    }
    if (failure->why.empty()) failure->why = "unknown error";
    sink(context, failure->why.data(), static_cast<std::uint32_t>(failure->why.size()), 0, {});
    return failure->outcome;
}
