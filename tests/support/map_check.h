// SPDX-License-Identifier: GPL-3.0-or-later
/// Invariants of the planar map that need no reference picture.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compiler/compile.h"

namespace fetexc::test {

/// Winding numbers of a face: (shape, winding), ascending shapes, no zeros. Two faces beside one edge always differ.
using WindingKey = std::vector<std::pair<std::uint32_t, std::int32_t>>;

struct FaceSum {
    std::uint64_t faces = 0; ///< of the whole canvas, put together across the sides of texels
    double area = 0;         ///< part of the canvas
};

struct MapCheck {
    std::optional<std::string> failure; ///< the first invariant that doesn't hold, or the compiler's error
    std::map<WindingKey, FaceSum> faces;
    double area_error = 0;                            ///< bound on each area, part of the canvas
    std::int64_t edges_minus_vertices = 0;            ///< of the whole arrangement; meaningful for lies_inside()
    std::uint64_t points = 0, points_undecidable = 0; ///< rational points asked; and too near to an edge to ask
};

struct MapCheckOptions {
    GridSize size{1, 1};
    int points_per_texel = 8;
    std::uint64_t seed = 0;
    bool inside = true; ///< the drawing lies inside the canvas: check what holds of the whole plane, too
};

/// Builds the map of the scene and checks, texel by texel: Euler's formula with independently counted faces; winding
/// numbers on both sides of every edge; trapezoids that are in order and fill the texel; winding numbers at random
/// rational points inside trapezoids, decided in exact arithmetic. Over the canvas: neighbouring texels agree; running
/// sums along rows equal what the faces say; Euler's formula; areas times winding numbers equal the contours'
/// integrals.
[[nodiscard]] MapCheck check_map(const Scene& scene, const MapCheckOptions& options);

} // namespace fetexc::test
