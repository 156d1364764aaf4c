// SPDX-License-Identifier: GPL-3.0-or-later
/// From a file on disk to a Scene, whatever front end it takes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "compiler/result.h"
#include "compiler/scene/scene.h"
#include "compiler/svg/svg.h"

namespace fetexc::cli {

struct SceneOptions {
    std::vector<std::string> fonts; ///< font files for text
    bool system_fonts = false;
    std::string resources;         ///< folder from which bitmaps named by the drawing are read; empty: none
    std::uint32_t raster_size = 0; ///< pixels on the longer side for what can't be vector; 0: raster_size_for(texels)
    bool cull = true;              ///< SkipRules::layers
};

struct LoadedScene {
    Scene scene;
    std::string source_hash; ///< XXH3-128 of the input's bytes, 32 hex digits, as `xxh128sum` prints it
};

/// Two pixels a texel: what a region's samples can show, without aliasing worth seeing.
std::uint32_t raster_size_for(std::uint32_t texels);

/// As LoadedScene::source_hash.
std::string hash_of(const std::vector<std::uint8_t>& bytes);

/// texels: longer side of the texture to come.
SvgOptions svg_options(const SceneOptions& options, std::uint32_t texels, unsigned threads);

/// path "-": stdin. texels: longer side of the texture to come. threads: 0 for all; never changes the scene.
/// Diagnostics are appended on success and on error.
Result<LoadedScene> load_scene(const std::string& path, const SceneOptions& options, std::uint32_t texels,
                               unsigned threads, std::vector<Diagnostic>& diagnostics);
/// The same for bytes already read.
Result<LoadedScene> scene_of_bytes(const std::vector<std::uint8_t>& bytes, const SceneOptions& options,
                                   std::uint32_t texels, unsigned threads, std::vector<Diagnostic>& diagnostics);

/// --font, --system-fonts, --resources, --raster-size.
void add_scene_options(CLI::App& app, SceneOptions& scene);

} // namespace fetexc::cli
