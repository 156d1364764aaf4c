// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <span>

#include "compiler/planar/planar_map.h"

namespace fetexc {

/// Along a grid line, from a position to the next part's.
struct LinePart {
    LinePosition from;
    std::uint32_t vertex = 0;
};

/// The next part along a line. Parts without length go; parts of one vertex join.
inline void append_part(std::vector<LinePart>& parts, const LinePosition& from, std::uint32_t vertex) {
    if (!parts.empty() && parts.back().from == from) parts.pop_back();
    if (parts.empty() || parts.back().vertex != vertex) parts.push_back({from, vertex});
}

/// visit(vertex of a, vertex of b, from, to) for every stretch along which two parts on the two sides of a grid line
/// face each other, the last parts up to the corner `end`. undecided: as PlanarMap::before.
template <class Visit>
void facing(const PlanarMap& map, Axis across, std::span<const LinePart> a, std::span<const LinePart> b, HalfStep end,
            bool& undecided, const Visit& visit) {
    const auto end_of = [&](std::span<const LinePart> parts, std::size_t k) {
        return k + 1 < parts.size() ? parts[k + 1].from : LinePosition{end};
    };
    const auto before = [&](const LinePosition& p, const LinePosition& q) {
        return map.before(p, q, across, undecided);
    };
    std::size_t i = 0, k = 0;
    while (i < a.size() && k < b.size()) {
        const LinePosition a_end = end_of(a, i), b_end = end_of(b, k);
        const LinePosition from = std::max(a[i].from, b[k].from, before), to = std::min(a_end, b_end, before);
        if (before(from, to)) visit(a[i].vertex, b[k].vertex, from, to);
        if (!before(b_end, a_end)) ++i;
        if (!before(a_end, b_end)) ++k;
    }
}

} // namespace fetexc
