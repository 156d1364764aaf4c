// SPDX-License-Identifier: GPL-3.0-or-later
/// On which side of the discontinuities each cluster of a pinchmap lies (Tarini and Cignoni 2005, §7.2 steps 1 and 2).
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace fetexc {

/// Sides of clusters, row by row; beyond the border they repeat.
struct ZoneMask {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> above; ///< 1: the side k = 1

    [[nodiscard]] std::uint8_t at(std::int64_t i, std::int64_t j) const {
        const auto x = static_cast<std::size_t>(std::clamp<std::int64_t>(i, 0, std::int64_t{width} - 1)),
                   y = static_cast<std::size_t>(std::clamp<std::int64_t>(j, 0, std::int64_t{height} - 1));
        return above[y * width + x];
    }
};

/// Clusters around a corner, and what stands there.
struct CornerSides {
    int nw = 0, ne = 0, sw = 0, se = 0;

    [[nodiscard]] bool active() const { return !(nw == ne && ne == sw && sw == se); }
    /// The sides alternate.
    [[nodiscard]] bool cross() const { return nw == se && ne == sw && nw != ne; }
};
/// Of corner (i,j), 0 … width, 0 … height.
CornerSides sides_around(const ZoneMask& mask, std::uint32_t i, std::uint32_t j);

/// Each cluster above where more than half of it is. parts: 0 … 1, of width·height clusters.
ZoneMask majority_mask(std::span<const double> parts, std::uint32_t width, std::uint32_t height);

/// SPEC 8.1 for a cluster: not four active corners nor two across from each other, and a line between two active
/// corners that are neighbours. (Paper, §4.4; the last is SPEC's.)
bool is_valid_cluster(const ZoneMask& mask, std::uint32_t i, std::uint32_t j);

/// What it costs, in square clusters, to lie inside a zone.
struct SideCosts {
    double below = 0, above = 0;
};

/// What the drawing has where the zones may be.
struct ZoneTruth {
    std::vector<double> parts; ///< of each cluster, that is above, 0 … 1
    std::vector<double>
        distances; ///< of each corner, 0 … width by 0 … height, from the outline, clusters; above 0: above
    /// Of each corner. If there are any they count alone, distances and parts don't.
    std::vector<SideCosts> costs;
};

/// Square clusters, about, that no γ can mend: clusters all of whose neighbours are on their own zone's side count with
/// their wrong part, and corners inside a zone, on whose side they aren't, with their distance (far ones no more than
/// those at 1.5). Elsewhere a discontinuity may run up to a cluster beyond its zone (§8). Crosses count as well: they
/// blur.
double unmendable(const ZoneMask& mask, const ZoneTruth& truth);

/// Of a corner's sides, and of its texel's being active although one side would do.
double corner_cost(const ZoneMask& mask, const ZoneTruth& truth, std::uint32_t i, std::uint32_t j);

/// What it cost to keep the constraints.
struct MaskMoves {
    std::uint64_t broken = 0; ///< clusters that broke one before
    std::uint64_t moves = 0;  ///< rectangles of clusters that were set to one side
    double lost = 0;          ///< by how much more is unmendable
};

/// Sets rectangles of 2 or 3 clusters a side to one side, each time the one that makes the least more unmendable for
/// each cluster that it makes valid, larger ones where none of those helps; and those that make a tenth of a cluster
/// less unmendable; until all are valid and none does. (The paper, §7.2, takes squares of 2 × 2 and counts all that is
/// on the wrong side of its zone: lines thinner than a cluster then go, where a wider zone with the right γ keeps
/// them.)
MaskMoves enforce_constraints(ZoneMask& mask, const ZoneTruth& truth);

} // namespace fetexc
