// SPDX-License-Identifier: GPL-3.0-or-later
/// `fetexc compile --repr silmap`: from a drawing, or an image with features, to a silhouette-map texture.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/options.h"
#include "compiler/silmap/silmap_builder.h"

namespace fetexc::cli {

struct SilmapCommandOptions {
    std::uint32_t cell_bits = 8; ///< or 16
    double max_wrong_ppm = 0;    ///< with --size auto; 0: the builder's own
    std::string effort = "auto"; ///< or "quick", "thorough"
};

/// What is to be made of a drawing or an image.
struct SilmapRequest {
    SilmapCommandOptions how;
    GridSize size; ///< unless the size is chosen
    bool automatic = false;
    std::uint64_t max_bytes = 0; ///< 0: size counts
    std::string samples = "8";   ///< as --samples takes it
    bool mips = false;
    unsigned threads = 0;
    SkipRules skip = {};
};

/// Errors: those of compile_silmap and compile_silmap_at_chosen_size.
Result<SilmapBuild> compile_silhouette_map(const Scene& scene, const SilmapRequest& request,
                                           const ProgressSink& progress);
Result<SilmapBuild> compile_silhouette_map(const FeaturedImage& picture, const SilmapRequest& request,
                                           const ProgressSink& progress);

/// For the file's metadata.
std::string options_text(const SilmapRequest& request);

/// 8 or 16.
std::uint32_t cell_bits(const fetex::SilmapTexture& texture);
/// As `compile --samples` names it: 8, 16, float, rgb8.
fetex::SilmapSampleFormat silmap_sample_format(const std::string& name);
const char* silmap_samples_name(fetex::SilmapSampleFormat format);

/// --cell-bits, --effort; --max-wrong, which pinchmaps have as well.
struct SilmapCliOptions {
    std::vector<CLI::Option*> own;
    CLI::Option* max_wrong = nullptr;
};
SilmapCliOptions add_silmap_options(CLI::App& app, SilmapCommandOptions& options);

} // namespace fetexc::cli
