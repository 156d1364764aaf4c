// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/snapping.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "compiler/feature_curves/curve_displacement.h"
#include "compiler/feature_curves/curve_insertion.h"
#include "compiler/feature_curves/displacement.h"
#include "compiler/feature_curves/edge_points.h"
#include "compiler/feature_curves/fitting.h"
#include "compiler/feature_curves/knots.h"
#include "compiler/parallel.h"

namespace fetexc {
namespace {

using fetex::FeatureEdge;

constexpr std::size_t kRows = 16; ///< for a thread at a time

class Snapper {
  public:
    /// tangents: whether the texture is to have them.
    Snapper(const LatticeCurves& curves, std::uint32_t width, std::uint32_t height, bool tangents, unsigned threads)
        : curves_(curves), grid_(make_grid(curves.extent, width, height)), threads_(threads),
          inside_(curves.vertices.size()), degree_(curves.vertices.size()) {
        InsertedCurves inserted = insert_curves(curves, grid_, tangents, threads);
        points_ = std::move(inserted.points), directions_ = std::move(inserted.directions);
        profiles_ = std::move(inserted.profiles), arms_of_ = std::move(inserted.arms);
        out_.width = width, out_.height = height;
        out_.texels = std::move(inserted.texels);
        out_.stats.crossings = inserted.counts.crossings, out_.stats.segments = inserted.counts.segments;
        out_.stats.folded = inserted.counts.folded;
    }

    SnappedCurves run() {
        for (std::uint32_t k = 0; k < curves_.curves.size(); ++k)
            add_to_knots(k);
        insert_knots();
        settle_points();
        if (!profiles_.empty()) settle_profiles();
        if (directions_.empty()) {
            out_.moves = measure_moves(out_, points_, knots_, threads_);
        } else {
            settle_tangents();
            fit_signatures(out_, threads_);
            out_.moves = measure_curve_moves({curves_, grid_, points_, knots_}, out_);
        }
        count();
        return std::move(out_);
    }

  private:
    [[nodiscard]] PlanarPoint planar(std::uint32_t vertex) const { return planar_point(curves_, grid_, vertex); }
    [[nodiscard]] std::int32_t column(PlanarPoint p) const { return grid_cell(p.x, grid_.px, grid_.width); }
    [[nodiscard]] std::int32_t row(PlanarPoint p) const { return grid_cell(p.y, grid_.py, grid_.height); }
    [[nodiscard]] bool on_canvas(std::int32_t i, std::int32_t j) const {
        return i >= 0 && j >= 0 && i < static_cast<std::int32_t>(grid_.width) &&
               j < static_cast<std::int32_t>(grid_.height);
    }
    SnappedTexel& texel(std::uint32_t i, std::uint32_t j) { return out_.texels[std::size_t{j} * grid_.width + i]; }

    [[nodiscard]] fetex::FeaturePoint texels(std::int64_t dx, std::int64_t dy) const {
        return {static_cast<double>(dx) / static_cast<double>(grid_.px),
                static_cast<double>(dy) / static_cast<double>(grid_.py)};
    }

    /// At one of its vertices, away from it.
    [[nodiscard]] fetex::FeaturePoint tangent(const LatticeCurve& curve, std::uint32_t vertex) const {
        const LatticePoint& from = curves_.vertices[vertex];
        const LatticePoint& to =
            curve.straight ? curves_.vertices[curve.a == vertex ? curve.b : curve.a] : curve.middle;
        return texels((to.x - from.x) * grid_.kx, (to.y - from.y) * grid_.ky);
    }

    void add_to_knots(std::uint32_t k) {
        const LatticeCurve& curve = curves_.curves[k];
        ++degree_[curve.a], ++degree_[curve.b];
        const CurveArms& arms = arms_of_[k];
        if (arms.edge[0] != FeatureEdge{}) add_arm(curve, curve.a, arms.edge[0], arms.position[0]);
        if (arms.edge[1] != FeatureEdge{}) add_arm(curve, curve.b, arms.edge[1], arms.position[1]);
        // Whatever leaves a texel of the canvas has an arm there.
        if (arms.edge[0] == FeatureEdge{} && on_canvas(column(planar(curve.a)), row(planar(curve.a))))
            add_inside(curve);
    }

    void add_inside(const LatticeCurve& curve) {
        inside_.unite(curve.a, curve.b);
        knot_lines_.push_back({curve.a,
                               curve.b,
                               {},
                               local(curve.a),
                               local(curve.b),
                               tangent(curve, curve.a),
                               tangent(curve, curve.b),
                               curve.straight,
                               curve.profile});
    }

