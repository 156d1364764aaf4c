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
    std::uint32_t first_piece = 0, pieces = 0; ///< in PieceRuns::pieces
};

/// Runs of several features, one after the other.
struct PieceRuns {
    std::vector<Run> runs;
    std::vector<Piece> pieces;

    [[nodiscard]] std::span<const Piece> pieces_of(const Run& r) const {
        return std::span(pieces).subspan(r.first_piece, r.pieces);
    }
    void clear() { runs.clear(), pieces.clear(); }
    /// Takes back the runs from this one on.
    void truncate(std::size_t run) {
        if (run == runs.size()) return;
        pieces.resize(runs[run].first_piece);
        runs.resize(run);
    }
};

struct PieceStats {
    std::uint64_t pieces = 0, demoted = 0, vanished = 0;
};

/// Every piece from a run on is there an even number of times, whichever way it runs: no ray tells inside from outside.
bool cancel_out(const PieceRuns& all, std::size_t first_run);

/// Appends: joins steps along one arc, lowers degrees within kDemotionTolerance, quantises, drops pieces that vanish.
/// End points come from the nodes, so chains stay closed and neighbouring texels meet.
void make_runs(const PlanarMap& map, const TexelMap& texel, std::span<const FeatureStep> steps, PieceRuns& out,
               PieceStats& stats);

} // namespace fetexc
