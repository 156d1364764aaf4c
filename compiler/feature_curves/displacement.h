// SPDX-License-Identifier: GPL-3.0-or-later
/// What snapping moved, and how far. A bound for each texel: how far its edges' points and its vertices are from the
/// segments inserted for them, and these from the segments that the table left.
#pragma once

#include <vector>

#include "compiler/feature_curves/edge_points.h"
#include "compiler/feature_curves/knots.h"
#include "compiler/feature_curves/snapping.h"

namespace fetexc {

struct ShownKnot {
    Knot knot;
    KnotShape shape;
    std::vector<fetex::FeatureEdge> ends; ///< ends_of both
};

/// kEndCut, kFolded, kLostInside, or 0: a segment shows the knot.
std::uint8_t missing_kind(const ShownKnot& k);

/// `curves` without its moves; on `threads` threads (0: all), with the same result for any number.
std::vector<FeatureMove> measure_moves(const SnappedCurves& curves, const EdgePoints& points,
                                       const std::vector<ShownKnot>& knots, unsigned threads);

} // namespace fetexc
