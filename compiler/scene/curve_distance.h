// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "compiler/scene/scene_builder.h"

namespace fetexc {

struct CurveDistance {
    double distance = 0, t = 0; ///< t: parameter of the nearest point
};

/// Distance from a point to a Bezier segment, in the frame of the control points, if it is below `best`; else `best`
/// as it is. Every local minimum is isolated: the derivative of the squared distance is a polynomial of degree 2n−1
/// whose Bernstein coefficients tell how many sign changes are left; parts with more than one are halved. Accurate to
/// budget::kDistanceAccuracy for coordinates up to 2^28.
[[nodiscard]] CurveDistance nearest_below(const CanvasSegment& s, double x, double y, CurveDistance best);
[[nodiscard]] double distance_below(const CanvasSegment& s, double x, double y, double best);

} // namespace fetexc
