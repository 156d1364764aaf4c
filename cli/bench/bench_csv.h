// SPDX-License-Identifier: GPL-3.0-or-later
/// The figures of `bench` as CSV (RFC 4180): a line for each texture and output size. Columns whose figures never
/// change from run to run come first, timed ones last.
#pragma once

#include <string>
#include <vector>

#include "cli/bench/bench_point.h"

namespace fetexc::cli {

/// timed: with the columns that depend on the clock.
std::string bench_csv(const std::vector<BenchFile>& files, bool timed);

/// In quotes where it has to be.
std::string csv_field(const std::string& text);

} // namespace fetexc::cli
