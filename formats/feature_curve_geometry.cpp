// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "formats/feature_curve_geometry.h"

#include <cmath>

namespace fetex {

std::optional<FeaturePoint> feature_middle_point(const FeatureCrossing& first, const FeaturePoint& b0,
                                                 const FeatureCrossing& second, const FeaturePoint& b2) {
    const FeaturePoint t0{std::cos(first.angle), std::sin(first.angle)},
        t2{std::cos(second.angle), std::sin(second.angle)};
    const double turn = t0.x * t2.y - t0.y * t2.x;
    if (std::abs(turn) < kFeatureLeastTurn) return std::nullopt;
    const double along = ((b2.x - b0.x) * t2.y - (b2.y - b0.y) * t2.x) / turn;
    const FeaturePoint b1{b0.x + along * t0.x, b0.y + along * t0.y};
    const bool inside = b1.x >= 0 && b1.x <= 1 && b1.y >= 0 && b1.y <= 1;
    return inside ? std::optional(b1) : std::nullopt;
}

std::optional<FeatureQuadratic> feature_curve(const FeatureSignature& signature, FeatureSegment segment,
                                              bool straight) {
    const FeatureCrossing &first = signature[feature_edge_index(segment.first)],
                          &second = signature[feature_edge_index(segment.second)];
    const FeaturePoint b0 = feature_point(segment.first, first.position),
                       b2 = feature_point(segment.second, second.position);
    if (straight) return FeatureQuadratic{b0, {(b0.x + b2.x) / 2, (b0.y + b2.y) / 2}, b2, true};
    const auto b1 = feature_middle_point(first, b0, second, b2);
    return b1 ? std::optional(FeatureQuadratic{b0, *b1, b2, false}) : std::nullopt;
}

FeatureQuadratic feature_segment_curve(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j,
                                       std::uint32_t segment) {
    const FeatureSegmentList list = feature_unpack(t.configurations[std::size_t{j} * t.width + i]);
    const FeatureSignature signature = feature_signature(t, i, j);
    const FeatureSegment which = list.segment[segment];
    const auto curve = feature_curve(signature, which, t.linear || list.straight[segment]);
    return curve ? *curve : *feature_curve(signature, which, true);
}

FeaturePoint feature_curve_at(const FeatureQuadratic& q, double u) {
    const double a = (1 - u) * (1 - u), b = 2 * u * (1 - u), c = u * u;
    return {a * q.b0.x + b * q.b1.x + c * q.b2.x, a * q.b0.y + b * q.b1.y + c * q.b2.y};
}

FeaturePoint feature_curve_derivative(const FeatureQuadratic& q, double u) {
    const double a = 2 * (1 - u), b = 2 * u;
    return {a * (q.b1.x - q.b0.x) + b * (q.b2.x - q.b1.x), a * (q.b1.y - q.b0.y) + b * (q.b2.y - q.b1.y)};
}

} // namespace fetex
