// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/load_scene.h"

#include <algorithm>

#include <fmt/format.h>
#include <xxhash.h>

#include "cli/io.h"
#include "compiler/svg/svg.h"

namespace fetexc::cli {
namespace {

constexpr std::uint32_t kMinRaster = 16, kMaxRaster = 16384; // the limits of SvgOptions::raster_pixels

std::string hash_of(const std::vector<std::uint8_t>& bytes) {
    const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

} // namespace

std::uint32_t raster_size_for(std::uint32_t texels) { return std::clamp(2 * texels, kMinRaster, kMaxRaster); }

Result<LoadedScene> load_scene(const std::string& path, const SceneOptions& options, std::uint32_t texels,
                               unsigned threads, std::vector<Diagnostic>& diagnostics) {
    SvgOptions svg;
    svg.font_files.assign(options.fonts.begin(), options.fonts.end());
    svg.system_fonts = options.system_fonts;
    svg.resources_dir = options.resources;
    svg.raster_pixels = options.raster_size != 0 ? options.raster_size : raster_size_for(texels);
    svg.cull = options.cull;
    svg.threads = threads;
    const auto bytes = read_input(path, svg.limits.bytes);
    if (!bytes) return bytes.error();
    auto scene = load_svg(bytes.value(), svg, diagnostics);
    if (!scene) return scene.error();
    return LoadedScene{std::move(scene).value(), hash_of(bytes.value())};
}

} // namespace fetexc::cli
