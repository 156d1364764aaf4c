// SPDX-License-Identifier: GPL-3.0-or-later
/// From arcs and their common points to edges that meet in vertices only (DESIGN §5.1).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <tuple>

#include "compiler/compile.h"
#include "compiler/planar/arrangement.h"

namespace fetexc {

/// A common point of two arcs.
struct PairContact {
    std::uint32_t a = 0, b = 0;
    std::uint32_t vertex = 0;
    std::uint32_t place : 31 = 0; ///< among the contacts of the pair
    std::uint32_t fresh : 1 = 0;  ///< a crossing: a new vertex
    Contact at;
    [[nodiscard]] auto key() const { return std::tuple(a, b, std::uint32_t{place}); }
};

/// Cuts the arcs at their contacts, in parallel; contacts that turn out to be one point become one vertex, which takes
/// the best that is known of it. Returns a vertex whose place on some arc couldn't be decided.
std::optional<Vertex> cut_arcs(Arrangement& arrangement, std::span<const PairContact> contacts, unsigned threads,
                               PlanarStats& stats);

} // namespace fetexc
