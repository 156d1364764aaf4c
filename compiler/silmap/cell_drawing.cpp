// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/cell_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "compiler/error_budget.h"
#include "compiler/silmap/small_sort.h"

namespace fetexc {
namespace {

using fetex::SilmapPoint;

/// In cells: neither tiny nor huge.
double length(double x, double y) { return std::sqrt(x * x + y * y); }

bool on_line(HalfStep h) { return h % 2 == 0; }

} // namespace

/// Control points in the cell's frame, from top to bottom.
struct CellReader::Polygon {
    int degree = 1;
    std::array<SilmapPoint, 4> p{};

    [[nodiscard]] SilmapPoint at(double t) const {
        std::array<SilmapPoint, 4> q = p;
        for (int n = degree; n > 0; --n) {
            for (int k = 0; k < n; ++k)
                q[k] = {q[k].x + t * (q[k + 1].x - q[k].x), q[k].y + t * (q[k + 1].y - q[k].y)};
        }
        return q[0];
    }

    /// A chord of a curve with second derivative d misses it by at most d/8 of the square of its part.
    [[nodiscard]] int chords(double tolerance) const {
        double bend = 0;
        for (int k = 0; k + 2 <= degree; ++k) {
            bend = std::max(bend, length(p[k].x - 2 * p[k + 1].x + p[k + 2].x, p[k].y - 2 * p[k + 1].y + p[k + 2].y));
        }
        return std::max(1, static_cast<int>(std::ceil(std::sqrt(bend * degree * (degree - 1) / 8 / tolerance))));
    }

