// SPDX-License-Identifier: GPL-3.0-or-later
/// From front-end contours to snapped, merged, exactly closed lattice segments. Steps in README.md.
#pragma once

#include <vector>

#include "compiler/result.h"
#include "compiler/scene/scene_builder.h"

namespace fetexc {

/// Fills scene.segments and scene.shapes (one per raw shape, same index, possibly empty) and the geometry statistics.
/// Needs scene.extent. Errors: non-finite coordinate, bad degree, more segments than 32-bit indices hold.
Status snap_shapes(const std::vector<RawShape>& raw, Scene& scene);

} // namespace fetexc
