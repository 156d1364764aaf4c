// SPDX-License-Identifier: GPL-3.0-or-later
/// What `compare` holds OTHER against: a drawing, what a network of curves should show, or a picture.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cli/compare_input.h"
#include "cli/compile_curves.h"
#include "cli/lighting.h"
#include "cli/load_scene.h"
#include "compiler/measure/curve_truth.h"
#include "compiler/measure/truth.h"

namespace fetexc::cli {

struct TruthOptions {
    SceneOptions scene;
    CurvesCommandOptions curves;
    bool curves_given = false;           ///< --curves: an SVG is a network
    bool kind_given = false;             ///< --kind
    std::string curve_option;            ///< an option given that says something of curves; empty: none
    std::optional<LightDirection> light; ///< of normals
    bool nearest = false;
    unsigned threads = 0;
    bool quiet = false;
};

/// One of scene, curves and picture.
struct TruthFile {
    std::unique_ptr<const LoadedScene> loaded; ///< what `scene` points into
    std::unique_ptr<const measure::Truth> scene;
    std::unique_ptr<const LoadedBase> base; ///< what `curves` points into; null: none
    std::unique_ptr<const measure::CurveTruth> curves;
    ComparedPicture picture;
    std::string description;

    /// width / height.
    [[nodiscard]] double aspect() const;
};

/// What of colours is compared: with a light normals lit, y being down, else nothing (empty).
std::function<Rgba(const Rgba&)> seen_colors(const TruthOptions& options);

/// A network, or an SVG whose curves are to be taken for one.
bool is_curve_truth(const ComparedFile& truth, const ComparedPicture& other, const TruthOptions& options);

/// Says, too, what of a texture with feature curves isn't as the truth has it (W5149). Errors: those of scene_of_bytes,
/// network_of_bytes, compile_curves and picture_of; usage, where options don't go together.
Result<TruthFile> load_truth(const ComparedFile& file, const ComparedPicture& other, const TruthOptions& options);

} // namespace fetexc::cli
