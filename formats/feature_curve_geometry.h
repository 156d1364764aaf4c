// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Discontinuity segments as curves (SPEC.md, section 9). Frame: the texel's, local 0 … 1, x right, y down.
#pragma once

#include <optional>

#include "formats/feature_curves.h"

namespace fetex {

/// A quadratic Bezier curve inside the closed texel. Straight: b1 is the middle of b0 and b2.
struct FeatureQuadratic {
    FeaturePoint b0, b1, b2;
    bool straight = false;
};

/// The tangents at a curve's ends differ by an angle whose sine is at least this, else the segment has to be straight:
/// where the tangents meet is then known to 2^-9 texel from angles that are known to 2^-20, as in float arithmetic.
/// What is straightened for that reason moves by 2^-12 texel at most.
inline constexpr double kFeatureLeastTurn = 0x1p-10;

/// Where the lines through the ends, at these angles, meet, if that is in the closed texel and they differ by
/// kFeatureLeastTurn. Angles from x towards y.
std::optional<FeaturePoint> feature_middle_point(const FeatureCrossing& first, const FeaturePoint& b0,
                                                 const FeatureCrossing& second, const FeaturePoint& b2);

/// What a signature says about a segment: nullopt if it isn't straight and has no middle point.
std::optional<FeatureQuadratic> feature_curve(const FeatureSignature& signature, FeatureSegment segment, bool straight);

/// Segment 0 or 1 of texel (i,j), from its first edge to its second. Precondition: the texel has it, and
/// validate_feature_curves found nothing.
FeatureQuadratic feature_segment_curve(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j,
                                       std::uint32_t segment);

/// The curve at u, 0 … 1, and its derivative (0 where b1 is an end).
FeaturePoint feature_curve_at(const FeatureQuadratic& q, double u);
FeaturePoint feature_curve_derivative(const FeatureQuadratic& q, double u);

} // namespace fetex
