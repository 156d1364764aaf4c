// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <bit>

#include "compiler/feature_curves/distance_map.h"
#include "compiler/feature_curves/transformations.h"
#include "compiler/parallel.h"

namespace fetexc {
namespace {

constexpr std::size_t kRows = 16; ///< of corners, for a thread at a time
constexpr double kStep = 0.5;     ///< part of the way to the mean

/// The corners that a corner is smoothed with.
enum NeighbourBit : std::uint8_t { kLeft = 1, kRight = 2, kAbove = 4, kBelow = 8 };

class Smoother {
  public:
    Smoother(const DistanceMap& map, const fetex::FeatureCurvesTexture& texture)
        : map_(map), columns_(std::size_t{map.width} + 1), rows_(std::size_t{map.height} + 1),
          neighbours_(columns_ * rows_) {
        for (std::size_t j = 0; j < rows_; ++j)
            for (std::size_t i = 0; i < columns_; ++i)
                join(i, j, texture);
    }

    /// Without branches, which no processor could foresee: what isn't joined is replaced by the corner itself.
    void smooth_row(const std::vector<DistanceGradient>& from, std::vector<DistanceGradient>& to, std::size_t j) const {
        static constexpr std::array<double, 5> kShare = {0, kStep, kStep / 2, kStep / 3, kStep / 4};
        for (std::size_t at = j * columns_; at < (j + 1) * columns_; ++at) {
            const unsigned joined = neighbours_[at];
            const auto count = static_cast<std::size_t>(std::popcount(joined));
            const DistanceGradient &g = from[at], &left = from[at - (joined & 1u)],
                                   &right = from[at + (joined >> 1 & 1u)],
                                   &above = from[at - columns_ * (joined >> 2 & 1u)],
                                   &below = from[at + columns_ * (joined >> 3 & 1u)];
            const double share = kShare[count],
                         itself = (count > 0 ? 1 - kStep : 1) - static_cast<double>(4 - count) * share;
            to[at] = {itself * g.x + share * (left.x + right.x + above.x + below.x),
                      itself * g.y + share * (left.y + right.y + above.y + below.y)};
        }
    }

  private:
    /// A point of a curve on the north (west) edge of texel (i,j) is the south (east) edge's of the texel before.
    static bool has_point(const fetex::FeatureCurvesTexture& t, std::size_t i, std::size_t j, fetex::FeatureEdge e) {
        const auto ends = [&](std::size_t x, std::size_t y, fetex::FeatureEdge on) {
            if (x >= t.width || y >= t.height) return false; // before the first: beyond the largest number
            const EdgeSet edges = edges_of(segment_set(t.configurations[y * t.width + x]));
            return (edges >> fetex::feature_edge_index(on) & 1u) != 0;
        };
        using enum fetex::FeatureEdge;
        return e == North ? ends(i, j, North) || ends(i, j - 1, South) : ends(i, j, West) || ends(i - 1, j, East);
    }

    /// With the corner to the right and that below.
    void join(std::size_t i, std::size_t j, const fetex::FeatureCurvesTexture& texture) {
        const std::size_t at = j * columns_ + i;
        const auto near = [&](std::size_t corner) { return map_.distances[corner] < map_.limit; };
        const auto set = [&](std::size_t corner, NeighbourBit bit) {
            neighbours_[corner] = static_cast<std::uint8_t>(neighbours_[corner] | bit);
        };
        if (!near(at)) return;
        if (i + 1 < columns_ && near(at + 1) && !has_point(texture, i, j, fetex::FeatureEdge::North))
            set(at, kRight), set(at + 1, kLeft);
        if (j + 1 < rows_ && near(at + columns_) && !has_point(texture, i, j, fetex::FeatureEdge::West))
            set(at, kBelow), set(at + columns_, kAbove);
    }

    const DistanceMap& map_;
    std::size_t columns_, rows_;
    std::vector<std::uint8_t> neighbours_; ///< by corner: NeighbourBits
};

} // namespace

void smooth_gradients(DistanceMap& map, const fetex::FeatureCurvesTexture& texture, std::uint32_t iterations,
                      unsigned threads) {
    const Smoother smoother(map, texture);
    std::vector<DistanceGradient> next(map.gradients.size());
    for (std::uint32_t k = 0; k < iterations; ++k) {
        parallel_for_chunks(std::size_t{map.height} + 1, kRows, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t j = begin; j < end; ++j)
                smoother.smooth_row(map.gradients, next, j);
        });
        map.gradients.swap(next);
    }
}

} // namespace fetexc