    void add_arm(const LatticeCurve& curve, std::uint32_t vertex, FeatureEdge e, double position) {
        arms_.push_back({vertex, e, position});
        knot_lines_.push_back({vertex,
                               kNone,
                               e,
                               local(vertex),
                               fetex::feature_point(e, position),
                               tangent(curve, vertex),
                               {},
                               curve.straight,
                               curve.profile});
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

    /// By counting; parts of a knot stay in their order.
    template <class Part> void sort_by_knot(std::vector<Part>& parts) {
        std::vector<std::uint32_t> next(inside_.size() + 1);
        for (const Part& part : parts)
            ++next[inside_.find(part.vertex) + 1];
        std::partial_sum(next.begin(), next.end(), next.begin());
        std::vector<Part> sorted(parts.size());
        for (const Part& part : parts)
            sorted[next[inside_.find(part.vertex)]++] = part;
        parts = std::move(sorted);
    }

    /// Everything by knot, knots by their first vertex.
    void insert_knots() {
        for (std::uint32_t v = 0; v < curves_.vertices.size(); ++v)
            if (degree_[v] > 0 && on_canvas(column(planar(v)), row(planar(v)))) vertices_.push_back(knot_vertex(v));
        const auto knot_of = [&](const auto& part) { return inside_.find(part.vertex); };
        sort_by_knot(vertices_), sort_by_knot(arms_), sort_by_knot(knot_lines_);
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
            if (shape.segments >> k & 1u) insert_segment(texel(knot.i, knot.j), k), ++out_.stats.segments;
        if (std::popcount(shape.edges) > 2) ++out_.stats.junctions;
        std::vector<FeatureEdge> ends = ends_of(knot, shape);
        if (!directions_.empty()) {
            if (is_curved(knot, shape)) texel(knot.i, knot.j).curved |= shape.segments;
            add_end_directions(knot, ends);
        }
        if (!profiles_.empty()) add_end_profiles(knot, ends);
        knots_.push_back({knot, std::move(shape), std::move(ends)});
    }

    /// Lines make straight segments, but one that goes round a corner.
    static bool is_curved(const Knot& knot, const KnotShape& shape) {
        if (!std::ranges::all_of(knot.lines, &KnotLine::straight)) return true;
        const fetex::FeaturePoint d = knot.lines.front().leaves;
        const auto along = [&](const KnotLine& l) { return d.x * l.leaves.y == d.y * l.leaves.x; };
        return std::popcount(shape.edges) == 2 && !std::ranges::all_of(knot.lines, along);
    }

    void add_end_directions(const Knot& knot, const std::vector<FeatureEdge>& ends) {
        const auto add = [&](std::uint32_t vertex, fetex::FeaturePoint direction) {
            const FeatureEdge e = ends[index_in(knot, vertex)];
            if (e != FeatureEdge{}) directions_.at(knot.i, knot.j, e).add(direction.x, direction.y);
        };
        for (const KnotLine& l : knot.lines) {
            add(l.vertex, l.leaves);
            if (l.other != kNone) add(l.other, l.arrives);
        }
    }

    void add_end_profiles(const Knot& knot, const std::vector<FeatureEdge>& ends) {
        const auto add = [&](std::uint32_t vertex, std::uint8_t profile) {
            const FeatureEdge e = ends[index_in(knot, vertex)];
            if (e != FeatureEdge{}) profiles_.at(knot.i, knot.j, e).add(profile);
        };
        for (const KnotLine& l : knot.lines) {
            add(l.vertex, l.profile);
            if (l.other != kNone) add(l.other, l.profile);
        }
    }

    /// Of the edges that segments end on.
    void settle_profiles() {
        const std::size_t columns = std::size_t{grid_.width} + 1, rows = std::size_t{grid_.height} + 1;
        out_.north_profile.assign(columns * rows, 0), out_.west_profile.assign(columns * rows, 0);
        bool several = false;
        for (std::uint32_t j = 0; j < rows; ++j) {
            for (std::uint32_t i = 0; i < columns; ++i) {
                for (const FeatureEdge e : {FeatureEdge::North, FeatureEdge::West}) {
                    if (!out_.is_used(i, j, e)) continue;
                    const EdgeProfile& p = profiles_.at(i, j, e);
                    out_.profile(i, j, e) = p.number, several |= p.number != 0;
                    out_.stats.edges_of_profiles += p.others;
                }
            }
        }
        if (!several) out_.north_profile.clear(), out_.west_profile.clear(); // the others are off the canvas
    }

    /// Means of the edges that segments end on.
    void settle_points() {
        const std::size_t columns = std::size_t{grid_.width} + 1, rows = std::size_t{grid_.height} + 1;
        out_.north.assign(columns * rows, fetex::FeatureCrossing{}.position);
        out_.west.assign(columns * rows, fetex::FeatureCrossing{}.position);
        parallel_for_chunks(rows, kRows, threads_, [&](std::size_t begin, std::size_t end) {
            for (auto j = static_cast<std::uint32_t>(begin); j < end; ++j)
                for (std::uint32_t i = 0; i < columns; ++i)
                    for (const FeatureEdge e : {FeatureEdge::North, FeatureEdge::West})
                        if (out_.is_used(i, j, e)) out_.position(i, j, e) = points_.at(i, j, e).position();
        });
    }

    /// Mean directions; of a segment that the table made, the kind of those that it replaced.
    void settle_tangents() {
        const std::size_t corners = (std::size_t{grid_.width} + 1) * (std::size_t{grid_.height} + 1);
        out_.north_angle.assign(corners, fetex::FeatureCrossing{}.angle);
        out_.west_angle.assign(corners, fetex::FeatureCrossing{}.angle);
        for (std::uint32_t j = 0; j < grid_.height; ++j) {
            for (std::uint32_t i = 0; i < grid_.width; ++i) {
                SnappedTexel& t = texel(i, j);
                if ((t.curved & ~t.segments) != 0) t.curved |= static_cast<SegmentSet>(t.segments & ~t.inserted);
                t.curved &= t.segments;
                for (const FeatureEdge e : fetex::kFeatureEdges)
                    if (edges_of(t.segments) >> fetex::feature_edge_index(e) & 1u)
                        out_.angle(i, j, e) = directions_.at(i, j, e).angle();
            }
        }
    }

    void count() {
        SnapStats& s = out_.stats;
        s.lines = curves_.curves.size();
        for (const SnappedTexel& t : out_.texels)
            if (t.inserted != t.segments)
                s.rerouted +=
                    static_cast<std::uint64_t>(std::popcount(static_cast<unsigned>(t.inserted & ~t.segments)));
        for (const ShownKnot& k : knots_) {
            const std::uint8_t kind = missing_kind(k);
            s.ends_cut += kind == kEndCut, s.folded += kind == kFolded, s.lost_inside += kind == kLostInside;
        }
    }

    const LatticeCurves& curves_;
    Grid grid_;
    unsigned threads_;
    EdgePoints points_;
    EdgeDirections directions_; ///< empty if everything is straight
    EdgeProfiles profiles_;     ///< empty if all are 0
    UnionFind inside_;          ///< vertices joined by lines that leave no texel
    std::vector<std::uint32_t> degree_;
    std::vector<CurveArms> arms_of_; ///< by curve
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

SnappedCurves snap_lines(const LatticeLines& lines, std::uint32_t width, std::uint32_t height, unsigned threads) {
    const LatticeCurves curves = lattice_curves(lines);
    return Snapper(curves, width, height, false, threads).run();
}

SnappedCurves snap_quadratics(const LatticeCurves& curves, std::uint32_t width, std::uint32_t height,
                              unsigned threads) {
    return Snapper(curves, width, height, true, threads).run();
}

fetex::FeatureCurvesTexture linear_texture(const SnappedCurves& curves, fetex::FeatureNumberFormat format,
                                           float distance_limit, unsigned threads) {
    fetex::FeatureCurvesTexture t =
        fetex::feature_empty_texture(curves.width, curves.height, format, true, distance_limit);
    std::ranges::transform(curves.texels, t.configurations.begin(),
                           [](const SnappedTexel& s) { return configuration_of(s.segments); });
    const auto set = [&](std::uint32_t i, std::uint32_t j, FeatureEdge e) {
        const fetex::FeatureCrossing at{curves.position(i, j, e), 0};
        if (at != fetex::FeatureCrossing{}) fetex::feature_set_crossing(t, i, j, e, at);
    };
    parallel_for_chunks(std::size_t{curves.height} + 1, kRows, threads, [&](std::size_t begin, std::size_t end) {
        for (auto j = static_cast<std::uint32_t>(begin); j < end; ++j)
            for (std::uint32_t i = 0; i <= curves.width; ++i)
                set(i, j, FeatureEdge::North), set(i, j, FeatureEdge::West);
    });
    return t;
}

} // namespace fetexc
