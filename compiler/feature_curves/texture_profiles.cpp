// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/texture_profiles.h"

#include <algorithm>
#include <map>
#include <utility>

namespace fetexc {

TextureProfiles::TextureProfiles(FeatureProfile profile) : profiles_{std::move(profile)} {}

TextureProfiles::TextureProfiles(const Network& network) : of_the_network_(network.profile) {
    std::map<std::string, std::size_t> counts;
    for (const NetworkCurve& c : network.curves)
        if (!wanted(c).empty()) ++counts[wanted(c)];
    names_ = {std::string(kProfilePresets.front())};
    std::size_t most = 0;
    for (const NetworkCurve& c : network.curves) // in their order, so that the first of equals leads
        if (!wanted(c).empty() && counts[wanted(c)] > most) names_[0] = wanted(c), most = counts[wanted(c)];
    for (const NetworkCurve& c : network.curves) {
        if (wanted(c).empty() || std::ranges::count(names_, wanted(c)) > 0) continue;
        if (names_.size() < fetex::kFeatureProfilesMost)
            names_.push_back(wanted(c));
        else if (curves_beyond_++ == 0)
            name_beyond_ = wanted(c);
    }
    for (const std::string& name : names_)
        profiles_.push_back(*find_profile(network, name));
}

std::uint8_t TextureProfiles::number_of(const NetworkCurve& curve) const {
    const auto found = std::ranges::find(names_, wanted(curve));
    return found == names_.end() ? 0 : static_cast<std::uint8_t>(found - names_.begin());
}

} // namespace fetexc
