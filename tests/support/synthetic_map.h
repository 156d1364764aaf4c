// SPDX-License-Identifier: GPL-3.0-or-later
/// A map of any size: cells that share wiggly borders, crossed by roads. What a benchmark of scaling needs: the number
/// of crossings, of edges and of texels with edges all grow with the number of segments.
#pragma once

#include <cstddef>
#include <cstdint>

#include "compiler/scene/scene_builder.h"

namespace fetexc::test {

/// About `segments` path segments (each border counts twice, once per cell) on a canvas of 1000 × 1000.
[[nodiscard]] SceneBuilder synthetic_map_builder(std::uint64_t seed, std::size_t segments);

} // namespace fetexc::test
