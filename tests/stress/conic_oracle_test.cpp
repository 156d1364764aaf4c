// SPDX-License-Identifier: GPL-3.0-or-later
/// Our subdivision of lines and quadratics against CGAL's Arr_conic_traits_2: the same vertices, edges and faces. (Its
/// sweep throws on one scene in some hundreds.)
#include "compiler/geometry/exact.h"
#include "tests/stress/seeds.h"
#include "tests/stress/subdivision_check.h"
#include "tests/support/cgal_oracles.h"
#include "tests/support/random.h"

namespace fetexc::test {
namespace {

std::int64_t cross(LatticePoint o, LatticePoint a, LatticePoint b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// Steps of the grid that control points lie on. Few: shared ends, T-junctions, tangencies, overlaps of lines and of
/// parabolas, several curves through a point. Many: nothing but crossings.
std::int64_t grid_step(Random& random) {
    constexpr std::array<std::int64_t, 4> steps{kDrawingSide / 4, kDrawingSide / 8, kDrawingSide / 64, 1};
    return steps[static_cast<std::size_t>(random.integer(0, 3))];
}

Curve as_curve(const std::vector<LatticePoint>& points) {
    std::array<IntPoint, 4> p{};
    for (std::size_t i = 0; i < points.size(); ++i)
        p[i] = {points[i].x, points[i].y};
    return make_curve(static_cast<int>(points.size()) - 1, p);
}

/// A triangle with straight and bent sides. No two sides share more than points: what a path runs there and back has no
/// edge in our subdivision.
Path triangle(Random& random, std::int64_t step) {
    const int cells = static_cast<int>(kDrawingSide / step);
    const auto point = [&] { return LatticePoint{step * random.integer(0, cells), step * random.integer(0, cells)}; };
    for (;;) {
        const std::array<LatticePoint, 3> corner{point(), point(), point()};
        if (cross(corner[0], corner[1], corner[2]) == 0) continue;
        Path path;
        std::vector<Curve> bent;
        bool good = true;
        for (std::size_t i = 0; i < 3; ++i) {
            const LatticePoint a = corner[i], b = corner[(i + 1) % 3], m = point();
            if (random.chance(0.35)) {
                path.push_back({a, b});
                continue;
            }
            good = good && cross(a, m, b) != 0;
            path.push_back({a, m, b});
            for (const Curve& c : bent) {
                SupportMap map;
                good = good && !same_support(c, as_curve(path.back()), map);
            }
            bent.push_back(as_curve(path.back()));
        }
        if (good) return path;
    }
}

std::vector<Path> drawing(std::uint64_t seed) {
    Random random(seed);
    const std::int64_t step = grid_step(random);
    std::vector<Path> paths(static_cast<std::size_t>(random.integer(2, 5)));
    for (Path& path : paths)
        path = triangle(random, step);
    return paths;
}

TEST(ConicOracle, SameVerticesEdgesAndFaces) {
    OracleTally tally;
    for (std::uint64_t seed : stress_seeds(30))
        tally.compare(drawing(seed), conic_subdivision, "seed " + std::to_string(seed));
    tally.report(0.95);
}

} // namespace
} // namespace fetexc::test
