// SPDX-License-Identifier: GPL-3.0-or-later
/// Whether a configuration and a signature give quadratics that a texture can hold (Parilov and Zorin 2008, §4 and
/// §5.2). Local coordinates of the texel, 0 … 1.
#pragma once

#include <array>
#include <optional>

#include "compiler/feature_curves/snapping.h"

namespace fetexc {

/// Control points of a discontinuity segment.
using SegmentCurve = std::array<fetex::FeaturePoint, 3>;

enum class SignatureFault : std::uint8_t {
    None,
    NoMiddle, ///< the tangents are parallel, or both ends are one point
    Outside,  ///< the middle control point isn't inside the texel, so the curve leaves it or turns back at an end
    SideTest, ///< the parabola comes into the texel once more
};

/// Where the lines through a and b with these angles meet. None: they are parallel.
std::optional<fetex::FeaturePoint> middle_point(fetex::FeaturePoint a, double angle_a, fetex::FeaturePoint b,
                                                double angle_b);

/// The parabola beyond the segment meets the inside of the texel: then its sign doesn't tell the segment's sides.
/// Decided where it is on the texel's border; the paper's test (7) and least angle θmin stand for this and are nearly
/// always right.
bool comes_back(const SegmentCurve& curve);

SignatureFault fault_of(const SegmentCurve& curve);

/// A texel's segment, as the signature has it; without a middle point the middle of its ends.
struct ShownSegment {
    SegmentCurve curve;
    SignatureFault fault = SignatureFault::None;
};
ShownSegment shown_segment(const SnappedCurves& curves, std::uint32_t i, std::uint32_t j, std::uint32_t segment);

/// A straight segment that has both of its angles.
bool is_aligned(const SnappedCurves& curves, std::uint32_t i, std::uint32_t j, std::uint32_t segment);

/// One of the texel's curved segments has a fault.
bool has_fault(const SnappedCurves& curves, std::uint32_t i, std::uint32_t j);

} // namespace fetexc
