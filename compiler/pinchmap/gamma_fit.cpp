// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/gamma_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "compiler/bilevel/discrete_fit.h"
#include "compiler/bilevel/seed.h"
#include "compiler/error_budget.h"
#include "compiler/parallel.h"
#include "compiler/pinchmap/gamma_search.h"

namespace fetexc {
namespace {

using fetex::PinchmapFormat;
using fetex::PinchmapTexel;

/// Scan lines a cluster: of the fits, of the last numbers and pairs of them, of the figure in the report.
constexpr std::uint32_t kFitLines = 8, kPolishLines = 16, kVerifyLines = 64;
constexpr int kContourSteps = 12, kSweeps = 80, kPairSweeps = 2;
/// Of 16 bits: what a step of a stored number is tried for. Smaller ones win less than a byte's thousandth.
constexpr int kFineGrain = 16;

/// Where (1 + k − γ)/2 reaches 0 and 1 in the beginning, clusters from the outline: k does at 1.
constexpr std::array kReaches = {1.0, 1.5};

/// Active texels.
std::vector<std::uint8_t> active_texels(std::span<const PinchmapTexel> map) {
    std::vector<std::uint8_t> out(map.size());
    std::ranges::transform(map, out.begin(), [](const PinchmapTexel& t) { return t.k == 0 ? 1 : 0; });
    return out;
}

/// A problem scanned.
struct Scan {
    Scan(const GammaProblem& p, std::span<const OutlineSegment> outline, std::span<const std::uint8_t> active,
         std::uint32_t lines)
        : outline_scan(p.silhouette, outline, p.width, p.height, lines),
          cells(outline_scan, p.width + 1, p.height + 1, fetex::BilevelRule::Single, TexelPlaces::Corners, active) {}

