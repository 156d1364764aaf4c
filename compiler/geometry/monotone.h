// SPDX-License-Identifier: GPL-3.0-or-later
/// Interior extrema of a curve's coordinates: where it has to be split to be monotone.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/geometry/curve.h"

namespace fetexc {

/// Enclosures, ascending and disjoint, of the parameters in (0,1) where x'(t) or y'(t) changes sign. How many there are
/// is decided exactly (integer discriminants), each enclosure by an exact sign change. Extrema of both axes that
/// doubles can't tell apart come as one: exactly so in a cusp; otherwise counted in near_cusps, and the curve is taken
/// to be monotone between the two, where it moves by less than 2^-40 of a planar unit (parameters less than 2^-48
/// apart, |x''| < 2^51).
std::vector<Interval> extrema(const Curve& c, std::uint64_t* near_cusps = nullptr);

/// Sign of a·t² + 2b·t + c, exact. |a|, |2b|, |c| < 2^48, 0 ≤ t ≤ 1.
int quadratic_sign(std::int64_t a, std::int64_t b, std::int64_t c, double t);

} // namespace fetexc
