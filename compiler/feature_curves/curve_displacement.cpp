// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/curve_displacement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "compiler/error_budget.h"
#include "compiler/feature_curves/curve_walk.h"
#include "compiler/feature_curves/plane.h"
#include "compiler/feature_curves/signatures.h"

namespace fetexc {
namespace {

using fetex::FeatureEdge;
using fetex::FeaturePoint;

/// Chords that stand for a quadratic; off by 1/kChords² of what the whole one's is.
constexpr int kChords = 4;
using Chords = std::array<FeaturePoint, kChords + 1>;

FeaturePoint point_at(const SegmentCurve& c, double t) {
    const double a = (1 - t) * (1 - t), b = 2 * t * (1 - t), d = t * t;
    return {a * c[0].x + b * c[1].x + d * c[2].x, a * c[0].y + b * c[1].y + d * c[2].y};
}

Chords chords_of(const SegmentCurve& c) {
    Chords out;
    for (std::size_t k = 0; k < out.size(); ++k)
        out[k] = point_at(c, static_cast<double>(k) / kChords);
    return out;
}

/// How far chords_of are from the curve, at most.
double chord_error(const SegmentCurve& c) {
    return std::hypot(c[0].x - 2 * c[1].x + c[2].x, c[0].y - 2 * c[1].y + c[2].y) / (4 * kChords * kChords);
}

/// Greatest distance of points with the same parameter, at most: distances of control points, weighted as these are.
double parametric_distance(const SegmentCurve& a, const SegmentCurve& b) {
    const double first = distance(a[0], b[0]), middle = distance(a[1], b[1]), last = distance(a[2], b[2]);
    const double bend = first - 2 * middle + last, half = middle - first;
    double most = std::max(first, last);
    if (bend < 0 && half > 0 && half < -bend) most = std::max(most, first - half * half / bend);
    return most;
}

/// What a texel shows.
struct Shown {
    struct Segment {
        SegmentCurve curve;
        Chords chords{};
        double error = 0;
    };
    std::array<Segment, 2> segments;
    std::size_t count = 0;
    std::array<FeaturePoint, 4> points{}; ///< where segments end, also of texels beside it
    std::size_t ends = 0;

    Shown(const SnappedCurves& curves, std::uint32_t i, std::uint32_t j) {
        const SegmentSet set = curves.texel(i, j).segments;
        for (std::uint32_t k = 0; k < fetex::kFeatureSegmentCount; ++k)
            if (set >> k & 1u) segments[count++].curve = shown_segment(curves, i, j, k).curve;
        for (const FeatureEdge e : fetex::kFeatureEdges)
            if (curves.is_used(i, j, e)) points[ends++] = fetex::feature_point(e, curves.position(i, j, e));
    }

    /// Bound of the distance of any point of the piece.
    double distance_of(const SegmentCurve& piece) {
        const SegmentCurve back = {piece[2], piece[1], piece[0]};
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < count; ++k)
            least = std::min(
                {least, parametric_distance(piece, segments[k].curve), parametric_distance(back, segments[k].curve)});
        return least <= budget::kFeatureMoveNoise ? least : std::min(least, distance_of_chords(piece));
    }

  private:
    double distance_of_chords(const SegmentCurve& piece) {
        for (std::size_t k = 0; k < count && !drawn_; ++k)
            segments[k].chords = chords_of(segments[k].curve), segments[k].error = chord_error(segments[k].curve);
        drawn_ = true;
        const Chords from = chords_of(piece);
        double most = 0;
        for (std::size_t k = 0; k < kChords; ++k)
            most = std::max(most, distance_of_chord(from[k], from[k + 1]));
        return most + chord_error(piece);
    }

    /// Distances to one chord, or point, are the greatest at an end.
    [[nodiscard]] double distance_of_chord(FeaturePoint a, FeaturePoint b) const {
        double least = std::numeric_limits<double>::infinity();
        const auto to = [&](const Chord& chord, double error) {
            least = std::min(least, std::max(distance_to_chord(a, chord), distance_to_chord(b, chord)) + error);
        };
        for (std::size_t s = 0; s < count; ++s)
            for (std::size_t k = 0; k < kChords; ++k)
                to({segments[s].chords[k], segments[s].chords[k + 1]}, segments[s].error);
        for (std::size_t k = 0; k < ends; ++k)
            to({points[k], points[k]}, 0);
        return least;
    }

    bool drawn_ = false;
};

/// A piece of a curve in its texel.
struct Piece {
    std::int32_t i = 0, j = 0;
    SegmentCurve curve;
};

/// Cuts curves at the grid, as snapping has.
class Pieces {
  public:
    explicit Pieces(const CurveMoveSource& source) : source_(source), walk_(source.grid) {}

