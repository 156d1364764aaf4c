// SPDX-License-Identifier: GPL-3.0-or-later
/// The zones of a drawing of many colours.
#pragma once

#include <cstdint>

#include "compiler/bilevel/silhouette.h"

namespace fetexc {

struct TwoZones {
    Silhouette silhouette;
    std::uint64_t edges = 0;             ///< all visible ones
    std::uint64_t blurred = 0;           ///< of them: between colours in one zone
    double blurred_part = 0;             ///< 0 … 1: their share of all edges, by length times contrast
    double blurred_u = 0, blurred_v = 0; ///< 0 … 1: the middle of the one that shows most
};

/// Parts its visible colours into two zones so that edges lie between them: pairs of neighbours, those with the longest
/// edges of the most contrast first, go into different zones unless pairs before decide otherwise. All edges between
/// zones are the silhouette's. Errors: those of visible_edges.
Result<TwoZones> two_zones_of(const Scene& scene, unsigned threads);

} // namespace fetexc
