// SPDX-License-Identifier: GPL-3.0-or-later
/// Which input is written where, settled before any work starts.
#pragma once

#include <string>
#include <vector>

#include "compiler/result.h"

namespace fetexc::cli {

struct Job {
    std::string input, output; ///< "-": stdin, stdout
};

struct Plan {
    std::vector<Job> jobs;
    std::string folder; ///< to be made first; empty: none
};

/// output empty: beside each input, its extension replaced by .fetex (stdin goes to stdout). For one input, output is a
/// file, "-", or an existing folder; for several it is a folder. Errors E8041 (combination), E8014 (would overwrite an
/// input), E8015 (two inputs, one output).
Result<Plan> plan_outputs(const std::vector<std::string>& inputs, const std::string& output);

/// The dependency file must not be an input or an output, and an output on stdout has no name to put in it. Errors
/// E8041, E8014.
Status check_depfile(const std::string& depfile, const std::vector<Job>& jobs);

} // namespace fetexc::cli
