// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/snapping.h"

#include <algorithm>
#include <utility>

#include "compiler/feature_curves/displacement.h"
#include "compiler/feature_curves/edge_points.h"
#include "compiler/feature_curves/grid_walk.h"
#include "compiler/feature_curves/knots.h"

namespace fetexc {
namespace {

using fetex::FeatureEdge;

constexpr auto segment_table() {
    std::array<std::array<std::uint8_t, 4>, 4> table{};
    for (const FeatureEdge a : fetex::kFeatureEdges)
        for (const FeatureEdge b : fetex::kFeatureEdges)
            if (a != b)
                table[fetex::feature_edge_index(a)][fetex::feature_edge_index(b)] =
                    static_cast<std::uint8_t>(segment_between(a, b));
    return table;
}
constexpr auto kSegmentBetween = segment_table();

/// Where a line leaves a texel, and where it comes into the next.
struct Passage {
    FeatureEdge out{}, in{};
};
Passage passage(const GridCrossing& c, bool right, bool down) {
    using enum FeatureEdge;
    if (c.vertical) return right ? Passage{East, West} : Passage{West, East};
    return down ? Passage{South, North} : Passage{North, South};
}

class Snapper {
  public:
    Snapper(const LatticeLines& lines, std::uint32_t width, std::uint32_t height)
        : lines_(lines), grid_(make_grid(lines.extent, width, height)), points_(width, height),
          inside_(lines.vertices.size()), degree_(lines.vertices.size()) {
        out_.width = width, out_.height = height;
        out_.texels.resize(std::size_t{width} * height);
    }

    SnappedCurves run() {
        for (const auto& [a, b] : lines_.lines)
            insert_line(a, b);
        insert_knots();
        settle_points();
        out_.moves = measure_moves(out_, points_, knots_);
        count();
        return std::move(out_);
    }

  private:
    [[nodiscard]] PlanarPoint planar(std::uint32_t vertex) const {
        const LatticePoint& p = lines_.vertices[vertex];
        return {p.x * grid_.kx, p.y * grid_.ky};
    }
    [[nodiscard]] std::int32_t column(PlanarPoint p) const { return grid_cell(p.x, grid_.px, grid_.width); }
    [[nodiscard]] std::int32_t row(PlanarPoint p) const { return grid_cell(p.y, grid_.py, grid_.height); }
    [[nodiscard]] bool on_canvas(std::int32_t i, std::int32_t j) const {
        return i >= 0 && j >= 0 && i < static_cast<std::int32_t>(grid_.width) &&
               j < static_cast<std::int32_t>(grid_.height);
    }
    SnappedTexel& texel(std::uint32_t i, std::uint32_t j) { return out_.texels[std::size_t{j} * grid_.width + i]; }

    /// By the table.
    void insert(std::uint32_t i, std::uint32_t j, std::uint32_t segment) {
        SnappedTexel& t = texel(i, j);
        t.segments = kTransformations[t.segments][segment];
        t.inserted = static_cast<SegmentSet>(t.inserted | 1u << segment);
        ++out_.stats.segments;
    }

    /// The edge's points, unless it is off the canvas.
    void cross(const GridCrossing& c) {
        const std::uint32_t cells = c.vertical ? grid_.height : grid_.width;
        if (c.cell < 0 || c.cell >= static_cast<std::int32_t>(cells)) return;
        const auto line = static_cast<std::uint32_t>(c.line), cell = static_cast<std::uint32_t>(c.cell);
        EdgePoint& p =
            c.vertical ? points_.at(line, cell, FeatureEdge::West) : points_.at(cell, line, FeatureEdge::North);
        __builtin_prefetch(&p, 1);
        crossed_.push_back({&p, c.position});
    }

    /// After the whole line, when memory had time to arrive: most of the time was spent waiting for it.
    void add_crossings() {
        for (const auto& [point, position] : crossed_)
            point->add(position);
        out_.stats.crossings += crossed_.size();
        crossed_.clear();
    }

