// SPDX-License-Identifier: GPL-3.0-or-later
/// Coordinates of vertices as algebraic numbers: whether two unrelated points lie on one level is then a matter of
/// polynomials, not of digits. Milliseconds a call.
#pragma once

#include "compiler/planar/exact_points.h"

namespace fetexc::test {

struct RationalBox {
    RationalRange x, y;
};

/// Encloses the vertex; about 2^(48 − bits) wide. None: its definition doesn't say which point it is.
std::optional<RationalBox> box_of(const ArcSet& set, const Vertex& v, int bits);

/// Exact. None as above.
std::optional<AlgebraicNumber> coordinate_of(const ArcSet& set, const Vertex& v, Axis axis);

} // namespace fetexc::test
