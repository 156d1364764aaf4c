// SPDX-License-Identifier: GPL-3.0-or-later
/// Maps of 1k … 1M segments at 512², each in a process of its own: time and peak memory must grow no faster than 12
/// times for 10 times the segments. Exit 1 when they do.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

#include "compiler/compile.h"
#include "tests/support/synthetic_map.h"

namespace fetexc::test {
namespace {

constexpr GridSize kSize{512, 512};
constexpr double kMaxGrowth = 12;
constexpr double kMaxMebibytes = 4096;

struct Measured {
    double seconds = 0, mebibytes = 0;
};

/// In a child process: exits 0, or 1 on an error.
[[noreturn]] void compile_map(std::size_t segments) {
    Result<Scene> scene = synthetic_map_builder(1, segments).finish();
    if (!scene) _exit(1);
    const Result<FbtBuild> build = compile_fbt(scene.value(), {kSize, 1, {}});
    if (!build) _exit(1);
    const PlanarStats& s = build.value().report.planar;
    std::printf("%8zu segments: %8llu edges, %8llu grid crossings, %6llu crossings, %4llu of %8llu pairs exact",
                static_cast<std::size_t>(s.segments), static_cast<unsigned long long>(s.edges),
                static_cast<unsigned long long>(s.grid_crossings), static_cast<unsigned long long>(s.crossings),
                static_cast<unsigned long long>(s.pairs_exact), static_cast<unsigned long long>(s.box_pairs));
    std::fflush(stdout);
    _exit(0);
}

bool measure(std::size_t segments, Measured& out) {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) compile_map(segments);
    int status = 0;
    rusage usage{};
    if (child < 0 || wait4(child, &status, 0, &usage) != child || status != 0) return false;
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    out = {seconds(usage.ru_utime) + seconds(usage.ru_stime), static_cast<double>(usage.ru_maxrss) / 1024};
    return true;
}

int run() {
    Measured last;
    bool good = true;
    for (const std::size_t segments :
         {std::size_t{1'000}, std::size_t{10'000}, std::size_t{100'000}, std::size_t{1'000'000}}) {
        Measured m;
        if (!measure(segments, m)) {
            std::printf("%zu segments: failed\n", segments);
            return 1;
        }
        std::printf("; %7.2f s CPU, %6.0f MiB", m.seconds, m.mebibytes);
        if (last.seconds > 0) {
            const double time = m.seconds / last.seconds, memory = m.mebibytes / last.mebibytes;
            std::printf(" (%.1f and %.1f times)", time, memory);
            good = good && time <= kMaxGrowth && memory <= kMaxGrowth;
        }
        std::printf("\n");
        good = good && m.mebibytes < kMaxMebibytes;
        last = m;
    }
    return good ? 0 : 1;
}

} // namespace
} // namespace fetexc::test

int main() { return fetexc::test::run(); }
