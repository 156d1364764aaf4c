// SPDX-License-Identifier: GPL-3.0-or-later
/// Our subdivision of x-monotone cubics against CGAL's Arr_Bezier_curve_traits_2 where that finishes: the same
/// vertices, edges and faces. CGAL's runs in a process of its own, because it throws, crashes or hangs on some scenes.
#include "tests/stress/seeds.h"
#include "tests/stress/subdivision_check.h"
#include "tests/support/cgal_oracles.h"
#include "tests/support/random.h"

namespace fetexc::test {
namespace {

constexpr int kSide = static_cast<int>(kDrawingSide);

/// From `from` to `to`, which lies right of it, with inner control points between them along x.
std::vector<LatticePoint> monotone_cubic(Random& random, LatticePoint from, LatticePoint to) {
    std::int64_t x1 = random.integer(static_cast<int>(from.x), static_cast<int>(to.x));
    std::int64_t x2 = random.integer(static_cast<int>(from.x), static_cast<int>(to.x));
    if (x1 > x2) std::swap(x1, x2);
    return {from, {x1, random.integer(0, kSide)}, {x2, random.integer(0, kSide)}, to};
}

/// Left to right in one or two cubics.
Path chain(Random& random, LatticePoint from, LatticePoint to) {
    if (random.chance(0.6)) return {monotone_cubic(random, from, to)};
    const LatticePoint middle{(from.x + to.x) / 2, random.integer(0, kSide)};
    return {monotone_cubic(random, from, middle), monotone_cubic(random, middle, to)};
}

/// There along one chain, back along another.
Path lens(Random& random, LatticePoint from, LatticePoint to) {
    Path path = chain(random, from, to);
    Path back = chain(random, from, to);
    std::reverse(back.begin(), back.end());
    for (auto& segment : back) {
        std::reverse(segment.begin(), segment.end());
        path.push_back(segment);
    }
    return path;
}

/// Some share their ends.
std::vector<Path> drawing(std::uint64_t seed) {
    Random random(seed);
    std::vector<Path> paths(static_cast<std::size_t>(random.integer(2, 4)));
    LatticePoint from, to;
    for (std::size_t k = 0; k < paths.size(); ++k) {
        if (k == 0 || !random.chance(0.2)) from = {random.integer(0, kSide / 2 - 64), random.integer(0, kSide)};
        if (k == 0 || !random.chance(0.2)) to = {random.integer(kSide / 2 + 64, kSide), random.integer(0, kSide)};
        paths[k] = lens(random, from, to);
    }
    return paths;
}

TEST(BezierOracle, SameVerticesEdgesAndFacesWhereItFinishes) {
    OracleTally tally;
    for (std::uint64_t seed : stress_seeds(50))
        tally.compare(drawing(seed), bezier_subdivision, "seed " + std::to_string(seed));
    tally.report(0.9);
}

} // namespace
} // namespace fetexc::test
