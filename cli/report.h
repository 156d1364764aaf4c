// SPDX-License-Identifier: GPL-3.0-or-later
/// The compile report: what was made, and what was skipped on the way (DESIGN §8).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compiler/compile.h"

namespace fetexc::cli {

/// One input compiled.
struct CompileOutcome {
    std::string input, output;
    std::uint32_t width = 0, height = 0; ///< texels
    std::uint64_t file_bytes = 0, gpu_bytes = 0;
    fetex::FbtSampleFormat samples = fetex::FbtSampleFormat::Rgba8;
    fetex::FbtTraits traits;
    CompileReport report;
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
