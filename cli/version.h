// SPDX-License-Identifier: GPL-3.0-or-later
/// What this program is and was built from.
#pragma once

#include <string>

namespace fetexc::cli {

/// "0.1.0": goes into files, so it names neither commit nor machine.
std::string version_number();

/// `fetexc --version`: number, commit, compiler, libraries, and the drawing back ends found on this machine.
std::string version_text();

} // namespace fetexc::cli
