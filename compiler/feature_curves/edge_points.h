// SPDX-License-Identifier: GPL-3.0-or-later
/// The one point of each edge of the grid: the centre of mass of all that lines cross it in (§4).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "formats/feature_curves.h"

namespace fetexc {

struct EdgePoint {
    double sum = 0, least = 1, most = 0; ///< of positions, 0 … 1
    std::uint32_t count = 0;

    void add(double position) {
        sum += position, ++count;
        least = std::min(least, position), most = std::max(most, position);
    }
    /// Equal positions give that position. Precondition: count > 0.
    [[nodiscard]] double position() const { return std::clamp(sum / count, least, most); }
    /// How far the farthest of its crossings is from a position between them.
    [[nodiscard]] double move(double to) const { return std::max(to - least, most - to); }
};

/// Directions of curves, as lines: their angles doubled, so that opposite ones are the same.
struct EdgeDirection {
    double cosine = 0, sine = 0; ///< sums

    /// Not 0.
    void add(double dx, double dy) {
        const double square = dx * dx + dy * dy;
        cosine += (dx * dx - dy * dy) / square, sine += 2 * dx * dy / square;
    }
    /// Of the mean, [0, π).
    [[nodiscard]] double angle() const {
        const double a = std::atan2(sine, cosine) / 2;
        return a < 0 ? std::fmod(a + std::numbers::pi, std::numbers::pi) : a;
    }
};

/// Something for every edge of the grid.
template <class T> class EdgeGrid {
  public:
    EdgeGrid() = default;
    EdgeGrid(std::uint32_t width, std::uint32_t height)
        : tiles_(width / kTile + 1), points_(std::size_t{tiles_} * (height / kTile + 1) * kTile * kTile * 2) {}

    [[nodiscard]] bool empty() const { return points_.empty(); }
    /// Of texel (i,j).
    [[nodiscard]] T& at(std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e) { return points_[index(i, j, e)]; }
    [[nodiscard]] const T& at(std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e) const {
        return points_[index(i, j, e)];
    }

  private:
    [[nodiscard]] std::size_t index(std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e) const {
        using enum fetex::FeatureEdge;
        const std::size_t column = i + (e == East ? 1u : 0u), row = j + (e == South ? 1u : 0u);
        const std::size_t tile = row / kTile * tiles_ + column / kTile;
        return 2 * (tile * kTile * kTile + row % kTile * kTile + column % kTile) + (e == East || e == West ? 1u : 0u);
    }

    /// Texels a side of what lies together: of points 64 bytes each, a page of memory. Steep lines would touch a page a
    /// texel.
    static constexpr std::size_t kTile = 8;
    std::size_t tiles_ = 0; ///< in a row
    std::vector<T> points_;
};

using EdgePoints = EdgeGrid<EdgePoint>;
using EdgeDirections = EdgeGrid<EdgeDirection>;

} // namespace fetexc
