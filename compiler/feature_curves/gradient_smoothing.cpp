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
        for_rows(threads, [&](std::size_t j) {
            for (std::size_t i = 0; i < columns_; ++i)
                neighbours_[j * columns_ + i] = neighbours_of(i, j);
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
    [[nodiscard]] bool ends(std::size_t i, std::size_t j, fetex::FeatureEdge on) const {
        if (i >= texture_.width || j >= texture_.height) return false; // before the first: beyond the largest number
        const EdgeSet edges = edges_of_configuration(texture_.configurations[j * texture_.width + i]);
        return (edges >> fetex::feature_edge_index(on) & 1u) != 0;
    }
    [[nodiscard]] bool near(std::size_t i, std::size_t j) const {
        return i < columns_ && j < rows_ && map_.distances[j * columns_ + i] < map_.limit;
    }
    /// With the corner to the right, and with that below: no point of a curve between them. A point on the north (west)
    /// edge of texel (i,j) is the south (east) edge's of the texel before.
    [[nodiscard]] bool joined_right(std::size_t i, std::size_t j) const {
        using enum fetex::FeatureEdge;
        return near(i, j) && near(i + 1, j) && !ends(i, j, North) && !ends(i, j - 1, South);
    }
    [[nodiscard]] bool joined_below(std::size_t i, std::size_t j) const {
        using enum fetex::FeatureEdge;
        return near(i, j) && near(i, j + 1) && !ends(i, j, West) && !ends(i - 1, j, East);
    }
    [[nodiscard]] std::uint8_t neighbours_of(std::size_t i, std::size_t j) const {
        unsigned bits = 0;
        if (joined_right(i - 1, j)) bits |= kLeft;
        if (joined_right(i, j)) bits |= kRight;
        if (joined_below(i, j - 1)) bits |= kAbove;
        if (joined_below(i, j)) bits |= kBelow;
        return static_cast<std::uint8_t>(bits);
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
