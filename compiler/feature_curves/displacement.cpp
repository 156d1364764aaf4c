// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/displacement.h"

#include <algorithm>
#include <string>

#include "compiler/diagnostics.h"
#include "compiler/error_budget.h"
#include "compiler/feature_curves/plane.h"
#include "compiler/parallel.h"

namespace fetexc {
namespace {

using fetex::FeatureEdge;
using fetex::FeaturePoint;
using enum fetex::FeatureEdge;

constexpr std::size_t kRows = 16; ///< for a thread at a time

/// A texel's points where they came to be.
class TexelPoints {
  public:
    TexelPoints(const SnappedCurves& curves, std::uint32_t i, std::uint32_t j)
        : positions_{curves.position(i, j, North), curves.position(i, j, East), curves.position(i, j, South),
                     curves.position(i, j, West)},
          points_{FeaturePoint{positions_[0], 0}, {1, positions_[1]}, {positions_[2], 1}, {0, positions_[3]}} {}

    [[nodiscard]] double position(FeatureEdge e) const { return positions_[fetex::feature_edge_index(e)]; }
    [[nodiscard]] FeaturePoint at(FeatureEdge e) const { return points_[fetex::feature_edge_index(e)]; }
    [[nodiscard]] Chord chord(std::uint32_t segment) const {
        const fetex::FeatureSegment s = fetex::kFeatureSegments[segment];
        return {at(s.first), at(s.second)};
    }
    [[nodiscard]] FeaturePoint crossing() const {
        return crossing_point(position(North), position(East), position(South), position(West));
    }

  private:
    std::array<double, 4> positions_; ///< by feature_edge_index
    std::array<FeaturePoint, 4> points_;
};

class Measure {
  public:
    Measure(const SnappedCurves& curves, const EdgePoints& points) : curves_(curves), points_(points) {}

    void knot(const ShownKnot& k) {
        Found& f = found_.emplace_back();
        f.texel = index(k.knot.i, k.knot.j);
        if (const std::uint8_t kind = missing_kind(k)) f.kinds |= kind;
        if (k.shape.edges == 0) return;
        if (missing_kind(k) != 0 && !curves_.is_used(k.knot.i, k.knot.j, only_edge(k.shape))) {
            f.kinds |= kLostInside; // nothing goes on where it leaves
            return;
        }
        f.edges |= k.shape.edges;
        const TexelPoints t(curves_, k.knot.i, k.knot.j);
        Away most;
        for (const KnotLine& l : k.knot.lines) {
            const Away a = away(l, k, t);
            most = {std::max(most.ends, a.ends), std::max(most.detour, a.detour)};
        }
        if (most.ends + most.detour > 0 && k.shape.segments != 0) f.kinds |= kVertexCut;
        f.vertices = std::max(f.vertices, most.ends), f.detour = std::max(f.detour, most.detour);
    }

    std::vector<FeatureMove> run(unsigned threads) {
        std::ranges::sort(found_, {}, &Found::texel);
        std::vector<std::vector<FeatureMove>> parts((curves_.height + kRows - 1) / kRows);
        parallel_for_chunks(curves_.height, kRows, threads, [&](std::size_t begin, std::size_t end) {
            parts[begin / kRows] = moves_in(static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end));
        });
        std::vector<FeatureMove> moves;
        for (const std::vector<FeatureMove>& part : parts)
            moves.insert(moves.end(), part.begin(), part.end());
        return moves;
    }

  private:
    /// Of a knot, or of all in a texel.
    struct Found {
        std::size_t texel = 0;
        std::uint8_t kinds = 0;
        EdgeSet edges = 0;               ///< where knots are joined to others
        double vertices = 0, detour = 0; ///< as Away
        void add(const Found& other) {
            kinds |= other.kinds, edges |= other.edges;
            vertices = std::max(vertices, other.vertices), detour = std::max(detour, other.detour);
        }
    };

    [[nodiscard]] std::size_t index(std::uint32_t i, std::uint32_t j) const {
        return std::size_t{j} * curves_.width + i;
    }

    /// In rows first … last − 1.
    [[nodiscard]] std::vector<FeatureMove> moves_in(std::uint32_t first, std::uint32_t last) const {
        std::vector<FeatureMove> moves;
        auto next = std::ranges::lower_bound(found_, index(0, first), {}, &Found::texel);
        for (std::uint32_t j = first; j < last; ++j) {
            for (std::uint32_t i = 0; i < curves_.width; ++i) {
                Found all;
                for (; next != found_.end() && next->texel == index(i, j); ++next)
                    all.add(*next);
                const SnappedTexel& t = curves_.texels[index(i, j)];
                if (t.inserted == 0 && all.kinds == 0) continue;
                const FeatureMove move = move_of(i, j, t, all);
                if (move.kinds != 0) moves.push_back(move);
            }
        }
        return moves;
    }

    /// Of a knot's lines from its shape: how far their ends are, beyond where edges' points went, and what more it
    /// takes where the shape joins the ends by way of a third point.
    struct Away {
        double ends = 0, detour = 0;
    };
    static Away away(const KnotLine& l, const ShownKnot& k, const TexelPoints& t) {
        const auto end_of = [&](std::uint32_t vertex) { return k.ends[index_in(k.knot, vertex)]; };
        const auto end_distance = [&](FeatureEdge e, FeaturePoint p) {
            return e == FeatureEdge{} ? distance_to_shape(p, k.shape, t) : 0.0;
        };
        const FeatureEdge from = end_of(l.vertex), to = l.other == kNone ? l.edge : end_of(l.other);
        Away a{std::max(end_distance(from, l.from), end_distance(to, l.to)), 0};
        if (from == FeatureEdge{} || to == FeatureEdge{} || from == to) return a;
        const std::uint32_t segment = segment_between(from, to);
        if ((k.shape.segments >> segment & 1u) == 0) a.detour = detour(segment, k.shape.segments, t);
        return a;
    }

