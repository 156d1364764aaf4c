// SPDX-License-Identifier: GPL-3.0-or-later
/// A planar subdivision reduced to what two implementations must agree on: vertices, edges, number of faces.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "compiler/planar/arrangement.h"
#include "tests/support/drawn_scene.h"

namespace fetexc::test {

struct Subdivision {
    std::vector<CanvasPoint> vertices;                          ///< every one has an edge
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges; ///< several may join the same two vertices
    std::size_t faces = 0;                                      ///< the unbounded one included
};

/// The edges of the arrangement and the vertices that they use, in units of `unit` planar units; faces by Euler's
/// formula.
[[nodiscard]] Subdivision subdivision_of(const Arrangement& arrangement, double unit);

/// V − E + 1 + C with C connected parts, solved for F.
[[nodiscard]] std::size_t faces_by_euler(const Subdivision& s);

/// Vertices of degree two that are no end of a segment of the paths are where curves were split at extrema: their two
/// edges become one. What remains doesn't depend on where an implementation splits.
[[nodiscard]] Subdivision without_splits(const Subdivision& s, std::span<const Path> paths);

/// Empty when both are the same: vertices one to one within `tolerance` along each axis, as many edges between each two
/// of them, as many faces. Else what is not.
[[nodiscard]] std::string difference(const Subdivision& ours, const Subdivision& theirs, double tolerance);

/// For the way out of another process.
[[nodiscard]] std::vector<double> packed(const Subdivision& s);
[[nodiscard]] Subdivision unpacked(const std::vector<double>& values);

} // namespace fetexc::test
