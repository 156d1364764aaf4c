// SPDX-License-Identifier: GPL-3.0-or-later
/// Small scenes drawn by hand: opaque fills on a square canvas of 512 × 512.
#pragma once

#include <vector>

#include "compiler/scene/scene.h"

namespace fetexc::test {

using Path = std::vector<std::vector<LatticePoint>>; ///< control points of consecutive segments, in 1/512 of the canvas

/// One opaque fill per path, each in a colour of its own (nine of them, then again). unit: lattice steps per unit of
/// the paths, 512 of which are the canvas unless said otherwise.
[[nodiscard]] Scene scene_of(const std::vector<Path>& paths, FillRule rule = FillRule::EvenOdd,
                             std::int64_t unit = kLatticeSteps / 512);

/// Closed with a line back to the start.
[[nodiscard]] Path closed(Path segments);

[[nodiscard]] Path box(std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1);

/// One half of a segment; exact if its control points are multiples of 8.
[[nodiscard]] std::vector<LatticePoint> half_of(std::vector<LatticePoint> segment, bool first);

} // namespace fetexc::test
