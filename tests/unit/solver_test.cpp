// SPDX-License-Identifier: GPL-3.0-or-later
// Least squares by the module of compiler/solver.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <vector>

#include "compiler/solver/solver.h"

namespace fetexc {
namespace {

const Solver& solver() {
    static const Result<const Solver*> loaded = load_solver();
    if (!loaded) throw std::runtime_error(loaded.error().message);
    return *loaded.value();
}

constexpr double kNear = 1e-6; // steps are damped by 1e-8
const LeastSquaresOptions kThorough{100, 1e8, 1e-6, 1e-16, {}};

/// x − wanted, one residual for each wanted number, of one unknown.
struct MeanProblem {
    explicit MeanProblem(std::vector<double> numbers) : wanted(std::move(numbers)) {
        residuals.assign(wanted.size(), Residual{0, 1, 1});
        stated.unknowns = unknown, stated.blocks = blocks, stated.residuals = residuals;
        stated.evaluate = [this](std::uint32_t k, const double* const* x, double* values, double** derivatives) {
            values[0] = x[0][0] - wanted[k];
            if (derivatives != nullptr && derivatives[0] != nullptr) derivatives[0][0] = 1;
        };
    }
    MeanProblem(const MeanProblem&) = delete;

    double solve(const LeastSquaresOptions& options = kThorough) {
        solver().least_squares(stated, options);
        return unknown[0];
    }

    std::vector<double> wanted;
    std::array<double, 1> unknown{0};
    std::array<std::uint32_t, 1> blocks{0};
    std::vector<Residual> residuals;
    LeastSquares stated;
};

TEST(LeastSquaresSolver, findsTheMean) { EXPECT_NEAR(MeanProblem({1, 2, 6}).solve(), 3, kNear); }

TEST(LeastSquaresSolver, keepsToTheBounds) {
    MeanProblem above({5}), below({-5});
    for (MeanProblem* p : {&above, &below})
        p->stated.low = -1, p->stated.high = 1;
    EXPECT_EQ(above.solve(), 1);
    EXPECT_EQ(below.solve(), -1);
}

TEST(LeastSquaresSolver, endsWhenToldTo) {
    std::vector<int> steps;
    LeastSquaresOptions options = kThorough;
    options.trust_radius = 0.1; // small steps, so that there are several
    MeanProblem p({1});
    std::vector<double> seen;
    options.goes_on = [&](int step) {
        steps.push_back(step), seen.push_back(p.unknown[0]);
        return step < 2;
    };
    p.solve(options);
    EXPECT_EQ(steps, (std::vector<int>{0, 1, 2}));
    EXPECT_EQ(seen[0], 0);
    EXPECT_LT(seen[1], seen[2]) << "the unknowns are up to date";
    EXPECT_LT(p.unknown[0], 0.9) << "it went on";
}

TEST(LeastSquaresSolver, blocksOfSeveralUnknownsAndResidualsOfSeveralValues) {
    // Points a, b, c of the plane: a is given, b − a and c − b are, d is of no residual.
    std::array<double, 8> points{0, 0, 0, 0, 0, 0, 7, 8};
    const std::array<std::uint32_t, 5> blocks{0, 0, 1, 1, 2};
    const std::array<Residual, 3> residuals{Residual{0, 1, 2}, Residual{1, 2, 2}, Residual{3, 2, 2}};
    LeastSquares stated;
    stated.unknowns = points, stated.block_size = 2, stated.blocks = blocks, stated.residuals = residuals;
    stated.evaluate = [&](std::uint32_t k, const double* const* p, double* values, double** derivatives) {
        for (std::size_t c = 0; c < 2; ++c) {
            values[c] = k == 0 ? p[0][c] - 1 : p[1][c] - p[0][c] - (c == 0 ? 10 : -20);
            for (std::size_t block = 0; block < residuals[k].blocks; ++block) {
                if (derivatives == nullptr || derivatives[block] == nullptr) continue;
                derivatives[block][2 * c] = derivatives[block][2 * c + 1] = 0;
                derivatives[block][2 * c + c] = k == 0 || block == 1 ? 1 : -1;
            }
        }
    };
    solver().least_squares(stated, kThorough);
    const std::array<double, 8> expected{1, 1, 11, -19, 21, -39, 7, 8};
    for (std::size_t k = 0; k < 8; ++k)
        EXPECT_NEAR(points[k], expected[k], kNear) << k;
}

TEST(LeastSquaresSolver, withoutResidualsNothingHappens) {
    MeanProblem p({});
    p.unknown[0] = 0.3;
    EXPECT_EQ(p.solve(), 0.3);
}

TEST(LeastSquaresSolver, problemsMayBeSolvedAtTheSameTime) {
    std::array<double, 8> found{};
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < found.size(); ++t)
        threads.emplace_back([&, t] { found[t] = MeanProblem({0.1, 0.7, static_cast<double>(t)}).solve(); });
    for (std::thread& thread : threads)
        thread.join();
    for (std::size_t t = 0; t < found.size(); ++t)
        EXPECT_EQ(found[t], MeanProblem({0.1, 0.7, static_cast<double>(t)}).solve()) << t;
}

} // namespace
} // namespace fetexc
