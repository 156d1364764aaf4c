// SPDX-License-Identifier: GPL-3.0-or-later
/// The few operations on affine maps the front end needs.
#pragma once

#include <cmath>

#include "compiler/scene/scene.h"

namespace fetexc::svg {

inline CanvasPoint apply(const Affine& m, CanvasPoint p) {
    return {m.a * p.x + m.c * p.y + m.e, m.b * p.x + m.d * p.y + m.f};
}

/// First `inner`, then `outer`.
inline Affine compose(const Affine& outer, const Affine& inner) {
    return {outer.a * inner.a + outer.c * inner.b,           outer.b * inner.a + outer.d * inner.b,
            outer.a * inner.c + outer.c * inner.d,           outer.b * inner.c + outer.d * inner.d,
            outer.a * inner.e + outer.c * inner.f + outer.e, outer.b * inner.e + outer.d * inner.f + outer.f};
}

/// Of an invertible map; the front end hands out no other.
inline Affine inverted(const Affine& m) {
    const double det = m.a * m.d - m.b * m.c;
    const Affine i{m.d / det, -m.b / det, -m.c / det, m.a / det, 0, 0};
    return {i.a, i.b, i.c, i.d, -(i.a * m.e + i.c * m.f), -(i.b * m.e + i.d * m.f)};
}

/// Upper bound of how much lengths grow: the Frobenius norm.
inline double stretch(const Affine& m) { return std::sqrt(m.a * m.a + m.b * m.b + m.c * m.c + m.d * m.d); }

} // namespace fetexc::svg
