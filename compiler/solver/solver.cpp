// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/solver/solver.h"

#include "compiler/module/module.h"

namespace fetexc {

Result<const Solver*> load_solver() {
    static const Module module(kSolverModule);
    const auto entry = module.symbol(kSolverEntry);
    if (!entry) return entry.error();
    return reinterpret_cast<SolverEntry>(entry.value())();
}

} // namespace fetexc