    ScannedOutline outline_scan;
    ThresholdCells cells;
};

struct Attempt {
    std::vector<std::uint16_t> stored;
    FitTrace trace;
    std::uint64_t steps = 0, tried = 0;
    double area = 0;
};

} // namespace

PinchLevels::PinchLevels(std::span<const PinchmapTexel> map, PinchmapFormat format) {
    for (const PinchmapTexel& t : map)
        offsets_.push_back(static_cast<float>(t.k / 2));
    const std::uint32_t steps = 2 * fetex::pinchmap_zero(format);
    levels_ = {steps, 1, static_cast<std::uint16_t>(steps - 1), format == PinchmapFormat::Bits8 ? 1 : kFineGrain,
               offsets_};
}

double PinchLevels::gamma(std::uint16_t stored) const { return 1 - 2 * static_cast<double>(stored) / levels_.steps; }

std::vector<std::uint16_t> PinchLevels::stored(std::span<const PinchmapTexel> map) const {
    std::vector<std::uint16_t> out(map.size());
    std::ranges::transform(map, out.begin(),
                           [&](const PinchmapTexel& t) { return levels_.nearest((1 - t.gamma) / 2); });
    return out;
}

std::vector<float> PinchLevels::values(std::span<const PinchmapTexel> map) const {
    const std::vector<std::uint16_t> stored = this->stored(map);
    std::vector<float> out(map.size());
    for (std::size_t k = 0; k < map.size(); ++k)
        out[k] = levels_.value(k, stored[k]);
    return out;
}

GammaFit fit_gamma(const Solver& solver, const GammaProblem& problem, std::vector<PinchmapTexel>& map) {
    const std::vector<OutlineSegment> outline = outline_in_texels(problem.silhouette, problem.width, problem.height);
    const PinchLevels pinch(map, problem.format);
    const std::vector<std::uint8_t> active = active_texels(map);
    const Scan coarse(problem, outline, active, kFitLines), fine(problem, outline, active, kPolishLines);
    std::array<Attempt, kReaches.size()> attempts;
    parallel_for(kReaches.size(), problem.threads, [&](std::size_t k) {
        Attempt& a = attempts[k];
        a.stored = seed_stored(coarse.cells, coarse.outline_scan, outline, kReaches[k], 0, pinch.levels());
        fit_contour(solver, coarse.cells, pinch.levels(), a.stored, kContourSteps, a.trace);
        a.steps = a.trace.size();
        a.tried = fit_stored(coarse.cells, a.stored, {pinch.levels()}, {kSweeps, 0}, a.trace);
        a.tried += fit_stored(fine.cells, a.stored, {pinch.levels()}, {kSweeps, kPairSweeps}, a.trace);
        a.area = a.trace.empty() ? 0 : a.trace.back(); // nothing to fit
    });
    const Attempt& best = *std::ranges::min_element(attempts, {}, &Attempt::area);
    for (const std::uint32_t t : coarse.cells.texels())
        map[t].gamma = pinch.gamma(best.stored[t]);
    GammaFit out;
    out.trace = best.trace, out.contour_steps = best.steps;
    for (double& wrong : out.trace)
        wrong /= static_cast<double>(problem.width) * problem.height;
    for (const Attempt& a : attempts)
        out.tried += a.tried;
    out.texels_fitted = coarse.cells.texels().size();
    out.thin_cells = static_cast<std::uint64_t>(std::ranges::count_if(coarse.cells.cells(), [&](const Cell& c) {
        return std::ranges::any_of(coarse.cells.lines(c), [](const CellLine& l) { return l.crossings > 1; });
    }));
    out.wrong = wrong_part(problem, map, kVerifyLines);
    return out;
}

void settle_gamma(const GammaProblem& problem, std::vector<PinchmapTexel>& map, GammaFit& fit) {
    const std::vector<OutlineSegment> outline = outline_in_texels(problem.silhouette, problem.width, problem.height);
    const PinchLevels pinch(map, problem.format);
    const Scan scan(problem, outline, active_texels(map), kPolishLines);
    std::vector<std::uint16_t> stored = pinch.stored(map);
    FitTrace trace;
    fit.tried += fit_stored(scan.cells, stored, {pinch.levels()}, {kSweeps, 0}, trace);
    for (const std::uint32_t t : scan.cells.texels())
        map[t].gamma = pinch.gamma(stored[t]);
    fit.wrong = wrong_part(problem, map, kVerifyLines);
}

void search_gamma(const GammaProblem& problem, std::uint32_t rounds, std::vector<PinchmapTexel>& map, GammaFit& fit) {
    const std::vector<OutlineSegment> outline = outline_in_texels(problem.silhouette, problem.width, problem.height);
    const PinchLevels pinch(map, problem.format);
    const Scan scan(problem, outline, active_texels(map), kPolishLines);
    std::vector<std::uint16_t> stored = pinch.stored(map);
    FitTrace trace;
    fit.tried += search_stored(scan.cells, pinch.levels(), rounds, problem.threads, stored, trace);
    for (const std::uint32_t t : scan.cells.texels())
        map[t].gamma = pinch.gamma(stored[t]);
    for (const double wrong : trace)
        fit.trace.push_back(wrong / (static_cast<double>(problem.width) * problem.height));
    fit.wrong = wrong_part(problem, map, kVerifyLines);
}

double wrong_part(const GammaProblem& problem, std::span<const PinchmapTexel> map, std::uint32_t lines) {
    const std::vector<OutlineSegment> outline = outline_in_texels(problem.silhouette, problem.width, problem.height);
    const Scan scan(problem, outline, active_texels(map), lines);
    const std::vector<float> values = PinchLevels(map, problem.format).values(map);
    return scan.cells.wrong_area(values) / (static_cast<double>(problem.width) * problem.height);
}

std::vector<SideCosts> side_costs(const GammaProblem& problem, std::span<const PinchmapTexel> map, double far) {
    const std::vector<OutlineSegment> outline = outline_in_texels(problem.silhouette, problem.width, problem.height);
    const Scan scan(problem, outline, active_texels(map), kFitLines);
    std::vector<float> values = PinchLevels(map, problem.format).values(map);
    std::vector<SideCosts> out(map.size());
    for (std::size_t t = 0; t < map.size(); ++t)
        (map[t].k > map[t].gamma ? out[t].below : out[t].above) = far;
    const float least = 0.5F / static_cast<float>(fetex::pinchmap_zero(problem.format));
    for (const std::uint32_t t : scan.cells.texels()) {
        const auto area = [&] {
            double sum = 0;
            for (const std::uint32_t c : scan.cells.around(t))
                sum += scan.cells.wrong_area_in(values, scan.cells.cells()[c]);
            return sum;
        };
        const float value = values[t];
        const double now = area();
        values[t] = value > 0.5F ? 0.5F - least : 0.5F + least;
        (value > 0.5F ? out[t].below : out[t].above) = std::max(area() - now, 0.0);
        values[t] = value;
    }
    return out;
}

std::vector<double> wrong_in_clusters(const GammaProblem& problem, std::span<const PinchmapTexel> map) {
    const std::vector<OutlineSegment> outline = outline_in_texels(problem.silhouette, problem.width, problem.height);
    const Scan scan(problem, outline, active_texels(map), kFitLines);
    const std::vector<float> values = PinchLevels(map, problem.format).values(map);
    std::vector<double> out(std::size_t{problem.width} * problem.height);
    // Those without a cell lie on one side as a whole, of the drawing and of the map.
    for (std::uint32_t j = 0; j < problem.height; ++j) {
        for (std::uint32_t i = 0; i < problem.width; ++i) {
            const bool above = map[std::size_t{j} * (problem.width + 1) + i].k > 0;
            out[std::size_t{j} * problem.width + i] = above != scan.outline_scan.above(i + 0.5, j + 0.5) ? 1 : 0;
        }
    }
    for (const Cell& c : scan.cells.cells()) {
        if (c.column == 0 || c.row == 0 || c.column > problem.width || c.row > problem.height) continue; // no area
        out[std::size_t{c.row - 1} * problem.width + c.column - 1] = scan.cells.wrong_area_in(values, c);
    }
    return out;
}

std::vector<double> wrong_around(const GammaProblem& problem, std::span<const PinchmapTexel> map) {
    const std::vector<double> wrong = wrong_in_clusters(problem, map);
    std::vector<double> out(map.size(), 0);
    for (std::uint32_t j = 0; j < problem.height; ++j) {
        for (std::uint32_t i = 0; i < problem.width; ++i) {
            const std::size_t nw = std::size_t{j} * (problem.width + 1) + i, sw = nw + problem.width + 1;
            for (const std::size_t texel : {nw, nw + 1, sw, sw + 1})
                out[texel] += wrong[std::size_t{j} * problem.width + i];
        }
    }
    return out;
}

} // namespace fetexc
