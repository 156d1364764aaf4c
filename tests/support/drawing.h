// SPDX-License-Identifier: GPL-3.0-or-later
/// Drawings of stress tests: closed paths of curves in lattice steps, their text form (.crv), and what moves them
/// about.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "compiler/result.h"
#include "compiler/scene/scene_builder.h"
#include "tests/support/drawn_scene.h"

namespace fetexc::test {

/// The canvas is [0,kLatticeSteps]². Each path is one shape; where a curve doesn't start at the end of the one before,
/// and at the end of the path, a line closes the gap.
struct Drawing {
    FillRule rule = FillRule::NonZero;
    std::vector<Path> paths;
};

/// Exactly these curves: no merging, no culling. Opaque fills in nine colours.
[[nodiscard]] Scene scene_of(const Drawing& drawing);

/// All control points strictly inside the canvas, so that nothing is cut off.
[[nodiscard]] bool lies_inside(const Drawing& drawing);

[[nodiscard]] std::size_t curve_count(const Drawing& drawing);

using LatticeMap = std::function<LatticePoint(LatticePoint)>;
[[nodiscard]] Drawing mapped(Drawing drawing, const LatticeMap& map);
/// Every path traversed the other way round.
[[nodiscard]] Drawing reversed(Drawing drawing);
/// The paths from last to first, and each path's curves starting with another one.
[[nodiscard]] Drawing permuted(Drawing drawing);

/// Canvas-space contours, lattice steps times `unit`.
[[nodiscard]] std::vector<CanvasContour> contours_of(const Drawing& drawing, double unit);

// Text form, one item a line; `#` starts a comment:
//   rule evenodd            (or nonzero, which it is without)
//   unit N                  lattice steps per unit of the coordinates that follow
//   path                    starts a path
//   DEGREE X Y X Y …        a curve: degree + 1 points

[[nodiscard]] Result<Drawing> read_drawing(std::istream& in);
[[nodiscard]] Result<Drawing> read_drawing(const std::string& file);
/// In lattice steps, or in the largest power-of-two unit that all coordinates are multiples of.
void write_drawing(const Drawing& drawing, std::ostream& out);

} // namespace fetexc::test
