// SPDX-License-Identifier: GPL-3.0-or-later
/// Points inside trapezoids. Planar space.
#pragma once

#include <optional>

#include "compiler/planar/texel_map.h"
#include "tests/support/exact_winding.h"
#include "tests/support/random.h"

namespace fetexc::test {

struct TrapezoidPoint {
    std::optional<ExactPoint> point; ///< none: too thin to find one
    bool wrong_order = false;        ///< the left side runs right of the right side
};

/// A random point certainly inside: strictly between the enclosures of the nodes above and below and of both sides.
[[nodiscard]] TrapezoidPoint point_in(const PlanarMap& map, const TexelMap& texel, const Trapezoid& t, Random& random);

} // namespace fetexc::test
