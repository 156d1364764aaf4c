// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/geometry/short_parameter.h"

#include <bit>

#include "compiler/geometry/intersect.h"
#include "compiler/geometry/polynomial.h"

namespace fetexc {
namespace {

double to_double(std::int64_t t) { return std::ldexp(static_cast<double>(t), -budget::kShortBits); }

/// Truncated; converted back it is exact, being no longer than the double.
std::int64_t to_short(double t) { return static_cast<std::int64_t>(std::ldexp(t, budget::kShortBits)); }

Interval minus_exactly(const Interval& v, double shift) { return {widen_down(v.lo - shift), widen_up(v.hi - shift)}; }

/// floor(v·t·2^-kShortBits) for |v| < 2^124, |t| < 2^63.
Fixed times(Fixed v, std::int64_t t) {
    const auto high = static_cast<std::int64_t>(v >> 64);
    const auto low = static_cast<std::uint64_t>(v);
    constexpr int up = 64 - budget::kShortBits;
    return (static_cast<Fixed>(high) * t) * (1 << up) + ((static_cast<Fixed>(low) * t) >> budget::kShortBits);
}

/// v·2^-bits, rounded towards zero.
double truncated(Fixed v, int bits) {
    const Unsigned128 m = magnitude(v);
    const auto high = static_cast<std::uint64_t>(m >> 64), low = static_cast<std::uint64_t>(m);
    const int length = high != 0 ? 64 + std::bit_width(high) : std::bit_width(low), dropped = std::max(0, length - 53);
    const double d = std::ldexp(static_cast<double>(static_cast<std::uint64_t>(m >> dropped)), dropped - bits);
    return v < 0 ? -d : d;
}

/// v is evaluated, `beside` has to be added; the middle of both is kept.
Interval enclose_evaluated(Fixed v, int error, const Interval& beside) {
    const double e = std::ldexp(error, -budget::kFixedBits);
    return enclose_fixed(v, v, budget::kFixedBits) + (beside + Interval(-e, e));
}


} // namespace

Interval enclose_fixed(Fixed lo, Fixed hi, int bits) {
    return {widen_down(truncated(lo, bits)), widen_up(truncated(hi, bits))};
}

ShortParameter::ShortParameter(const Interval& t) : mid(to_short(t.mid())), rest(minus_exactly(t, to_double(mid))) {}

Interval ShortParameter::range() const { return enclose_fixed(mid, mid, budget::kShortBits) + rest; }

void ShortParameter::narrow_to(const Interval& new_rest) {
    const std::int64_t shift = to_short(new_rest.mid());
    mid += shift;
    rest = minus_exactly(new_rest, to_double(shift));
}

FixedCoordinate::FixedCoordinate(const Curve& c, Axis axis) : power_(power_coefficients(c, axis)) {}

// Coefficients are below 2^48 (c.p below 2^43), so for |t| < 2 all sums are below 2^52 steps; each product is rounded
// by less than a unit, which the ones after it at most double.
Fixed FixedCoordinate::at(std::int64_t t) const {
    const auto term = [&](std::size_t i) { return static_cast<Fixed>(power_[i]) << budget::kFixedBits; };
    return term(0) + times(term(1) + times(term(2) + times(term(3), t), t), t);
}

Interval FixedCoordinate::over(const ShortParameter& t, const Interval& derivative) const {
    return enclose_evaluated(at(t.mid), budget::kShortError, derivative * t.rest);
}

ShortContact::ShortContact(const Curve& a, const Curve& b, const Contact& c)
    : a_(a), b_(b), ax_(a, Axis::X), ay_(a, Axis::Y), bx_(b, Axis::X), by_(b, Axis::Y), s_(c.s), t_(c.t) {}

bool ShortContact::narrow() {
    const Interval rs = s_.range(), rt = t_.range();
    const auto residual = [&](const FixedCoordinate& a, const FixedCoordinate& b) {
        return enclose_evaluated(a.at(s_.mid) - b.at(t_.mid), 2 * budget::kShortError, 0);
    };
    const auto k = krawczyk(residual(ax_, bx_), residual(ay_, by_), derivative_over(a_, Axis::X, rs),
                            -derivative_over(b_, Axis::X, rt), derivative_over(a_, Axis::Y, rs),
                            -derivative_over(b_, Axis::Y, rt));
    if (!k) return false;
    const Interval s = meet(s_.rest, k->e11 * s_.rest + k->e12 * t_.rest - k->gs),
                   t = meet(t_.rest, k->e21 * s_.rest + k->e22 * t_.rest - k->gt);
    if (empty(s) || empty(t)) return false;
    s_.narrow_to(s), t_.narrow_to(t);
    return true;
}

Interval ShortContact::along(Axis axis) const {
    const Interval on_a = (axis == Axis::X ? ax_ : ay_).over(s_, derivative_over(a_, axis, s_.range())),
                   on_b = (axis == Axis::X ? bx_ : by_).over(t_, derivative_over(b_, axis, t_.range()));
    return meet(on_a, on_b);
}

} // namespace fetexc
