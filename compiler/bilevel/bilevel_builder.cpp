// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/bilevel/bilevel_builder.h"

#include <algorithm>
#include <cmath>

#include "compiler/bilevel/coverage.h"
#include "compiler/bilevel/mend_parts.h"
#include "compiler/bilevel/parts.h"
#include "compiler/bilevel/seed.h"
#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"
#include "compiler/parallel.h"
#include "formats/fbt_samples.h"

namespace fetexc {
namespace {

using fetex::BilevelRule;

/// What a fit takes: scan lines a texel of the contour's fit and of the first bytes, of pairs of bytes, and of the last
/// bytes if those are more. (More for pairs as well: 2 % less area for a quarter more time.)
struct Effort {
    std::uint32_t fit_lines, pair_lines, polish_lines;
};
constexpr Effort kEffortOfOne{8, 16, 16}, kEffortOfSeveral{8, 16, 32};
constexpr int kPairSweeps = 2;
constexpr std::uint32_t kVerifyLines = 64; ///< a texel, of the figure in the report
constexpr std::uint32_t kPartRows = 65;    ///< a texel
constexpr int kContourSteps = 12, kSweeps = 80;
constexpr std::uint32_t kMaxSize = 16384;

struct Fitted {
    BilevelFit fit;
    std::vector<std::uint8_t> values;
    std::uint64_t thin_cells = 0;
};

/// One texture of one rule.
Fitted fit_rule(const Solver& solver, const Silhouette& silhouette, GridSize size, BilevelRule rule, MidGreys greys) {
    Fitted out;
    out.fit.rule = rule, out.fit.width = size.width, out.fit.height = size.height;
    const std::vector<OutlineSegment> outline = outline_in_texels(silhouette, size.width, size.height);
    const Effort& effort = rule == BilevelRule::Single ? kEffortOfOne : kEffortOfSeveral;
    const ScannedOutline scanned(silhouette, outline, size.width, size.height, effort.fit_lines);
    const ThresholdCells cells(scanned, size.width, size.height, rule);
    out.fit.texels_fitted = cells.texels().size();
    out.fit.cells =
        static_cast<std::uint64_t>(std::ranges::count_if(cells.cells(), [](const Cell& c) { return c.holds_outline; }));
    const double reach = rule == BilevelRule::Single ? budget::kSeedReach : budget::kSeedReachOfSeveral;
    const double pixel = silhouette.pixelated * size.width;
    const double window = pixel > 0 ? std::max(budget::kCornerWindow, budget::kCornerPixels * pixel) : 0;
    out.thin_cells = static_cast<std::uint64_t>(std::ranges::count_if(cells.cells(), [&](const Cell& c) {
        return std::ranges::any_of(cells.lines(c), [](const CellLine& l) { return l.crossings > 1; });
    }));
    std::vector<std::vector<std::uint8_t>> starts{seed_values(cells, scanned, outline, reach, window)};
    if (rule == BilevelRule::Single) {
        starts.push_back(starts[0]);
        starts.push_back(seed_values(cells, scanned, outline, budget::kSeedReachOfSeveral, window));
        fit_intersections_and_angles(solver, cells, outline, starts[1]);
    }
    // Each ends in another of many least areas.
    double least = INFINITY;
    for (std::size_t k = 0; k < starts.size(); ++k) {
        FitTrace trace;
        fit_contour(solver, cells, starts[k], kContourSteps, trace);
        const std::uint64_t steps = trace.size();
        out.fit.bytes_tried += fit_bytes(cells, starts[k], greys, {kSweeps, 0}, trace);
        const double area = cells.wrong_area(starts[k]);
        if (!(area < least)) continue;
        least = area, out.values = std::move(starts[k]);
        out.fit.trace = std::move(trace), out.fit.contour_steps = steps, out.fit.paper_start = k == 1;
    }
    const bool polish = effort.polish_lines > effort.pair_lines;
    if (polish) {
        const ScannedOutline fine(silhouette, outline, size.width, size.height, effort.pair_lines);
        out.fit.bytes_tried += fit_bytes(ThresholdCells(fine, size.width, size.height, rule), out.values, greys,
                                         {kSweeps, kPairSweeps}, out.fit.trace);
    }
    const ScannedOutline finer(silhouette, outline, size.width, size.height, effort.polish_lines);
    const ThresholdCells fine(finer, size.width, size.height, rule);
    out.fit.bytes_tried += fit_bytes(fine, out.values, greys, {kSweeps, polish ? 0 : kPairSweeps, true}, out.fit.trace);
    const ScannedOutline rows(silhouette, outline, size.width, size.height, kPartRows);
    out.fit.parts_mended = mend_parts(fine, rows, outline, greys, out.values);
    const double area = static_cast<double>(size.width) * size.height;
    for (double& wrong : out.fit.trace)
        wrong /= area;
    const ScannedOutline finest(silhouette, outline, size.width, size.height, kVerifyLines);
    out.fit.wrong = ThresholdCells(finest, size.width, size.height, rule).wrong_area(out.values) / area;
    return out;
}

std::uint32_t packed(const Rgba& c) {
    return fetex::fbt_pack_sample({c.r, c.g, c.b, c.a}, fetex::FbtSampleFormat::Rgba8)[0];
}

bool left_out(GridSize size) { return size.width < 1 || size.height < 1; }
bool beyond_limits(GridSize size) { return size.width > kMaxSize || size.height > kMaxSize; }

/// As many bytes in more channels.
GridSize shrunk(GridSize size, std::uint32_t channels) {
    const double factor = 1 / std::sqrt(static_cast<double>(channels));
    const auto side = [&](std::uint32_t n) { return std::max(1U, static_cast<std::uint32_t>((n + 0.7) * factor)); };
    return {side(size.width), side(size.height)};
}

/// Of 1, 2 and 3 channels.
std::array<GridSize, 3> sizes_of(const BilevelOptions& options) {
    if (options.sizes) return *options.sizes;
    std::array<GridSize, 3> out{};
    for (std::uint32_t channels = 1; channels <= 3; ++channels) {
        const bool wanted = options.channels == 0 || options.channels == channels;
        const bool as_given = options.exact_size || left_out(options.size);
        if (wanted) out[channels - 1] = as_given ? options.size : shrunk(options.size, channels);
    }
    return out;
}

GridSize size_of(const std::array<GridSize, 3>& sizes, BilevelRule rule) {
    return sizes[fetex::bilevel_channels(rule) - 1];
}

} // namespace

Result<BilevelBuild> compile_bilevel(const Silhouette& silhouette, const BilevelOptions& options,
                                     const ProgressSink& progress) {
    const std::array<GridSize, 3> sizes = sizes_of(options);
    if (std::ranges::any_of(sizes, beyond_limits) || std::ranges::all_of(sizes, left_out))
        return Error{ErrorClass::Usage, diag::kSizeOutOfRange, "the size must be 1 to 16384 texels on each side", ""};
    const Result<const Solver*> solver = load_solver();
    if (!solver) return solver.error();
    std::vector<BilevelRule> rules;
    for (const BilevelRule rule : {BilevelRule::Single, BilevelRule::Min, BilevelRule::Max, BilevelRule::Median}) {
        if (!left_out(size_of(sizes, rule))) rules.push_back(rule);
    }
    if (progress) progress("fit", 0);
    std::vector<Fitted> fits(rules.size());
    parallel_for(rules.size(), options.threads, [&](std::size_t k) {
        fits[k] = fit_rule(*solver.value(), silhouette, size_of(sizes, rules[k]), rules[k], options.greys);
    });
    std::stable_sort(fits.begin(), fits.end(),
                     [](const Fitted& a, const Fitted& b) { return a.fit.wrong < b.fit.wrong; });
    BilevelBuild out;
    fetex::BilevelTexture& t = out.texture;
    t.width = fits[0].fit.width, t.height = fits[0].fit.height;
    t.rule = fits[0].fit.rule, t.channels = fetex::bilevel_channels(t.rule);
    t.texels = std::move(fits[0].values);
    out.stats.thin_cells = fits[0].thin_cells;
    for (Fitted& f : fits)
        out.stats.fits.push_back(std::move(f.fit));
    t.below = packed(silhouette.below), t.above = packed(silhouette.above);
    if (progress) progress("levels", 0.9);
    if (options.mips) t.mips = coverage_levels(silhouette, t.width, t.height, options.threads);
    out.stats.parts = count_parts(silhouette, t, kPartRows, options.threads);
    out.stats.gpu_bytes = fetex::bilevel_gpu_bytes(t);
    out.stats.edges = silhouette.edges.size(), out.stats.edges_varying = silhouette.edges_varying;
    return out;
}

} // namespace fetexc
