// SPDX-License-Identifier: Apache-2.0 OR MIT
/// What a sampler costs in plain bilinear lookups. Times of a busy machine drift by tens of per cent from second to
/// second, so both are drawn alternately in one process and each pair gives a ratio of its own; the median of those is
/// the cost.
#pragma once

#include <functional>

#include "runtime_glsl/host/renderer.h"

namespace fetex {

/// Ratios over the rounds.
struct SamplerCost {
    double median = 0, lower_quartile = 0, upper_quartile = 0;
    std::uint32_t rounds = 0;
};

struct CostOptions {
    View view = {};           ///< what is drawn of the texture
    std::uint32_t side = 512; ///< pixels, at most kTileSide
    std::uint32_t rounds = 11;
};

/// A renderer for timing: where Mesa draws in software, in this thread alone. LP_NUM_THREADS is set to 0 for the whole
/// process, and only the first context of a process heeds it. Not while other threads read the environment.
Outcome<Renderer> open_for_timing(Backend backend = Backend::OSMesa);

/// Cost of a sampler with what was uploaded for it, against Sampler::Bilinear with the uploaded bitmap, a small one
/// being uploaded if there is none. Sampler::Bilinear itself costs 1, but for noise.
Outcome<SamplerCost> sampler_cost(Renderer& renderer, Sampler sampler, const CostOptions& options = {});

/// The statistics alone: time_draws(plain, draws) gives the seconds of that many draws of one of both. One pair goes
/// ahead uncounted (shaders are compiled then) and says how many draws make a time that a clock can tell.
using TimeDraws = std::function<Outcome<double>(bool plain, std::uint32_t draws)>;
Outcome<SamplerCost> paired_cost(const TimeDraws& time_draws, std::uint32_t rounds);

} // namespace fetex
