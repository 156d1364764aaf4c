// SPDX-License-Identifier: GPL-3.0-or-later
/// Interior extrema of a curve's coordinates: where it has to be split to be monotone.
#pragma once

#include <vector>

#include "compiler/geometry/curve.h"

namespace fetexc {

/// Enclosures, ascending and disjoint, of the parameters in (0,1) where x'(t) or y'(t) changes sign. How many there are
/// is decided exactly (integer discriminants), each enclosure by an exact sign change. Extrema of both axes that
/// doubles can't tell apart (a cusp) come as one.
std::vector<Interval> extrema(const Curve& c);

} // namespace fetexc
