// SPDX-License-Identifier: GPL-3.0-or-later
/// The table of transformations (Parilov and Zorin 2008, §4): a valid configuration and a new segment give a valid
/// configuration. While curves are inserted, a configuration is a set of segments.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

#include "formats/feature_curves.h"

namespace fetexc {

/// Bit k: fetex::kFeatureSegments[k].
using SegmentSet = std::uint8_t;
inline constexpr std::uint32_t kSegmentSets = 1u << fetex::kFeatureSegmentCount;
/// Bit e: the edge with fetex::feature_edge_index e.
using EdgeSet = std::uint8_t;

/// Edges that a segment ends on.
constexpr EdgeSet edges_of_segment(std::uint32_t segment) {
    const fetex::FeatureSegment s = fetex::kFeatureSegments[segment];
    return static_cast<EdgeSet>(1u << fetex::feature_edge_index(s.first) | 1u << fetex::feature_edge_index(s.second));
}
inline constexpr auto kEdgesOf = [] {
    std::array<EdgeSet, kSegmentSets> edges{};
    for (std::uint32_t set = 0; set < kSegmentSets; ++set)
        for (std::uint32_t k = 0; k < fetex::kFeatureSegmentCount; ++k)
            if (set >> k & 1u) edges[set] = static_cast<EdgeSet>(edges[set] | edges_of_segment(k));
    return edges;
}();
constexpr EdgeSet edges_of(SegmentSet set) { return kEdgesOf[set]; }

/// The segment between two edges. Precondition: they differ.
constexpr std::uint32_t segment_between(fetex::FeatureEdge a, fetex::FeatureEdge b) {
    const unsigned wanted = 1u << fetex::feature_edge_index(a) | 1u << fetex::feature_edge_index(b);
    std::uint32_t k = 0;
    while (edges_of_segment(k) != wanted)
        ++k;
    return k;
}

/// Both ways across.
inline constexpr SegmentSet kCrossing = 1u << segment_between(fetex::FeatureEdge::North, fetex::FeatureEdge::South) |
                                        1u << segment_between(fetex::FeatureEdge::East, fetex::FeatureEdge::West);

constexpr bool is_configuration(SegmentSet set) { return std::popcount(set) <= 2; }

/// The transformation of a configuration by a new segment. What is joined stays joined:
/// - up to two segments: all of them;
/// - three between three edges: the two there were lead from each end of the new one to the other;
/// - three that use all four edges join all of them, and of two segments only the crossing does.
/// (Three segments between four edges without a circle are joined; a circle of three has three edges.)
constexpr SegmentSet transformed(SegmentSet configuration, std::uint32_t segment) {
    const auto all = static_cast<SegmentSet>(configuration | 1u << segment);
    if (is_configuration(all)) return all;
    return std::popcount(edges_of(all)) == 3 ? configuration : kCrossing;
}

/// The table; rows of sets that are no configuration stay 0.
constexpr auto transformation_table() {
    std::array<std::array<SegmentSet, fetex::kFeatureSegmentCount>, kSegmentSets> table{};
    for (std::uint32_t set = 0; set < kSegmentSets; ++set) {
        if (!is_configuration(static_cast<SegmentSet>(set))) continue;
        for (std::uint32_t k = 0; k < fetex::kFeatureSegmentCount; ++k)
            table[set][k] = transformed(static_cast<SegmentSet>(set), k);
    }
    return table;
}
inline constexpr auto kTransformations = transformation_table();

/// As a texture has it. Precondition: is_configuration.
constexpr fetex::FeatureConfiguration configuration_of(SegmentSet set) {
    if (set == 0) return 0;
    const auto first = static_cast<std::uint32_t>(std::countr_zero(set)),
               last = static_cast<std::uint32_t>(std::bit_width(set)) - 1;
    return fetex::feature_pack(fetex::kFeatureSegments[first], fetex::kFeatureSegments[last]);
}

/// Its inverse.
constexpr SegmentSet segment_set(fetex::FeatureConfiguration c) {
    unsigned set = 0;
    for (const fetex::FeatureSegment s : fetex::feature_unpack(c))
        set |= 1u << segment_between(s.first, s.second);
    return static_cast<SegmentSet>(set);
}

/// Edges that its segments end on. The word has them in four numbers of four bits, each edge in the lower three.
constexpr EdgeSet edges_of_configuration(fetex::FeatureConfiguration c) {
    const unsigned numbers = 1u << (c & 7u) | 1u << (c >> 4 & 7u) | 1u << (c >> 8 & 7u) | 1u << (c >> 12 & 7u);
    return static_cast<EdgeSet>(numbers >> 1); // 0: no edge
}

} // namespace fetexc
