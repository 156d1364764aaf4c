// SPDX-License-Identifier: GPL-3.0-or-later
/// From a file on disk to a Scene, whatever front end it takes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compiler/result.h"
#include "compiler/scene/scene.h"

namespace fetexc::cli {

struct SceneOptions {
    std::vector<std::string> fonts; ///< font files for text
    bool system_fonts = false;
    std::uint32_t raster_size =
        0; ///< pixels on the longer side for what can't be vector; 0: chosen from the texture's size
};

struct LoadedScene {
    Scene scene;
    std::vector<Diagnostic> diagnostics;
    std::string source_hash; ///< XXH3-128 of the input's bytes, 32 hex digits
};

/// path "-": stdin. texels: longer side of the texture to come.
Result<LoadedScene> load_scene(const std::string& path, const SceneOptions& options, std::uint32_t texels);

} // namespace fetexc::cli
