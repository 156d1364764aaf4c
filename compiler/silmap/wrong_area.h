// SPDX-License-Identifier: GPL-3.0-or-later
/// The area of a cell that shows another region than the drawing has there, exactly.
#pragma once

#include <array>
#include <span>

#include "compiler/silmap/cell_truth.h"

namespace fetexc {

/// What a cell shows: its point, where the links leave it (west and east: levels; north and south: x), and the corners'
/// results. Local frame.
struct ShownCell {
    fetex::SilmapPoint point{0.5, 0.5};
    std::array<double, 4> exit{0.5, 0.5, 0.5, 0.5}; ///< by link
    std::array<ResultId, 4> corners{};

    /// `across`: the neighbour's point, in this cell's frame.
    void link(std::uint32_t link, const fetex::SilmapPoint& across) { exit[link] = exit_of(point, link, across); }
    static double exit_of(const fetex::SilmapPoint& point, std::uint32_t link, const fetex::SilmapPoint& across);
};

/// Cell units squared: of the box, 0 … its area.
double wrong_area(const TruthSlabs& truth, std::span<const TruthSlab> slabs, const fetex::SilmapBox& box,
                  const ShownCell& shown);

} // namespace fetexc
