// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/map_fit.h"

#include <cmath>

#include "compiler/error_budget.h"
#include "compiler/pinchmap/pinch_frame.h"
#include "compiler/pinchmap/zone_truth.h"

namespace fetexc {
namespace {

/// Clusters: a discontinuity without zones says something of corners so far from the outline.
constexpr double kToldByGamma = 1.5;

MapFit fit_zones(const Solver& solver, const GammaProblem& problem, const ZoneTruth& truth) {
    MapFit out;
    ZoneMask mask = majority_mask(truth.parts, problem.width, problem.height);
    out.zones = enforce_constraints(mask, truth);
    out.unmendable = unmendable(mask, truth);
    out.map = pinch_frame(mask);
    out.gamma = fit_gamma(solver, problem, out.map);
    return out;
}

} // namespace

MapFit fit_map(const Solver& solver, const GammaProblem& problem) {
    ZoneTruth truth = zone_truth(problem.silhouette, problem.width, problem.height);
    MapFit best = fit_zones(solver, problem, truth);
    if (best.unmendable < budget::kPinchmapMuch) return best;
    // Every texel near the outline active: any γ there can be anything.
    std::vector<fetex::PinchmapTexel> open(truth.distances.size());
    for (std::size_t k = 0; k < open.size(); ++k) {
        const double above = truth.distances[k];
        open[k].k = std::abs(above) < kToldByGamma ? 0.0 : std::copysign(1.0, above);
    }
    fit_gamma(solver, problem, open);
    for (std::size_t k = 0; k < open.size(); ++k) {
        if (open[k].k == 0 && open[k].gamma != 0) truth.distances[k] = -open[k].gamma;
    }
    MapFit other = fit_zones(solver, problem, truth);
    return other.gamma.wrong < best.gamma.wrong ? other : best;
}

} // namespace fetexc
