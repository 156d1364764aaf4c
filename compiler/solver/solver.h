// SPDX-License-Identifier: GPL-3.0-or-later
/// The functions of the module fetexc_ceres.
#pragma once

#include "compiler/result.h"
#include "compiler/solver/least_squares.h"

namespace fetexc {

/// What the module offers. More solvers that need Ceres are more members.
struct Solver {
    /// Changes problem.unknowns. A problem that Ceres gives up (no finite value, no step) keeps the best unknowns so
    /// far.
    void (*least_squares)(const LeastSquares& problem, const LeastSquaresOptions& options);
};

/// Loads the module with the first call; any thread. Error kNoModule.
Result<const Solver*> load_solver();

using SolverEntry = const Solver* (*)();
inline constexpr const char* kSolverModule = "libfetexc_ceres.so";
/// The number changes with any struct here or in least_squares.h: the module may lie there from another version.
inline constexpr const char* kSolverEntry = "fetexc_solver_1";

} // namespace fetexc
