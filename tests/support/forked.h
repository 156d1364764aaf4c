// SPDX-License-Identifier: GPL-3.0-or-later
/// Work in a process of its own: what throws, crashes or hangs there doesn't take the test along.
#pragma once

#include <functional>
#include <vector>

namespace fetexc::test {

enum class Ended { Finished, Threw, Crashed, TimedOut };

struct ForkedRun {
    Ended ended = Ended::Crashed;
    std::vector<double> output; ///< of work that finished
    double seconds = 0;         ///< processor time of the child
};

/// Runs `work` in a child process for at most `seconds` of processor time, and ten times that of wall time (a machine
/// that is busy with other things). Call it while no other thread runs.
ForkedRun run_forked(const std::function<std::vector<double>()>& work, double seconds);

} // namespace fetexc::test
