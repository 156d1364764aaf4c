// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/ground_truth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compiler/scene/bezier.h"
#include "compiler/scene/curve_distance.h"
#include "compiler/scene/lattice.h"
#include "compiler/scene/row_index.h"

namespace fetexc {
namespace {

using bezier::Axis;

struct Box {
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

Box hull_of(const CanvasSegment& s) {
    Box box{s.p[0].x, s.p[0].y, s.p[0].x, s.p[0].y};
    for (int i = 1; i <= s.degree; ++i) {
        box.x0 = std::min(box.x0, s.p[i].x), box.x1 = std::max(box.x1, s.p[i].x);
        box.y0 = std::min(box.y0, s.p[i].y), box.y1 = std::max(box.y1, s.p[i].y);
    }
    return box;
}

/// A y-monotone piece of a segment over [t0,t1]. Neighbouring pieces share their end values bit for bit, so the
/// half-open rule in y counts each level of a closed contour consistently.
struct Piece {
    std::uint32_t segment = 0, shape = 0;
    double t0 = 0, t1 = 1;
    double y0 = 0, y1 = 0; ///< along the direction of travel
    double x0 = 0, x1 = 0; ///< smallest and largest x, conservative
};

/// Control-point x range, padded by the rounding of the split.
void set_x_range(const CanvasSegment& s, Piece& piece) {
    const Box box = hull_of(bezier::part(s, piece.t0, piece.t1));
    const double pad = static_cast<double>(kLatticeLimit) * 0x1p-48;
    piece.x0 = box.x0 - pad;
    piece.x1 = box.x1 + pad;
}

void add_pieces(const CanvasSegment& s, std::uint32_t segment, std::uint32_t shape, std::vector<Piece>& out) {
    const bezier::Parameters cuts = bezier::extrema(s, Axis::Y);
    double t0 = 0;
    for (int i = 0; i <= cuts.count; ++i) {
        Piece piece{segment, shape, t0, i < cuts.count ? cuts.t[i] : 1.0, 0, 0, 0, 0};
        piece.y0 = bezier::value_at(s, Axis::Y, piece.t0);
        piece.y1 = bezier::value_at(s, Axis::Y, piece.t1);
        t0 = piece.t1;
        if (piece.y0 == piece.y1) continue; // horizontal: no ray crosses it
        set_x_range(s, piece);
        out.push_back(piece);
    }
}

struct Crossing {
    std::uint32_t shape = 0;
    int sign = 0;
};

} // namespace

struct GroundTruth::Impl {
    explicit Impl(const Scene& s)
        : scene(s), compositor(s), curves(curves_of(s)), boxes(boxes_of(curves)), pieces(pieces_of(s, curves)),
          piece_rows(intervals_of(pieces)), curve_rows(intervals_of(boxes)) {}

    static std::vector<CanvasSegment> curves_of(const Scene& s) {
        std::vector<CanvasSegment> out;
        out.reserve(s.segments.size());
        for (const Segment& segment : s.segments)
            out.push_back(bezier::to_double(segment));
        return out;
    }
    static std::vector<Box> boxes_of(const std::vector<CanvasSegment>& curves) {
        std::vector<Box> out;
        out.reserve(curves.size());
        for (const CanvasSegment& s : curves)
            out.push_back(hull_of(s));
        return out;
    }
    static std::vector<Piece> pieces_of(const Scene& s, const std::vector<CanvasSegment>& curves) {
        std::vector<Piece> out;
        for (std::uint32_t shape = 0; shape < s.shapes.size(); ++shape)
            for (std::uint32_t k = 0; k < s.shapes[shape].count; ++k)
                add_pieces(curves[s.shapes[shape].first + k], s.shapes[shape].first + k, shape, out);
        return out;
    }
    static std::vector<RowInterval> intervals_of(const std::vector<Piece>& pieces) {
        std::vector<RowInterval> out;
        for (const Piece& piece : pieces)
            out.push_back({std::min(piece.y0, piece.y1), std::max(piece.y0, piece.y1)});
        return out;
    }
    static std::vector<RowInterval> intervals_of(const std::vector<Box>& boxes) {
        std::vector<RowInterval> out;
        for (const Box& box : boxes)
            out.push_back({box.y0, box.y1});
        return out;
    }

