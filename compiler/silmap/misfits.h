// SPDX-License-Identifier: GPL-3.0-or-later
/// What a silhouette map can't hold, counted and named.
#pragma once

#include "compiler/silmap/lost_parts.h"
#include "compiler/silmap/silmap_builder.h"

namespace fetexc {

/// The drawing has more in the cell than one point and its links: on a side other edges than the link across it, or
/// several corners.
bool holds_too_much(const SilmapCellData& c);

/// Counts, with W5121 and W5122.
void report_misfits(const SilmapCells& cells, const LostParts& lost, SilmapStats& stats,
                    std::vector<Diagnostic>& diagnostics);

} // namespace fetexc
