// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/fbt/pieces.h"

#include <algorithm>
#include <cmath>

#include "formats/fbt.h"

namespace fetexc {
namespace {

struct LocalPoint {
    double x = 0, y = 0;
};

/// A stretch of one arc from node to node, in chain direction.
struct Joined {
    std::uint32_t arc = 0;
    double t0 = 0, t1 = 0;        ///< in the arc's own direction: t0 < t1
    std::uint32_t n0 = 0, n1 = 0; ///< nodes at t0, t1
    bool forward = true;
};

class Quantiser {
  public:
    Quantiser(const PlanarMap& map, const TexelMap& texel) : map_(map), grid_(map.grid()) {
        x0_ = grid_.px * texel.i, y0_ = grid_.py * texel.j;
    }

    [[nodiscard]] LocalPoint local(const GridNode& n) const {
        return {(n.x - static_cast<double>(x0_)) / static_cast<double>(grid_.px),
                (n.y - static_cast<double>(y0_)) / static_cast<double>(grid_.py)};
    }

    /// Control points in texel units; ends from the nodes.
    [[nodiscard]] std::array<LocalPoint, 4> control(const Joined& j, const Curve& c) const {
        const std::array<double, 4> x = stretch(c, Axis::X, j.t0, j.t1), y = stretch(c, Axis::Y, j.t0, j.t1);
        const double ox = static_cast<double>(c.x.origin - x0_), oy = static_cast<double>(c.y.origin - y0_);
        std::array<LocalPoint, 4> p{};
        for (int i = 0; i <= c.degree; ++i) {
            p[i] = {(ox + x[i]) / static_cast<double>(grid_.px), (oy + y[i]) / static_cast<double>(grid_.py)};
        }
        p[0] = local(map_.node(j.n0));
        p[c.degree] = local(map_.node(j.n1));
        return p;
    }

  private:
    const PlanarMap& map_;
    const Grid& grid_;
    std::int64_t x0_ = 0, y0_ = 0;
};

double norm(LocalPoint p) { return std::sqrt(p.x * p.x + p.y * p.y); }

/// Lowest degree within tolerance. Cubic → quadratic: the best one by degree reduction, error √3/36·|third difference|.
int demote(std::array<LocalPoint, 4>& p, int degree) {
    if (degree == 3) {
        const LocalPoint third{p[3].x - 3 * p[2].x + 3 * p[1].x - p[0].x, p[3].y - 3 * p[2].y + 3 * p[1].y - p[0].y};
        constexpr double factor = 0.0482; // > √3/36
        if (factor * norm(third) > budget::kDemotionTolerance) return 3;
        const LocalPoint q{(3 * (p[1].x + p[2].x) - p[0].x - p[3].x) / 4,
                           (3 * (p[1].y + p[2].y) - p[0].y - p[3].y) / 4};
        p = {p[0], q, p[3], LocalPoint{}};
        degree = 2;
    }
    if (degree == 2) {
        const LocalPoint second{p[0].x - 2 * p[1].x + p[2].x, p[0].y - 2 * p[1].y + p[2].y};
        if (norm(second) / 4 > budget::kDemotionTolerance) return 2;
        p = {p[0], p[2], LocalPoint{}, LocalPoint{}};
    }
    return 1;
}

/// Calls use(Joined) for every maximal stretch of one arc along the chain.
template <class Use>
void join(const PlanarMap& map, const TexelMap& texel, std::span<const FeatureStep> steps, const Use& use) {
    Joined last;
    bool any = false;
    for (const FeatureStep& step : steps) {
        const SubEdge& s = texel.sub_edges[step.sub];
        const Joined next{map.arrangement().edges[s.edge].arc, s.range.lo, s.range.hi, s.n0, s.n1, step.forward};
        const bool same = any && last.arc == next.arc && last.forward == next.forward;
        if (same && next.forward && last.n1 == next.n0) {
            last.t1 = next.t1, last.n1 = next.n1;
        } else if (same && !next.forward && last.n0 == next.n1) {
            last.t0 = next.t0, last.n0 = next.n0;
        } else {
            if (any) use(last);
            last = next, any = true;
        }
    }
    if (any) use(last);
}

} // namespace

bool cancel_out(const PieceRuns& all, std::size_t first_run) {
    const auto end_of = [](const Piece& p) { return p.p[p.degree]; };
    if (first_run == all.runs.size()) return true;
    const auto chain = std::span(all.pieces).subspan(all.runs[first_run].first_piece);
    if (chain.size() % 2 != 0 || chain.front().p[0] != end_of(chain.back())) return false; // not closed
    std::vector<Piece> pieces(chain.begin(), chain.end());
    for (Piece& p : pieces) {
        if (end_of(p) < p.p[0]) std::reverse(p.p.begin(), p.p.begin() + p.degree + 1);
    }
    std::sort(pieces.begin(), pieces.end());
    for (std::size_t k = 0; k < pieces.size(); k += 2) {
        if (pieces[k] != pieces[k + 1]) return false;
    }
    return true;
}

void make_runs(const PlanarMap& map, const TexelMap& texel, std::span<const FeatureStep> steps, PieceRuns& out,
               PieceStats& stats) {
    const Quantiser quantiser(map, texel);
    const std::size_t first = out.runs.size();
    join(map, texel, steps, [&](const Joined& j) {
        const Curve& c = map.arrangement().set.curves[map.arrangement().set.arcs[j.arc].curve];
        std::array<LocalPoint, 4> p = quantiser.control(j, c);
        Piece piece;
        piece.degree = demote(p, c.degree);
        if (piece.degree < c.degree) ++stats.demoted;
        for (int i = 0; i <= piece.degree; ++i)
            piece.p[j.forward ? i : piece.degree - i] = fetex::fbt_pack_point(p[i].x, p[i].y);
        if (piece.p[0] == piece.p[piece.degree]) {
            ++stats.vanished;
            return;
        }
        ++stats.pieces;
        if (out.runs.size() == first || out.runs.back().degree != piece.degree ||
            out.runs.back().pieces == fetex::kFbtMaxPieces)
            out.runs.push_back({piece.degree, static_cast<std::uint32_t>(out.pieces.size()), 0});
        out.pieces.push_back(piece);
        ++out.runs.back().pieces;
    });
}

} // namespace fetexc
