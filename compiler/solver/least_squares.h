// SPDX-License-Identifier: GPL-3.0-or-later
/// Sparse non-linear least squares with bounds on the unknowns. No type of Ceres is seen here: those that state
/// problems don't link it.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <span>

namespace fetexc {

/// Some numbers that depend on the same blocks of unknowns.
struct Residual {
    std::uint32_t first = 0;  ///< in LeastSquares::blocks
    std::uint32_t blocks = 0; ///< all different
    std::uint32_t values = 1; ///< numbers
};

/// A problem. Unknowns come in blocks of equal size, block k from k·block_size on. Those of no residual stay as they
/// are.
struct LeastSquares {
    std::span<double> unknowns; ///< the start; then the solution
    std::uint32_t block_size = 1;
    double low = -INFINITY, high = INFINITY; ///< of every unknown
    std::span<const std::uint32_t> blocks;   ///< of all residuals
    std::span<const Residual> residuals;
    /// Of a residual, from the unknowns of its blocks: the values, and their derivatives by each block's unknowns,
    /// value by value. No derivatives are wanted where `derivatives`, or a block's, is null.
    std::function<void(std::uint32_t residual, const double* const* blocks, double* values, double** derivatives)>
        evaluate;
};

/// Levenberg-Marquardt, its normal equations by sparse Cholesky factors: the same numbers on every machine, for it asks
/// no BLAS, and one thread.
struct LeastSquaresOptions {
    int steps = 0;             ///< at most
    double trust_radius = 0;   ///< at first and at most; damping is its inverse
    double least_diagonal = 0; ///< damping is relative to the diagonal of the normal matrix, at least so much
    double tolerance = 0;      ///< relative change of the cost at which the fit ends
    std::function<bool(int step)> goes_on; ///< asked before step 1 and after each, when `unknowns` are up to date
};

} // namespace fetexc
