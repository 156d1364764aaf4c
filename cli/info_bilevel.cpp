// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "cli/compile_bilevel.h"
#include "cli/texture_info.h"

namespace fetexc::cli {
namespace {

/// "#rrggbbaa", premultiplied.
std::string color_text(std::uint32_t rgba) {
    return fmt::format("#{:02x}{:02x}{:02x}{:02x}", rgba & 0xff, rgba >> 8 & 0xff, rgba >> 16 & 0xff, rgba >> 24);
}

} // namespace

Json info_json(const fetex::BilevelTexture& t) {
    Json json = {{"width", t.width},
                 {"height", t.height},
                 {"channels", t.channels},
                 {"rule", rule_name(t.rule)},
                 {"gpuBytes", fetex::bilevel_gpu_bytes(t)},
                 {"texelBytes", t.texels.size()},
                 {"mipBytes", t.mips.size()},
                 {"mipLevels", mip_levels_of(t)},
                 {"imageBytes", 4 * t.image.size()},
                 {"below", color_text(t.below)}};
    if (t.image.empty())
        json["above"] = color_text(t.above);
    else
        json["image"] = {{"width", t.image_width}, {"height", t.image_height}};
    return json;
}

void print_info(const fetex::BilevelTexture& t) {
    fmt::print("bi-level      {} x {} texels, {} channel{} ({})\n", t.width, t.height, t.channels,
               t.channels == 1 ? "" : "s", rule_name(t.rule));
    fmt::print("  on the GPU  {} bytes: {} in texels{}{}\n", fetex::bilevel_gpu_bytes(t), t.texels.size(),
               t.mips.empty() ? "" : fmt::format(", {} in {} mip levels", t.mips.size(), mip_levels_of(t)),
               t.image.empty()
                   ? ""
                   : fmt::format(", {} in an image of {} x {}", 4 * t.image.size(), t.image_width, t.image_height));
    fmt::print("  colours     {} below, {} above\n", color_text(t.below),
               t.image.empty() ? color_text(t.above) : "the image");
}

} // namespace fetexc::cli
