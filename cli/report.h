// SPDX-License-Identifier: GPL-3.0-or-later
/// The compile report: what was made, and what was skipped on the way (DESIGN §8).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/report_curves.h"
#include "cli/report_pinchmap.h"
#include "cli/report_silmap.h"
#include "compiler/bilevel/bilevel_builder.h"
#include "compiler/compile.h"

namespace fetexc::cli {

/// The bi-level texture among what was made.
struct BilevelOutcome {
    std::uint32_t width = 0, height = 0; ///< texels
    fetex::BilevelRule rule = fetex::BilevelRule::Single;
    std::uint32_t mip_levels = 0;                    ///< 0: none
    std::uint64_t gpu_bytes = 0;                     ///< level 0, mip levels, image
    std::uint32_t image_width = 0, image_height = 0; ///< pixels; 0: one colour above
    BilevelStats stats;
};

/// One input compiled.
struct CompileOutcome {
    std::string input, output;
    bool has_fbt = true;
    std::uint32_t width = 0, height = 0; ///< texels, of the FBT
    std::uint64_t file_bytes = 0;
    std::uint64_t gpu_bytes = 0; ///< of the FBT
    fetex::FbtSampleFormat samples = fetex::FbtSampleFormat::Rgba8;
    fetex::FbtTraits traits;
    std::optional<BilevelOutcome> bilevel = {};
    std::optional<SilmapOutcome> silmap = {};
    std::optional<PinchmapOutcome> pinchmap = {};
    std::optional<CurvesOutcome> curves = {};
    CompileReport report;    ///< without an FBT: what the front end did, the image's size, the diagnostics
    double milliseconds = 0; ///< wall clock, front end and compiler; the only figure here that differs between runs
};

/// As `compile --samples` names it: 8, 16, float.
const char* sample_format_name(fetex::FbtSampleFormat format);

/// Parts of the sampler that this asset's shader does without, e.g. "cubics", "bands".
std::vector<std::string> shader_parts_left_out(const fetex::FbtTraits& traits);

/// For people; several lines, no diagnostics (those go to stderr as they come).
std::string report_text(const CompileOutcome& outcome);

/// One document for all inputs: cli/schema/compile_report.schema.json.
std::string report_json(const std::vector<CompileOutcome>& outcomes);

} // namespace fetexc::cli
