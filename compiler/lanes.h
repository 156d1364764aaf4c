// SPDX-License-Identifier: GPL-3.0-or-later
/// Four numbers of single precision at a time. Each is rounded as if alone, so results are the same on every machine.
#pragma once

#include <cstdint>

namespace fetexc {

inline constexpr std::uint32_t kLanes = 4;
using Lanes [[gnu::vector_size(16)]] = float;

/// The second where either isn't a number.
inline Lanes smaller(Lanes a, Lanes b) { return a < b ? a : b; }
inline Lanes larger(Lanes a, Lanes b) { return a > b ? a : b; }

} // namespace fetexc
