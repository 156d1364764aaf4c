// SPDX-License-Identifier: GPL-3.0-or-later
/// `fetexc compile --image`: from an image and its features to what the compiler takes (FBT §4.1).
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/load_scene.h"
#include "compiler/compile.h"
#include "compiler/raster/trace.h"

namespace fetexc::cli {

inline constexpr std::uint64_t kMaxImageBytes = std::uint64_t{1} << 30; ///< of an image's file

/// What an image's numbers are.
struct ImageValues {
    bool bright = false; ///< colours above 1 stay as they are, for samples in halves
    bool data = false;   ///< no colours: never encoded
};

struct ImageOptions {
    std::string image;    ///< empty: no image
    std::string features; ///< an SVG; empty: none
    bool trace = false;
    TraceOptions tracing;
    double invalidate = 1; ///< pixels
    ImageValues values;
};

struct LoadedImage {
    FeaturedImage picture;
    FeatureCurves features;    ///< the same as curves, in pixels of the image
    std::string source_hash;   ///< of the image, as LoadedScene's
    std::string features_hash; ///< of the features' drawing; empty: none
};

/// Errors 1001 … 1012 of the drawing, 1101 … 1104, 3002, 3004, 8001 … 8003. Diagnostics are appended on success and on
/// error.
Result<LoadedImage> load_image(const ImageOptions& options, const SceneOptions& scene, unsigned threads,
                               std::vector<Diagnostic>& diagnostics);

/// An image of any kind that OpenImageIO reads. values.bright: colours up to 65504, encoded, else up to 1. Errors 1101
/// … 1103, 8053.
Result<RasterImage> read_image(const std::string& path, ImageValues values, std::vector<Diagnostic>& diagnostics);

/// --image, --data, --features, --trace, --trace-contrast, --trace-speck, --invalidate. Returns --image.
CLI::Option* add_image_options(CLI::App& app, ImageOptions& options);

} // namespace fetexc::cli
