// SPDX-License-Identifier: GPL-3.0-or-later
/// Winding numbers by shape.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fetexc {

/// Following the curve with growing t, the shape's contour runs `winding` times along (negative: against). Of a point:
/// the shape's winding number there.
struct Contribution {
    std::uint32_t shape = 0;
    std::int32_t winding = 0;
};

using Windings = std::vector<Contribution>; ///< ascending shapes, no zeros

/// changes: ascending shapes; each is taken `sign` times.
void add_windings(Windings& w, std::span<const Contribution> changes, std::int32_t sign);

} // namespace fetexc
