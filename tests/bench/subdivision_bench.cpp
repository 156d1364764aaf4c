// SPDX-License-Identifier: GPL-3.0-or-later
/// Our planar subdivision against CGAL's Arr_Bezier_curve_traits_2 on the same curves, in one run: processor time of
/// one thread, and the ratio. CGAL's runs in a process of its own under a limit of time: it throws on some input, and
/// may take minutes.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "compiler/svg/svg.h"
#include "tests/support/cgal_oracles.h"
#include "tests/support/forked.h"
#include "tests/support/random.h"

namespace fetexc::test {
namespace {

/// What a scene gave, on either side.
struct Outcome {
    double seconds = 0; ///< mean
    bool finished = false;
    std::size_t vertices = 0, edges = 0, faces = 0;
};

struct Case {
    std::string name;
    Scene scene;
    double target = 0; ///< times faster
    Outcome ours, theirs;
};

double limit_in_seconds() {
    const char* text = std::getenv("FETEXC_BENCH_LIMIT");
    return text != nullptr ? std::stod(text) : 240;
}

std::vector<Path> paths_of(const Scene& scene) {
    std::vector<Path> paths(scene.shapes.size());
    for (std::size_t k = 0; k < paths.size(); ++k) {
        const Shape& shape = scene.shapes[k];
        for (std::uint32_t i = shape.first; i < shape.first + shape.count; ++i) {
            const Segment& s = scene.segments[i];
            paths[k].emplace_back(s.p.begin(), s.p.begin() + s.degree + 1);
        }
    }
    return paths;
}

/// The canvas made as large as the drawing, so that both sides have the same to do: nothing is done off the canvas.
void fit_canvas(Scene& scene) {
    LatticePoint lo = scene.segments.front().p[0], hi = lo;
    const auto each_point = [&](const auto& visit) {
        for (Segment& s : scene.segments)
            std::for_each(s.p.begin(), s.p.begin() + s.degree + 1, visit);
    };
    each_point([&](const LatticePoint& p) {
        lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
        hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
    });
    each_point([&](LatticePoint& p) { p = {p.x - lo.x, p.y - lo.y}; });
    scene.extent.lattice_w = hi.x - lo.x, scene.extent.lattice_h = hi.y - lo.y;
}

/// The first `count` segments, each a shape of its own: what one shape runs there and back has no edge in ours.
Scene first_segments(Scene scene, std::uint32_t count) {
    scene.segments.resize(std::min<std::size_t>(scene.segments.size(), count));
    scene.shapes.clear();
    for (std::uint32_t k = 0; k < scene.segments.size(); ++k)
        scene.shapes.push_back({k, 1, FillRule::EvenOdd, kNone});
    scene.nodes.clear();
    scene.root_end = 0;
    fit_canvas(scene);
    return scene;
}

/// x-monotone cubics right across the canvas.
Scene random_cubics(std::uint64_t seed, std::size_t count) {
    constexpr int side = 1 << 12;
    Random random(seed);
    const auto between = [&](int lo, int hi) { return static_cast<std::int64_t>(random.integer(lo, hi)); };
    std::vector<Path> paths;
    for (std::size_t k = 0; k < count; ++k) {
        std::array<std::int64_t, 2> inner{between(side / 8, 7 * side / 8), between(side / 8, 7 * side / 8)};
        std::sort(inner.begin(), inner.end());
        paths.push_back({{{between(0, side / 8), between(0, side)},
                          {inner[0], between(0, side)},
                          {inner[1], between(0, side)},
                          {between(7 * side / 8, side), between(0, side)}}});
    }
    return scene_of(paths, FillRule::EvenOdd, kLatticeSteps / side);
}

std::vector<Case> all_cases() {
    std::vector<Case> cases;
    const std::filesystem::path tiger = std::filesystem::path(FETEXC_CORPUS_DIR) / "classic" / "Ghostscript_Tiger.svg";
    std::ifstream in(tiger, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    std::vector<Diagnostic> diagnostics;
    const Result<Scene> scene =
        load_svg({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, {}, diagnostics);
    if (scene)
        cases.push_back({"tiger, first 500 segments", first_segments(scene.value(), 500), 1000, {}, {}});
    else
        std::printf("no corpus on this machine: the tiger is left out\n");
    cases.push_back({"130 random x-monotone cubics", random_cubics(1, 130), 100, {}, {}});
    return cases;
}

void run_ours(benchmark::State& state, Case& c) {
    const Grid grid = make_grid(c.scene.extent, 1, 1);
    double sum = 0;
    for (auto _ : state) {
        PlanarStats stats;
        const std::clock_t start = std::clock();
        const Result<Arrangement> arrangement = arrange(c.scene, grid, 1, stats);
        const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        state.SetIterationTime(seconds);
        if (!arrangement) return state.SkipWithError(arrangement.error().message.c_str());
        const Subdivision s = subdivision_of(arrangement.value(), 1);
        sum += seconds;
        c.ours = {0, true, s.vertices.size(), s.edges.size(), s.faces};
        state.counters["crossings"] = static_cast<double>(stats.crossings);
    }
    c.ours.seconds = sum / static_cast<double>(state.iterations());
}

void run_theirs(benchmark::State& state, Case& c) {
    const std::vector<Path> paths = paths_of(c.scene);
    for (auto _ : state) {
        const ForkedRun run = run_forked(
            [&] {
                const InsertionTiming t = time_bezier_insertion(paths);
                return std::vector<double>{t.seconds, static_cast<double>(t.vertices), static_cast<double>(t.edges),
                                           static_cast<double>(t.faces)};
            },
            limit_in_seconds());
        if (run.ended == Ended::Threw || run.ended == Ended::Crashed)
            return state.SkipWithError("CGAL's Bezier traits threw or crashed");
        const bool finished = run.ended == Ended::Finished;
        c.theirs = {finished ? run.output[0] : run.seconds, finished};
        if (finished) {
            c.theirs.vertices = static_cast<std::size_t>(run.output[1]);
            c.theirs.edges = static_cast<std::size_t>(run.output[2]);
            c.theirs.faces = static_cast<std::size_t>(run.output[3]);
        }
        state.SetIterationTime(c.theirs.seconds);
    }
}

/// Vertices and edges themselves differ: CGAL's splits at extrema along x only, ours along y, too.
std::string counts(const Outcome& o) {
    return std::to_string(o.faces) + " faces, E - V = " + std::to_string(o.edges - o.vertices);
}

/// False when the two subdivisions differ or the target is missed.
bool print_ratio(const Case& c) {
    if (!c.ours.finished || c.theirs.seconds == 0) {
        std::printf("%s: no ratio, one side failed\n", c.name.c_str());
        return false;
    }
    const bool same = !c.theirs.finished || counts(c.ours) == counts(c.theirs);
    const double ratio = c.theirs.seconds / c.ours.seconds;
    std::printf("%s: ours %.4f s (%s), CGAL's Bezier traits %s%.1f s (%s): %s%.0f times (target: %.0f)%s\n",
                c.name.c_str(), c.ours.seconds, counts(c.ours).c_str(), c.theirs.finished ? "" : "more than ",
                c.theirs.seconds, c.theirs.finished ? counts(c.theirs).c_str() : "not finished",
                c.theirs.finished ? "" : "at least ", ratio, c.target, same ? "" : " DIFFERENT SUBDIVISIONS");
    return same && ratio >= c.target;
}

} // namespace
} // namespace fetexc::test

int main(int argc, char** argv) {
    using namespace fetexc::test;
    benchmark::Initialize(&argc, argv);
    std::vector<Case> cases = all_cases();
    for (Case& c : cases) {
        benchmark::RegisterBenchmark(("ours/" + c.name).c_str(), [&](benchmark::State& s) { run_ours(s, c); })
            ->UseManualTime()
            ->Unit(benchmark::kMillisecond);
        benchmark::RegisterBenchmark(("CGAL/" + c.name).c_str(), [&](benchmark::State& s) { run_theirs(s, c); })
            ->UseManualTime()
            ->Iterations(1)
            ->Unit(benchmark::kMillisecond);
    }
    benchmark::RunSpecifiedBenchmarks();
    bool good = true;
    for (const Case& c : cases)
        good = print_ratio(c) && good;
    return good ? 0 : 1;
}
