// SPDX-License-Identifier: GPL-3.0-or-later
/// Any Arrangement_2 as a plain subdivision.
#pragma once

#include <unordered_map>

#include "tests/support/subdivision.h"

namespace fetexc::test {

template <class Arrangement2, class Place> Subdivision plain(const Arrangement2& arrangement, const Place& place) {
    Subdivision out;
    std::unordered_map<const void*, std::uint32_t> index;
    for (auto v = arrangement.vertices_begin(); v != arrangement.vertices_end(); ++v) {
        index[&*v] = static_cast<std::uint32_t>(out.vertices.size());
        out.vertices.push_back(place(v->point()));
    }
    for (auto e = arrangement.edges_begin(); e != arrangement.edges_end(); ++e)
        out.edges.emplace_back(index.at(&*e->source()), index.at(&*e->target()));
    out.faces = arrangement.number_of_faces();
    return out;
}

} // namespace fetexc::test
