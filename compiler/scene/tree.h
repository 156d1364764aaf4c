// SPDX-License-Identifier: GPL-3.0-or-later
/// Rebuilding the compositing tree: dropped fills and groups without effect disappear, pure clip groups hand their clip
/// down.
#pragma once

#include <vector>

#include "compiler/scene/scene.h"

namespace fetexc {

/// True when the group is composited in isolation (scene.h, Node).
[[nodiscard]] inline bool is_composited(const Node& group) {
    return group.opacity < 1 || group.blend != Blend::Normal || group.mask != kNone || group.isolated;
}

/// Rebuilds scene.nodes in place: the picture first (root_end is set), then each mask's content. `drop` marks fills (by
/// node index) to leave out; it may be empty. Clips may be added. With drop_invisible, groups of opacity 0 or with an
/// empty mask go as well. The scene must be validated.
void rebuild_tree(Scene& scene, const std::vector<bool>& drop, bool drop_invisible);

} // namespace fetexc
