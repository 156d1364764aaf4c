// SPDX-License-Identifier: GPL-3.0-or-later
/// What reports say of a texture with feature curves.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "compiler/feature_curves/feature_curves_builder.h"

namespace fetexc::cli {

/// Without what a report doesn't tell: arrays, moves.
struct CurvesOutcome {
    std::uint32_t width = 0, height = 0; ///< texels
    fetex::FeatureKind kind = fetex::FeatureKind::Normal;
    fetex::FeatureNumberFormat numbers = fetex::FeatureNumberFormat::Bits16;
    fetex::FeatureSampleFormat samples = fetex::FeatureSampleFormat::Rgba8;
    bool linear = false, base_map = false;
    std::uint32_t mip_levels = 0; ///< 0: none
    double limit = 0;             ///< texels
    std::vector<FeatureProfile> profiles;
    FeatureCurvesStats stats;
    std::string profile_file = {}; ///< for dependencies; empty: none
};
CurvesOutcome curves_outcome(const FeatureCurvesBuild& build);

/// For people; several lines.
std::string curves_text(const CurvesOutcome& outcome);
/// As cli/schema/compile_report.schema.json has it.
nlohmann::ordered_json curves_json(const CurvesOutcome& outcome);

} // namespace fetexc::cli
