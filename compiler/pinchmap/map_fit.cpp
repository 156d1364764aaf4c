// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/map_fit.h"

#include <array>
#include <cmath>
#include <span>

#include "compiler/error_budget.h"
#include "compiler/parallel.h"
#include "compiler/pinchmap/pinch_frame.h"
#include "compiler/pinchmap/zone_search.h"
#include "compiler/pinchmap/zone_truth.h"

namespace fetexc {
namespace {

/// Clusters: a discontinuity without zones says something of corners so far from the outline.
constexpr double kToldByGamma = 1.5;
/// Searches for other zones, of which the one with the least wrong area counts.
constexpr std::size_t kSearches = 3;

MapFit fit_zones(const Solver& solver, const GammaProblem& problem, const ZoneTruth& truth, std::uint64_t seed) {
    MapFit out;
    ZoneMask mask = majority_mask(truth.parts, problem.width, problem.height);
    out.zones = enforce_constraints(mask, truth);
    if (!truth.costs.empty()) search_zones(mask, truth, seed);
    out.unmendable = unmendable(mask, truth);
    out.map = pinch_frame(mask);
    out.gamma = fit_gamma(solver, problem, out.map);
    return out;
}

/// What corners cost by where discontinuities run if nothing binds them: every texel near the outline is active.
std::vector<SideCosts> costs_without_zones(const Solver& solver, const GammaProblem& problem,
                                           std::span<const double> distances) {
    std::vector<fetex::PinchmapTexel> open(distances.size());
    for (std::size_t k = 0; k < open.size(); ++k)
        open[k].k = std::abs(distances[k]) < kToldByGamma ? 0.0 : std::copysign(1.0, distances[k]);
    fit_gamma(solver, problem, open);
    return side_costs(problem, open, budget::kPinchmapFarWrong);
}

MapFit best_zones(const Solver& solver, const GammaProblem& problem) {
    ZoneTruth truth = zone_truth(problem.silhouette, problem.width, problem.height);
    MapFit best = fit_zones(solver, problem, truth, 0);
    if (best.unmendable < budget::kPinchmapMuch) return best;
    truth.costs = costs_without_zones(solver, problem, truth.distances);
    std::array<MapFit, kSearches> others;
    parallel_for(kSearches, problem.threads, [&](std::size_t k) { others[k] = fit_zones(solver, problem, truth, k); });
    for (MapFit& other : others) {
        if (other.gamma.wrong < best.gamma.wrong) best = std::move(other);
    }
    return best;
}

} // namespace

MapFit fit_map(const Solver& solver, const GammaProblem& problem) {
    MapFit out = best_zones(solver, problem);
    search_gamma(problem, kGammaRounds, out.map, out.gamma);
    return out;
}

} // namespace fetexc
