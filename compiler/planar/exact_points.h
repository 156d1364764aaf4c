// SPDX-License-Identifier: GPL-3.0-or-later
/// Exact questions about vertices, for what their enclosures leave open. Each is first answered by intervals (inline
/// comparisons of the caller), then by coordinates of 72 binary places, then by algebra; CGAL's kernel decides what 384
/// bits leave open.
#pragma once

#include "compiler/geometry/polynomial.h"
#include "compiler/geometry/precise.h"
#include "compiler/planar/algebraic_coordinate.h"
#include "compiler/planar/arcs.h"

namespace fetexc {

/// Coordinates rounded to 2^-kFixedBits, from what defines the vertex; none where that is too badly conditioned.
std::optional<FixedPoint> fixed_point(const ArcSet& set, const Vertex& v);

/// For exact comparisons.
AlgebraicCoordinate algebraic_coordinate(const ArcSet& set, const Vertex& v, Axis axis);

/// Sign of a − b in one coordinate, exact. None: degenerate beyond what can be decided.
std::optional<int> compare_coordinates(const ArcSet& set, const Vertex& a, const Vertex& b, Axis axis);

/// Sign of a difference of coordinates rounded to 2^-kFixedBits; 0 when the roundings may have made it.
int certain_sign(Fixed difference);

/// Sign of the vertex's coordinate minus v, exact. None: degenerate beyond what can be decided.
std::optional<int> side_of_level(const ArcSet& set, const Vertex& a, Axis axis, std::int64_t v);

/// The same for the point at parameter t where the curve's coordinate along `axis` is `level`: the side of its other
/// coordinate.
std::optional<int> side_of_level(const Curve& c, Axis axis, std::int64_t level, const Interval& t, std::int64_t v);

/// The vertex's parameter on a curve that it lies on; t: its enclosure there. Empty polynomial: no definition.
AlgebraicNumber parameter_of(const ArcSet& set, const Vertex& v, std::uint32_t curve, const Interval& t);

/// Sign of the difference of two vertices' parameters on an arc's curve, near or on the arc: by their enclosures, the
/// points' (the arc is monotone), or exactly (counted). None: degenerate beyond what can be decided.
std::optional<int> compare_along(const ArcSet& set, const Arc& arc, const Vertex& a, const Interval& ta,
                                 const Vertex& b, const Interval& tb, std::uint64_t& exact_comparisons);

} // namespace fetexc
