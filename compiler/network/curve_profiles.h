// SPDX-License-Identifier: GPL-3.0-or-later
/// What each curve of a network asks to have done near it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compiler/network/network.h"

namespace fetexc {

struct CurveProfiles {
    std::vector<FeatureProfile> profiles; ///< without equal names; one at least
    std::vector<std::uint32_t> of_curve;  ///< index into profiles, for each curve of the network
};

/// Of a curve's profile name, or the network's; empty: neither has one.
const std::string& profile_name(const Network& network, const NetworkCurve& curve);

/// The profile's name that most curves ask for, the first of equals; none does: the preset crease.
std::string commonest_profile(const Network& network);

/// for_all: whatever curves ask for. Curves that ask for none have the commonest one.
CurveProfiles curve_profiles(const Network& network, const std::optional<FeatureProfile>& for_all);

/// The largest of their widths, user units: farther from all curves only the base map counts.
double profile_reach(const CurveProfiles& profiles);

} // namespace fetexc
