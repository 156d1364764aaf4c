// SPDX-License-Identifier: GPL-3.0-or-later
/// Points on curves to nearly the resolution of double, where plain evaluation can't give it: exact integer evaluation at
/// dyadic parameters of budget::kPreciseBits bits. For what is badly conditioned (flat crossings, extrema near
/// inflections, zero handles); microseconds a call.
#pragma once

#include <optional>

#include "compiler/geometry/intersect.h"

namespace fetexc {

struct PointEnclosure {
    Interval x, y;
    [[nodiscard]] double width() const { return std::max(x.width(), y.width()); }
};

/// The common point of a certified contact. Plain evaluation first; when that is wider than budget::kPointWidth of the
/// curves' size, the contact is narrowed by Newton steps on exact residuals, certified again.
PointEnclosure contact_point(const Curve& a, const Curve& b, Contact& c);

/// The point of a monotone stretch where the coordinate equals v; t: its parameter as parameter_at() gives it,
/// narrowed where needed.
PointEnclosure level_point(const Stretch& s, Axis axis, double v, Interval& t);

/// The point of an extremum along one axis; t: an enclosure whose ends show the sign change of the derivative,
/// narrowed where needed.
PointEnclosure extremum_point(const Curve& c, Interval& t);

} // namespace fetexc
