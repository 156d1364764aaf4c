// SPDX-License-Identifier: GPL-3.0-or-later
/// What a comparison found, and whether it is within the thresholds given.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/measure/curve_errors.h"
#include "compiler/measure/differences.h"
#include "compiler/measure/errors.h"

namespace fetexc::cli {

/// Thresholds of `compare`; those not given are empty.
struct Thresholds {
    std::optional<double> misclassified = {}; ///< ppm
    std::optional<double> distance = {};      ///< texels, Hausdorff, either way
    std::optional<double> psnr = {};          ///< dB
    std::optional<double> color = {};         ///< 1/255
    std::optional<double> islands = {};       ///< lost and false ones together
};

struct ThresholdCheck {
    const char* option = "";
    const char* what = "";
    const char* unit = "";
    double limit = 0, worst = 0;
    GridSize pixels; ///< where the worst was
    bool passed = true;
};

/// With a scene `errors` has an entry for each output size, with a network `curve_errors`, else `differences` has.
struct CompareOutcome {
    std::string truth, other;           ///< paths
    std::string truth_kind, other_kind; ///< descriptions
    GridSize texels;                    ///< of the other
    std::uint64_t gpu_bytes = 0;        ///< of the other
    double texel_side = 0;              ///< width units; the unit of edges' and curves' distances in texels
    double height = 0;                  ///< of the canvas, width units; without either 0
    std::vector<measure::SizeErrors> errors;
    std::vector<measure::CurveErrors> curve_errors;
    std::vector<measure::PictureDifference> differences;
    std::vector<ThresholdCheck> checks;
};

/// One check for each threshold given, at the size where it is worst. Distances farther than the reach count as
/// infinite, so the threshold must not be beyond it.
std::vector<ThresholdCheck> check(const CompareOutcome& outcome, const Thresholds& thresholds);

bool all_passed(const CompareOutcome& outcome);

/// "misclassified area 812 ppm at 512 x 512 is beyond --max-misclassified 100"
std::string describe(const ThresholdCheck& check);

/// For people: a table with a column for each output size.
std::string compare_text(const CompareOutcome& outcome);
/// cli/schema/compare.schema.json.
std::string compare_json(const CompareOutcome& outcome);

} // namespace fetexc::cli
