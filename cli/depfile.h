// SPDX-License-Identifier: GPL-3.0-or-later
/// Dependency files that Make and Ninja both read.
#pragma once

#include <string>
#include <vector>

#include "compiler/result.h"

namespace fetexc::cli {

struct DepfileRule {
    std::string output;
    std::vector<std::string> inputs;
};

/// One rule a line, names escaped as GCC does (space, '#', '$', backslashes before a space). Make has no way to write a
/// newline in a name: error E8021.
Result<std::string> depfile_text(const std::vector<DepfileRule>& rules);

} // namespace fetexc::cli
