// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/lattice.h"

#include <algorithm>
#include <cmath>

#include "compiler/diagnostics.h"

namespace fetexc {
namespace {

std::int64_t smaller_side(double smaller, double larger) {
    const double steps = static_cast<double>(kLatticeSteps) * (smaller / larger);
    return std::max<std::int64_t>(1, std::llround(steps));
}

} // namespace

Result<Extent> make_extent(double width, double height) {
    if (!(std::isfinite(width) && std::isfinite(height) && width > 0 && height > 0))
        return Error{ErrorClass::InvalidInput, diag::kSceneExtentInvalid,
                     "the canvas must have a finite, positive width and height", "canvas"};
    Extent extent{width, height, kLatticeSteps, kLatticeSteps};
    if (width > height) extent.lattice_h = smaller_side(height, width);
    if (height > width) extent.lattice_w = smaller_side(width, height);
    const LatticeScale scale = lattice_scale(extent);
    if (!(std::isfinite(scale.sx) && std::isfinite(scale.sy) && scale.sx > 0 && scale.sy > 0))
        return Error{ErrorClass::InvalidInput, diag::kSceneExtentInvalid,
                     "the canvas is too small or too large for double precision", "canvas"};
    return extent;
}

LatticeScale lattice_scale(const Extent& extent) {
    return {static_cast<double>(extent.lattice_w) / extent.width,
            static_cast<double>(extent.lattice_h) / extent.height};
}

CanvasPoint to_canvas(const Extent& extent, double x, double y) {
    return {x * (extent.width / static_cast<double>(extent.lattice_w)),
            y * (extent.height / static_cast<double>(extent.lattice_h))};
}

} // namespace fetexc
