// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/options.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "runtime_glsl/host/image.h"

namespace fetexc::cli {
namespace {

std::optional<std::uint32_t> parse_side(std::string_view text) {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < 1 || value > kMaxSide) return std::nullopt;
    return value;
}

std::optional<double> parse_number(std::string_view text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

} // namespace

std::optional<SizeValue> parse_size(const std::string& text) {
    const std::string_view view = text;
    const std::size_t cross = view.find('x');
    if (cross == std::string_view::npos) {
        const auto longer = parse_side(view);
        if (!longer) return std::nullopt;
        return SizeValue{0, 0, *longer};
    }
    const auto width = parse_side(view.substr(0, cross)), height = parse_side(view.substr(cross + 1));
    if (!width || !height) return std::nullopt;
    return SizeValue{*width, *height, 0};
}

std::optional<ViewValue> parse_view(const std::string& text) {
    std::vector<double> numbers;
    std::string_view rest = text;
    for (;;) {
        const std::size_t comma = rest.find(',');
        const auto number = parse_number(rest.substr(0, comma));
        if (!number) return std::nullopt;
        numbers.push_back(*number);
        if (comma == std::string_view::npos) break;
        rest.remove_prefix(comma + 1);
    }
    if (numbers.size() != 4) return std::nullopt;
    const ViewValue view{numbers[0], numbers[1], numbers[2], numbers[3]};
    const double farthest = std::max({std::abs(view.x), std::abs(view.y), view.w, view.h});
    if (!(view.w > 0) || !(view.h > 0) || farthest > fetex::kMaxView) return std::nullopt;
    return view;
}

std::optional<std::array<double, 4>> parse_color(const std::string& text) {
    if ((text.size() != 7 && text.size() != 9) || text[0] != '#') return std::nullopt;
    std::array<double, 4> c{0, 0, 0, 1};
    for (std::size_t k = 0; 2 * k + 1 < text.size(); ++k) {
        unsigned value = 0;
        const char* const first = text.data() + 1 + 2 * k;
        if (std::from_chars(first, first + 2, value, 16).ptr != first + 2) return std::nullopt;
        c[k] = value / 255.0;
    }
    return c;
}

PixelSize resolve_size(const SizeValue& size, double aspect) {
    if (size.longer == 0) return {size.width, size.height};
    const auto shorter = [&](double ratio) {
        return static_cast<std::uint32_t>(
            std::clamp(std::round(size.longer * ratio), 1.0, static_cast<double>(kMaxSide)));
    };
    if (aspect >= 1) return {size.longer, shorter(1 / aspect)};
    return {shorter(aspect), size.longer};
}

CLI::Validator number_range(double least, double most) {
    return {[least, most](std::string& text) {
                const auto value = parse_number(text);
                if (value && *value >= least && *value <= most) return std::string();
                return fmt::format("'{}' is not a number from {:g} to {:g}", text, least, most);
            },
            fmt::format("FLOAT in [{:g} - {:g}]", least, most)};
}

namespace {

CLI::Option* add_size(CLI::App& app, SizeValue& value, const std::string& help, bool takes_auto) {
    return app
        .add_option_function<std::string>(
            "--size",
            [&value, takes_auto](const std::string& text) {
                if (takes_auto && text == "auto") {
                    value = {0, 0, 0, true};
                    return;
                }
                const auto size = parse_size(text);
                if (!size)
                    throw CLI::ValidationError("--size", fmt::format("'{}' is neither N nor WxH with sides 1 to {}{}",
                                                                     text, kMaxSide, takes_auto ? ", nor auto" : ""));
                value = *size;
            },
            help)
        ->type_name(takes_auto ? "WxH|N|auto" : "WxH|N");
}

} // namespace

CLI::Option* add_size_option(CLI::App& app, SizeValue& value, const std::string& help) {
    return add_size(app, value, help, false);
}

CLI::Option* add_size_or_auto_option(CLI::App& app, SizeValue& value, const std::string& help) {
    return add_size(app, value, help, true);
}

void add_view_option(CLI::App& app, ViewValue& value) {
    app.add_option_function<std::string>(
           "--view",
           [&value](const std::string& text) {
               const auto view = parse_view(text);
               if (!view)
                   throw CLI::ValidationError("--view", fmt::format("'{}' is not x,y,w,h with w and h above 0", text));
               value = *view;
           },
           "Part to draw, in texture space: x right, y down, the whole texture is 0,0,1,1 (default)")
        ->type_name("X,Y,W,H");
}

void add_quiet_option(CLI::App& app, bool& quiet) {
    app.add_flag("-q,--quiet", quiet, "Print no warnings, notes or progress; errors still");
}

} // namespace fetexc::cli
