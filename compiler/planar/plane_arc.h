// SPDX-License-Identifier: GPL-3.0-or-later
/// Points and curves of CGAL's arrangements (planar/filtered_arc_traits.h): numbers, which a plane knows the meaning
/// of.
#pragma once

#include <cstdint>

#include "compiler/scene/scene.h"

namespace fetexc {

/// A plane's point: whatever it knows by this number.
struct PlanePoint {
    std::uint32_t id = kNone;
    friend bool operator==(const PlanePoint&, const PlanePoint&) = default;
};

/// Part of a plane's piece from its smaller to its larger end, by first coordinates, then second ones.
struct PlaneArc {
    std::uint32_t piece = kNone;
    PlanePoint min, max;
    friend bool operator==(const PlaneArc&, const PlaneArc&) = default;
};

} // namespace fetexc
