// SPDX-License-Identifier: GPL-3.0-or-later
/// Which fills can't be seen (DESIGN §8). Marks only; tree.h removes.
#pragma once

#include <vector>

#include "compiler/scene/clip_tree.h"
#include "compiler/scene/scene.h"

namespace fetexc {

/// Fills that are empty, fully transparent or outside the canvas; counted in scene.stats. `shapes`: shape_boxes(scene).
[[nodiscard]] std::vector<bool> find_invisible_fills(Scene& scene, const std::vector<LatticeBox>& shapes);

/// Fills of a rebuilt tree that lie under a later opaque axis-aligned rectangle at root level; counted in scene.stats.
[[nodiscard]] std::vector<bool> find_hidden_fills(Scene& scene, const std::vector<LatticeBox>& shapes);

} // namespace fetexc
