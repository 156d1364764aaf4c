// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/bilevel_budget.h"

#include <algorithm>
#include <array>
#include <string>

#include "compiler/diagnostics.h"
#include "compiler/measure/alternatives.h"
#include "formats/fbt_mip.h"

namespace fetexc::cli {

std::optional<GridSize> bilevel_grid_of_bytes(double aspect, std::uint64_t bytes, std::uint32_t channels, bool mips) {
    for (std::uint64_t most = bytes; most > 0;) {
        const GridSize grid = measure::grid_of_bytes(aspect, most, channels);
        const std::uint64_t texels = std::uint64_t{grid.width} * grid.height * channels;
        if (texels + (mips ? fetex::fbt_mip_samples(grid.width, grid.height) : 0) <= bytes) return grid;
        if (grid.width == 1) return std::nullopt;
        most = std::min(most, texels) - 1;
    }
    return std::nullopt;
}

Result<BilevelBuild> compile_bilevel_within(const Silhouette& silhouette, const BilevelOptions& options,
                                            std::uint64_t bytes, const ProgressSink& progress) {
    std::array<GridSize, 3> sizes{};
    for (std::uint32_t channels = 1; channels <= 3; ++channels) {
        if (options.channels != 0 && options.channels != channels) continue;
        const auto grid = bilevel_grid_of_bytes(silhouette.height, bytes, channels, options.mips);
        if (grid) sizes[channels - 1] = *grid;
    }
    if (std::ranges::all_of(sizes, [](GridSize size) { return size.width == 0; }))
        return Error{ErrorClass::Unsupported, diag::kFbtBudget,
                     "no bi-level texture fits in " + std::to_string(bytes) + " bytes", "--max-bytes"};
    BilevelOptions how = options;
    how.sizes = sizes;
    return compile_bilevel(silhouette, how, progress);
}

} // namespace fetexc::cli
