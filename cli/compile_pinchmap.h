// SPDX-License-Identifier: GPL-3.0-or-later
/// `fetexc compile --repr pinchmap`: from a drawing or an image to a pinchmap and its signal.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/options.h"
#include "compiler/pinchmap/pinchmap_builder.h"

namespace fetexc::cli {

struct PinchmapCommandOptions {
    std::uint32_t map_bits = 8;     ///< or 16
    std::uint32_t signal_scale = 0; ///< K: 2^K samples of the signal along a cluster
    double line_width = 0;          ///< clusters, 0 … 1; 0: no line
    std::string line_color = "#000000";
};

/// What is to be made of a drawing or an image.
struct PinchmapRequest {
    PinchmapCommandOptions how;
    std::string silhouette; ///< as silhouette_rule takes it; empty: whatever two zones can hold
    GridSize size;          ///< unless the size is chosen
    bool automatic = false;
    double max_wrong_ppm = 0;
    std::uint64_t max_bytes = 0; ///< 0: size counts
    std::string samples = "8";   ///< as --samples takes it
    bool mips = false;
    unsigned threads = 0;
};

/// Errors: those of compile_pinchmap and compile_pinchmap_at_chosen_size.
Result<PinchmapBuild> compile_pinched(const Scene& scene, const PinchmapRequest& request, const ProgressSink& progress);
Result<PinchmapBuild> compile_pinched(const PinchedImage& image, const PinchmapRequest& request,
                                      const ProgressSink& progress);

/// For the file's metadata.
std::string options_text(const PinchmapRequest& request);

/// Of the map, a channel: 8 or 16.
std::uint32_t map_bits(const fetex::PinchmapTexture& texture);

/// --map-bits, --signal-scale, --line-width, --line-color.
std::vector<CLI::Option*> add_pinchmap_options(CLI::App& app, PinchmapCommandOptions& options);

} // namespace fetexc::cli
