// SPDX-License-Identifier: GPL-3.0-or-later
/// Points on curves to nearly the resolution of double, where plain evaluation can't give it: exact integer evaluation
/// at dyadic parameters of budget::kPreciseBits bits. For what is badly conditioned (flat crossings, extrema near
/// inflections, zero handles); microseconds a call.
#pragma once

#include <optional>

#include "compiler/geometry/intersect.h"
#include "compiler/geometry/short_parameter.h"

namespace fetexc {

struct PointEnclosure {
    Interval x, y;
    [[nodiscard]] double width() const { return std::max(x.width(), y.width()); }
};

/// The common point of a certified contact. Plain evaluation first; when that is wider than budget::kPointWidth of the
/// curves' size, the contact is narrowed: in 128-bit integers, or else by Newton steps on exact residuals, certified
/// again.
PointEnclosure contact_point(const Curve& a, const Curve& b, Contact& c);

/// The point of a monotone stretch where the coordinate equals v; t: its parameter as parameter_at() gives it,
/// narrowed where needed.
PointEnclosure level_point(const Stretch& s, Axis axis, double v, Interval& t);

/// The point of an extremum along one axis; t: an enclosure whose ends show the sign change of the derivative,
/// narrowed where needed.
PointEnclosure extremum_point(const Curve& c, Interval& t);

struct FixedPoint {
    Fixed x = 0, y = 0;
};

mpz_class to_integer(Fixed v);

/// Enclosures of both parameters of a certified contact, about 2^-170 wide. None when it is tangent.
std::optional<NarrowContact> narrow_contact(const Curve& a, const Curve& b, const Contact& c);

/// Rounded to the nearest multiple of 2^-kFixedBits, after errors below it. None when the enclosure doesn't tell which
/// point is meant.
FixedPoint fixed(IntPoint p);
FixedPoint fixed_contact(const Curve& a, const NarrowContact& c);
std::optional<FixedPoint> fixed_level(const Curve& c, Axis axis, std::int64_t v, const Interval& t);
/// Exact: where the curve takes the value v at the nearest parameter of kWholeBits. None: it doesn't.
std::optional<FixedPoint> whole_level(const Curve& c, Axis axis, std::int64_t v, const Interval& t);
std::optional<FixedPoint> fixed_extremum(const Curve& c, const Interval& t);

} // namespace fetexc