    void insert_line(std::uint32_t a, std::uint32_t b) {
        const PlanarPoint from = planar(a), to = planar(b);
        std::int32_t i = column(from), j = row(from);
        bool crossed = false;
        FeatureEdge in{};
        double position = 0;
        walk_grid(grid_, from, to, [&](const GridCrossing& c) {
            const Passage p = passage(c, to.x > from.x, to.y > from.y);
            cross(c);
            if (on_canvas(i, j)) {
                if (crossed)
                    insert(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j),
                           kSegmentBetween[fetex::feature_edge_index(in)][fetex::feature_edge_index(p.out)]);
                else
                    add_arm(a, p.out, c.position);
            }
            in = p.in, position = c.position, crossed = true;
            if (c.vertical)
                i += to.x > from.x ? 1 : -1;
            else
                j += to.y > from.y ? 1 : -1;
        });
        add_crossings();
        ++degree_[a], ++degree_[b];
        if (crossed) {
            if (on_canvas(i, j)) add_arm(b, in, position);
        } else if (on_canvas(i, j)) {
            inside_.unite(a, b);
            knot_lines_.push_back({a, b, {}, local(a), local(b)});
        }
    }

    void add_arm(std::uint32_t vertex, FeatureEdge e, double position) {
        arms_.push_back({vertex, e, position});
        knot_lines_.push_back({vertex, kNone, e, local(vertex), fetex::feature_point(e, position)});
    }

    /// In its texel.
    [[nodiscard]] fetex::FeaturePoint local(std::uint32_t vertex) const {
        const PlanarPoint p = planar(vertex);
        return {static_cast<double>(p.x - grid_.px * column(p)) / static_cast<double>(grid_.px),
                static_cast<double>(p.y - grid_.py * row(p)) / static_cast<double>(grid_.py)};
    }

    [[nodiscard]] KnotVertex knot_vertex(std::uint32_t vertex) const {
        const PlanarPoint p = planar(vertex);
        const std::int64_t x = p.x - grid_.px * column(p), y = p.y - grid_.py * row(p);
        const auto on = [](bool is, FeatureEdge e) { return is ? 1u << fetex::feature_edge_index(e) : 0u; };
        using enum FeatureEdge;
        return {vertex, local(vertex),
                static_cast<EdgeSet>(on(y == 0, North) | on(x == grid_.px, East) | on(y == grid_.py, South) |
                                     on(x == 0, West))};
    }

    /// Everything by knot, knots by their first vertex.
    void insert_knots() {
        for (std::uint32_t v = 0; v < lines_.vertices.size(); ++v)
            if (degree_[v] > 0 && on_canvas(column(planar(v)), row(planar(v)))) vertices_.push_back(knot_vertex(v));
        const auto knot_of = [&](const auto& part) { return inside_.find(part.vertex); };
        std::ranges::stable_sort(vertices_, {}, knot_of);
        std::ranges::stable_sort(arms_, {}, knot_of);
        std::ranges::stable_sort(knot_lines_, {}, knot_of);
        std::size_t vertex = 0, arm = 0, line = 0;
        const auto next = [&](const auto& parts, std::size_t& at, std::uint32_t knot) {
            const std::size_t first = at;
            while (at < parts.size() && knot_of(parts[at]) == knot)
                ++at;
            return std::span(parts.data() + first, at - first);
        };
        while (vertex < vertices_.size()) {
            const std::uint32_t knot = knot_of(vertices_[vertex]);
            insert_knot(knot, next(vertices_, vertex, knot), next(arms_, arm, knot), next(knot_lines_, line, knot));
        }
    }

    void insert_knot(std::uint32_t vertex, std::span<const KnotVertex> vertices, std::span<const KnotArm> arms,
                     std::span<const KnotLine> lines) {
        const PlanarPoint p = planar(vertex);
        const Knot knot{static_cast<std::uint32_t>(column(p)), static_cast<std::uint32_t>(row(p)), vertices, arms,
                        lines};
        KnotShape shape = shape_of(knot);
        if (shape.segments != 0)
            for (const KnotEnd& end : shape.ends)
                points_.at(knot.i, knot.j, end.edge).add(end.position);
        for (std::uint32_t k = 0; k < fetex::kFeatureSegmentCount; ++k)
            if (shape.segments >> k & 1u) insert(knot.i, knot.j, k);
        if (std::popcount(shape.edges) > 2) ++out_.stats.junctions;
        std::vector<FeatureEdge> ends = ends_of(knot, shape);
        knots_.push_back({knot, std::move(shape), std::move(ends)});
    }

