// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
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

/// Both numbers of a gradient at a time, each rounded as if alone.
using Pair [[gnu::vector_size(16)]] = double;
static_assert(sizeof(Pair) == sizeof(DistanceGradient));

Pair load(const DistanceGradient& g) { return Pair{g.x, g.y}; }

/// Of the corner itself, and of each of the four; those not joined are replaced by the corner itself.
struct Weights {
    double itself = 1, share = 0;
};
constexpr std::array<Weights, 16> kWeights = [] { // by NeighbourBits
    std::array<Weights, 16> all{};
    for (unsigned joined = 1; joined < all.size(); ++joined) {
        const int count = std::popcount(joined);
        const double share = kStep / count;
        all[joined] = {1 - kStep - (4 - count) * share, share};
    }
    return all;
}();

class Smoother {
  public:
    Smoother(const DistanceMap& map, const fetex::FeatureCurvesTexture& texture, unsigned threads)
        : map_(map), texture_(texture), columns_(std::size_t{map.width} + 1), rows_(std::size_t{map.height} + 1),
          neighbours_(columns_ * rows_) {
        std::vector<std::uint8_t> joins(columns_ * rows_);
        for_rows(threads, [&](std::size_t j) { find_joins(j, joins.data() + j * columns_); });
        for_rows(threads, [&](std::size_t j) {
            for (std::size_t i = 0; i < columns_; ++i) {
                const std::size_t at = j * columns_ + i;
                unsigned bits = joins[at];
                if (i > 0 && (joins[at - 1] & kRight) != 0) bits |= kLeft;
                if (j > 0 && (joins[at - columns_] & kBelow) != 0) bits |= kAbove;
                neighbours_[at] = static_cast<std::uint8_t>(bits);
            }
        });
    }

    /// visit(row) for all rows of corners.
    template <class Visit> void for_rows(unsigned threads, const Visit& visit) const {
        parallel_for_chunks(rows_, kRows, threads, [&](std::size_t begin, std::size_t end) {
            for (std::size_t j = begin; j < end; ++j)
                visit(j);
        });
    }

    /// Without branches, which no processor could foresee.
    void smooth_row(const DistanceGradient* from, DistanceGradient* to, std::size_t j) const {
        for (std::size_t at = j * columns_; at < (j + 1) * columns_; ++at) {
            const unsigned joined = neighbours_[at];
            const Pair g = load(from[at]), left = load(from[at - (joined & 1u)]),
                       right = load(from[at + (joined >> 1 & 1u)]),
                       above = load(from[at - columns_ * (joined >> 2 & 1u)]),
                       below = load(from[at + columns_ * (joined >> 3 & 1u)]);
            const auto [itself, share] = kWeights[joined];
            const Pair smooth = itself * g + share * (left + right + above + below);
            to[at] = {smooth[0], smooth[1]};
        }
    }

  private:
    /// Of the texels of a row and of none right of them, the edges that segments end on; before the first and behind
    /// the last row: none.
    [[nodiscard]] std::vector<EdgeSet> edges_in_row(std::size_t j) const {
        std::vector<EdgeSet> edges(columns_);
        if (j < texture_.height) // before the first: beyond the largest number
            std::transform(texture_.configurations.data() + j * texture_.width,
                           texture_.configurations.data() + (j + 1) * texture_.width, edges.begin(),
                           edges_of_configuration);
        return edges;
    }

    /// Of the corners of a row, with the one to the right and that below, where no point of a curve is between them.
    /// One on the north (west) edge of a texel is the south (east) edge's of the texel before.
    void find_joins(std::size_t j, std::uint8_t* joins) const {
        using enum fetex::FeatureEdge;
        const auto ends = [](EdgeSet edges, fetex::FeatureEdge on) {
            return (edges >> fetex::feature_edge_index(on) & 1u) != 0;
        };
        const std::vector<EdgeSet> edges = edges_in_row(j), above = edges_in_row(j - 1);
        const double* const distance = map_.distances.data() + j * columns_;
        const double limit = map_.limit;
        for (std::size_t i = 0; i < columns_; ++i) {
            unsigned bits = 0;
            if (i + 1 < columns_ && distance[i + 1] < limit && !ends(edges[i], North) && !ends(above[i], South))
                bits |= kRight;
            if (j + 1 < rows_ && distance[i + columns_] < limit && !ends(edges[i], West) &&
                !(i > 0 && ends(edges[i - 1], East)))
                bits |= kBelow;
            joins[i] = static_cast<std::uint8_t>(distance[i] < limit ? bits : 0);
        }
    }

    const DistanceMap& map_;
    const fetex::FeatureCurvesTexture& texture_;
    std::size_t columns_, rows_;
    std::vector<std::uint8_t> neighbours_; ///< by corner: NeighbourBits
};

} // namespace

void smooth_gradients(DistanceMap& map, const fetex::FeatureCurvesTexture& texture, std::uint32_t iterations,
                      unsigned threads) {
    const Smoother smoother(map, texture, threads);
    std::vector<DistanceGradient> next(map.gradients.size());
    for (std::uint32_t k = 0; k < iterations; ++k) {
        smoother.for_rows(threads, [&](std::size_t j) { smoother.smooth_row(map.gradients.data(), next.data(), j); });
        map.gradients.swap(next);
    }
}

} // namespace fetexc
