// SPDX-License-Identifier: GPL-3.0-or-later
/// `fetexc compile --repr curves`: from a drawing or a network to a texture with feature curves.
#pragma once

#include <cstdint>
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
    std::string profile;      ///< empty: as the network says; else a preset's name, or a file
    double profile_width = 0; ///< user units, of a preset; 0: kPresetWidth
    std::string base, base_color = "#ffffff", normal_y = "up";
    double base_height = 0; ///< user units; 0: the base isn't heights
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

/// A network's own curves, or a drawing's. Errors: those of read_network and load_svg_features. Diagnostics are
/// appended on success and on error.
Result<Network> network_of_bytes(const std::vector<std::uint8_t>& bytes, const std::string& curves,
                                 const SceneOptions& scene, unsigned threads, std::vector<Diagnostic>& diagnostics);

struct CompiledCurves {
    FeatureCurvesBuild build;
    std::string base_hash;    ///< of the base image; empty: none
    std::string profile_file; ///< that the profile was read from; empty: none
};

/// Errors: those of compile_feature_curves, compile_feature_curves_within, read_profile and read_image.
Result<CompiledCurves> compile_curves(const Network& network, const CurvesRequest& request,
                                      const ProgressSink& progress, std::vector<Diagnostic>& diagnostics);

/// For the file's metadata.
std::string options_text(const CurvesRequest& request, const FeatureCurvesBuild& build);

const char* kind_name(fetex::FeatureKind kind);
const char* numbers_name(fetex::FeatureNumberFormat format);

/// --curves, --kind, --numbers, --linear, --limit, --smooth, --profile, --profile-width, --base, --base-color,
/// --base-height, --normal-y.
std::vector<CLI::Option*> add_curves_options(CLI::App& app, CurvesCommandOptions& options);

} // namespace fetexc::cli