    /// Away from an end, of length 1; nothing for a point.
    [[nodiscard]] SilmapPoint direction(bool from_end) const {
        const auto at = [&](int k) -> const SilmapPoint& { return p[from_end ? degree - k : k]; };
        for (int k = 1; k <= degree; ++k) {
            const double dx = at(k).x - at(0).x, dy = at(k).y - at(0).y, size = length(dx, dy);
            if (size > 0) return {dx / size, dy / size};
        }
        return {};
    }
};

void CellDrawing::clear() {
    chords.clear(), corners.clear(), left.clear();
    for (std::vector<double>& side : crossings)
        side.clear();
}

SilmapPoint CellReader::place_of(std::uint32_t i, std::uint32_t j, std::uint32_t node) const {
    const GridNode& n = map_.node(node);
    const Grid& g = map_.grid();
    return {(n.x - static_cast<double>(g.px * i)) / static_cast<double>(g.px),
            (n.y - static_cast<double>(g.py * j)) / static_cast<double>(g.py)};
}

CellReader::Polygon CellReader::polygon_of(const LoneEdge& e) const {
    const Curve& c = *map_.stretch_of(*e.sub).curve;
    const Grid& g = map_.grid();
    Polygon edge;
    edge.degree = c.degree;
    const auto n = static_cast<std::size_t>(c.degree);
    edge.p[0] = place_of(e.i, e.j, e.top), edge.p[n] = place_of(e.i, e.j, e.bottom);
    if (n == 1) return edge;
    const std::array<double, 4> x = stretch(c, Axis::X, e.sub->range.lo, e.sub->range.hi),
                                y = stretch(c, Axis::Y, e.sub->range.lo, e.sub->range.hi);
    const auto x0 = static_cast<double>(c.x.origin - g.px * e.i), y0 = static_cast<double>(c.y.origin - g.py * e.j);
    for (std::size_t k = 1; k < n; ++k)
        edge.p[e.down ? k : n - k] = {(x0 + x[k]) / static_cast<double>(g.px), (y0 + y[k]) / static_cast<double>(g.py)};
    return edge;
}

void CellReader::add_chords(const Polygon& edge, ResultId left, ResultId right, CellDrawing& out) const {
    const int chords = edge.chords(chord_);
    const SilmapPoint& end = edge.p[static_cast<std::size_t>(edge.degree)];
    SilmapPoint from = edge.p[0];
    for (int k = 1; k <= chords; ++k) {
        SilmapPoint to = k == chords ? end : edge.at(static_cast<double>(k) / chords);
        to.y = std::clamp(to.y, from.y, std::max(from.y, end.y)); // rounding
        out.chords.push_back({from.x, from.y, to.x, to.y, left, right});
        from = to;
    }
}

void CellReader::add_edge(const TexelMap& cell, const Portion& portion, CellDrawing& out) {
    const SweepEdge& e = cell.graph.edges[portion.edge];
    const ResultId left = cell.left_result(portion), right = cell.right_result(portion);
    const Polygon edge = polygon_of({cell.i, cell.j, &cell.sub_edges[e.sub], cell.graph.nodes[e.top],
                                     cell.graph.nodes[e.bottom], e.down, left, right});
    ends_.push_back({e.top, edge.direction(false)}), ends_.push_back({e.bottom, edge.direction(true)});
    add_chords(edge, left, right, out);
}

/// Of the ends of visible edges, node by node.
void CellReader::find_corners(const TexelMap& cell, CellDrawing& out) {
    small_sort(ends_, [](const EdgeEnd& a, const EdgeEnd& b) { return a.node < b.node; });
    for (std::size_t k = 0; k < ends_.size();) {
        const std::size_t first = k;
        while (k < ends_.size() && ends_[k].node == ends_[first].node)
            ++k;
        const GridNode& node = map_.node(cell.graph.nodes[ends_[first].node]);
        const SilmapPoint at = place_of(cell.i, cell.j, cell.graph.nodes[ends_[first].node]);
        if (on_line(node.hx) || on_line(node.hy)) {
            if (on_line(node.hx))
                out.crossings[node.hx == cell.frame.left ? fetex::kSilmapWest : fetex::kSilmapEast].push_back(at.y);
            if (on_line(node.hy))
                out.crossings[node.hy == cell.frame.top ? fetex::kSilmapNorth : fetex::kSilmapSouth].push_back(at.x);
            continue;
        }
        const auto edges = static_cast<std::uint32_t>(k - first);
        double turn = 0;
        if (edges == 2) {
            const SilmapPoint &a = ends_[first].direction, &b = ends_[first + 1].direction;
            turn = std::abs(std::atan2(a.y * b.x - a.x * b.y, -a.x * b.x - a.y * b.y));
            if (turn <= budget::kCornerTurn) continue;
        }
        out.corners.push_back({at, edges, turn});
    }
}

void CellReader::read(const TexelMap& cell, CellDrawing& out) {
    out.clear(), ends_.clear();
    for (const Portion& p : cell.sweep.portions) {
        if (cell.left_result(p) != cell.right_result(p)) add_edge(cell, p, out);
    }
    find_corners(cell, out);
    for (const SidePart& part : cell.sweep.sides[static_cast<std::size_t>(TexelSide::Left)])
        out.left.push_back({part.from == kNone ? 0 : place_of(cell.i, cell.j, cell.graph.nodes[part.from]).y,
                            cell.results[part.face]});
}

void CellReader::read(const LoneEdge& e, CellDrawing& out) {
    out.clear();
    const HalfStep west = 2 * static_cast<HalfStep>(e.i), north = 2 * static_cast<HalfStep>(e.j);
    out.left.push_back({0, map_.node(e.top).hx == west ? e.right : e.left});
    for (const std::uint32_t end : {e.top, e.bottom}) {
        const GridNode& n = map_.node(end);
        const SilmapPoint at = place_of(e.i, e.j, end);
        if (n.hx == west) out.left.push_back({at.y, end == e.top ? e.left : e.right});
        if (e.left == e.right) continue;
        if (on_line(n.hx))
            out.crossings[n.hx == west ? fetex::kSilmapWest : fetex::kSilmapEast].push_back(at.y);
        else
            out.crossings[n.hy == north ? fetex::kSilmapNorth : fetex::kSilmapSouth].push_back(at.x);
    }
    if (e.left != e.right) add_chords(polygon_of(e), e.left, e.right, out);
}

} // namespace fetexc
