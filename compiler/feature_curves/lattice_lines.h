// SPDX-License-Identifier: GPL-3.0-or-later
/// A network as lines between points of the lattice, for snapping textures of straight segments.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "compiler/feature_curves/texture_profiles.h"
#include "compiler/network/network.h"
#include "compiler/result.h"
#include "compiler/scene/scene.h"

namespace fetexc {

/// Lattice space. Vertices differ, but those outside the guard box's inside, which nothing looks at; each line is there
/// once, in the direction and order in which curves first have it, and isn't a point.
struct LatticeLines {
    Extent extent;
    std::vector<LatticePoint> vertices;
    std::vector<std::array<std::uint32_t, 2>> lines;
    std::vector<std::uint8_t> profiles; ///< of lines, by number; empty: all have the first
    std::uint64_t overlaid = 0;         ///< lines left out that have another profile than the same line before
};

/// Curves become chords within kFeatureChord of a texel; ends closer than kMergeDistance become one vertex, as in
/// scenes. profiles: of the curves; none: all have the first. Errors: 3001 (size), 1504 (too many chords).
Result<LatticeLines> lattice_lines(const Network& network, std::uint32_t width, std::uint32_t height,
                                   const TextureProfiles* profiles = nullptr);

} // namespace fetexc
