// SPDX-License-Identifier: GPL-3.0-or-later
/// The one point of each edge of the grid: the centre of mass of all that lines cross it in (§4).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "compiler/parallel.h"
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

/// The profile of the curves that cross an edge: the first one's.
struct EdgeProfile {
    std::uint8_t number = 0;
    bool known = false, others = false; ///< others: some curve has another

    void add(std::uint8_t profile) {
        if (!known) number = profile, known = true;
        others |= number != profile;
    }
};

/// Of an EdgeGrid: where it is in memory.
template <class T> struct EdgeView {
    T* edges = nullptr;
    std::size_t columns = 0;

    /// Of texel (i,j).
    [[nodiscard]] T& at(std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e) const {
        using enum fetex::FeatureEdge;
        const std::size_t column = i + (e == East ? 1u : 0u), row = j + (e == South ? 1u : 0u);
        return edges[2 * (row * columns + column) + (e == East || e == West ? 1u : 0u)];
    }
};

/// Something for every edge of the grid, row by row.
template <class T> class EdgeGrid {
  public:
    EdgeGrid() = default;
    /// Unwritten: see reset_rows.
    EdgeGrid(std::uint32_t width, std::uint32_t height)
        : columns_(std::size_t{width} + 1), edges_((std::size_t{height} + 1) * columns_ * 2) {}

    /// Edges that begin in rows first … last − 1 of corners, 0 … height, as nothing has crossed them. Threads may do
    /// this at once for different rows.
    void reset_rows(std::size_t first, std::size_t last) {
        const auto row = [&](std::size_t j) { return edges_.begin() + static_cast<std::ptrdiff_t>(2 * j * columns_); };
        std::fill(row(first), row(last), T{});
    }

    [[nodiscard]] bool empty() const { return edges_.empty(); }
    [[nodiscard]] EdgeView<T> view() { return {edges_.data(), columns_}; }
    /// Of texel (i,j).
    [[nodiscard]] T& at(std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e) { return view().at(i, j, e); }
    [[nodiscard]] const T& at(std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e) const {
        return EdgeView<const T>{edges_.data(), columns_}.at(i, j, e);
    }

  private:
    std::size_t columns_ = 0;
    UnwrittenVector<T> edges_;
};

using EdgePoints = EdgeGrid<EdgePoint>;
using EdgeDirections = EdgeGrid<EdgeDirection>;
using EdgeProfiles = EdgeGrid<EdgeProfile>;

} // namespace fetexc
