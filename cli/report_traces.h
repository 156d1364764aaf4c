// SPDX-License-Identifier: GPL-3.0-or-later
/// Wrong area after each step of a fit.
#pragma once

#include <string>
#include <vector>

namespace fetexc::cli {

/// Millionths; trace: parts.
std::vector<double> trace_ppm(const std::vector<double>& trace);
/// After steps 1, 2, 4 … and the last.
std::string trace_text(const std::vector<double>& trace);

} // namespace fetexc::cli
