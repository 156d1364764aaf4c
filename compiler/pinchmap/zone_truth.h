// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "compiler/bilevel/silhouette.h"
#include "compiler/pinchmap/zone_mask.h"

namespace fetexc {

/// Exact parts of clusters, and distances of corners from the outline up to kFarFromOutline, of width × height clusters
/// spread over the canvas.
ZoneTruth zone_truth(const Silhouette& silhouette, std::uint32_t width, std::uint32_t height);

/// Clusters.
inline constexpr double kFarFromOutline = 2;

} // namespace fetexc
