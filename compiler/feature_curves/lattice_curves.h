// SPDX-License-Identifier: GPL-3.0-or-later
/// A network as lines and quadratics between points of the lattice, for snapping.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/feature_curves/lattice_lines.h"

namespace fetexc {

/// Between two vertices, which differ.
struct LatticeCurve {
    std::uint32_t a = 0, b = 0;
    LatticePoint middle; ///< the control point; nothing of a line
    bool straight = true;
    std::uint8_t profile = 0; ///< its number
};

/// As LatticeLines. Quadratics aren't lines: their control points aren't on one.
struct LatticeCurves {
    Extent extent;
    std::vector<LatticePoint> vertices;
    std::vector<LatticeCurve> curves;
    std::uint64_t overlaid = 0; ///< curves left out that have another profile than the same curve before

    [[nodiscard]] bool linear() const;
};

LatticeCurves lattice_curves(const LatticeLines& lines);

/// Cubics become quadratics within quadratic_tolerance, ends closer than kMergeDistance one vertex. Quadratics whose
/// control points are on a line are the lines that they run through. profiles: of the curves; none: all have the first.
/// Errors: 3001 (size), 1504 (too many quadratics).
Result<LatticeCurves> lattice_curves(const Network& network, const TextureProfiles* profiles = nullptr);

} // namespace fetexc