    template <class Visit> void visit(const LatticeCurve& curve, const Visit& visit) {
        const Grid& grid = source_.grid;
        const PlanarPoint from = planar(source_.curves.vertices[curve.a]),
                          to = planar(source_.curves.vertices[curve.b]), middle = planar(curve.middle);
        Piece piece{grid_cell(from.x, grid.px, grid.width), grid_cell(from.y, grid.py, grid.height), {}};
        const SegmentCurve whole = {texels(from), curve.straight ? FeaturePoint{} : texels(middle), texels(to)};
        FeaturePoint at = whole[0];
        double t = 0;
        const auto end_piece = [&](FeaturePoint end, double t1) {
            const FeaturePoint inner =
                curve.straight ? FeaturePoint{(at.x + end.x) / 2, (at.y + end.y) / 2} : blossom(whole, t, t1);
            piece.curve = {local(at, piece), local(inner, piece), local(end, piece)};
            visit(piece);
            at = end, t = t1;
        };
        const auto cross = [&](const GridCrossing& c, double t1) {
            const double line = c.line, along = c.cell + c.position;
            end_piece(c.vertical ? FeaturePoint{line, along} : FeaturePoint{along, line}, t1);
            (c.vertical ? piece.i : piece.j) += c.increasing ? 1 : -1;
        };
        if (curve.straight)
            walk_grid(grid, from, to, [&](const GridCrossing& c) { cross(c, 0); });
        else
            for (const CurveCrossing& c : walk_.walk({from, middle, to}))
                cross(c.at, c.t);
        end_piece(whole[2], 1);
    }

  private:
    [[nodiscard]] PlanarPoint planar(const LatticePoint& p) const {
        return {p.x * source_.grid.kx, p.y * source_.grid.ky};
    }
    [[nodiscard]] FeaturePoint texels(PlanarPoint p) const {
        return {static_cast<double>(p.x) / static_cast<double>(source_.grid.px),
                static_cast<double>(p.y) / static_cast<double>(source_.grid.py)};
    }
    static FeaturePoint local(FeaturePoint p, const Piece& in) { return {p.x - in.i, p.y - in.j}; }
    /// The middle control point between two parameters.
    static FeaturePoint blossom(const SegmentCurve& c, double s, double t) {
        const double a = (1 - s) * (1 - t), b = s * (1 - t) + t * (1 - s), d = s * t;
        return {a * c[0].x + b * c[1].x + d * c[2].x, a * c[0].y + b * c[1].y + d * c[2].y};
    }

    const CurveMoveSource& source_;
    CurveWalk walk_;
};

/// By texel.
class Moves {
  public:
    Moves(const CurveMoveSource& source, const SnappedCurves& snapped)
        : source_(source), snapped_(snapped), distances_(snapped.texels.size()), kinds_(snapped.texels.size()) {}

    std::vector<FeatureMove> run() {
        add_pieces();
        for (const ShownKnot& k : source_.knots)
            kinds_[index(k.knot.i, k.knot.j)] |= k.shape.segments != 0 ? std::uint8_t{kVertexCut} : missing_kind(k);
        std::vector<FeatureMove> moves;
        for (std::uint32_t j = 0; j < snapped_.height; ++j)
            for (std::uint32_t i = 0; i < snapped_.width; ++i)
                if (const FeatureMove move = move_of(i, j); move.kinds != 0) moves.push_back(move);
        return moves;
    }

  private:
    [[nodiscard]] std::size_t index(std::uint32_t i, std::uint32_t j) const {
        return std::size_t{j} * snapped_.width + i;
    }

    void add_pieces() {
        Pieces pieces(source_);
        for (const LatticeCurve& curve : source_.curves.curves) {
            pieces.visit(curve, [&](const Piece& p) {
                if (p.i < 0 || p.j < 0 || p.i >= static_cast<std::int32_t>(snapped_.width) ||
                    p.j >= static_cast<std::int32_t>(snapped_.height))
                    return;
                const auto i = static_cast<std::uint32_t>(p.i), j = static_cast<std::uint32_t>(p.j);
                const double away = Shown(snapped_, i, j).distance_of(p.curve);
                const std::size_t k = index(i, j);
                if (std::isinf(away))
                    kinds_[k] |= kLostInside;
                else
                    distances_[k] = std::max(distances_[k], away);
            });
        }
    }

    [[nodiscard]] FeatureMove move_of(std::uint32_t i, std::uint32_t j) const {
        const SnappedTexel& t = snapped_.texel(i, j);
        const double away = distances_[index(i, j)];
        unsigned kinds = kinds_[index(i, j)] | t.kinds;
        const bool moved = away > budget::kFeatureMoveNoise;
        if (!moved) kinds &= ~unsigned{kVertexCut};
        for (const FeatureEdge e : fetex::kFeatureEdges)
            if (moved && snapped_.is_used(i, j, e) && is_merged(source_.points.at(i, j, e))) kinds |= kEdgeMerged;
        if ((t.inserted & ~t.segments) != 0) kinds |= kRerouted;
        if (moved && kinds == 0) kinds = kFitted; // with a texel beside it
        return {i, j, static_cast<std::uint8_t>(kinds), moved ? away : 0};
    }

    static bool is_merged(const EdgePoint& p) { return p.most - p.least > budget::kFeatureMoveNoise; }

    const CurveMoveSource& source_;
    const SnappedCurves& snapped_;
    std::vector<double> distances_;
    std::vector<std::uint8_t> kinds_;
};

} // namespace

std::vector<FeatureMove> measure_curve_moves(const CurveMoveSource& source, const SnappedCurves& snapped) {
    return Moves(source, snapped).run();
}

} // namespace fetexc
