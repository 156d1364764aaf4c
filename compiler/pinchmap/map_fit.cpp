// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/map_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "compiler/error_budget.h"
#include "compiler/parallel.h"
#include "compiler/pinchmap/pinch_frame.h"
#include "compiler/pinchmap/zone_patches.h"
#include "compiler/pinchmap/zone_search.h"
#include "compiler/pinchmap/zone_truth.h"

namespace fetexc {
namespace {

using fetex::PinchmapTexel;

/// Clusters: a discontinuity without zones says something of corners so far from the outline.
constexpr double kToldByGamma = 1.5;
/// For other zones.
constexpr std::size_t kSearches = 3;
/// Clusters: what a cluster's zone changes by way of other texels' γ reaches so far, nearly all of it.
constexpr std::int64_t kReach = 2;

/// Zones with their fit.
struct ZonedFit {
    ZoneMask mask;
    std::vector<PinchmapTexel> map;
    GammaFit gamma;
};

ZonedFit fit_zones(const Solver& solver, const GammaProblem& problem, ZoneMask mask) {
    ZonedFit out{std::move(mask), {}, {}};
    out.map = pinch_frame(out.mask);
    out.gamma = fit_gamma(solver, problem, out.map);
    return out;
}

/// What corners cost by where discontinuities run if nothing binds them: every texel near the outline is active.
std::vector<SideCosts> costs_without_zones(const Solver& solver, const GammaProblem& problem,
                                           std::span<const double> distances) {
    std::vector<PinchmapTexel> open(distances.size());
    for (std::size_t k = 0; k < open.size(); ++k)
        open[k].k = std::abs(distances[k]) < kToldByGamma ? 0.0 : std::copysign(1.0, distances[k]);
    fit_gamma(solver, problem, open);
    return side_costs(problem, open, budget::kPinchmapFarWrong);
}

/// Of several searches.
std::vector<ZoneMask> searched_zones(const GammaProblem& problem, const ZoneTruth& truth) {
    ZoneMask mask = majority_mask(truth.parts, problem.width, problem.height);
    enforce_constraints(mask, truth);
    std::vector<ZoneMask> found(kSearches, mask);
    parallel_for(kSearches, problem.threads, [&](std::size_t k) { search_zones(found[k], truth, k); });
    return found;
}

/// Visits the clusters at most `reach` from cluster k.
template <class Visit> void each_near(const ZoneMask& mask, std::size_t k, std::int64_t reach, const Visit& visit) {
    const auto i = static_cast<std::int64_t>(k % mask.width), j = static_cast<std::int64_t>(k / mask.width);
    for (std::int64_t y = std::max<std::int64_t>(j - reach, 0); y <= std::min<std::int64_t>(j + reach, mask.height - 1);
         ++y) {
        for (std::int64_t x = std::max<std::int64_t>(i - reach, 0);
             x <= std::min<std::int64_t>(i + reach, mask.width - 1); ++x)
            visit(static_cast<std::size_t>(y * mask.width + x));
    }
}

/// By how much less is wrong in and around each patch of the other, square clusters.
std::vector<double> gains(const GammaProblem& problem, const ZonePatches& patches, const ZonedFit& one,
                          const ZonedFit& other) {
    const std::vector<double> before = wrong_in_clusters(problem, one.map),
                              after = wrong_in_clusters(problem, other.map);
    std::vector<double> out(patches.count, 0);
    std::vector<std::vector<std::uint32_t>> near(before.size());
    for (std::size_t k = 0; k < before.size(); ++k) {
        if (patches.of[k] == ZonePatches::kNone) continue;
        each_near(one.mask, k, kReach, [&](std::size_t at) {
            if (std::ranges::find(near[at], patches.of[k]) == near[at].end()) near[at].push_back(patches.of[k]);
        });
    }
    for (std::size_t k = 0; k < near.size(); ++k) {
        for (const std::uint32_t patch : near[k])
            out[patch] += before[k] - after[k];
    }
    return out;
}

/// Takes from the other fit the places where it has less of the drawing on the wrong side.
void take_better_patches(const GammaProblem& problem, const ZonePatches& patches, ZonedFit& one,
                         const ZonedFit& other) {
    const std::vector<double> gain = gains(problem, patches, one, other);
    std::vector<std::uint8_t> taken(one.map.size(), 0);
    for (std::size_t k = 0; k < patches.of.size(); ++k) {
        if (patches.of[k] == ZonePatches::kNone || !(gain[patches.of[k]] > 0)) continue;
        one.mask.above[k] = other.mask.above[k];
        each_near(one.mask, k, 1, [&](std::size_t at) {
            const std::size_t nw = at / one.mask.width * (one.mask.width + 1) + at % one.mask.width,
                              sw = nw + one.mask.width + 1;
            for (const std::size_t texel : {nw, nw + 1, sw, sw + 1})
                taken[texel] = 1;
        });
    }
    const std::vector<PinchmapTexel> frame = pinch_frame(one.mask);
    for (std::size_t t = 0; t < frame.size(); ++t) {
        const double gamma = (taken[t] != 0 ? other : one).map[t].gamma;
        one.map[t] = frame[t], one.map[t].gamma = gamma;
    }
}

/// The better one of both and of what has the better places of each.
ZonedFit better_of(const GammaProblem& problem, ZonedFit one, ZonedFit other) {
    ZonedFit& best = one.gamma.wrong <= other.gamma.wrong ? one : other;
    const ZonePatches patches = patches_between(one.mask, other.mask);
    if (patches.count == 0) return std::move(best);
    ZonedFit both = one;
    take_better_patches(problem, patches, both, other);
    settle_gamma(problem, both.map, both.gamma);
    return std::move(both.gamma.wrong < best.gamma.wrong ? both : best);
}

} // namespace

MapFit fit_map(const Solver& solver, const GammaProblem& problem) {
    ZoneTruth truth = zone_truth(problem.silhouette, problem.width, problem.height);
    ZoneMask mask = majority_mask(truth.parts, problem.width, problem.height);
    MapFit out;
    out.zones = enforce_constraints(mask, truth);
    out.unmendable = unmendable(mask, truth);
    ZonedFit best = fit_zones(solver, problem, std::move(mask));
    if (out.unmendable >= budget::kPinchmapMuch) {
        truth.costs = costs_without_zones(solver, problem, truth.distances);
        std::vector<ZoneMask> found = searched_zones(problem, truth);
        std::array<ZonedFit, kSearches> others;
        parallel_for(kSearches, problem.threads,
                     [&](std::size_t k) { others[k] = fit_zones(solver, problem, std::move(found[k])); });
        for (ZonedFit& other : others)
            best = better_of(problem, std::move(best), std::move(other));
        out.unmendable = unmendable(best.mask, truth);
    }
    out.map = std::move(best.map), out.gamma = std::move(best.gamma);
    search_gamma(problem, kGammaRounds, out.map, out.gamma);
    return out;
}

} // namespace fetexc
