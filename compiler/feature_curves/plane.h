// SPDX-License-Identifier: GPL-3.0-or-later
/// Distances inside a texel, local coordinates; they are reported, and decide between shapes that are all valid.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "formats/feature_curves.h"

namespace fetexc {

using Chord = std::array<fetex::FeaturePoint, 2>;

inline double distance(fetex::FeaturePoint a, fetex::FeaturePoint b) {
    const double dx = a.x - b.x, dy = a.y - b.y;
    return std::sqrt(dx * dx + dy * dy);
}

/// On the chord's line; exact where that is along an axis.
inline bool on_line(fetex::FeaturePoint p, const Chord& c) {
    return (c[1].x - c[0].x) * (p.y - c[0].y) == (c[1].y - c[0].y) * (p.x - c[0].x);
}

inline double distance_to_chord(fetex::FeaturePoint p, const Chord& c) {
    const double dx = c[1].x - c[0].x, dy = c[1].y - c[0].y, length = dx * dx + dy * dy;
    if (length == 0) return distance(p, c[0]);
    const double t = std::clamp(((p.x - c[0].x) * dx + (p.y - c[0].y) * dy) / length, 0.0, 1.0);
    return distance(p, {c[0].x + t * dx, c[0].y + t * dy});
}

/// Where the ways across meet: N–S and E–W. Positions 0 … 1 along the edges.
inline fetex::FeaturePoint crossing_point(double north, double east, double south, double west) {
    // (x, y): x = north + y (south − north), y = west + x (east − west).
    const double across = south - north, along = east - west, turn = 1 - along * across;
    if (turn == 0) return {0.5, 0.5}; // both are the same diagonal
    const double x = std::clamp((north + west * across) / turn, 0.0, 1.0);
    return {x, west + x * along};
}

} // namespace fetexc
