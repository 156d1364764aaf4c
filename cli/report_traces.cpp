// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/report_traces.h"

#include <fmt/format.h>

namespace fetexc::cli {

std::vector<double> trace_ppm(const std::vector<double>& trace) {
    std::vector<double> ppm;
    for (const double wrong : trace)
        ppm.push_back(1e6 * wrong);
    return ppm;
}

std::string trace_text(const std::vector<double>& trace) {
    std::string text;
    for (std::size_t step = 1; step < trace.size(); step *= 2)
        text += fmt::format("{:.0f} ", 1e6 * trace[step - 1]);
    return trace.empty() ? "nothing to fit" : text + fmt::format("{:.0f}", 1e6 * trace.back());
}

} // namespace fetexc::cli
