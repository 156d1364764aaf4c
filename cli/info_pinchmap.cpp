// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "cli/compile_pinchmap.h"
#include "cli/compile_silmap.h"
#include "cli/texture_info.h"

namespace fetexc::cli {
namespace {

/// Texels of the map: where discontinuities pass, and of those with less than full strength.
struct Counts {
    std::uint64_t texels = 0, active = 0, weak = 0;
};
Counts count_texels(const fetex::PinchmapTexture& t) {
    Counts out;
    for (std::uint32_t j = 0; j < fetex::pinchmap_rows(t); ++j) {
        for (std::uint32_t i = 0; i < fetex::pinchmap_columns(t); ++i) {
            const fetex::PinchmapTexel texel = fetex::pinchmap_texel(t, i, j);
            ++out.texels;
            if (texel.k != 0) continue;
            ++out.active;
            out.weak += std::max(std::abs(texel.du), std::abs(texel.dv)) < 1 ? 1 : 0;
        }
    }
    return out;
}

std::uint64_t signal_bytes(const fetex::PinchmapTexture& t) {
    return fetex::pinchmap_gpu_bytes(t) - 4 * std::uint64_t{t.map.size() + t.mips.size()};
}

std::uint32_t signal_levels(const fetex::PinchmapTexture& t) {
    return t.mips.empty() ? 0
                          : fetex::fbt_mip_levels(fetex::pinchmap_signal_width(t), fetex::pinchmap_signal_height(t));
}

} // namespace

Json info_json(const fetex::PinchmapTexture& t) {
    const Counts counts = count_texels(t);
    return {{"width", t.width},
            {"height", t.height},
            {"scale", t.scale},
            {"mapBits", map_bits(t)},
            {"samples", silmap_samples_name(t.sample_format)},
            {"gpuBytes", fetex::pinchmap_gpu_bytes(t)},
            {"mapBytes", 4 * t.map.size()},
            {"signalBytes", signal_bytes(t)},
            {"mipBytes", 4 * t.mips.size()},
            {"mipLevels", signal_levels(t)},
            {"lineWidth", t.line_width / fetex::kPinchmapLineUnit},
            {"texels", {{"total", counts.texels}, {"active", counts.active}, {"weak", counts.weak}}}};
}

void print_info(const fetex::PinchmapTexture& t) {
    const Counts counts = count_texels(t);
    fmt::print("pinchmap      {} x {} clusters, {}-bit map; signal of {} x {} samples\n", t.width, t.height,
               map_bits(t), fetex::pinchmap_signal_width(t), fetex::pinchmap_signal_height(t));
    fmt::print("  on the GPU  {} bytes: {} in the map, {} in the signal{}\n", fetex::pinchmap_gpu_bytes(t),
               4 * t.map.size(), signal_bytes(t),
               t.mips.empty() ? "" : fmt::format(", {} in {} mip levels", 4 * t.mips.size(), signal_levels(t)));
    fmt::print("  map         {} of {} texels with a discontinuity, {} of them weak{}\n", counts.active, counts.texels,
               counts.weak,
               t.line_width == 0
                   ? ""
                   : fmt::format("; a line of {:.3f} texels along them", t.line_width / fetex::kPinchmapLineUnit));
}

} // namespace fetexc::cli
