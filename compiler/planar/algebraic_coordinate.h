// SPDX-License-Identifier: GPL-3.0-or-later
/// Coordinates of points as algebraic numbers: whether two unrelated points lie on one level is then a matter of
/// polynomials, not of digits. Up to milliseconds a call.
#pragma once

#include <cstdint>
#include <optional>

#include "compiler/geometry/polynomial.h"

namespace fetexc {

/// One coordinate of a point: an integer, or that of a curve at a parameter.
struct AlgebraicCoordinate {
    std::optional<std::int64_t> level;
    const Curve* curve = nullptr; ///< without a level
    Axis axis = Axis::X;
    AlgebraicNumber parameter;
};

/// Sign of a − b, exact. None: a parameter's interval doesn't hold exactly one root.
std::optional<int> compare(const AlgebraicCoordinate& a, const AlgebraicCoordinate& b);

/// Enclosure from the parameter to 2^-bits. None as above.
std::optional<RationalRange> narrowed(const AlgebraicCoordinate& c, int bits);

} // namespace fetexc
