// SPDX-License-Identifier: GPL-3.0-or-later
/// Bi-level textures (Loviscach 2005): a silhouette fitted by a small texture whose interpolation is cut at one half.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "compiler/bilevel/discrete_fit.h"
#include "compiler/bilevel/parts.h"
#include "compiler/bilevel/silhouette.h"
#include "compiler/compile.h"
#include "formats/bilevel.h"

namespace fetexc {

struct BilevelOptions {
    GridSize size; ///< of a texture of one channel; those of more channels have as many bytes, so fewer texels
    std::uint32_t channels = 0; ///< 1, 2, 3; 0: whichever gets the least area wrong
    bool exact_size = false;    ///< the size is in texels, whatever the channels
    /// Of 1, 2 and 3 channels, instead of the three above; width 0: not tried.
    std::optional<std::array<GridSize, 3>> sizes;
    MidGreys greys = MidGreys::Allow;
    bool mips = false;
    unsigned threads = 1; ///< 0: all; never changes a byte
};

/// Of one fit.
struct BilevelFit {
    fetex::BilevelRule rule = fetex::BilevelRule::Single;
    std::uint32_t width = 0, height = 0;
    std::uint64_t cells = 0, texels_fitted = 0; ///< with some of the outline; at their corners
    std::uint64_t thin_cells =
        0; ///< of the cells: with a line that the outline crosses twice or more, so thinner than a texel
    bool paper_start = false; ///< the fit began with the paper's equations, which ended better
    FitTrace trace;           ///< part of the canvas that is wrong, after each step (contour, then bytes)
    std::uint64_t contour_steps = 0, bytes_tried = 0;
    std::uint64_t parts_mended = 0; ///< bytes changed so that fewer parts are lost or invented
    double wrong = 0;               ///< part of the canvas, along finer lines
};
struct BilevelStats {
    std::vector<BilevelFit> fits; ///< the chosen one first
    std::uint64_t edges = 0, edges_varying = 0;
    PartCounts parts;
    std::uint64_t thin_cells =
        0; ///< cells of the chosen fit where the outline crosses a line twice or more: thinner than a texel
    std::uint64_t gpu_bytes = 0;
};
struct BilevelBuild {
    fetex::BilevelTexture texture;
    BilevelStats stats;
};

/// Errors: size out of range, and those of load_solver.
Result<BilevelBuild> compile_bilevel(const Silhouette& silhouette, const BilevelOptions& options,
                                     const ProgressSink& progress = {});

} // namespace fetexc
