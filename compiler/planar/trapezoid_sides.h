// SPDX-License-Identifier: GPL-3.0-or-later
/// Where a trapezoid of a texel's sweep begins and ends, in planar space and double.
#pragma once

#include "compiler/planar/texel_map.h"

namespace fetexc {

struct Extent1 {
    double low = 0, high = 0;
    [[nodiscard]] double at(double part) const { return low + part * (high - low); }
    [[nodiscard]] double size() const { return high - low; }
};

class TrapezoidSides {
  public:
    /// Both must outlive this.
    TrapezoidSides(const PlanarMap& map, const TexelMap& texel);
    /// Of a texel without edges: it has its own sides only.
    TrapezoidSides(const PlanarMap& map, std::uint32_t i, std::uint32_t j);

    /// Levels of its top and bottom.
    [[nodiscard]] Extent1 levels(const Trapezoid& t) const;
    /// Its left and right side at a level.
    [[nodiscard]] Extent1 at(const Trapezoid& t, double y) const { return at(t.left, t.right, y); }
    /// Between two edges of the graph; kNone: the texel's side.
    [[nodiscard]] Extent1 at(std::uint32_t left, std::uint32_t right, double y) const {
        return {x_on(left, y, columns_.low), x_on(right, y, columns_.high)};
    }
    /// The texel's own.
    [[nodiscard]] const Extent1& columns() const { return columns_; }
    [[nodiscard]] const Extent1& rows() const { return rows_; }

  private:
    [[nodiscard]] double x_on(std::uint32_t edge, double y, double side) const;

    const PlanarMap* map_;
    const TexelMap* texel_ = nullptr;
    Extent1 columns_, rows_;
};

} // namespace fetexc
