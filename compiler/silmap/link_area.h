// SPDX-License-Identifier: GPL-3.0-or-later
/// The area of a cell that shows what the drawing has there, link by link, exactly.
///
/// Along a level let C_r(x) be the length left of x that has result r. What the cell shows right is the length of the
/// last corner's result on the whole level, and for each link that crosses it C_a(x) − C_b(x), a being shown left of
/// the link and b right of it. So every link counts by itself, and moving a point changes one link of each neighbour.
#pragma once

#include <array>
#include <span>

#include "compiler/silmap/cell_truth.h"

namespace fetexc {

/// What a cell shows, local frame.
struct ShownCell {
    fetex::SilmapPoint point{0.5, 0.5};
    std::array<double, 4> exit{0.5, 0.5, 0.5, 0.5}; ///< by link, where it leaves the cell: west and east levels, else x
    std::array<ResultId, 4> corners{};

    /// `across`: the neighbour's point, in this cell's frame.
    static double exit_of(const fetex::SilmapPoint& point, std::uint32_t link, const fetex::SilmapPoint& across);
};

/// The drawing in a cell.
struct CellTruth {
    const TruthSlabs& all;
    std::span<const TruthSlab> slabs;
    fetex::SilmapBox box;
};

/// Square cells: area of a result.
double area_of(const CellTruth& truth, ResultId result);

/// What a link adds to the area that is right; 0 between equal corners. Together with area_of the south-east corner's
/// result the four links give all of it.
double link_area(const CellTruth& truth, const fetex::SilmapPoint& point, std::uint32_t link, double exit,
                 const std::array<ResultId, 4>& corners);

/// The result at a point of the cell.
ResultId result_at(const CellTruth& truth, double x, double y);

} // namespace fetexc
