// SPDX-License-Identifier: GPL-3.0-or-later
/// The compiler's stages on the tiger (or a synthetic map where there is no corpus), one thread.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "compiler/fbt/fbt_builder.h"
#include "compiler/svg/svg.h"
#include "tests/support/synthetic_map.h"

namespace fetexc::test {
namespace {

constexpr std::uint32_t kTexels = 256;

std::vector<std::uint8_t> tiger_bytes() {
    std::ifstream file(std::filesystem::path(FETEXC_CORPUS_DIR) / "classic/Ghostscript_Tiger.svg", std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

Scene load(const std::vector<std::uint8_t>& bytes) {
    std::vector<Diagnostic> diagnostics;
    if (bytes.empty()) return synthetic_map_builder(1, 10'000).finish().value();
    return load_svg(bytes, {}, diagnostics).value();
}

const Scene& scene() {
    static const Scene s = load(tiger_bytes());
    return s;
}

Grid grid() {
    const GridSize size = grid_for(scene().extent, kTexels);
    return make_grid(scene().extent, size.width, size.height);
}

void front_end(benchmark::State& state) {
    const std::vector<std::uint8_t> bytes = tiger_bytes();
    if (bytes.empty()) state.SkipWithError("no corpus here");
    for (auto _ : state)
        benchmark::DoNotOptimize(load(bytes));
}

void prepare(benchmark::State& state) {
    for (auto _ : state) {
        PlanarStats stats;
        benchmark::DoNotOptimize(prepare_arcs(scene(), grid(), {}, stats));
    }
}

void arrangement(benchmark::State& state) {
    PlanarStats stats;
    for (auto _ : state)
        benchmark::DoNotOptimize(arrange(scene(), grid(), 1, stats));
    state.counters["pairs"] = static_cast<double>(stats.box_pairs);
    state.counters["exact"] = static_cast<double>(stats.pairs_exact);
    state.counters["crossings"] = static_cast<double>(stats.crossings);
}

void planar_map(benchmark::State& state) {
    PlanarStats stats;
    for (auto _ : state)
        benchmark::DoNotOptimize(PlanarMap::build(scene(), grid(), 1, stats));
    state.counters["grid_crossings"] = static_cast<double>(stats.grid_crossings);
}

/// All texels with edges, by the direct sweep or by CGAL.
void texels(benchmark::State& state, bool direct) {
    PlanarStats stats;
    const PlanarMap map = PlanarMap::build(scene(), grid(), 1, stats).value();
    Compositor compositor(scene());
    SkipRules skip;
    skip.direct_sweep = direct;
    for (auto _ : state) {
        TexelMapper mapper(map, scene(), compositor, stats, skip);
        TexelMap texel;
        for (std::uint32_t j = 0; j < map.grid().height; ++j) {
            map.along_row(j, [&](std::uint32_t i, const Windings& corner) {
                if (i == map.grid().width || map.sub_edges(i, j).empty()) return;
                if (!mapper.analyse(i, j, corner, texel)) state.SkipWithError("inconsistent");
            });
        }
    }
}

void fbt(benchmark::State& state) {
    const GridSize size = grid_for(scene().extent, kTexels);
    for (auto _ : state)
        benchmark::DoNotOptimize(compile_fbt(scene(), {size, 1, {}}));
}

BENCHMARK(front_end)->Unit(benchmark::kMillisecond);
BENCHMARK(prepare)->Unit(benchmark::kMillisecond);
BENCHMARK(arrangement)->Unit(benchmark::kMillisecond);
BENCHMARK(planar_map)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(texels, direct_sweep, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(texels, cgal, false)->Unit(benchmark::kMillisecond);
BENCHMARK(fbt)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace fetexc::test

BENCHMARK_MAIN();
