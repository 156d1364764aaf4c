// SPDX-License-Identifier: GPL-3.0-or-later
/// The FBT against the ground truth: does every point fall into the right region?
#pragma once

#include <cstdint>
#include <string>

#include "compiler/fbt/fbt_builder.h"
#include "compiler/scene/scene.h"

namespace fetexc::test {

struct RegionCheck {
    std::uint64_t points = 0;
    std::uint64_t wrong = 0;     ///< sampled region shows another result than the scene
    std::uint64_t wrong_far = 0; ///< … farther than budget::kRegionTolerance from every curve
    std::uint64_t color_off = 0; ///< right region, solid, but more than 1/255 off in a channel
    double worst_distance = 0;   ///< of the wrong points, in texels: each axis in its own texel side
    std::string worst;           ///< where: "texel-space x y, expected …"
};

/// points uniform in the texture, seeded.
RegionCheck check_regions(const Scene& scene, const FbtBuild& build, const FbtRegions& regions, std::uint64_t points,
                          std::uint64_t seed);

} // namespace fetexc::test
