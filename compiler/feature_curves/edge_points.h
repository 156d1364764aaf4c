// SPDX-License-Identifier: GPL-3.0-or-later
/// The one point of each edge of the grid: the centre of mass of all that lines cross it in (§4).
#pragma once

#include <algorithm>
#include <cstdint>
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
    /// How far the farthest of its crossings moved.
    [[nodiscard]] double move() const { return std::max(position() - least, most - position()); }
};

class EdgePoints {
  public:
    EdgePoints(std::uint32_t width, std::uint32_t height)
        : columns_(width + 1), points_(2 * std::size_t{columns_} * (std::size_t{height} + 1)) {}

    /// Of texel (i,j).
    [[nodiscard]] EdgePoint& at(std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e) {
        return points_[index(i, j, e)];
    }
    [[nodiscard]] const EdgePoint& at(std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e) const {
        return points_[index(i, j, e)];
    }

  private:
    [[nodiscard]] std::size_t index(std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e) const {
        using enum fetex::FeatureEdge;
        const std::size_t column = i + (e == East ? 1u : 0u), row = j + (e == South ? 1u : 0u);
        return 2 * (row * columns_ + column) + (e == East || e == West ? 1u : 0u);
    }

    std::uint32_t columns_;
    std::vector<EdgePoint> points_;
};

} // namespace fetexc
