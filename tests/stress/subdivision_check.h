// SPDX-License-Identifier: GPL-3.0-or-later
/// Our subdivision of a drawing, and the drawing moved in ways that change no vertex, edge or face.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>

#include "tests/support/forked.h"
#include "tests/support/subdivision.h"

namespace fetexc::test {

/// Drawings of the oracles lie in [0, kDrawingSide]²; the canvas is four times as wide, so that shears stay inside.
inline constexpr std::int64_t kDrawingSide = 1 << 12;
inline constexpr std::int64_t kDrawingUnit = kLatticeSteps / (4 * kDrawingSide);

inline Subdivision our_subdivision(const std::vector<Path>& paths, const std::string& what) {
    const Scene scene = scene_of(paths, FillRule::EvenOdd, kDrawingUnit);
    PlanarStats stats;
    const Result<Arrangement> arrangement = arrange(scene, make_grid(scene.extent, 1, 1), 1, stats);
    if (!arrangement) {
        ADD_FAILURE() << what << ": " << arrangement.error().message << " " << arrangement.error().place;
        return {};
    }
    return without_splits(subdivision_of(arrangement.value(), static_cast<double>(kDrawingUnit)), paths);
}

using Map = std::function<LatticePoint(LatticePoint)>;

inline std::vector<Path> mapped(std::vector<Path> paths, const Map& map) {
    for (Path& path : paths) {
        for (auto& segment : path)
            std::transform(segment.begin(), segment.end(), segment.begin(), map);
    }
    return paths;
}

/// F and E − V are those of the drawing as it is (split points at extrema, which depend on the axes, taken out).
inline void expect_same_when_moved(const std::vector<Path>& paths, const Subdivision& expected,
                                   const std::string& what) {
    const std::vector<std::pair<const char*, Map>> maps = {
        {"transposed",
         [](LatticePoint p) {
             return LatticePoint{p.y, p.x};
         }},
        {"mirrored",
         [](LatticePoint p) {
             return LatticePoint{kDrawingSide - p.x, p.y};
         }},
        {"sheared along x",
         [](LatticePoint p) {
             return LatticePoint{p.x + 2 * p.y, p.y};
         }},
        {"sheared along y",
         [](LatticePoint p) {
             return LatticePoint{p.x, p.y + 3 * p.x};
         }},
    };
    for (const auto& [name, map] : maps) {
        const Subdivision moved = our_subdivision(mapped(paths, map), what + " " + name);
        EXPECT_EQ(moved.faces, expected.faces) << what << " " << name;
        EXPECT_EQ(moved.vertices.size(), expected.vertices.size()) << what << " " << name;
        EXPECT_EQ(moved.edges.size(), expected.edges.size()) << what << " " << name;
    }
}

/// Scenes compared with an oracle, and how it ended on them.
class OracleTally {
  public:
    /// `oracle`: paths to subdivision; runs in a process of its own, since it may throw, crash or hang.
    template <class Oracle>
    void compare(const std::vector<Path>& paths, const Oracle& oracle, const std::string& what) {
        constexpr double seconds = 20, tolerance = 1e-6;
        const Subdivision ours = our_subdivision(paths, what);
        expect_same_when_moved(paths, ours, what);
        const ForkedRun run = run_forked([&] { return packed(oracle(paths)); }, seconds);
        ++ended_[static_cast<std::size_t>(run.ended)];
        if (run.ended != Ended::Finished) {
            std::printf("%s: the oracle did not finish\n", what.c_str());
            return;
        }
        EXPECT_EQ(difference(ours, without_splits(unpacked(run.output), paths), tolerance), "") << what;
        vertices_ += ours.vertices.size(), edges_ += ours.edges.size(), faces_ += ours.faces;
    }

    /// Fails when the oracle finished on less than `share` of the scenes.
    void report(double share) const {
        const std::size_t scenes = ended_[0] + ended_[1] + ended_[2] + ended_[3], finished = count(Ended::Finished);
        std::printf("%zu scenes, the oracle finished on %zu: %zu vertices, %zu edges, %zu faces compared; it threw on "
                    "%zu, crashed on %zu, ran out of time on %zu\n",
                    scenes, finished, vertices_, edges_, faces_, count(Ended::Threw), count(Ended::Crashed),
                    count(Ended::TimedOut));
        EXPECT_GE(static_cast<double>(finished), share * static_cast<double>(scenes)) << "too few to compare with";
    }

  private:
    [[nodiscard]] std::size_t count(Ended e) const { return ended_[static_cast<std::size_t>(e)]; }

    std::array<std::size_t, 4> ended_{};
    std::size_t vertices_ = 0, edges_ = 0, faces_ = 0;
};

} // namespace fetexc::test
