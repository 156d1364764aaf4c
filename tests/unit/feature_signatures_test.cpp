// SPDX-License-Identifier: GPL-3.0-or-later
/// Quadratics of a texel: their walk through the grid, what makes them valid, and the solver of local problems.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compiler/feature_curves/curve_walk.h"
#include "compiler/feature_curves/signatures.h"
#include "compiler/feature_curves/sqp.h"
#include "tests/support/random.h"

namespace fetexc {
namespace {

using fetex::FeaturePoint;
using test::Random;

double value(std::int64_t a, std::int64_t b, std::int64_t c, double t) {
    return static_cast<double>(a) * (1 - t) * (1 - t) + 2 * static_cast<double>(b) * t * (1 - t) +
           static_cast<double>(c) * t * t;
}

/// Small whole numbers: most curves pass corners of the grid, touch its lines, or end on them.
TEST(CurveWalk, goesFromTexelToNeighbourUpToItsEnd) {
    constexpr std::int64_t kPitch = 4;
    constexpr std::uint32_t kCells = 5;
    Grid grid;
    grid.width = grid.height = kCells, grid.px = grid.py = kPitch;
    CurveWalk walk(grid);
    int corners = 0, touching = 0;
    for (std::uint64_t seed = 0; seed < 20000; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const auto point = [&]() -> PlanarPoint { return {random.integer(-6, 26), random.integer(-6, 26)}; };
        const PlanarQuadratic q = {point(), point(), point()};
        if ((q[1].x - q[0].x) * (q[2].y - q[0].y) == (q[1].y - q[0].y) * (q[2].x - q[0].x)) continue;
        std::int32_t i = grid_cell(q[0].x, kPitch, kCells), j = grid_cell(q[0].y, kPitch, kCells);
        double t = 0;
        for (const CurveCrossing& c : walk.walk(q)) {
            EXPECT_GE(c.t, t - 1e-12);
            t = c.t;
            EXPECT_EQ(c.at.cell, c.at.vertical ? j : i);
            EXPECT_EQ(c.at.line, (c.at.vertical ? i : j) + (c.at.increasing ? 1 : 0));
            (c.at.vertical ? i : j) += c.at.increasing ? 1 : -1;
            const double x = value(q[0].x, q[1].x, q[2].x, t), y = value(q[0].y, q[1].y, q[2].y, t);
            const double along = c.at.vertical ? y : x, across = c.at.vertical ? x : y;
            EXPECT_NEAR(across, static_cast<double>(kPitch * c.at.line), 1e-6);
            if (c.at.cell >= 0 && c.at.cell < static_cast<std::int32_t>(kCells)) {
                EXPECT_NEAR(along, kPitch * (c.at.cell + c.at.position), 1e-6);
            }
            EXPECT_GE(c.at.increasing ? c.at.vertical ? c.dx : c.dy : c.at.vertical ? -c.dx : -c.dy, -1e-9);
            corners += c.at.position == 0 || c.at.position == 1;
        }
        EXPECT_EQ(i, grid_cell(q[2].x, kPitch, kCells));
        EXPECT_EQ(j, grid_cell(q[2].y, kPitch, kCells));
        // A maximum on a line: p0 + (p1 − p0)² / (2 p1 − p0 − p2).
        const std::int64_t half = q[1].x - q[0].x, bend = 2 * q[1].x - q[0].x - q[2].x;
        if (bend > 0 && half > 0 && half < bend && half * half % bend == 0 &&
            (q[0].x + half * half / bend) % kPitch == 0)
            ++touching;
        if (HasFailure()) break;
    }
    EXPECT_GT(corners, 500);
    EXPECT_GT(touching, 50);
}

/// The paper's (7).
bool passes_safety_test(const SegmentCurve& c) {
    const double cx = c[2].x - c[0].x, cy = c[2].y - c[0].y, square = cx * cx + cy * cy;
    const double mx = c[1].x - (c[0].x + c[2].x) / 2, my = c[1].y - (c[0].y + c[2].y) / 2;
    const double x0 = (mx * cx + my * cy) / square, y0 = (my * cx - mx * cy) / square, n = std::hypot(x0, y0);
    const double axis = x0 * y0 / (4 * n * n * n), half = y0 / (2 * n);
    return std::min({std::abs(axis), std::abs(axis + half), std::abs(axis - half)}) * std::sqrt(square) >
           std::numbers::sqrt2;
}

/// Along the parabola, far beyond the segment.
bool found_inside_beyond(const SegmentCurve& c) {
    for (double t = -40; t <= 41; t += 1.0 / 512) {
        if (t >= 0 && t <= 1) continue;
        const double a = (1 - t) * (1 - t), b = 2 * t * (1 - t), d = t * t;
        const double x = a * c[0].x + b * c[1].x + d * c[2].x, y = a * c[0].y + b * c[1].y + d * c[2].y;
        if (x > 1e-9 && x < 1 - 1e-9 && y > 1e-9 && y < 1 - 1e-9) return true;
    }
    return false;
}

TEST(Signatures, parabolasThatComeBackAreFound) {
    int back = 0, passed = 0, passed_and_back = 0, missed = 0;
    for (std::uint64_t seed = 0; seed < 20000; ++seed) {
        Random random(seed);
        const auto e = fetex::kFeatureEdges[static_cast<std::size_t>(random.integer(0, 3))],
                   f = fetex::kFeatureEdges[static_cast<std::size_t>(random.integer(0, 3))];
        if (e == f) continue;
        const SegmentCurve c = {fetex::feature_point(e, random.unit()),
                                {random.unit(), random.unit()},
                                fetex::feature_point(f, random.unit())};
        const bool comes = comes_back(c);
        if (random.chance(0.1)) {
            const bool found = found_inside_beyond(c);
            EXPECT_TRUE(comes || !found) << seed;
            missed += comes && !found; // between two of the points looked at, or farther away
        }
        back += comes, passed += passes_safety_test(c), passed_and_back += comes && passes_safety_test(c);
    }
    EXPECT_GT(back, 1000);
    EXPECT_LT(missed, back / 50);
    EXPECT_GT(passed, 50);
    EXPECT_LT(passed_and_back, passed / 20);
}

TEST(Signatures, middlePointsAreWhereTangentsMeet) {
    const auto p = middle_point({0, 0.25}, 0, {0.75, 1}, std::numbers::pi / 2);
    ASSERT_TRUE(p);
    EXPECT_NEAR(p->x, 0.75, 1e-15);
    EXPECT_NEAR(p->y, 0.25, 1e-15);
    EXPECT_FALSE(middle_point({0, 0.25}, 1, {0.75, 1}, 1));
}

TEST(Signatures, faultsAreTold) {
    EXPECT_EQ(fault_of({FeaturePoint{0, 0.5}, {0.5, 0.5}, {0.5, 1}}), SignatureFault::None);
    EXPECT_EQ(fault_of({FeaturePoint{0, 0.5}, {1.5, 0.5}, {0.5, 1}}), SignatureFault::Outside);
    EXPECT_EQ(fault_of({FeaturePoint{0, 0}, {0.5, 0.5}, {0, 0}}), SignatureFault::NoMiddle);
    // A tangent almost along the edge: the parabola turns back in.
    EXPECT_EQ(fault_of({FeaturePoint{0.14, 0}, {0.01, 0.04}, {0, 0.07}}), SignatureFault::SideTest);
}

/// (x − 3)² + (y − 2)² on the circle of radius √2 around (1, 1), with x ≤ 1.9.
class Circle : public sqp::Problem {
  public:
    void constraints(const sqp::Vector& x, sqp::Values& values, sqp::Jacobian& jacobian) const override {
        values.resize(1), jacobian.resize(1, 2);
        values[0] = (x[0] - 1) * (x[0] - 1) + (x[1] - 1) * (x[1] - 1) - 2;
        jacobian << 2 * (x[0] - 1), 2 * (x[1] - 1);
    }
    void add_curvature(const sqp::Values& weights, sqp::Matrix& to) const override {
        to(0, 0) += 2 * weights[0], to(1, 1) += 2 * weights[0];
    }
};

TEST(Sqp, findsTheLeastValueOnACurve) {
    const Circle circle;
    for (const double most : {1.9, 5.0}) {
        sqp::Task task{circle, 1, 2 * sqp::Matrix::Identity(2, 2), sqp::Vector(2), sqp::Vector(2), sqp::Vector(2)};
        task.gradient << -6, -4;
        task.low << -5, -5;
        task.high << most, 5;
        sqp::Vector x(2);
        x << 0.5, 2.5;
        const sqp::Outcome outcome = sqp::solve(task, x, 1e-10, 50);
        EXPECT_TRUE(outcome.solved);
        EXPECT_LE(outcome.steps, 15);
        // Without the bound: towards (3, 2) from the centre, (2, 1)·√2/√5.
        const double free = 1 + 2 * std::sqrt(2.0 / 5), wanted = std::min(free, most);
        EXPECT_NEAR(x[0], wanted, 1e-8);
        EXPECT_NEAR(x[1], 1 + std::sqrt(2 - (wanted - 1) * (wanted - 1)), 1e-8);
    }
}

TEST(Sqp, saysSoWithoutASolution) {
    const Circle circle;
    sqp::Task task{circle, 1, 2 * sqp::Matrix::Identity(2, 2), sqp::Vector::Zero(2), sqp::Vector(2), sqp::Vector(2)};
    task.low << 4, 4; // the circle is elsewhere
    task.high << 5, 5;
    sqp::Vector x(2);
    x << 4.5, 4.5;
    EXPECT_FALSE(sqp::solve(task, x, 1e-10, 50).solved);
}

} // namespace
} // namespace fetexc
