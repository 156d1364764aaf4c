// SPDX-License-Identifier: GPL-3.0-or-later
/// The scene's segments in planar space, each stretch of line and each curve once (DESIGN §5.1).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/compile.h"
#include "compiler/geometry/curve.h"
#include "compiler/planar/grid.h"
#include "compiler/planar/windings.h"
#include "compiler/scene/scene.h"

namespace fetexc {

/// 2 GiB of them: nested shapes along one line, or on one curve, have as many as the square of their number.
inline constexpr std::size_t kMaxContributions = std::size_t{1} << 28;

struct ContributionRun {
    std::uint32_t first = 0, count = 0;
};

struct MergedCurves {
    std::vector<Curve> curves; ///< lines first; in an order of their own, the same for any order of the input
    std::size_t first_bent = 0;
    std::vector<ContributionRun> runs; ///< of each curve
    std::vector<Contribution> contributions;
    bool too_many = false; ///< contributions: kMaxContributions; some are missing

    [[nodiscard]] std::span<const Contribution> of(std::uint32_t curve) const {
        return std::span(contributions).subspan(runs[curve].first, runs[curve].count);
    }
};

/// Drops null segments and (skip.outside) what lies right of, above or below the canvas; reduces degrees; merges
/// identical and reversed curves and overlapping stretches of a line, dropping what cancels. All of it exact.
MergedCurves merge_curves(const Scene& scene, const Grid& grid, PlanarStats& stats, unsigned threads,
                          const SkipRules& skip);

} // namespace fetexc