    static FeatureEdge only_edge(const KnotShape& shape) {
        return fetex::kFeatureEdges[static_cast<std::size_t>(std::countr_zero(shape.edges))];
    }

    /// To the one edge, to the segment, or where three or four ways meet.
    static double distance_to_shape(FeaturePoint p, const KnotShape& shape, const TexelPoints& t) {
        if (shape.hub) return distance(p, t.at(shape.hub_edge));
        if (shape.segments == kCrossing) return distance(p, t.crossing());
        if (shape.segments != 0)
            return distance_to_chord(p, t.chord(static_cast<std::uint32_t>(std::countr_zero(shape.segments))));
        return distance(p, t.at(only_edge(shape)));
    }

    /// A segment that the table replaced by others goes by way of where these meet.
    static double detour(std::uint32_t segment, SegmentSet segments, const TexelPoints& t) {
        return farthest_detour(1u << segment, segments, t);
    }
    static FeatureEdge hub_of(SegmentSet segments, std::uint32_t segment) {
        const auto hub = static_cast<EdgeSet>(edges_of(segments) & ~edges_of_segment(segment));
        return fetex::kFeatureEdges[static_cast<std::size_t>(std::countr_zero(hub))];
    }
    /// Of a set of such segments.
    static double farthest_detour(unsigned replaced, SegmentSet segments, const TexelPoints& t) {
        double most = 0;
        const bool crossing = segments == kCrossing && replaced != 0;
        const FeaturePoint centre = crossing ? t.crossing() : FeaturePoint{};
        for (; replaced != 0; replaced &= replaced - 1) {
            const auto segment = static_cast<std::uint32_t>(std::countr_zero(replaced));
            const FeaturePoint by = crossing ? centre : t.at(hub_of(segments, segment));
            most = std::max(most, distance_to_chord(by, t.chord(segment)));
        }
        return most;
    }

    [[nodiscard]] FeatureMove move_of(std::uint32_t i, std::uint32_t j, const SnappedTexel& texel,
                                      const Found& f) const {
        const TexelPoints t(curves_, i, j);
        double merged = 0;
        const unsigned edges = edges_of(texel.segments) | f.edges;
        for (const FeatureEdge e : fetex::kFeatureEdges)
            if (edges >> fetex::feature_edge_index(e) & 1u)
                merged = std::max(merged, points_.at(i, j, e).move(t.position(e)));
        const unsigned replaced = texel.inserted & ~unsigned{texel.segments};
        const double rerouted = farthest_detour(replaced, texel.segments, t);
        const unsigned kinds = f.kinds | kEdgeMerged * unsigned{merged > 0} | kRerouted * unsigned{replaced != 0};
        return {i, j, static_cast<std::uint8_t>(kinds), std::max(merged, f.vertices) + f.detour + rerouted};
    }

    const SnappedCurves& curves_;
    const EdgePoints& points_;
    std::vector<Found> found_;
};

std::string place_of(const FeatureMove& m) {
    return "texel (" + std::to_string(m.i) + ", " + std::to_string(m.j) + ")";
}

void warn(std::vector<Diagnostic>& out, std::uint64_t count, int code, const std::string& text,
          std::string place = "") {
    if (count > 0) out.push_back({Severity::Warning, code, std::to_string(count) + text, std::move(place)});
}

} // namespace

std::uint8_t missing_kind(const ShownKnot& k) {
    const auto shown = [](FeatureEdge end) { return end != FeatureEdge{}; };
    if (k.shape.segments != 0 || std::ranges::all_of(k.ends, shown)) return 0;
    if (k.knot.arms.empty()) return kLostInside;
    return k.knot.arms.size() > 1 ? kFolded : kEndCut;
}

std::vector<FeatureMove> measure_moves(const SnappedCurves& curves, const EdgePoints& points,
                                       const std::vector<ShownKnot>& knots, unsigned threads) {
    Measure measure(curves, points);
    for (const ShownKnot& k : knots)
        measure.knot(k);
    return measure.run(threads);
}

std::vector<Diagnostic> snap_diagnostics(const SnappedCurves& curves) {
    const auto far = static_cast<std::uint64_t>(std::ranges::count_if(
        curves.moves, [](const FeatureMove& m) { return m.distance > budget::kFeatureMoveTold; }));
    std::vector<Diagnostic> out;
    if (far > 0) {
        const FeatureMove& farthest = *std::ranges::max_element(curves.moves, {}, &FeatureMove::distance);
        const std::string hundredths = std::to_string(static_cast<int>(farthest.distance * 100 + 0.5));
        warn(out, far, diag::kFeatureMoved,
             " texels in which feature curves moved by more than half a texel; at most " + hundredths +
                 " hundredths of a texel",
             place_of(farthest));
    }
    warn(out, curves.stats.ends_cut, diag::kFeatureEndsCut,
         " ends of feature curves inside a texel end on its boundary instead");
    warn(out, curves.stats.folded + curves.stats.lost_inside, diag::kFeatureLost,
         " feature curves inside a texel, or that fold back in it, don't show there");
    const auto straightened =
        std::ranges::find_if(curves.moves, [](const FeatureMove& m) { return (m.kinds & kStraightened) != 0; });
    if (straightened != curves.moves.end())
        warn(out, curves.stats.straightened, diag::kFeatureStraightened,
             " segments of feature curves are straight, and bend where they end: no valid quadratic was found",
             place_of(*straightened));
    return out;
}

} // namespace fetexc
