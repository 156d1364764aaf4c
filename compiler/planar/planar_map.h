// SPDX-License-Identifier: GPL-3.0-or-later
/// The arrangement cut at the texel grid (DESIGN §5.2): for each texel the sub-edges inside it, and the winding numbers
/// at its corner.
#pragma once

#include <span>
#include <vector>

#include "compiler/geometry/precise.h"
#include "compiler/parallel.h"
#include "compiler/planar/algebraic_coordinate.h"
#include "compiler/planar/arrangement.h"

namespace fetexc {

/// Position in half steps of the grid: even 2i = on grid line i, odd 2i+1 = between lines i and i+1; −1 and 2n+1
/// outside the canvas.
using HalfStep = std::int32_t;

/// A vertex or a crossing with a grid line. Each is one object: neighbouring texels share it, so they agree by
/// construction. Whether it lies on a grid line is decided exactly (x or y is then exactly the line's).
struct GridNode {
    double x = 0, y = 0; ///< planar space
    Interval x_range, y_range;
    HalfStep hx = 0, hy = 0;
};

/// Where an edge crosses a grid line.
struct LineCrossing {
    std::uint32_t edge = 0;
    Axis axis = Axis::X;    ///< whose coordinate is the line's
    std::int64_t level = 0; ///< the line's, in planar space
    Interval t;
};

/// Part of an edge inside one texel; t grows from n0 to n1. Never along a grid line.
struct SubEdge {
    std::uint32_t edge = 0;
    Interval range; ///< outer parameter enclosure
    std::uint32_t n0 = 0, n1 = 0;
};

/// Winding change when stepping right over a grid line (or, for line 0, from far left onto the canvas) just below a
/// row's top.
struct RowStep {
    std::uint32_t row = 0, line = 0, arc = 0;
    std::int32_t sign = 1;
};

/// Part of an edge along the side that two texels share; texel: the one to the right of it or below it, row-major.
struct SideEdge {
    Axis across = Axis::X; ///< X: between left and right neighbours
    std::uint32_t texel = 0;
    std::uint32_t n0 = 0, n1 = 0;
};

/// Position along a grid line: a corner of the grid, or a node between two corners.
struct LinePosition {
    HalfStep h = 0;
    std::uint32_t node = kNone; ///< kNone at a corner
    friend bool operator==(const LinePosition&, const LinePosition&) = default;
};

class PlanarMap {
  public:
    static Result<PlanarMap> build(const Scene& scene, const Grid& grid, unsigned threads, PlanarStats& stats,
                                   const SkipRules& skip = {});

    [[nodiscard]] const Grid& grid() const { return grid_; }
    [[nodiscard]] const Arrangement& arrangement() const { return arrangement_; }
    [[nodiscard]] const GridNode& node(std::uint32_t n) const { return nodes_[n]; }
    /// Coordinates of a node to 2^-kFixedBits: exact arithmetic, microseconds. None where that doesn't get so far.
    [[nodiscard]] std::optional<FixedPoint> fixed(std::uint32_t n) const;
    /// The same as algebraic numbers, for exact comparisons: up to milliseconds.
    [[nodiscard]] AlgebraicCoordinate algebraic(std::uint32_t n, Axis axis) const;
    /// Position of a node on a line across the axis (X: a vertical line).
    [[nodiscard]] LinePosition position(std::uint32_t n, Axis across) const;
    /// a comes before b on a line across the axis. undecided is set if nothing could tell, and left alone otherwise.
    [[nodiscard]] bool before(const LinePosition& a, const LinePosition& b, Axis across, bool& undecided) const;
    [[nodiscard]] std::span<const SubEdge> sub_edges(std::uint32_t i, std::uint32_t j) const;
    [[nodiscard]] Stretch stretch_of(const SubEdge& s) const;
    [[nodiscard]] std::span<const Contribution> contributions_of(const SubEdge& s) const;

    /// Some edge runs along the side that texel (i,j) shares with its left (across X) or upper (across Y) neighbour,
    /// somewhere between the two positions.
    [[nodiscard]] bool runs_along(Axis across, std::uint32_t i, std::uint32_t j, const LinePosition& from,
                                  const LinePosition& to, bool& undecided) const;

    /// Runs along row j from left to right; `visit(i, windings)` gets the winding numbers at the texel's corner (X_i +
    /// 0, Y_j + 0), left of everything inside the texel; i = width is the right border, seen from inside. For j =
    /// height: along the bottom border, seen from inside (Y_j − 0).
    template <class Visit> void along_row(std::uint32_t j, Visit&& visit) const {
        Windings w;
        const bool bottom = j == grid_.height;
        std::span<const RowStep> steps = steps_of(j);
        const auto cross_line = [&](std::uint32_t line) {
            for (; !steps.empty() && steps.front().line == line; steps = steps.subspan(1))
                apply(w, steps.front());
        };
        cross_line(0);
        for (std::uint32_t i = 0;; ++i) {
            visit(i, static_cast<const Windings&>(w));
            if (i == grid_.width) return;
            for (const SubEdge& s : sub_edges(i, bottom ? j - 1 : j))
                cross_row_line(w, s, 2 * static_cast<HalfStep>(j));
            if (i + 1 < grid_.width) cross_line(i + 1);
        }
    }

    /// t grows downwards.
    [[nodiscard]] bool runs_down(const SubEdge& s) const;

  private:
    class EdgeWalk;
    class Builder;
    [[nodiscard]] std::span<const RowStep> steps_of(std::uint32_t row) const;
    void apply(Windings& w, const RowStep& step) const;
    void cross_row_line(Windings& w, const SubEdge& s, HalfStep line) const;

    Grid grid_;
    Arrangement arrangement_;
    UnwrittenVector<GridNode> nodes_; ///< the arrangement's vertices, then crossings with grid lines
    UnwrittenVector<LineCrossing> line_crossings_;
    UnwrittenVector<SubEdge> sub_edges_;
    std::vector<std::uint32_t> texel_start_; ///< CSR over texels, row-major
    std::vector<SideEdge> side_edges_;       ///< sorted by direction, texel
    std::vector<RowStep> steps_;             ///< sorted by row, line
    std::vector<std::uint32_t> step_start_;  ///< per row, height + 2 entries
};

} // namespace fetexc
