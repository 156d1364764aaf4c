// SPDX-License-Identifier: GPL-3.0-or-later
/// A texel's edges and its four sides as CGAL sees them (planar/filtered_arc_traits.h): first coordinates run down,
/// second ones to the right. Edges meet in nodes only, so every question is about ranks of nodes, or about two edges
/// at a level where they don't meet.
#pragma once

#include <vector>

#include "compiler/planar/plane_arc.h"
#include "compiler/planar/sweep.h"

namespace fetexc {

/// A question that stayed open, or a graph that is none (its edges cross or overlap): nothing to decide it with.
struct UndecidedPlane {};

class TexelPlane {
  public:
    /// Throws UndecidedPlane when two nodes can't be told apart.
    TexelPlane(const PlanarMap& map, NodeOrder& order, PlanarStats& stats, std::span<const SubEdge> sub_edges,
               const SweepGraph& graph, TexelFrame frame);

    /// A node of the graph or a corner of the texel.
    struct Point {
        std::uint32_t x = 0, y = 0;  ///< ranks; 0: left and top side
        std::uint32_t node = kNone;  ///< sweep node
        std::uint32_t piece = kNone; ///< an edge that ends here, if there is one; level only if all are
    };
    [[nodiscard]] std::span<const Point> points() const { return points_; } ///< by y, then x
    /// The graph's edges, in their order, then pieces of the sides: left, right, top, bottom.
    [[nodiscard]] std::span<const PlaneArc> arcs() const { return arcs_; }
    [[nodiscard]] bool is_edge(std::uint32_t piece) const { return piece < edges_.size(); }
    /// First piece of a side, and the one behind its last.
    [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> side(TexelSide s) const {
        const auto k = static_cast<std::size_t>(s);
        return {side_start_[k], side_end_[k]};
    }

    int compare_first(PlanePoint p, PlanePoint q) const { return sign(point(p).y, point(q).y); }
    int compare(PlanePoint p, PlanePoint q) const { return sign(p.id, q.id); }
    bool is_vertical(const PlaneArc& c) const { return point(c.min).y == point(c.max).y; }
    int compare_at(PlanePoint p, const PlaneArc& c);
    int compare_after(const PlaneArc& a, const PlaneArc& b, PlanePoint p);
    int compare_before(const PlaneArc& a, const PlaneArc& b, PlanePoint p);

  private:
    static int sign(std::uint32_t a, std::uint32_t b) { return a < b ? -1 : a > b ? 1 : 0; }
    [[nodiscard]] const Point& point(PlanePoint p) const { return points_[p.id]; }
    void place_points();
    void add_edges();
    void add_side(TexelSide s);
    int compare_inside(PlanePoint p, const PlaneArc& c);
    int compare_beside(const PlaneArc& a, const PlaneArc& b, PlanePoint common, PlanePoint end_a, PlanePoint end_b);
    int order_between(const PlaneArc& a, const PlaneArc& b, PlanePoint from, PlanePoint to);
    [[nodiscard]] Stretch stretch_of(const PlaneArc& c) const;
    [[nodiscard]] std::uint32_t map_node(PlanePoint p) const { return graph_.nodes[point(p).node]; }

    const PlanarMap& map_;
    NodeOrder& order_;
    PlanarStats& stats_;
    std::span<const SubEdge> sub_edges_;
    const SweepGraph& graph_;
    std::span<const SweepEdge> edges_;
    TexelFrame frame_;
    std::vector<Point> points_;
    std::vector<PlanePoint> point_of_node_;
    std::vector<PlaneArc> arcs_;
    std::array<std::uint32_t, 4> side_start_{}, side_end_{}; ///< by TexelSide
};

} // namespace fetexc
