// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "runtime_glsl/host/sampler_cost.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace fetex {
namespace {

constexpr double kShortestTime = 1e-3; ///< seconds of a plain draw; both clocks tick in less than a microsecond
constexpr std::uint32_t kMostDraws = 10000, kPlainSide = 256;

/// Linear between the sorted values, as most statistics programs have it.
double quantile(const std::vector<double>& sorted, double share) {
    const double at = share * static_cast<double>(sorted.size() - 1);
    const auto k = static_cast<std::size_t>(at);
    const double next = sorted[std::min(k + 1, sorted.size() - 1)];
    return sorted[k] + (next - sorted[k]) * (at - static_cast<double>(k));
}

std::uint32_t draws_needed(double seconds_of_one) {
    if (!(seconds_of_one > kShortestTime / kMostDraws)) return kMostDraws;
    return static_cast<std::uint32_t>(std::max(1.0, std::ceil(kShortestTime / seconds_of_one)));
}

/// One pair, the plain draw first or second. A clock that doesn't move gives no ratio.
Outcome<double> one_ratio(const TimeDraws& time_draws, bool plain_first, std::uint32_t draws) {
    double seconds[2] = {};
    for (const bool plain : {plain_first, !plain_first}) {
        const auto time = time_draws(plain, draws);
        if (!time) return time.error();
        seconds[plain] = time.value();
    }
    if (!(seconds[1] > 0)) return RuntimeError{RuntimeErrc::OutOfMemoryOrLost, "a draw took no time by the clock"};
    return seconds[0] / seconds[1];
}

} // namespace

Outcome<SamplerCost> paired_cost(const TimeDraws& time_draws, std::uint32_t rounds) {
    if (rounds == 0) return RuntimeError{RuntimeErrc::BadView, "a cost needs at least one round"};
    // Shaders are compiled by the first draw of each; the second is timed.
    std::uint32_t draws = 1;
    for (const bool plain : {false, true, true}) {
        const auto time = time_draws(plain, 1);
        if (!time) return time.error();
        draws = draws_needed(time.value());
    }
    std::vector<double> ratios;
    for (std::uint32_t round = 0; round < rounds; ++round) {
        const auto ratio = one_ratio(time_draws, round % 2 == 0, draws);
        if (!ratio) return ratio.error();
        ratios.push_back(ratio.value());
    }
    std::sort(ratios.begin(), ratios.end());
    return SamplerCost{quantile(ratios, 0.5), quantile(ratios, 0.25), quantile(ratios, 0.75), rounds};
}

Outcome<Renderer> open_for_timing(Backend backend) {
    setenv("LP_NUM_THREADS", "0", 1);
    return Renderer::open(backend);
}

Outcome<SamplerCost> sampler_cost(Renderer& renderer, Sampler sampler, const CostOptions& options) {
    if (!renderer.has_bitmap()) {
        const std::vector<std::uint8_t> grey(std::size_t{kPlainSide} * kPlainSide * 4, 77);
        if (auto bad = renderer.upload_bitmap(grey, kPlainSide, kPlainSide)) return *bad;
    }
    return paired_cost(
        [&](bool plain, std::uint32_t draws) {
            return renderer.time_draws(plain ? Sampler::Bilinear : sampler, options.view, options.side, draws);
        },
        options.rounds);
}

} // namespace fetex
