// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/network/network.h"

#include <algorithm>
#include <utility>

namespace fetexc {
namespace {

bool same(CanvasPoint a, CanvasPoint b) { return a.x == b.x && a.y == b.y; }

} // namespace

bool is_point(const CanvasSegment& s) {
    return std::all_of(s.p.begin() + 1, s.p.begin() + s.degree + 1, [&](CanvasPoint p) { return same(p, s.p[0]); });
}

std::uint64_t segment_count(const Network& network) {
    std::uint64_t n = 0;
    for (const NetworkCurve& curve : network.curves)
        n += curve.segments.size();
    return n;
}

std::optional<FeatureProfile> find_profile(const Network& network, const std::string& name) {
    const auto found = std::ranges::find(network.profiles, name, &FeatureProfile::name);
    if (found != network.profiles.end()) return *found;
    return preset_profile(name, kPresetWidth * std::max(network.width, network.height));
}

Network network_of(const FeatureCurves& features) {
    Network network{features.width, features.height, {}};
    for (const CanvasContour& run : features.runs) {
        NetworkCurve curve;
        std::ranges::copy_if(run, std::back_inserter(curve.segments), [](const auto& s) { return !is_point(s); });
        if (curve.segments.empty()) continue;
        const CanvasSegment& last = curve.segments.back();
        curve.closed = same(last.p[static_cast<std::size_t>(last.degree)], curve.segments.front().p[0]);
        network.curves.push_back(std::move(curve));
    }
    return network;
}

} // namespace fetexc
