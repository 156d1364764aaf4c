// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/bilevel_budget.h"

#include <algorithm>
#include <string>

#include "compiler/diagnostics.h"
#include "compiler/measure/alternatives.h"
#include "compiler/parallel.h"
#include "formats/fbt_mip.h"

namespace fetexc::cli {
namespace {

/// One number of channels at its own size.
struct Candidate {
    BilevelOptions options;
    std::optional<Result<BilevelBuild>> built;
};

std::vector<Candidate> candidates(const Silhouette& silhouette, const BilevelOptions& options, std::uint64_t bytes) {
    std::vector<Candidate> out;
    for (std::uint32_t channels = 1; channels <= 3; ++channels) {
        if (options.channels != 0 && options.channels != channels) continue;
        const auto grid = bilevel_grid_of_bytes(silhouette.height, bytes, channels, options.mips);
        if (!grid) continue;
        out.push_back({options, {}});
        out.back().options.size = *grid, out.back().options.channels = channels, out.back().options.exact_size = true;
    }
    return out;
}

double wrong_area(const BilevelBuild& build) { return build.stats.fits.front().wrong; }

} // namespace

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
    std::vector<Candidate> tried = candidates(silhouette, options, bytes);
    if (tried.empty())
        return Error{ErrorClass::Unsupported, diag::kFbtBudget,
                     "no bi-level texture fits in " + std::to_string(bytes) + " bytes", "--max-bytes"};
    if (progress) progress("fit", 0);
    parallel_for(tried.size(), options.threads,
                 [&](std::size_t k) { tried[k].built.emplace(compile_bilevel(silhouette, tried[k].options)); });
    std::vector<BilevelFit> fits;
    Candidate* best = nullptr;
    for (Candidate& c : tried) {
        if (!*c.built) return c.built->error();
        if (best == nullptr || wrong_area(c.built->value()) < wrong_area(best->built->value())) best = &c;
        const std::vector<BilevelFit>& more = c.built->value().stats.fits;
        fits.insert(fits.end(), more.begin(), more.end());
    }
    std::stable_sort(fits.begin(), fits.end(),
                     [](const BilevelFit& a, const BilevelFit& b) { return a.wrong < b.wrong; });
    BilevelBuild out = std::move(*best->built).value();
    out.stats.fits = std::move(fits);
    return out;
}

} // namespace fetexc::cli
