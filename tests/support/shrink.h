// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes a failing drawing small, and asks a question in a process of its own, so that crashes and hangs are answers.
#pragma once

#include <functional>
#include <string>

#include "tests/support/drawing.h"
#include "tests/support/stress_case.h"

namespace fetexc::test {

using StillFails = std::function<bool(const Drawing&)>;

struct ShrinkCounts {
    std::size_t tried = 0, kept = 0;
};

/// Removes paths and curves, lowers degrees, rounds control points to ever coarser powers of two and puts them where
/// others are, as long as the drawing still fails; until no single step can be taken. `drawing` must fail.
[[nodiscard]] Drawing shrink(Drawing drawing, const StillFails& still_fails, ShrinkCounts* counts = nullptr);

struct Outcome {
    enum class Kind { Fine, Fails, Crashes, Hangs } kind = Kind::Fine;
    std::string message; ///< of a failure; a crash's signal
};

/// Runs the question in a forked child with a limit on its processor time (and ten times that on the clock). The
/// calling process must not have started threads.
[[nodiscard]] Outcome ask_in_child(const std::function<Failure()>& question, unsigned seconds);

} // namespace fetexc::test
