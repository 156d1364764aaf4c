// SPDX-License-Identifier: GPL-3.0-or-later
/// Contacts and crossings with a level, narrowed from enclosures that doubles find: curves are evaluated at parameters
/// of kShortBits in 128-bit integers, and what is left of the parameter stays a double beside it. An enclosure is the
/// image of the one before under Newton's interval operator, so it holds the same root. Used inside geometry/ only.
#pragma once

#include <optional>

#include "compiler/geometry/exact.h"

namespace fetexc {

/// Coordinate in units of 2^-kFixedBits: planar coordinates (below 2^43) to far below anything doubles tell apart.
using Fixed = __int128;

using Unsigned128 = unsigned __int128;
inline Unsigned128 magnitude(Fixed v) { return v < 0 ? -static_cast<Unsigned128>(v) : static_cast<Unsigned128>(v); }

/// Encloses [lo, hi]·2^-bits.
Interval enclose_fixed(Fixed lo, Fixed hi, int bits);

/// The parameter mid·2^-kShortBits + rest, within (-2, 2).
struct ShortParameter {
    std::int64_t mid = 0;
    Interval rest;

    ShortParameter() = default;
    explicit ShortParameter(const Interval& t);
    [[nodiscard]] Interval range() const;
    /// What it is known to be, with another middle: in the middle of that.
    void narrow_to(const Interval& new_rest);
};

/// One coordinate of a curve by powers of t; errs by less than kShortError units.
class FixedCoordinate {
  public:
    FixedCoordinate(const Curve& c, Axis axis);
    [[nodiscard]] Fixed at(std::int64_t t) const; ///< t in units of 2^-kShortBits
    /// Where the derivative over t.range() is known.
    [[nodiscard]] Interval over(const ShortParameter& t, const Interval& derivative) const;

  private:
    std::array<std::int64_t, 4> power_{};
};

/// A common point of two curves.
class ShortContact {
  public:
    ShortContact(const Curve& a, const Curve& b, const Contact& c);

    /// One step. False: it showed nothing.
    bool narrow();
    [[nodiscard]] Contact contact() const { return {s_.range(), t_.range()}; }
    [[nodiscard]] Interval along(Axis axis) const;

  private:
    const Curve &a_, &b_;
    FixedCoordinate ax_, ay_, bx_, by_;
    ShortParameter s_, t_;
};

} // namespace fetexc
