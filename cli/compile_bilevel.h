// SPDX-License-Identifier: GPL-3.0-or-later
/// `fetexc compile --repr bilevel`: from a drawing or a bitmap to a bi-level texture.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/options.h"
#include "compiler/bilevel/bilevel_builder.h"

namespace fetexc::cli {

struct BilevelCommandOptions {
    std::string silhouette = "two-colors"; ///< as silhouette_rule takes it
    std::string channels = "auto";         ///< or "1", "2", "3"
    bool no_mid_greys = false;
    std::string above_image; ///< shown instead of the colour above; empty: none
};

/// Of a texture without a size or bytes given.
inline constexpr std::uint32_t kDefaultBilevelTexels = 128;

/// What is to be made of a silhouette.
struct BilevelRequest {
    BilevelCommandOptions how;
    SizeValue size{0, 0, kDefaultBilevelTexels};
    std::uint64_t max_bytes = 0; ///< 0: size counts
    bool mips = false;
    unsigned threads = 0;
};

/// "two-colors", "alpha", "luminance" or "id:NAME"; empty if it is none.
std::optional<SilhouetteRule> silhouette_rule(const std::string& text);

/// The texture with its image, ready for a file. Bytes are those of level 0, the mip levels and the image. Errors:
/// those of compile_bilevel_within and, for the image, of read_image and read_input. Diagnostics are appended.
struct CompiledBilevel {
    BilevelBuild build;
    std::string options;    ///< for the file's metadata
    std::string image_hash; ///< of --above-image; empty: none
};
Result<CompiledBilevel> compile_silhouette(const Silhouette& silhouette, const BilevelRequest& request,
                                           const ProgressSink& progress, std::vector<Diagnostic>& diagnostics);

/// "single", "min", "max", "median".
const char* rule_name(fetex::BilevelRule rule);

/// --channels, --no-mid-greys, --above-image; --silhouette, which pinchmaps have as well.
struct BilevelCliOptions {
    std::vector<CLI::Option*> own;
    CLI::Option* silhouette = nullptr;
};
BilevelCliOptions add_bilevel_options(CLI::App& app, BilevelCommandOptions& options);

} // namespace fetexc::cli
