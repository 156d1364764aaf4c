// SPDX-License-Identifier: GPL-3.0-or-later
/// Fits of the texels' values in real numbers: sparse least squares with 0 ≤ value ≤ 1.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/bilevel/threshold_cells.h"
#include "compiler/bilevel/value_levels.h"
#include "compiler/solver/solver.h"

namespace fetexc {

/// Wrong area, in square texels, after each step of a fit.
using FitTrace = std::vector<double>;

/// The paper's system, of one channel: where the outline crosses a line between two neighbouring centres the
/// interpolated value is one half there if the outline is nearly level or upright, and the gradient has the outline's
/// direction elsewhere (Loviscach 2005, "Optimizing the lo-res texture"). Starts from `values`; the result is rounded
/// to bytes.
void fit_intersections_and_angles(const Solver& solver, const ThresholdCells& cells,
                                  std::span<const OutlineSegment> outline, std::vector<std::uint8_t>& values);

/// Moves the texture's contour onto the outline: the sum over all scan lines of the distance between a crossing of the
/// outline and the one of the texture nearest to it, which is the wrong area where contours are single; its derivative
/// by the values is exact, that of the crossing. Steps until the wrong area of the rounded values falls no more, or
/// `steps` of them; `values` gets the best. Any rule.
void fit_contour(const Solver& solver, const ThresholdCells& cells, std::vector<std::uint8_t>& values, int steps,
                 FitTrace& trace);

/// The same of numbers stored otherwise.
void fit_contour(const Solver& solver, const ThresholdCells& cells, const ValueLevels& levels,
                 std::vector<std::uint16_t>& stored, int steps, FitTrace& trace);

} // namespace fetexc
