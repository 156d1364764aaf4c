// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/load_scene.h"

#include <algorithm>

#include <fmt/format.h>
#include <xxhash.h>

#include "cli/io.h"
#include "cli/options.h"
#include "compiler/svg/svg.h"

namespace fetexc::cli {
namespace {

constexpr std::uint32_t kMinRaster = 16, kMaxRaster = 16384; // the limits of SvgOptions::raster_pixels

} // namespace

std::string hash_of(const std::vector<std::uint8_t>& bytes) {
    const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::uint32_t raster_size_for(std::uint32_t texels) { return std::clamp(2 * texels, kMinRaster, kMaxRaster); }

SvgOptions svg_options(const SceneOptions& options, std::uint32_t texels, unsigned threads) {
    SvgOptions svg;
    svg.font_files.assign(options.fonts.begin(), options.fonts.end());
    svg.system_fonts = options.system_fonts;
    svg.resources_dir = options.resources;
    svg.raster_pixels = options.raster_size != 0 ? options.raster_size : raster_size_for(texels);
    svg.cull = options.cull;
    svg.threads = threads;
    return svg;
}

Result<LoadedScene> scene_of_bytes(const std::vector<std::uint8_t>& bytes, const SceneOptions& options,
                                   std::uint32_t texels, unsigned threads, std::vector<Diagnostic>& diagnostics) {
    auto scene = load_svg(bytes, svg_options(options, texels, threads), diagnostics);
    if (!scene) return scene.error();
    return LoadedScene{std::move(scene).value(), hash_of(bytes)};
}

Result<LoadedScene> load_scene(const std::string& path, const SceneOptions& options, std::uint32_t texels,
                               unsigned threads, std::vector<Diagnostic>& diagnostics) {
    const auto bytes = read_input(path, SvgLimits{}.bytes);
    if (!bytes) return bytes.error();
    return scene_of_bytes(bytes.value(), options, texels, threads, diagnostics);
}

void add_scene_options(CLI::App& app, SceneOptions& scene) {
    app.add_option("--font", scene.fonts, "Font file for text; may be given several times")
        ->type_name("FILE")
        ->take_all();
    app.add_flag("--system-fonts", scene.system_fonts,
                 "Also use the fonts installed here (the bytes then depend on this machine)");
    app.add_option(
           "--resources", scene.resources,
           "Folder from which bitmaps named by a drawing may be read; default: none is (--depfile doesn't list them)")
        ->type_name("DIR");
    app.add_option(
           "--raster-size", scene.raster_size,
           "Pixels on the longer side for what can't be vector (filters, patterns, bitmaps); default: two a texel")
        ->check(CLI::Range(16u, kMaxSide))
        ->type_name("N");
}

} // namespace fetexc::cli
