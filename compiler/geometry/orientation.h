// SPDX-License-Identifier: GPL-3.0-or-later
/// Orientation of integer points, exact.
#pragma once

#include "compiler/geometry/curve.h"

namespace fetexc {

using Int128 = __int128;

inline int sign_of(Int128 v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }

/// Twice the signed area of (o, a, b). Coordinates are below 2^43, so it is below 2^91.
inline Int128 cross(IntPoint o, IntPoint a, IntPoint b) {
    return static_cast<Int128>(a.x - o.x) * (b.y - o.y) - static_cast<Int128>(a.y - o.y) * (b.x - o.x);
}

} // namespace fetexc
