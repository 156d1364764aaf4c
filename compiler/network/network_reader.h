// SPDX-License-Identifier: GPL-3.0-or-later
/// Networks from JSON; cli/schema/network.schema.json is its schema.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/network/network.h"
#include "compiler/result.h"

namespace fetexc {

inline constexpr std::uint64_t kNetworkMaxBytes = std::uint64_t{256} << 20;
inline constexpr std::uint64_t kNetworkMaxSegments = std::uint64_t{1} << 24;
/// Largest canvas side, and how far coordinates may be from the origin, in larger canvas sides.
inline constexpr double kNetworkMaxSide = 1e9, kNetworkReach = 1000;

/// Errors 1501 … 1505, whose place names the line and column, or the curve and its segment. `diagnostics` gets 2061 and
/// 2062. Bytes may be untrusted: what is allocated is in proportion to them.
Result<Network> read_network(std::span<const std::uint8_t> bytes, std::vector<Diagnostic>& diagnostics);

} // namespace fetexc
