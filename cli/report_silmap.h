// SPDX-License-Identifier: GPL-3.0-or-later
/// What reports say of a silhouette-map texture.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "compiler/silmap/silmap_builder.h"

namespace fetexc::cli {

/// Without what a report doesn't tell: cells, colours.
struct SilmapOutcome {
    std::uint32_t width = 0, height = 0; ///< texels
    std::uint32_t cell_bits = 8;
    fetex::SilmapSampleFormat samples = fetex::SilmapSampleFormat::Rgba8;
    std::uint32_t mip_levels = 0; ///< 0: none
    SilmapStats stats;
    PlanarStats planar;
};
SilmapOutcome silmap_outcome(const SilmapBuild& build);

/// For people; several lines.
std::string silmap_text(const SilmapOutcome& outcome);
/// As cli/schema/compile_report.schema.json has it.
nlohmann::ordered_json silmap_json(const SilmapOutcome& outcome);

} // namespace fetexc::cli
