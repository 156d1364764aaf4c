// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/edge_index.h"

#include <algorithm>
#include <cmath>

#include "compiler/scene/bezier.h"
#include "compiler/scene/curve_distance.h"

namespace fetexc::measure {
namespace {

/// Width units to about lattice steps, for which scene/curve_distance states its accuracy (1e-6 steps: 2^-45 of the
/// width). A power of two: exact.
constexpr double kSteps = static_cast<double>(kLatticeSteps);

CanvasSegment scaled(const VisibleEdge& e, double factor) {
    CanvasSegment s;
    s.degree = e.degree;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(e.degree); ++i)
        s.p[i] = {e.p[i].x * factor, e.p[i].y * factor};
    return s;
}

} // namespace

double WidthBox::distance(WidthPoint p) const {
    const double dx = std::max({x0 - p.x, p.x - x1, 0.0}), dy = std::max({y0 - p.y, p.y - y1, 0.0});
    if (dx == 0) return dy; // as hypot, which is slow
    return dy == 0 ? dx : std::hypot(dx, dy);
}

WidthBox box_of(const VisibleEdge& e) {
    WidthBox box{e.p[0].x, e.p[0].y, e.p[0].x, e.p[0].y};
    for (std::size_t i = 1; i <= static_cast<std::size_t>(e.degree); ++i) {
        box.x0 = std::min(box.x0, e.p[i].x), box.x1 = std::max(box.x1, e.p[i].x);
        box.y0 = std::min(box.y0, e.p[i].y), box.y1 = std::max(box.y1, e.p[i].y);
    }
    return box;
}

WidthPoint point_at(const VisibleEdge& e, double t) {
    const CanvasPoint p = bezier::point_at(scaled(e, 1), t);
    return {p.x, p.y};
}

WidthPoint direction_at(const VisibleEdge& e, double t) {
    std::array<WidthPoint, 3> d{};
    const auto n = static_cast<std::size_t>(e.degree);
    for (std::size_t i = 0; i < n; ++i)
        d[i] = {e.degree * (e.p[i + 1].x - e.p[i].x), e.degree * (e.p[i + 1].y - e.p[i].y)};
    for (std::size_t level = n - 1; level > 0; --level) {
        for (std::size_t i = 0; i < level; ++i)
            d[i] = {d[i].x + t * (d[i + 1].x - d[i].x), d[i].y + t * (d[i + 1].y - d[i].y)};
    }
    return d[0];
}

EdgeIndex::EdgeIndex(std::span<const VisibleEdge> edges, double height) : edges_(edges) {
    const double wanted = std::clamp(2 * std::sqrt(static_cast<double>(edges.size())), 8.0, 1024.0);
    side_ = std::max(1.0, height) / wanted;
    columns_ = std::max(1, static_cast<int>(std::ceil(1 / side_)));
    rows_ = std::max(1, static_cast<int>(std::ceil(height / side_)));
    std::vector<std::uint32_t> count(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
    for (const VisibleEdge& e : edges)
        boxes_.push_back(box_of(e));
    const auto each_cell = [&](const auto& visit) {
        for (std::uint32_t e = 0; e < boxes_.size(); ++e) {
            const Cells c = cells_of(boxes_[e]);
            for (int y = c.y0; y <= c.y1; ++y) {
                for (int x = c.x0; x <= c.x1; ++x)
                    visit(static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) +
                              static_cast<std::size_t>(x),
                          e);
            }
        }
    };
    each_cell([&](std::size_t cell, std::uint32_t) { ++count[cell + 1]; });
    for (std::size_t k = 1; k < count.size(); ++k)
        count[k] += count[k - 1];
    first_ = count;
    items_.resize(first_.back());
    each_cell([&](std::size_t cell, std::uint32_t e) { items_[count[cell]++] = e; });
}

EdgeIndex::Cells EdgeIndex::cells_of(const WidthBox& box) const {
    const auto index = [&](double v, int n) {
        return static_cast<int>(std::clamp(std::floor(v / side_), 0.0, static_cast<double>(n - 1)));
    };
    return {index(box.x0, columns_), index(box.y0, rows_), index(box.x1, columns_), index(box.y1, rows_)};
}

std::span<const std::uint32_t> EdgeIndex::cell(int x, int y) const {
    const std::size_t k =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
    return std::span(items_).subspan(first_[k], first_[k + 1] - first_[k]);
}

EdgePoint EdgeIndex::nearest_on(std::uint32_t edge, WidthPoint p, double radius) const {
    const CurveDistance d =
        nearest_below(scaled(edges_[edge], kSteps), p.x * kSteps, p.y * kSteps, {radius * kSteps, -1});
    if (d.t < 0) return {kNone, 0, radius};
    return {edge, d.t, d.distance / kSteps};
}

void EdgeIndex::search_cell(int x, int y, WidthPoint p, EdgePoint& best) const {
    for (std::uint32_t e : cell(x, y)) {
        if (boxes_[e].distance(p) >= best.distance) continue;
        const EdgePoint found = nearest_on(e, p, best.distance);
        if (found.edge != kNone) best = found;
    }
}

/// Rings of cells around the point's own (or the nearest to it), until no nearer edge can follow.
EdgePoint EdgeIndex::nearest(WidthPoint p, double radius) const {
    EdgePoint best{kNone, 0, radius};
    const Cells own = cells_of({p.x, p.y, p.x, p.y});
    for (int ring = 0; ring <= std::max(columns_, rows_); ++ring) {
        if ((ring - 1) * side_ >= best.distance) break;
        const int y0 = own.y0 - ring, y1 = own.y0 + ring, x0 = own.x0 - ring, x1 = own.x0 + ring;
        for (int y = std::max(y0, 0); y <= std::min(y1, rows_ - 1); ++y) {
            const bool whole = y == y0 || y == y1;
            for (int x = std::max(x0, 0); x <= std::min(x1, columns_ - 1); ++x) {
                if (!whole && x != x0 && x != x1) {
                    x = std::min(x1, columns_) - 1; // on to the ring's right side
                    continue;
                }
                search_cell(x, y, p, best);
            }
        }
    }
    return best;
}

bool EdgeIndex::any_within(WidthPoint p, double radius) const {
    const Cells c = cells_of({p.x - radius, p.y - radius, p.x + radius, p.y + radius});
    for (int y = c.y0; y <= c.y1; ++y) {
        for (int x = c.x0; x <= c.x1; ++x) {
            for (std::uint32_t e : cell(x, y)) {
                if (boxes_[e].distance(p) < radius && nearest_on(e, p, radius).edge != kNone) return true;
            }
        }
    }
    return false;
}

void EdgeIndex::near(WidthPoint p, double radius, std::vector<std::uint32_t>& out) const {
    out.clear();
    const Cells c = cells_of({p.x - radius, p.y - radius, p.x + radius, p.y + radius});
    for (int y = c.y0; y <= c.y1; ++y) {
        for (int x = c.x0; x <= c.x1; ++x) {
            for (std::uint32_t e : cell(x, y)) {
                if (boxes_[e].distance(p) <= radius) out.push_back(e);
            }
        }
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
}

} // namespace fetexc::measure
