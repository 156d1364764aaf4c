// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/trapezoid_sides.h"

namespace fetexc {

TrapezoidSides::TrapezoidSides(const PlanarMap& map, std::uint32_t i, std::uint32_t j) : map_(&map) {
    const Grid& g = map.grid();
    columns_ = {static_cast<double>(g.px * i), static_cast<double>(g.px * (i + std::int64_t{1}))};
    rows_ = {static_cast<double>(g.py * j), static_cast<double>(g.py * (j + std::int64_t{1}))};
}

TrapezoidSides::TrapezoidSides(const PlanarMap& map, const TexelMap& texel) : TrapezoidSides(map, texel.i, texel.j) {
    texel_ = &texel;
}

Extent1 TrapezoidSides::levels(const Trapezoid& t) const {
    const auto level = [&](std::uint32_t node) { return map_->node(texel_->graph.nodes[node]).y; };
    return {t.top_node == kNone ? rows_.low : level(t.top_node),
            t.bottom_node == kNone ? rows_.high : level(t.bottom_node)};
}

double TrapezoidSides::x_on(std::uint32_t edge, double y, double side) const {
    if (edge == kNone) return side;
    const Stretch s = map_->stretch_of(texel_->sub_edges[texel_->graph.edges[edge].sub]);
    return value_double(*s.curve, Axis::X, parameter_at(*s.curve, Axis::Y, s.range, s.y_increasing, y).mid());
}

} // namespace fetexc
