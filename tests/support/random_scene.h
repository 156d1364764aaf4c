// SPDX-License-Identifier: GPL-3.0-or-later
/// Seeded random scenes for property tests: the same for every compiler and standard library.
#pragma once

#include <cstdint>

#include "compiler/scene/scene.h"
#include "compiler/scene/scene_builder.h"
#include "tests/support/random_shapes.h"

namespace fetexc::test {

struct RandomSceneOptions {
    ShapeSpace space;
    ShapeMix mix;
    int layers = 12; ///< fills of the picture (mask contents come on top)

    // probabilities, per fill
    double copied = 0.1;      ///< uses an earlier shape again
    double reversed = 0.1;    ///< draws an earlier shape the other way round, as a shape of its own
    double even_odd = 0.4;    ///< else nonzero
    double translucent = 0.3; ///< alpha below 1 in the paint or in the fill
    double gradient = 0.2;    ///< else solid
    double raster = 0;
    double clip = 0;
    double cover = 0.03; ///< an opaque rectangle over the whole canvas or half of it

    // probability that a group opens, and of what it carries then (a group with nothing is there, too)
    double group = 0;
    double group_opacity = 0.4, group_clip = 0.3, group_blend = 0.3, group_mask = 0.3, group_isolated = 0.2;

    bool cull = true;
};

/// Everything the compositor knows: groups, clips, masks, blend modes, bitmaps.
[[nodiscard]] RandomSceneOptions everything(int layers = 12);

/// Only solid opaque paints.
[[nodiscard]] RandomSceneOptions opaque_solids(int layers = 12);

[[nodiscard]] SceneBuilder random_scene_builder(std::uint64_t seed, const RandomSceneOptions& options);

[[nodiscard]] Scene random_scene(std::uint64_t seed, const RandomSceneOptions& options = {});

} // namespace fetexc::test
