// SPDX-License-Identifier: GPL-3.0-or-later
/// `fetexc compile --repr curves`: from a drawing or a network to a texture with feature curves.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/load_scene.h"
#include "cli/options.h"
#include "compiler/feature_curves/feature_curves_builder.h"

namespace fetexc::cli {

struct CurvesCommandOptions {
    std::string curves = "all"; ///< of a drawing: strokes, edges, all
    std::string kind = "normal", numbers = "16";
    bool linear = false;
    double limit = 0; ///< texels; 0: by the profile
    std::uint32_t smooth = kGradientIterations;
    double max_move = 0;      ///< user units, of sizes that are chosen; 0: none
    std::string profile;      ///< empty: as the network says; else a preset's name, or a file
    double profile_width = 0; ///< user units, of a preset; 0: kPresetWidth
    std::string base, base_color = "#ffffff", normal_y = "up";
    double base_height = 0; ///< user units, of a base of heights; 0: it isn't one
};

/// What is to be made of a network.
struct CurvesRequest {
    CurvesCommandOptions how;
    SizeValue size;
    std::uint64_t max_bytes = 0; ///< 0: size counts
    std::string samples = "8";   ///< as --samples takes it
    bool mips = false;
    unsigned threads = 0;
};

/// The first character that isn't space is a brace.
bool is_network(std::span<const std::uint8_t> bytes);

/// A network's own curves, or a drawing's; of neither any is warning 2062. Errors: those of read_network and
/// load_svg_features. Diagnostics are appended on success and on error.
Result<Network> network_of_bytes(const std::vector<std::uint8_t>& bytes, const std::string& curves,
                                 const SceneOptions& scene, unsigned threads, std::vector<Diagnostic>& diagnostics);

/// One of the network's, a preset, or a file's, whose name `file` becomes; none: as the network says. Errors: those of
/// read_input and read_profile.
Result<std::optional<FeatureProfile>> wanted_profile(const Network& network, const CurvesCommandOptions& how,
                                                     std::string& file);

struct LoadedBase {
    RasterImage image;
    std::string hash; ///< as LoadedScene's
};
/// Precondition: there is a base, and check_curves_base agrees. bright: colours above 1 stay. Errors: those of
/// read_input and read_image.
Result<LoadedBase> load_base(const CurvesCommandOptions& how, bool bright, std::vector<Diagnostic>& diagnostics);

/// Usage errors of --kind, --base and --base-height together.
Status check_curves_base(const CurvesCommandOptions& how);

fetex::FeatureKind curves_kind(const std::string& name);
/// image: null: none; it must outlive what is made of it.
BaseImage base_image(const CurvesCommandOptions& how, const RasterImage* image);
/// Of --base-color.
Rgba straight_color(const std::string& text);

struct CompiledCurves {
    FeatureCurvesBuild build;
    std::string base_hash;    ///< of the base image; empty: none
    std::string profile_file; ///< that the profile was read from; empty: none
};

/// Errors: those of compile_feature_curves, compile_feature_curves_within,
/// compile_feature_curves_at_chosen_size, read_profile and read_image.
Result<CompiledCurves> compile_curves(const Network& network, const CurvesRequest& request,
                                      const ProgressSink& progress, std::vector<Diagnostic>& diagnostics);

/// For the file's metadata.
std::string options_text(const CurvesRequest& request, const FeatureCurvesBuild& build);

const char* kind_name(fetex::FeatureKind kind);
const char* numbers_name(fetex::FeatureNumberFormat format);

/// What is shown of curves: --curves, --kind, --profile, --profile-width, --base, --base-color, --base-height,
/// --normal-y.
std::vector<CLI::Option*> add_shown_options(CLI::App& app, CurvesCommandOptions& options);
/// These, and how it is stored: --numbers, --linear, --limit, --smooth, --max-move.
std::vector<CLI::Option*> add_curves_options(CLI::App& app, CurvesCommandOptions& options);

} // namespace fetexc::cli
