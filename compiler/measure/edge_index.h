// SPDX-License-Identifier: GPL-3.0-or-later
/// Buckets of visible edges: what passes near a point.
#pragma once

#include <vector>

#include "compiler/measure/truth.h"
#include "compiler/scene/scene_builder.h"

namespace fetexc::measure {

struct WidthBox {
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    [[nodiscard]] double distance(WidthPoint p) const;
};

/// Holds the whole edge.
[[nodiscard]] WidthBox box_of(const VisibleEdge& e);
[[nodiscard]] WidthPoint point_at(const VisibleEdge& e, double t);
/// Derivative by t.
[[nodiscard]] WidthPoint direction_at(const VisibleEdge& e, double t);

class EdgeIndex {
  public:
    /// The edges must outlive the index.
    EdgeIndex(std::span<const VisibleEdge> edges, double height);
    [[nodiscard]] EdgePoint nearest(WidthPoint p, double radius) const;
    [[nodiscard]] bool any_within(WidthPoint p, double radius) const;
    void near(WidthPoint p, double radius, std::vector<std::uint32_t>& out) const;
    /// Distance to one edge, below `radius`; else kNone.
    [[nodiscard]] EdgePoint nearest_on(std::uint32_t edge, WidthPoint p, double radius) const;

  private:
    struct Cells {
        int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    };
    [[nodiscard]] Cells cells_of(const WidthBox& box) const;
    void search_cell(int x, int y, WidthPoint p, EdgePoint& best) const;
    [[nodiscard]] std::span<const std::uint32_t> cell(int x, int y) const;

    std::span<const VisibleEdge> edges_;
    std::vector<WidthBox> boxes_;
    int columns_ = 1, rows_ = 1;
    double side_ = 1; ///< of a cell
    std::vector<std::uint32_t> first_, items_;
};

} // namespace fetexc::measure