    /// Means of the edges that segments end on.
    void settle_points() {
        const std::size_t corners = (std::size_t{grid_.width} + 1) * (std::size_t{grid_.height} + 1);
        out_.north.assign(corners, fetex::FeatureCrossing{}.position);
        out_.west.assign(corners, fetex::FeatureCrossing{}.position);
        for (std::uint32_t j = 0; j < grid_.height; ++j) {
            for (std::uint32_t i = 0; i < grid_.width; ++i) {
                const EdgeSet edges = edges_of(texel(i, j).segments);
                for (const FeatureEdge e : fetex::kFeatureEdges)
                    if (edges >> fetex::feature_edge_index(e) & 1u)
                        out_.position(i, j, e) = points_.at(i, j, e).position();
            }
        }
    }

    void count() {
        SnapStats& s = out_.stats;
        s.lines = lines_.lines.size();
        for (const SnappedTexel& t : out_.texels)
            if (t.inserted != t.segments)
                s.rerouted +=
                    static_cast<std::uint64_t>(std::popcount(static_cast<unsigned>(t.inserted & ~t.segments)));
        for (const ShownKnot& k : knots_) {
            const std::uint8_t kind = missing_kind(k);
            s.ends_cut += kind == kEndCut, s.folded += kind == kFolded, s.lost_inside += kind == kLostInside;
        }
    }

    const LatticeLines& lines_;
    Grid grid_;
    EdgePoints points_;
    UnionFind inside_; ///< vertices joined by lines that leave no texel
    std::vector<std::uint32_t> degree_;
    std::vector<std::pair<EdgePoint*, double>> crossed_; ///< by the line being inserted
    std::vector<KnotVertex> vertices_;
    std::vector<KnotArm> arms_;
    std::vector<KnotLine> knot_lines_;
    std::vector<ShownKnot> knots_;
    SnappedCurves out_;
};

} // namespace

bool SnappedCurves::is_used(std::uint32_t i, std::uint32_t j, FeatureEdge e) const {
    using enum FeatureEdge;
    const std::int64_t column = std::int64_t{i} + (e == East ? 1 : 0), row = std::int64_t{j} + (e == South ? 1 : 0);
    const auto ends = [&](std::int64_t x, std::int64_t y, FeatureEdge on) {
        if (x < 0 || y < 0 || x >= width || y >= height) return false;
        const EdgeSet edges = edges_of(texels[static_cast<std::size_t>(y * width + x)].segments);
        return (edges >> fetex::feature_edge_index(on) & 1u) != 0;
    };
    const bool vertical = e == East || e == West;
    return vertical ? ends(column, row, West) || ends(column - 1, row, East)
                    : ends(column, row, North) || ends(column, row - 1, South);
}

SnappedCurves snap_lines(const LatticeLines& lines, std::uint32_t width, std::uint32_t height) {
    return Snapper(lines, width, height).run();
}

fetex::FeatureCurvesTexture linear_texture(const SnappedCurves& curves, fetex::FeatureNumberFormat format,
                                           float distance_limit) {
    fetex::FeatureCurvesTexture t =
        fetex::feature_empty_texture(curves.width, curves.height, format, true, distance_limit);
    std::ranges::transform(curves.texels, t.configurations.begin(),
                           [](const SnappedTexel& s) { return configuration_of(s.segments); });
    for (std::uint32_t j = 0; j <= curves.height; ++j) {
        for (std::uint32_t i = 0; i <= curves.width; ++i) {
            fetex::feature_set_crossing(t, i, j, FeatureEdge::North, {curves.position(i, j, FeatureEdge::North), 0});
            fetex::feature_set_crossing(t, i, j, FeatureEdge::West, {curves.position(i, j, FeatureEdge::West), 0});
        }
    }
    return t;
}

} // namespace fetexc
