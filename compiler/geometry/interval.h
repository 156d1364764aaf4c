// SPDX-License-Identifier: GPL-3.0-or-later
/// Closed intervals of doubles that contain the exact result of every operation.
///
/// Each operation rounds to nearest and then widens by two unit roundoffs, instead of switching the rounding mode: the
/// same bytes on every compiler, no per-thread state, no -frounding-math. The cost is one unit of width per operation.
#pragma once

#include <algorithm>
#include <cmath>

#include "compiler/error_budget.h"

namespace fetexc {

struct Interval {
    double lo = 0, hi = 0;

    Interval() = default;
    Interval(double v) : lo(v), hi(v) {}
    Interval(double l, double h) : lo(l), hi(h) {}

    [[nodiscard]] double mid() const { return 0.5 * (lo + hi); }
    [[nodiscard]] double width() const { return hi - lo; }
    [[nodiscard]] bool contains(double v) const { return lo <= v && v <= hi; }
    [[nodiscard]] bool overlaps(const Interval& o) const { return lo <= o.hi && o.lo <= hi; }
    /// +1 or −1 when certain, else 0.
    [[nodiscard]] int sign() const { return lo > 0 ? 1 : hi < 0 ? -1 : 0; }
    [[nodiscard]] double magnitude() const { return std::max(std::fabs(lo), std::fabs(hi)); }
};

/// Lower and upper bounds of the exact value whose round-to-nearest result is r.
inline double widen_down(double r) {
    return r - (std::fabs(r) * (2 * budget::kUnitRoundoff) + budget::kUnderflowGuard);
}
inline double widen_up(double r) { return r + (std::fabs(r) * (2 * budget::kUnitRoundoff) + budget::kUnderflowGuard); }

/// Empty (lo > hi) if they don't overlap.
inline Interval meet(const Interval& a, const Interval& b) { return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)}; }
inline bool empty(const Interval& v) { return !(v.lo <= v.hi); }
inline Interval hull(const Interval& a, const Interval& b) { return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)}; }
inline Interval operator-(const Interval& a) { return {-a.hi, -a.lo}; }
inline Interval operator+(const Interval& a, const Interval& b) {
    return {widen_down(a.lo + b.lo), widen_up(a.hi + b.hi)};
}
inline Interval operator-(const Interval& a, const Interval& b) {
    return {widen_down(a.lo - b.hi), widen_up(a.hi - b.lo)};
}
inline Interval operator*(const Interval& a, const Interval& b) {
    const double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
    return {widen_down(std::min(std::min(p, q), std::min(r, s))), widen_up(std::max(std::max(p, q), std::max(r, s)))};
}
/// b must not contain 0.
inline Interval operator/(const Interval& a, const Interval& b) {
    const double p = a.lo / b.lo, q = a.lo / b.hi, r = a.hi / b.lo, s = a.hi / b.hi;
    return {widen_down(std::min(std::min(p, q), std::min(r, s))), widen_up(std::max(std::max(p, q), std::max(r, s)))};
}

/// −1, +1 when a is certainly below / above b, else 0.
inline int compare(const Interval& a, const Interval& b) { return a.hi < b.lo ? -1 : a.lo > b.hi ? 1 : 0; }

} // namespace fetexc
