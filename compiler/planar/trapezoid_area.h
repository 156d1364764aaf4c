// SPDX-License-Identifier: GPL-3.0-or-later
/// Areas of trapezoids by integrals along their sides. Planar space.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "compiler/planar/texel_map.h"

namespace fetexc {

struct BoundedArea {
    double area = 0, error = 0; ///< error: a bound
};

class TrapezoidAreas {
  public:
    TrapezoidAreas(const PlanarMap& map, const TexelMap& texel);
    [[nodiscard]] BoundedArea of(const Trapezoid& t);

  private:
    [[nodiscard]] long double level(std::uint32_t node, bool top) const;
    [[nodiscard]] long double level_error(std::uint32_t node) const;
    [[nodiscard]] long double side_integral(std::uint32_t edge, bool right, long double y0, long double y1);
    [[nodiscard]] long double side_error(std::uint32_t edge, long double height) const;

    const PlanarMap& map_;
    const TexelMap& texel_;
    std::int64_t x0_, y0_; ///< the texel's corner
    long double width_, height_;
    /// Where an edge met the levels asked for last: the trapezoids on its two sides, one above the other, share them.
    struct Meeting {
        long double level = std::numeric_limits<long double>::quiet_NaN(), parameter = 0;
    };
    std::vector<std::array<Meeting, 2>> meetings_; ///< by edge; the last one first
};

} // namespace fetexc
