// SPDX-License-Identifier: GPL-3.0-or-later
/// Processor time of making textures, beside that of a yardstick in the same rounds: clocks differ from machine to
/// machine and drift with what else runs there, ratios much less.
#pragma once

#include <functional>
#include <vector>

#include "compiler/result.h"

namespace fetexc::cli {

/// The yardstick: std::sort of so many pseudo-random 64-bit numbers, always the same ones, on one thread.
inline constexpr std::size_t kYardstickNumbers = 1'000'000;

struct CompileTime {
    double seconds = 0; ///< median over the rounds
    double ratio = 0;   ///< median of the rounds' ratios to the yardstick
};

/// Each round runs the yardstick, then every work once. Stops at the first error.
using Work = std::function<Status()>;
Result<std::vector<CompileTime>> time_works(const std::vector<Work>& works, unsigned rounds);

/// Mean of the two in the middle for an even number; values must not be empty.
double median(std::vector<double> values);

} // namespace fetexc::cli