    /// Does the ray from (x,y) towards +x cross the piece? Half-open in y: the upper end value doesn't count.
    [[nodiscard]] bool crosses(const Piece& piece, double x, double y) const {
        if (y < std::min(piece.y0, piece.y1) || y >= std::max(piece.y0, piece.y1)) return false;
        if (x < piece.x0) return true;
        if (x >= piece.x1) return false;
        const CanvasSegment& s = curves[piece.segment];
        return bezier::value_at(s, Axis::X, bezier::solve_monotone(s, Axis::Y, y, piece.t0, piece.t1)) > x;
    }

    [[nodiscard]] std::vector<Crossing> crossings(double x, double y) const {
        std::vector<Crossing> out;
        for (std::uint32_t i : piece_rows.items(piece_rows.row_of(y)))
            if (crosses(pieces[i], x, y)) out.push_back({pieces[i].shape, pieces[i].y1 > pieces[i].y0 ? 1 : -1});
        // pieces are listed by shape already
        return out;
    }

    void nearest_in_row(std::size_t row, double x, double y, double& best) const {
        for (std::uint32_t i : curve_rows.items(row)) {
            const Box& box = boxes[i];
            const double dx = std::max({box.x0 - x, x - box.x1, 0.0}), dy = std::max({box.y0 - y, y - box.y1, 0.0});
            if (dx >= best || dy >= best || std::hypot(dx, dy) >= best) continue;
            best = distance_below(curves[i], x, y, best);
        }
    }

    const Scene& scene;
    Compositor compositor;
    std::vector<CanvasSegment> curves;
    std::vector<Box> boxes;
    std::vector<Piece> pieces;
    RowIndex piece_rows, curve_rows;
};

GroundTruth::GroundTruth(const Scene& scene) : impl_(std::make_unique<Impl>(scene)) {}
GroundTruth::~GroundTruth() = default;

std::vector<std::uint32_t> GroundTruth::inside(double x, double y) const {
    std::vector<std::uint32_t> out;
    const std::vector<Crossing> crossings = impl_->crossings(x, y);
    for (std::size_t i = 0; i < crossings.size();) {
        const std::uint32_t shape = crossings[i].shape;
        std::int64_t winding = 0;
        for (; i < crossings.size() && crossings[i].shape == shape; ++i)
            winding += crossings[i].sign;
        const bool odd = impl_->scene.shapes[shape].rule == FillRule::EvenOdd;
        if (odd ? winding % 2 != 0 : winding != 0) out.push_back(shape);
    }
    return out;
}

ResultId GroundTruth::result_at(Compositor& compositor, double x, double y) const {
    return compositor.resolve(inside(x, y));
}

Rgba GroundTruth::color_at(double x, double y) const {
    const ResultId id = result_at(impl_->compositor, x, y);
    return impl_->compositor.color(id, to_canvas(impl_->scene.extent, x, y));
}

double GroundTruth::distance_to_curves(double x, double y) const {
    return distance_to_curves_within(x, y, std::numeric_limits<double>::infinity());
}

double GroundTruth::distance_to_curves_within(double x, double y, double radius) const {
    const RowIndex& rows = impl_->curve_rows;
    double best = radius;
    const std::size_t own = rows.row_of(y);
    impl_->nearest_in_row(own, x, y, best);
    for (std::size_t row = own; row-- > 0 && rows.distance_to_row(y, row) < best;)
        impl_->nearest_in_row(row, x, y, best);
    for (std::size_t row = own + 1; row < rows.rows() && rows.distance_to_row(y, row) < best; ++row)
        impl_->nearest_in_row(row, x, y, best);
    return best < radius ? best : std::numeric_limits<double>::infinity();
}

} // namespace fetexc
