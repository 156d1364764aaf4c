// SPDX-License-Identifier: GPL-3.0-or-later
/// Textures with feature curves at 512 × 512 texels from networks of 10,000 lines, or quadratics, in memory: the whole
/// and its stages, by processor time of all threads and by the clock.
#include <benchmark/benchmark.h>

#include "compiler/feature_curves/distance_map.h"
#include "compiler/feature_curves/feature_curves_builder.h"
#include "compiler/feature_curves/lattice_lines.h"
#include "tests/support/random.h"

namespace fetexc::test {
namespace {

constexpr std::uint32_t kTexels = 512;
constexpr int kCurves = 10'000;

/// Control points of a curve follow each other within `reach` texels in x and in y, or are anywhere (0).
Network network_of(int degree, double reach) {
    Random random(1);
    Network n{kTexels, kTexels, {}};
    const auto anywhere = [&] { return CanvasPoint{random.between(0, kTexels), random.between(0, kTexels)}; };
    for (int k = 0; k < kCurves; ++k) {
        CanvasSegment s{degree, {anywhere()}};
        for (std::size_t at = 1; at <= static_cast<std::size_t>(degree); ++at) {
            const double step = reach / degree;
            s.p[at] = reach > 0 ? CanvasPoint{s.p[at - 1].x + random.between(-step, step),
                                              s.p[at - 1].y + random.between(-step, step)}
                                : anywhere();
        }
        n.curves.push_back({"", {s}, false, "", {}, {}});
    }
    return n;
}

const Network& short_lines() {
    static const Network n = network_of(1, 20);
    return n;
}
const Network& long_lines() {
    static const Network n = network_of(1, 0);
    return n;
}
const Network& quadratics() {
    static const Network n = network_of(2, 20);
    return n;
}

using Input = const Network& (*)();

FeatureCurvesOptions options_of(const benchmark::State& state) {
    FeatureCurvesOptions options;
    options.size = {kTexels, kTexels}, options.threads = static_cast<unsigned>(state.range(0));
    return options;
}

void whole(benchmark::State& state, Input input) {
    const Network& network = input();
    for (auto _ : state)
        benchmark::DoNotOptimize(compile_feature_curves(network, options_of(state)));
}

void lattice(benchmark::State& state, Input input) {
    const Network& network = input();
    for (auto _ : state)
        benchmark::DoNotOptimize(lattice_lines(network, kTexels, kTexels));
}

void snapping(benchmark::State& state, Input input) {
    const LatticeLines lines = lattice_lines(input(), kTexels, kTexels).value();
    for (auto _ : state)
        benchmark::DoNotOptimize(snap_lines(lines, kTexels, kTexels, options_of(state).threads));
}

/// From the curves as the texture has them.
void distances(benchmark::State& state, Input input) {
    const FeatureCurvesBuild build = compile_feature_curves(input(), options_of(state)).value();
    for (auto _ : state) {
        const TextureSegments segments(build.texture);
        benchmark::DoNotOptimize(distance_map(segments, build.texture.distance_limit, options_of(state).threads));
    }
}

void smoothing(benchmark::State& state, Input input) {
    const FeatureCurvesBuild build = compile_feature_curves(input(), options_of(state)).value();
    DistanceMap map = distance_map(TextureSegments(build.texture), build.texture.distance_limit, 0);
    for (auto _ : state)
        smooth_gradients(map, build.texture, kGradientIterations, options_of(state).threads);
}

void all(benchmark::internal::Benchmark* b) {
    b->Arg(1)->Arg(2)->ArgName("threads")->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
}

#define FETEXC_LINES(stage)                                                                                            \
    BENCHMARK_CAPTURE(stage, short_lines, short_lines)->Apply(all);                                                    \
    BENCHMARK_CAPTURE(stage, long_lines, long_lines)->Apply(all)

FETEXC_LINES(whole);
BENCHMARK_CAPTURE(whole, quadratics, quadratics)->Apply(all);
FETEXC_LINES(lattice);
FETEXC_LINES(snapping);
FETEXC_LINES(distances);
FETEXC_LINES(smoothing);

} // namespace
} // namespace fetexc::test

BENCHMARK_MAIN();
