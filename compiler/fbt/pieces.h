// SPDX-License-Identifier: GPL-3.0-or-later
/// Output geometry: the chain of a simple feature as quantised pieces, in texel-local coordinates (formats/fbt.h).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compiler/fbt/features.h"

namespace fetexc {

/// A quantised point, x in the low half.
using PackedPoint = std::uint32_t;

struct Piece {
    int degree = 1;
    std::array<PackedPoint, 4> p{};
    auto operator<=>(const Piece&) const = default;
};

/// Consecutive pieces of one degree; consecutive pieces share end points.
struct Run {
    int degree = 1;
    std::vector<Piece> pieces;
    bool operator==(const Run&) const = default;
};

struct PieceStats {
    std::uint64_t pieces = 0, demoted = 0, vanished = 0;
};

/// Every piece is there an even number of times, whichever way it runs: no ray tells inside from outside.
bool cancel_out(const std::vector<Run>& runs);

/// Joins steps along one arc, lowers degrees within kDemotionTolerance, quantises, drops pieces that vanish. End points
/// come from the nodes, so chains stay closed and neighbouring texels meet.
std::vector<Run> make_runs(const PlanarMap& map, const TexelMap& texel, std::span<const FeatureStep> steps,
                           PieceStats& stats);

} // namespace fetexc
