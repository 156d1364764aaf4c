// SPDX-License-Identifier: GPL-3.0-or-later
/// Sequential quadratic programming for small dense problems: a convex quadratic objective, quadratic equality
/// constraints, bounds of the variables. No memory is allocated.
#pragma once

#include <Eigen/Dense>

namespace fetexc::sqp {

inline constexpr int kMostVariables = 16, kMostConstraints = 16;

using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostVariables, 1>;
using Values = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostConstraints, 1>;
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostVariables, kMostVariables>;
using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostConstraints, kMostVariables>;

/// What depends on the variables.
class Problem {
  public:
    virtual ~Problem() = default;
    /// Values of the constraints, 0 where they are met, and their derivatives. Sizes are those of the problem.
    virtual void constraints(const Vector& x, Values& values, Jacobian& jacobian) const = 0;
    /// Adds Σ weight·(second derivatives), which are constant.
    virtual void add_curvature(const Values& weights, Matrix& to) const = 0;
};

/// Least x·hessian·x/2 + gradient·x with all constraints met and low ≤ x ≤ high.
struct Task {
    const Problem& problem;
    int constraints = 0;
    Matrix hessian; ///< positive semidefinite
    Vector gradient, low, high;
};

struct Outcome {
    bool solved = false;
    int steps = 0;
};

/// x: the start, within the bounds, and the result. Stops at steps of `accuracy` with constraints met to it; not solved
/// after `most_steps`.
Outcome solve(const Task& task, Vector& x, double accuracy, int most_steps);

} // namespace fetexc::sqp
