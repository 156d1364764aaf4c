// SPDX-License-Identifier: GPL-3.0-or-later
/// The texels that a line goes through, and exactly where it crosses from one to the next (§4, scan conversion).
///
/// Frame: planar space (compiler/planar/grid.h), integers, so every comparison is exact. A point on a grid line lies
/// right of it or below it; on the right or lower border of the canvas, left of it or above. A line through a corner of
/// the grid passes it as if it were moved to the right by an infinitely small step, and down by a far smaller one (the
/// right and lower borders instead of the line); so lines never go from a texel to the one across a corner, and what
/// crosses or meets does so in one texel.
#pragma once

#include <algorithm>
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

/// A coordinate where a line crosses grid lines across the other axis, base + (grid line − start)·delta/length, as a
/// whole number, from the beginning of the line's cell on, and a rest; step by step, exact.
class GridSteps {
  public:
    GridSteps() = default;
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
    /// The cell begins so much later.
    void shift(std::int64_t by) { whole_ -= by; }

    [[nodiscard]] bool below(std::int64_t v) const { return whole_ < v; }
    [[nodiscard]] bool above(std::int64_t v) const { return whole_ > v || (whole_ == v && rest_ > 0); }

    /// grid_cell of the coordinate, before any shift.
    [[nodiscard]] std::int32_t cell(std::int64_t pitch, std::uint32_t count) const {
        return grid_cell(above(pitch * count) ? pitch * count + 1 : whole_, pitch, count);
    }

    /// Part of the cell.
    [[nodiscard]] double position(double pitch) const {
        return (static_cast<double>(whole_) + static_cast<double>(rest_) * part_) / pitch;
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

    std::int64_t length_ = 1;
    double part_ = 1; ///< 1 / length
    std::int64_t whole_ = 0, rest_ = 0, step_whole_ = 0, step_rest_ = 0;
};

/// Along one axis, from and to which cell.
struct CellRange {
    std::int32_t from = 0, to = 0;
};

/// The grid lines across one axis, in the order in which a line gets to them.
struct GridLines {
    std::int32_t next = 0, left = 0; ///< the next one, how many remain
    bool increasing = true;
    GridSteps at;

    /// Of the lines between cells of a line whose `axis` coordinates go from a to b; the other coordinate begins at
    /// `base` and changes by `delta`.
    GridLines(CellRange cells, std::int64_t a, std::int64_t b, std::int64_t pitch, std::int64_t base,
              std::int64_t delta) {
        const auto [from, to] = cells;
        if (from == to) return;
        increasing = from < to, left = increasing ? to - from : from - to, next = increasing ? from + 1 : from;
        const std::int64_t length = a < b ? b - a : a - b, first = pitch * next;
        at = GridSteps(base, a < b ? first - a : a - first, pitch, delta, length);
    }
};

/// Rows first … last − 1.
struct GridRows {
    std::int32_t first = 0, last = 0;

    [[nodiscard]] bool has(std::int32_t row) const { return first <= row && row < last; }
};

/// Where a line enters, and the grid lines that it crosses from there on.
struct GridWay {
    std::int32_t column = 0, row = 0;
    GridLines across, along; ///< vertical and horizontal ones
    bool leaves = false;     ///< the last of `along` is the last of all
};

/// The walk of walk_rows, its directions known where it is compiled.
template <bool Right, bool Down, class Visit> Visit walk_way(const Grid& grid, GridWay way, Visit visit) {
    constexpr std::int32_t kAcross = Right ? 1 : -1, kAlong = Down ? 1 : -1;
    std::int32_t column = way.column, row = way.row;
    GridLines &across = way.across, &along = way.along;
    across.at.shift(grid.py * row), along.at.shift(grid.px * column);
    const std::int64_t border = Down ? grid.py : 0; // of the row, where the line leaves it
    const auto width = static_cast<double>(grid.px), height = static_cast<double>(grid.py); // of a texel
    // At a corner of the grid (see above): to the right, the vertical line is first, but for the border.
    const auto horizontal_first = [&] {
        if (along.left == 0 || across.left == 0) return across.left == 0;
        if (Down ? across.at.below(border) : across.at.above(border)) return false;
        const bool corner = Down ? !across.at.above(border) : !across.at.below(border);
        return !corner || Right == (across.next == static_cast<std::int32_t>(grid.width));
    };
    while (along.left > 0 || (across.left > 0 && !way.leaves)) {
        if (horizontal_first()) {
            visit(GridCrossing{false, along.next, column, along.at.position(width), Down});
            row += kAlong, across.at.shift(kAlong * grid.py);
            along.next += kAlong, --along.left, along.at.advance();
        } else {
            visit(GridCrossing{true, across.next, row, across.at.position(height), Right});
            column += kAcross, along.at.shift(kAcross * grid.px);
            across.next += kAcross, --across.left, across.at.advance();
        }
    }
    return visit;
}

/// visit(GridCrossing) for every grid line that the line from a to b crosses in the rows or on their border, in order:
/// what walk_grid visits there, bit for bit. Gives `visit` back, as std::for_each does: what a copy knows isn't written
/// to memory at each step.
template <class Visit> Visit walk_rows(const Grid& grid, PlanarPoint a, PlanarPoint b, GridRows rows, Visit visit) {
    const std::int32_t start = grid_cell(a.y, grid.py, grid.height), end = grid_cell(b.y, grid.py, grid.height);
    const CellRange within{std::clamp(start, rows.first - 1, rows.last), std::clamp(end, rows.first - 1, rows.last)};
    if (within.from == within.to && !rows.has(within.from)) return visit;
    const GridLines along(within, a.y, b.y, grid.py, a.x, b.x - a.x);
    const std::int32_t column =
        rows.has(start) ? grid_cell(a.x, grid.px, grid.width) : along.at.cell(grid.px, grid.width);
    const GridLines across({column, grid_cell(b.x, grid.px, grid.width)}, a.x, b.x, grid.px, a.y, b.y - a.y);
    const GridWay way{column, within.from, across, along, !rows.has(end)};
    if (across.increasing)
        return along.increasing ? walk_way<true, true>(grid, way, visit) : walk_way<true, false>(grid, way, visit);
    return along.increasing ? walk_way<false, true>(grid, way, visit) : walk_way<false, false>(grid, way, visit);
}

/// visit(GridCrossing) for every grid line that the line from a to b crosses, in order.
template <class Visit> void walk_grid(const Grid& grid, PlanarPoint a, PlanarPoint b, const Visit& visit) {
    walk_rows(grid, a, b, {-1, static_cast<std::int32_t>(grid.height) + 1}, visit);
}

} // namespace fetexc
