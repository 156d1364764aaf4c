// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <fmt/format.h>

#include "cli/compile_silmap.h"
#include "cli/texture_info.h"

namespace fetexc::cli {
namespace {

/// Of the cells.
struct Counts {
    std::uint64_t cells = 0, with_boundary = 0, ends = 0, joints = 0;
};

/// Boundary links at each cell's point: none, one (an end), two (an edge passes), more (a junction).
Counts count_cells(const fetex::SilmapTexture& t) {
    Counts out;
    for (std::uint32_t j = 0; j < fetex::silmap_rows(t); ++j) {
        for (std::uint32_t i = 0; i < fetex::silmap_columns(t); ++i) {
            const int links = __builtin_popcount(fetex::silmap_shape(t, i, j).boundaries);
            ++out.cells, out.with_boundary += links > 0 ? 1 : 0;
            out.ends += links == 1 ? 1 : 0, out.joints += links > 2 ? 1 : 0;
        }
    }
    return out;
}

std::uint64_t color_bytes(const fetex::SilmapTexture& t) {
    const std::uint64_t bytes = 4 * std::uint64_t{t.colors.size()};
    return t.sample_format == fetex::SilmapSampleFormat::Rgb8 ? bytes / 4 * 3 : bytes;
}

std::uint64_t cell_bytes(const fetex::SilmapTexture& t) { return std::uint64_t{t.cells.size()} * cell_bits(t) / 8; }

const char* samples_text(fetex::SilmapSampleFormat format) {
    switch (format) {
    case fetex::SilmapSampleFormat::Rgb8:
        return "RGB8";
    case fetex::SilmapSampleFormat::Rgba8:
        return "RGBA8";
    case fetex::SilmapSampleFormat::Rgba16:
        return "RGBA16";
    case fetex::SilmapSampleFormat::Rgba16F:
        return "RGBA16F";
    }
    return "";
}

} // namespace

Json info_json(const fetex::SilmapTexture& t) {
    const Counts counts = count_cells(t);
    return {{"width", t.width},
            {"height", t.height},
            {"cellBits", cell_bits(t)},
            {"samples", silmap_samples_name(t.sample_format)},
            {"gpuBytes", fetex::silmap_gpu_bytes(t)},
            {"cellBytes", cell_bytes(t)},
            {"colorBytes", color_bytes(t)},
            {"mipBytes", 4 * t.mips.size()},
            {"mipLevels", mip_levels_of(t)},
            {"cells",
             {{"total", counts.cells},
              {"withBoundary", counts.with_boundary},
              {"ends", counts.ends},
              {"junctions", counts.joints}}}};
}

void print_info(const fetex::SilmapTexture& t) {
    const Counts counts = count_cells(t);
    fmt::print("silmap        {} x {} texels, {}-bit cells, {}\n", t.width, t.height, cell_bits(t),
               samples_text(t.sample_format));
    fmt::print("  on the GPU  {} bytes: {} in cells, {} in colours{}\n", fetex::silmap_gpu_bytes(t), cell_bytes(t),
               color_bytes(t),
               t.mips.empty() ? "" : fmt::format(", {} in {} mip levels", 4 * t.mips.size(), mip_levels_of(t)));
    fmt::print("  cells       {} of {} with boundaries: {} ends, {} junctions\n", counts.with_boundary, counts.cells,
               counts.ends, counts.joints);
}

} // namespace fetexc::cli
