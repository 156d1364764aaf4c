// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/knots.h"

#include <algorithm>
#include <array>
#include <utility>

#include "compiler/feature_curves/edge_points.h"
#include "compiler/feature_curves/plane.h"

namespace fetexc {
namespace {

using fetex::FeatureEdge;
using fetex::FeaturePoint;

constexpr EdgeSet bit(FeatureEdge e) { return static_cast<EdgeSet>(1u << fetex::feature_edge_index(e)); }

struct EdgeList {
    std::array<FeatureEdge, 4> edge{};
    std::size_t count = 0;

    [[nodiscard]] std::size_t size() const { return count; }
    [[nodiscard]] auto begin() const { return edge.begin(); }
    [[nodiscard]] auto end() const { return edge.begin() + count; }
    FeatureEdge operator[](std::size_t k) const { return edge[k]; }
};

class Shaper {
  public:
    explicit Shaper(const Knot& knot) : knot_(knot) {
        for (const KnotArm& arm : knot.arms)
            join(arm.edge, arm.position);
    }

    KnotShape run() {
        for (const KnotVertex& v : knot_.vertices)
            if (v.on != 0 && is_cut_off(v)) end_on_boundary(v);
        add_segments();
        return std::move(shape_);
    }

  private:
    void join(FeatureEdge e, double position) {
        shape_.edges |= bit(e);
        points_[fetex::feature_edge_index(e)].add(position);
    }

    [[nodiscard]] FeaturePoint point(FeatureEdge e) const {
        return fetex::feature_point(e, points_[fetex::feature_edge_index(e)].position());
    }

    [[nodiscard]] EdgeList edges() const {
        EdgeList out;
        for (const FeatureEdge e : fetex::kFeatureEdges)
            if (shape_.edges & bit(e)) out.edge[out.count++] = e;
        return out;
    }

    [[nodiscard]] bool is_cut_off(const KnotVertex& v) const {
        const auto at = [&](FeatureEdge e) {
            const FeaturePoint p = point(e);
            return p.x == v.at.x && p.y == v.at.y;
        };
        const EdgeList joined = edges();
        if (std::ranges::any_of(joined, at)) return false;
        if (joined.size() < 2) return true;
        return joined.size() == 2 && !on_line(v.at, {point(joined[0]), point(joined[1])});
    }

    /// On an edge that has no point yet.
    void end_on_boundary(const KnotVertex& v) {
        for (const FeatureEdge e : fetex::kFeatureEdges) {
            if ((v.on & bit(e)) == 0 || (shape_.edges & bit(e)) != 0) continue;
            const double position = e == FeatureEdge::North || e == FeatureEdge::South ? v.at.x : v.at.y;
            shape_.ends.push_back({e, position});
            join(e, position);
            return;
        }
    }

    void add_segments() {
        const EdgeList joined = edges();
        if (joined.size() == 4) shape_.segments = kCrossing;
        if (joined.size() == 2) insert(joined[0], joined[1]);
        if (joined.size() != 3) return;
        shape_.hub = true;
        shape_.hub_edge = *std::ranges::min_element(joined, {}, [&](FeatureEdge e) { return farthest(e, joined); });
        for (const FeatureEdge e : joined)
            if (e != shape_.hub_edge) insert(shape_.hub_edge, e);
    }

    /// How far the lines' ends and middles are from segments that meet on the edge.
    [[nodiscard]] double farthest(FeatureEdge hub, const EdgeList& joined) const {
        const auto away = [&](FeaturePoint p) {
            double least = distance(p, point(hub));
            for (const FeatureEdge e : joined)
                if (e != hub) least = std::min(least, distance_to_chord(p, {point(hub), point(e)}));
            return least;
        };
        double most = 0;
        for (const KnotLine& l : knot_.lines)
            most = std::max({most, away(l.from), away(l.to), away({(l.from.x + l.to.x) / 2, (l.from.y + l.to.y) / 2})});
        return most;
    }

    void insert(FeatureEdge a, FeatureEdge b) {
        shape_.segments = static_cast<SegmentSet>(shape_.segments | 1u << segment_between(a, b));
    }

    const Knot& knot_;
    KnotShape shape_;
    std::array<EdgePoint, 4> points_; ///< as far as the knot knows them
};

} // namespace

std::size_t index_in(const Knot& knot, std::uint32_t vertex) {
    const auto at = std::ranges::lower_bound(knot.vertices, vertex, {}, &KnotVertex::vertex);
    return static_cast<std::size_t>(at - knot.vertices.begin());
}

std::vector<FeatureEdge> ends_of(const Knot& knot, const KnotShape& shape) {
    std::vector<FeatureEdge> ends(knot.vertices.size());
    for (const KnotArm& a : knot.arms) {
        const std::size_t k = index_in(knot, a.vertex);
        if (ends[k] == FeatureEdge{} && (knot.vertices[k].on & bit(a.edge)) != 0) ends[k] = a.edge;
    }
    for (std::size_t k = 0; k < ends.size(); ++k) {
        const KnotVertex& v = knot.vertices[k];
        if (v.on == 0 || ends[k] != FeatureEdge{}) continue;
        for (const KnotEnd& e : shape.ends) {
            const FeaturePoint p = fetex::feature_point(e.edge, e.position);
            if (p.x == v.at.x && p.y == v.at.y) ends[k] = e.edge;
        }
    }
    return ends;
}

KnotShape shape_of(const Knot& knot) { return Shaper(knot).run(); }

} // namespace fetexc
