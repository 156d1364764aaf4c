// SPDX-License-Identifier: GPL-3.0-or-later
/// Clipping to the guard box: the canvas expanded by one larger side in every direction, in lattice steps.
#pragma once

#include <vector>

#include "compiler/scene/scene_builder.h"

namespace fetexc {

/// Closed box, lattice steps.
struct GuardBox {
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// True if no control point lies outside, so that clipping changes nothing.
[[nodiscard]] inline bool hull_inside(const CanvasSegment& s, const GuardBox& box) {
    for (int i = 0; i <= s.degree; ++i)
        if (!(s.p[i].x >= box.x0 && s.p[i].x <= box.x1 && s.p[i].y >= box.y0 && s.p[i].y <= box.y1)) return false;
    return true;
}

[[nodiscard]] GuardBox guard_box(const Extent& extent);

/// Appends the segment's parts inside the box unchanged and, for each part outside, a line along the border between the
/// clamped end points. The replacement moves no curve across a point of the box's interior, so all winding numbers in
/// there stay. Consecutive input segments give consecutive output; every output end point lies in the box, every handle
/// within kLatticeLimit.
void clip_to_guard_box(const CanvasSegment& s, const GuardBox& box, std::vector<CanvasSegment>& out);

} // namespace fetexc
