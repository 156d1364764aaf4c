// SPDX-License-Identifier: GPL-3.0-or-later
/// grid_walk.h for quadratics. Which grid lines a curve crosses is decided in integers; in which order, from certified
/// enclosures of its parameters there, or by exact arithmetic where they overlap. A curve that touches a grid line
/// without crossing it stays on its side.
#pragma once

#include <array>
#include <vector>

#include "compiler/feature_curves/grid_walk.h"
#include "compiler/geometry/interval.h"

namespace fetexc {

/// Control points in planar space, |coordinate| ≤ 2^43, not on a line.
using PlanarQuadratic = std::array<PlanarPoint, 3>;

struct CurveCrossing {
    GridCrossing at;
    double t = 0;          ///< 0 and 1 at the ends, and only there
    double dx = 0, dy = 0; ///< the tangent, texels
};

/// A grid line crossed, of one axis.
struct AxisCrossing {
    std::int32_t line = 0;
    bool increasing = true;
    Interval t;
};

class CurveWalk {
  public:
    explicit CurveWalk(const Grid& grid) : grid_(grid) {}

    /// All crossings in the order of t; valid until the next call.
    const std::vector<CurveCrossing>& walk(const PlanarQuadratic& curve);

  private:
    /// One coordinate of the curve, and its grid lines: base + 2·half·t + bend·t².
    struct Coordinate {
        std::int64_t first = 0, last = 0, half = 0, bend = 0, pitch = 1;
        std::uint32_t count = 0;
    };
    static Coordinate coordinate(std::int64_t p0, std::int64_t p1, std::int64_t p2, std::int64_t pitch,
                                 std::uint32_t count);
    static void find_crossings(const Coordinate& c, std::vector<AxisCrossing>& out);
    static Interval parameter(const Coordinate& c, const AxisCrossing& crossing, bool at_start, bool at_end);
    /// The vertical grid line is crossed first.
    [[nodiscard]] bool vertical_first(const AxisCrossing& vertical, const AxisCrossing& horizontal) const;
    /// Sign of the difference of the parameters, where enclosures overlap.
    [[nodiscard]] int compare_exactly(const AxisCrossing& vertical, const AxisCrossing& horizontal) const;
    void add(const AxisCrossing& crossing, bool vertical, std::int32_t cell);

    Grid grid_;
    Coordinate x_, y_;
    std::vector<AxisCrossing> across_, along_;
    std::vector<CurveCrossing> out_;
};

} // namespace fetexc
