// SPDX-License-Identifier: GPL-3.0-or-later
/// The oracle of the stress tests: winding numbers, positions and areas in integer arithmetic.
#include <gtest/gtest.h>

#include "tests/support/exact_winding.h"

namespace fetexc::test {
namespace {

/// x, y in steps plus a tiny odd part, so that no coordinate is an integer.
ExactPoint point(std::int64_t x, std::int64_t y, int dx = 1, int dy = 1) {
    const auto exact = [](std::int64_t v, int d) -> mpz_class {
        return (mpz_class(static_cast<long>(v)) << kPointBits) + d;
    };
    return {exact(x, dx), exact(y, dy)};
}

PlanarCurve line(std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1) {
    return {1, {x0, x1, 0, 0}, {y0, y1, 0, 0}};
}

/// Down on the left, so its inside has winding number 1.
const std::vector<PlanarCurve> kSquare = {line(0, 0, 0, 10), line(0, 10, 10, 10), line(10, 10, 10, 0),
                                          line(10, 0, 0, 0)};

TEST(ExactWinding, CountsDownwardCrossingsOnTheLeft) {
    EXPECT_EQ(winding_at(kSquare, point(5, 5)), 1);
    EXPECT_EQ(winding_at(kSquare, point(-5, 5)), 0);
    EXPECT_EQ(winding_at(kSquare, point(15, 5)), 0);
    EXPECT_EQ(winding_at(kSquare, point(5, 15)), 0);
    EXPECT_EQ(winding_at(kSquare, point(5, -1)), 0);
    std::vector<PlanarCurve> back;
    for (const PlanarCurve& c : kSquare)
        back.push_back(line(c.x[1], c.y[1], c.x[0], c.y[0]));
    EXPECT_EQ(winding_at(back, point(5, 5)), -1);
}

TEST(ExactWinding, TellsSidesAPartIn2To240Apart) {
    EXPECT_EQ(winding_at(kSquare, point(0, 5, 1, 1)), 1);
    EXPECT_EQ(winding_at(kSquare, point(0, 5, -1, 1)), 0);
    EXPECT_EQ(winding_at(kSquare, point(5, 10, 1, -1)), 1);
    EXPECT_EQ(winding_at(kSquare, point(5, 10, 1, 1)), 0);
}

TEST(ExactWinding, FollowsCurvesAndLoops) {
    // y = x(8 − x)/8 upside down: apex (4, 2), closed along its chord.
    const std::vector<PlanarCurve> arch = {{2, {0, 4, 8, 0}, {0, 4, 0, 0}}, line(8, 0, 0, 0)};
    ExactPoint below_apex = point(4, 2), above_apex = point(4, 2); // by 2^-100
    below_apex.y -= mpz_class(1) << (kPointBits - 100), above_apex.y += mpz_class(1) << (kPointBits - 100);
    EXPECT_EQ(winding_at(arch, below_apex), 1);
    EXPECT_EQ(winding_at(arch, above_apex), 0);
    EXPECT_EQ(winding_at(arch, point(1, 1)), 0); // above its left flank: y(1) = 7/8
    // A cubic with crossed handles: the loop is traversed the other way round than the rest.
    const std::vector<PlanarCurve> loop = {{3, {0, 100, -60, 40}, {0, 60, 60, 0}}, line(40, 0, 0, 0)};
    EXPECT_EQ(winding_at(loop, point(20, 40)), -*winding_at(loop, point(20, 10)));
    EXPECT_EQ(winding_at(loop, point(20, 50)), 0);
}

TEST(ExactWinding, SaysWhenAPointIsOnTheCurve) {
    const PlanarCurve diagonal = line(0, 0, 10, 10);
    EXPECT_EQ(crossings_left_of(diagonal, point(5, 5, 1, 1)), std::nullopt);
    EXPECT_EQ(crossings_left_of(diagonal, point(5, 4)), 1);
    EXPECT_EQ(crossings_left_of(diagonal, point(4, 5)), 0);
}

TEST(ExactWinding, EnclosesPositions) {
    const PlanarCurve arch{2, {0, 4, 8, 0}, {0, 4, 0, 0}}; // y = x − x²/8
    const mpz_class y = (mpz_class(3) << kPointBits) / 2;  // at x = 2 and x = 6
    const auto near = [](const ExactRange& r, int x) {
        const mpz_class v = mpz_class(x) << kPointBits, slack = mpz_class(1) << (kPointBits - 70);
        return r.lo <= v && v <= r.hi && r.hi - r.lo < slack;
    };
    ASSERT_TRUE(position_at(arch, 0, 0.5, y) && position_at(arch, 0.5, 1, y));
    EXPECT_TRUE(near(*position_at(arch, 0, 0.5, y), 2));
    EXPECT_TRUE(near(*position_at(arch, 0.5, 1, y), 6));
    EXPECT_FALSE(position_at(arch, 0, 0.125, y));
}

TEST(ExactWinding, IntegratesAreas) {
    EXPECT_EQ(winding_area(kSquare), 100);
    const std::vector<PlanarCurve> arch = {{2, {0, 4, 8, 0}, {0, 4, 0, 0}}, line(8, 0, 0, 0)};
    EXPECT_EQ(winding_area(arch), mpq_class(32, 3)); // 2/3 of width times height
    const std::vector<PlanarCurve> cubic = {{3, {0, 0, 6, 6}, {0, 6, 6, 0}}, line(6, 0, 0, 0)};
    EXPECT_EQ(winding_area(cubic), mpq_class(108, 5)); // 3/20 · (…) = 21.6
}

} // namespace
} // namespace fetexc::test
