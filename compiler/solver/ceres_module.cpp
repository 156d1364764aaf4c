// SPDX-License-Identifier: GPL-3.0-or-later
/// The module fetexc_ceres: the only file that knows Ceres.
#include <deque>
#include <vector>

#include <ceres/ceres.h>

#include "compiler/solver/solver.h"

namespace {

using fetexc::LeastSquares;
using fetexc::LeastSquaresOptions;
using fetexc::Residual;

/// A residual as Ceres wants it.
class Cost final : public ceres::CostFunction {
  public:
    Cost(const LeastSquares& problem, std::uint32_t residual) : problem_(problem), residual_(residual) {
        set_num_residuals(static_cast<int>(problem.residuals[residual].values));
        mutable_parameter_block_sizes()->assign(problem.residuals[residual].blocks,
                                                static_cast<int>(problem.block_size));
    }

    bool Evaluate(double const* const* blocks, double* values, double** derivatives) const override {
        problem_.evaluate(residual_, blocks, values, derivatives);
        return true;
    }

  private:
    const LeastSquares& problem_;
    std::uint32_t residual_;
};

class GoesOn final : public ceres::IterationCallback {
  public:
    explicit GoesOn(const LeastSquaresOptions& options) : options_(options) {}
    ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
        return options_.goes_on(step.iteration) ? ceres::SOLVER_CONTINUE : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
    }

  private:
    const LeastSquaresOptions& options_;
};

ceres::Solver::Options ceres_options(const LeastSquaresOptions& options) {
    ceres::Solver::Options o;
    o.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    o.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE; // no BLAS
    o.num_threads = 1;
    o.logging_type = ceres::SILENT;
    // Values that the residuals say little about stay near where they are.
    o.jacobi_scaling = false;
    o.max_num_iterations = options.steps;
    o.initial_trust_region_radius = o.max_trust_region_radius = options.trust_radius;
    o.min_lm_diagonal = options.least_diagonal;
    o.function_tolerance = options.tolerance;
    return o;
}

void set_bounds(ceres::Problem& problem, const LeastSquares& stated) {
    std::vector<double*> blocks;
    problem.GetParameterBlocks(&blocks);
    for (double* block : blocks) {
        for (int k = 0; k < static_cast<int>(stated.block_size); ++k) {
            if (std::isfinite(stated.low)) problem.SetParameterLowerBound(block, k, stated.low);
            if (std::isfinite(stated.high)) problem.SetParameterUpperBound(block, k, stated.high);
        }
    }
}

void least_squares(const LeastSquares& stated, const LeastSquaresOptions& options) {
    if (stated.residuals.empty()) return;
    ceres::Problem::Options ownership;
    ownership.disable_all_safety_checks = true;
    ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    std::deque<Cost> costs;
    ceres::Problem problem(ownership);
    std::vector<double*> blocks;
    for (std::uint32_t k = 0; k < stated.residuals.size(); ++k) {
        const Residual& residual = stated.residuals[k];
        blocks.clear();
        for (const std::uint32_t block : stated.blocks.subspan(residual.first, residual.blocks))
            blocks.push_back(stated.unknowns.data() + std::size_t{block} * stated.block_size);
        problem.AddResidualBlock(&costs.emplace_back(stated, k), nullptr, blocks);
    }
    set_bounds(problem, stated);
    GoesOn watch(options);
    ceres::Solver::Options ceres_way = ceres_options(options);
    if (options.goes_on) {
        ceres_way.callbacks.push_back(&watch);
        ceres_way.update_state_every_iteration = true;
    }
    ceres::Solver::Summary summary;
    ceres::Solve(ceres_way, &problem, &summary);
}

constexpr fetexc::Solver kSolver{least_squares};

} // namespace

extern "C" __attribute__((visibility("default"))) const fetexc::Solver* fetexc_solver_1() { return &kSolver; }
