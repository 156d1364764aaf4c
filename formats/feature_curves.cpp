// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Configurations: their names and symmetries.
#include "formats/feature_curves.h"

#include <algorithm>
#include <numbers>
#include <utility>

namespace fetex {
namespace {

constexpr std::uint32_t kMirrorX = 1, kMirrorY = 2, kExchange = 4;

double turned_position(std::uint32_t symmetry, FeatureEdge e, double position) {
    const bool along_x = e == FeatureEdge::North || e == FeatureEdge::South;
    return symmetry & (along_x ? kMirrorX : kMirrorY) ? 1 - position : position;
}

/// Into [0, π).
double line_angle(double angle) {
    const double turned = angle < 0 ? angle + std::numbers::pi : angle;
    return turned >= std::numbers::pi ? turned - std::numbers::pi : turned;
}

double turned_angle(std::uint32_t symmetry, double angle) {
    const bool mirrored = ((symmetry & kMirrorX) != 0) != ((symmetry & kMirrorY) != 0);
    const double a = mirrored ? -angle : angle;
    return line_angle(symmetry & kExchange ? line_angle(std::numbers::pi / 2 - line_angle(a)) : a);
}

char letter(FeatureEdge e) { return "NESW"[feature_edge_index(e)]; }

} // namespace

std::vector<FeatureConfiguration> feature_configurations() {
    std::vector<FeatureConfiguration> all;
    for (std::uint32_t word = 0; word <= 0xffff; ++word) {
        const auto c = static_cast<FeatureConfiguration>(word);
        if (feature_valid(c) && feature_edges(c) == c) all.push_back(c);
    }
    return all;
}

std::string feature_name(FeatureConfiguration c) {
    std::string name;
    const FeatureSegmentList list = feature_unpack(c);
    for (std::uint32_t k = 0; k < list.count; ++k) {
        if (!name.empty()) name += ' ';
        name += {letter(list.segment[k].first), list.straight[k] ? '|' : '-', letter(list.segment[k].second)};
    }
    return name.empty() ? "empty" : name;
}

FeatureEdge feature_turned(std::uint32_t symmetry, FeatureEdge e) {
    using enum FeatureEdge;
    if (symmetry & kMirrorX && (e == East || e == West)) e = e == East ? West : East;
    if (symmetry & kMirrorY && (e == North || e == South)) e = e == North ? South : North;
    if ((symmetry & kExchange) == 0) return e;
    switch (e) {
    case North:
        return West;
    case West:
        return North;
    case East:
        return South;
    default:
        return East;
    }
}

FeatureSegment feature_turned(std::uint32_t symmetry, FeatureSegment s) {
    const auto [first, second] = std::minmax({feature_turned(symmetry, s.first), feature_turned(symmetry, s.second)});
    return {first, second};
}

FeatureConfiguration feature_turned(std::uint32_t symmetry, FeatureConfiguration c) {
    const FeatureSegmentList list = feature_unpack(c);
    if (list.count == 0) return 0;
    return feature_pack(feature_turned(symmetry, list.segment[0]), feature_turned(symmetry, list.segment[1]),
                        list.straight[0], list.straight[1]);
}

FeatureSignature feature_turned(std::uint32_t symmetry, const FeatureSignature& s) {
    FeatureSignature out;
    for (const FeatureEdge e : kFeatureEdges) {
        const FeatureCrossing& c = s[feature_edge_index(e)];
        out[feature_edge_index(feature_turned(symmetry, e))] = {turned_position(symmetry, e, c.position),
                                                                turned_angle(symmetry, c.angle)};
    }
    return out;
}

FeaturePoint feature_point(FeatureEdge e, double position) {
    switch (e) {
    case FeatureEdge::North:
        return {position, 0};
    case FeatureEdge::East:
        return {1, position};
    case FeatureEdge::South:
        return {position, 1};
    default:
        return {0, position};
    }
}

} // namespace fetex
