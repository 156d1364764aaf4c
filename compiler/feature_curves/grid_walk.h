// SPDX-License-Identifier: GPL-3.0-or-later
/// The texels that a line goes through, and exactly where it crosses from one to the next (§4, scan conversion).
///
/// Frame: planar space (compiler/planar/grid.h), integers, so every comparison is exact. A point on a grid line lies
/// right of it or below it; on the right or lower border of the canvas, left of it or above. A line through a corner of
/// the grid passes it as if it were moved to the right by an infinitely small step, and down by a far smaller one (the
/// right and lower borders instead of the line); so lines never go from a texel to the one across a corner, and what
/// crosses or meets does so in one texel.
#pragma once

#include <cstdint>

#include "compiler/planar/grid.h"

namespace fetexc {

struct PlanarPoint {
    std::int64_t x = 0, y = 0;
};

/// Column or row of a coordinate: −1 before the canvas, `count` behind it.
inline std::int32_t grid_cell(std::int64_t v, std::int64_t pitch, std::uint32_t count) {
    if (v < 0) return -1;
    if (v > pitch * count) return static_cast<std::int32_t>(count);
    return static_cast<std::int32_t>(std::min<std::int64_t>(v / pitch, std::int64_t{count} - 1));
}

/// Where a line crosses a grid line.
struct GridCrossing {
    bool vertical = false; ///< the grid line is
    std::int32_t line = 0; ///< 0 … W of vertical ones, 0 … H of the others
    std::int32_t cell = 0; ///< row, or column, −1 and count outside the canvas
    double position = 0; ///< 0 … 1 along the cell, the exact one but for four roundings; exact at vertices and corners
    bool increasing = true; ///< to the right, or down
};

/// base + (k-th grid line − start)·delta/length as a whole number and a rest, step by step, exact.
class GridSteps {
  public:
    /// distance: from the start to the first grid line, along the line's way; length > 0; pitch: between grid lines.
    GridSteps(std::int64_t base, std::int64_t distance, std::int64_t pitch, std::int64_t delta, std::int64_t length)
        : length_(length), part_(1 / static_cast<double>(length)) {
        divide(Wide{distance} * delta, whole_, rest_);
        whole_ += base;
        divide(Wide{pitch} * delta, step_whole_, step_rest_);
    }

    void advance() {
        whole_ += step_whole_, rest_ += step_rest_;
        if (rest_ >= length_) rest_ -= length_, ++whole_;
    }

    /// Sign of the coordinate minus v.
    [[nodiscard]] int compare(std::int64_t v) const {
        if (whole_ != v) return whole_ < v ? -1 : 1;
        return rest_ > 0 ? 1 : 0;
    }

    /// Part of the cell that begins at `origin`.
    [[nodiscard]] double position(std::int64_t origin, std::int64_t pitch) const {
        return (static_cast<double>(whole_ - origin) + static_cast<double>(rest_) * part_) / static_cast<double>(pitch);
    }

  private:
    __extension__ using Wide = __int128;

    void divide(Wide n, std::int64_t& whole, std::int64_t& rest) const {
        const auto narrow = static_cast<std::int64_t>(n);
        if (narrow == n) {
            whole = narrow / length_, rest = narrow % length_;
        } else {
            whole = static_cast<std::int64_t>(n / length_), rest = static_cast<std::int64_t>(n % length_);
        }
        if (rest < 0) rest += length_, --whole;
    }

    std::int64_t length_;
    double part_; ///< 1 / length
    std::int64_t whole_ = 0, rest_ = 0, step_whole_ = 0, step_rest_ = 0;
};

/// The grid lines across one axis, in the order in which a line gets to them.
struct GridLines {
    std::int32_t next = 0, left = 0, step = 1; ///< the next one, how many remain
    GridSteps at;

    /// Of the lines that cross `axis` coordinates from a to b; the other coordinate begins at `base` and changes by
    /// `delta`.
    GridLines(std::int64_t a, std::int64_t b, std::int64_t pitch, std::uint32_t count, std::int64_t base,
              std::int64_t delta)
        : at(0, 0, 0, 0, 1) {
        const std::int32_t from = grid_cell(a, pitch, count), to = grid_cell(b, pitch, count);
        if (from == to) return;
        step = from < to ? 1 : -1, left = from < to ? to - from : from - to, next = from < to ? from + 1 : from;
        const std::int64_t length = a < b ? b - a : a - b, first = pitch * next;
        at = GridSteps(base, a < b ? first - a : a - first, pitch, delta, length);
    }
    void advance() { next += step, --left, at.advance(); }
};

/// visit(GridCrossing) for every grid line that the line from a to b crosses, in order.
template <class Visit> void walk_grid(const Grid& grid, PlanarPoint a, PlanarPoint b, Visit&& visit) {
    GridLines across(a.x, b.x, grid.px, grid.width, a.y, b.y - a.y);
    GridLines along(a.y, b.y, grid.py, grid.height, a.x, b.x - a.x);
    std::int32_t column = grid_cell(a.x, grid.px, grid.width), row = grid_cell(a.y, grid.py, grid.height);
    const bool down = b.y > a.y;
    const auto cross_horizontal = [&] {
        visit(GridCrossing{false, along.next, column, along.at.position(grid.px * column, grid.px), down});
        row += along.step;
        along.advance();
    };
    while (across.left > 0) {
        // At a corner of the grid (see above): to the right, the vertical line is first, but for the border.
        const bool vertical_first = (across.step > 0) != (across.next == static_cast<std::int32_t>(grid.width));
        while (along.left > 0) {
            const int side = across.at.compare(grid.py * along.next);
            if (side == 0 ? vertical_first : (side > 0) != down) break;
            cross_horizontal();
        }
        visit(GridCrossing{true, across.next, row, across.at.position(grid.py * row, grid.py), across.step > 0});
        column += across.step;
        across.advance();
    }
    while (along.left > 0)
        cross_horizontal();
}

} // namespace fetexc
