// SPDX-License-Identifier: GPL-3.0-or-later
/// What reports say of a pinchmap.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "compiler/pinchmap/pinchmap_builder.h"

namespace fetexc::cli {

/// Without what a report doesn't tell: map, signal.
struct PinchmapOutcome {
    std::uint32_t width = 0, height = 0, scale = 0; ///< clusters; K
    std::uint32_t map_bits = 8;
    fetex::PinchmapSampleFormat samples = fetex::PinchmapSampleFormat::Rgba8;
    std::uint32_t mip_levels = 0; ///< of the signal; 0: none
    PinchmapStats stats;
};
PinchmapOutcome pinchmap_outcome(const PinchmapBuild& build);

/// For people; several lines.
std::string pinchmap_text(const PinchmapOutcome& outcome);
/// As cli/schema/compile_report.schema.json has it.
nlohmann::ordered_json pinchmap_json(const PinchmapOutcome& outcome);

} // namespace fetexc::cli
