// SPDX-License-Identifier: GPL-3.0-or-later
/// How far the texture's curves are from the input's, by walking along these once more.
#pragma once

#include <vector>

#include "compiler/feature_curves/displacement.h"
#include "compiler/planar/grid.h"

namespace fetexc {

struct CurveMoveSource {
    const LatticeCurves& curves;
    const Grid& grid;
    const EdgePoints& points;
    const std::vector<ShownKnot>& knots;
};

/// For each texel a bound of how far a point of the input's curves in it is from what the texture shows there; none
/// where that is no more than rounding.
std::vector<FeatureMove> measure_curve_moves(const CurveMoveSource& source, const SnappedCurves& snapped);

} // namespace fetexc
