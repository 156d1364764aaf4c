// SPDX-License-Identifier: GPL-3.0-or-later
/// How far a texture's feature curves are from the network's (curve_errors.h has the definitions).
#pragma once

#include <vector>

#include "compiler/measure/curve_truth.h"
#include "compiler/measure/errors.h"

namespace fetexc::measure {

/// The texture's segments as samplers see them, over the truth's canvas; by rows of texels. Precondition: validated.
std::vector<VisibleEdge> curves_of(const fetex::FeatureCurvesTexture& texture, double height);

struct CurveDistances {
    Distances to_picture, to_truth;
};
/// step: about the distance of sample points; reach: both width units.
CurveDistances curve_distances(const CurveTruth& truth, std::span<const VisibleEdge> shown, double step, double reach,
                               unsigned threads);

} // namespace fetexc::measure
