// SPDX-License-Identifier: GPL-3.0-or-later
/// Profiles from JSON; $defs/profile of cli/schema/network.schema.json is their schema.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/network/json_members.h"
#include "compiler/network/profile.h"
#include "compiler/result.h"

namespace fetexc {

inline constexpr std::size_t kProfileMaxPoints = 65536;

/// An object of profiles by name. Numbers are at most `reach`. Throws json::Refused.
std::vector<FeatureProfile> read_profiles(const json::Json& object, double reach);

/// A file that holds one. Errors 1501 … 1503, 1506. Bytes may be untrusted.
Result<FeatureProfile> read_profile(std::span<const std::uint8_t> bytes);

} // namespace fetexc
