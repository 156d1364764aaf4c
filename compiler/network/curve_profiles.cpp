// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/network/curve_profiles.h"

#include <algorithm>
#include <map>

namespace fetexc {

const std::string& profile_name(const Network& network, const NetworkCurve& curve) {
    return curve.profile.empty() ? network.profile : curve.profile;
}

std::string commonest_profile(const Network& network) {
    std::map<std::string, std::size_t> counts;
    for (const NetworkCurve& c : network.curves)
        if (const std::string& name = profile_name(network, c); !name.empty()) ++counts[name];
    std::string best = std::string(kProfilePresets.front());
    std::size_t most = 0;
    for (const NetworkCurve& c : network.curves) { // in their order, so that the first to lead stays
        const std::string& name = profile_name(network, c);
        if (!name.empty() && counts[name] > most) best = name, most = counts[name];
    }
    return best;
}

CurveProfiles curve_profiles(const Network& network, const std::optional<FeatureProfile>& for_all) {
    CurveProfiles out;
    out.of_curve.assign(network.curves.size(), 0);
    const std::string commonest = commonest_profile(network);
    out.profiles.push_back(for_all ? *for_all : *find_profile(network, commonest));
    if (for_all) return out;
    std::map<std::string, std::uint32_t> known{{commonest, 0}};
    for (std::size_t k = 0; k < network.curves.size(); ++k) {
        const std::string& own = profile_name(network, network.curves[k]);
        if (own.empty()) continue;
        const auto [found, is_new] = known.emplace(own, static_cast<std::uint32_t>(out.profiles.size()));
        if (is_new) out.profiles.push_back(*find_profile(network, own));
        out.of_curve[k] = found->second;
    }
    return out;
}

double profile_reach(const CurveProfiles& profiles) {
    return std::ranges::max_element(profiles.profiles, {}, &FeatureProfile::width)->width;
}

} // namespace fetexc
