// SPDX-License-Identifier: GPL-3.0-or-later
/// From angles that are means of what crosses an edge to valid signatures (Parilov and Zorin 2008, §4, Eq. 2-3).
#pragma once

#include "compiler/feature_curves/snapping.h"

namespace fetexc {

/// Moves points and angles where a curved segment isn't valid, one local problem after the other, and makes straight
/// what stays invalid: afterwards every curved segment is valid, and has at both of its ends the tangent of the curved
/// segments that go on there. Sets kinds of texels and the statistics. Straight segments stay as they are; where one
/// goes on in a curve, the curve takes its direction. The same result for any number of threads (0: all).
void fit_signatures(SnappedCurves& curves, unsigned threads);

} // namespace fetexc
