// SPDX-License-Identifier: GPL-3.0-or-later
/// Certified intersection of two monotone stretches (DESIGN §5.4): the floating-point filter in front of
/// geometry/exact.h.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "compiler/geometry/exact.h"

namespace fetexc {

/// Krawczyk operator for two equations in two unknowns: a zero at m + d, in a box over which a11 … a22 enclose the
/// Jacobian, has d in e·d − g, when f encloses the residual at m.
struct Krawczyk {
    Interval gs, gt, e11, e12, e21, e22;
};
/// None: the Jacobian in the middle is singular.
std::optional<Krawczyk> krawczyk(const Interval& fx, const Interval& fy, const Interval& a11, const Interval& a12,
                                 const Interval& a21, const Interval& a22);

/// The same for the middle of the box of radii (rs, rt). True: it is mapped strictly into itself and holds exactly one
/// zero.
bool krawczyk_maps_inside(const Interval& fx, const Interval& fy, const Interval& a11, const Interval& a12,
                          const Interval& a21, const Interval& a22, double rs, double rt);

/// A stretch with the control points of just that part of its curve (blossom), made once for many pairs.
struct ControlPolygon {
    ControlPolygon() = default;
    ControlPolygon(const Stretch& s);
    Stretch stretch;
    std::array<double, 4> x{}, y{}; ///< relative to the curve's origin; error ≤ 2·kEvaluationError·magnitude
};

enum class PairOutcome { Certified, Undecided };

/// Appends every common point that is not in `known` (shared end points and end points lying on the other curve, found
/// exactly by the caller). Certified: the list is complete, each entry proved to exist (Krawczyk) and to be alone
/// (tangent cones). Undecided: tangent, overlapping or too close to tell; nothing is appended and exact.h decides.
PairOutcome intersect_certified(const ControlPolygon& a, const ControlPolygon& b, std::span<const Contact> known,
                                std::vector<Contact>& found);

/// Exact: the integer point lies on the stretch's curve and within the stretch; gives its parameter.
std::optional<Interval> point_on_stretch(const ControlPolygon& s, IntPoint p);

} // namespace fetexc
