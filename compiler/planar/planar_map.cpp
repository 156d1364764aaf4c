// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/planar_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "compiler/geometry/precise.h"

namespace fetexc {
namespace {

/// Half-step position of an enclosed coordinate; lines inside the enclosure win.
HalfStep half_step(const Interval& v, std::int64_t pitch, std::uint32_t lines) {
    const double p = static_cast<double>(pitch);
    const double nearest = std::clamp(std::round(v.mid() / p), 0.0, static_cast<double>(lines));
    if (v.contains(nearest * p)) return 2 * static_cast<HalfStep>(nearest);
    if (v.mid() < 0) return -1;
    const double cell = std::floor(v.mid() / p);
    return cell >= lines ? 2 * static_cast<HalfStep>(lines) + 1 : 2 * static_cast<HalfStep>(cell) + 1;
}

HalfStep clamp_between(HalfStep v, HalfStep a, HalfStep b) { return std::clamp(v, std::min(a, b), std::max(a, b)); }

double on_line(HalfStep h, std::int64_t pitch) { return static_cast<double>(pitch * (h / 2)); }

bool is_line(HalfStep h) { return h >= 0 && h % 2 == 0; }

} // namespace

void add_winding(Windings& w, std::uint32_t shape, std::int32_t change) {
    const auto it =
        std::lower_bound(w.begin(), w.end(), shape, [](const Contribution& c, std::uint32_t s) { return c.shape < s; });
    if (it == w.end() || it->shape != shape) {
        w.insert(it, {shape, change});
    } else if ((it->winding += change) == 0) {
        w.erase(it);
    }
}

/// Walks the edges over the grid.
class PlanarMap::Builder {
  public:
    Builder(PlanarMap& map, PlanarStats& stats) : map_(map), grid_(map.grid_), stats_(stats) {}

    void run() {
        add_vertices();
        for (std::uint32_t e = 0; e < map_.arrangement_.edges.size(); ++e)
            walk(e);
        merge_nodes();
        sort_into_texels();
        sort_steps();
    }

  private:
    struct Crossing {
        HalfStep order = 0; ///< position along the (monotone) edge
        Interval t;
        std::uint32_t node = 0;
    };
    struct Piece {
        SubEdge sub;
        std::uint32_t texel;
    };

    /// The enclosure of a node along the grid line it lies on, for telling nodes apart.
    struct Placed {
        HalfStep hx, hy;
        Interval along;
        std::uint32_t node;
    };

    std::uint32_t add_node(const Interval& x, const Interval& y, HalfStep hx, HalfStep hy) {
        const auto n = static_cast<std::uint32_t>(map_.nodes_.size());
        map_.nodes_.push_back(
            {is_line(hx) ? on_line(hx, grid_.px) : x.mid(), is_line(hy) ? on_line(hy, grid_.py) : y.mid(), hx, hy});
        if (is_line(hx) || is_line(hy))
            placed_.push_back({hx, hy, is_line(hx) ? (is_line(hy) ? Interval(0) : y) : x, n});
        return n;
    }

    void add_vertices() {
        map_.nodes_.reserve(map_.arrangement_.set.vertices.size() * 2);
        for (const Vertex& v : map_.arrangement_.set.vertices) {
            add_node(v.x, v.y, half_step(v.x, grid_.px, grid_.width), half_step(v.y, grid_.py, grid_.height));
        }
    }

    void walk(std::uint32_t e) {
        const Edge& edge = map_.arrangement_.edges[e];
        const GridNode a = map_.nodes_[edge.va], b = map_.nodes_[edge.vb];
        if (outside(a, b)) return;
        if (std::max(a.hx, b.hx) < 0) return left_of_canvas(e, a, b);
        const Stretch s = map_.arrangement_.stretch_of(edge);
        crossings_.clear();
        crossings_.push_back({0, edge.ta, edge.va});
        const std::size_t before_lines = crossings_.size();
        cross_lines(s, Axis::X, a, b);
        cross_lines(s, Axis::Y, a, b);
        std::sort(crossings_.begin() + static_cast<std::ptrdiff_t>(before_lines), crossings_.end(),
                  [](const Crossing& p, const Crossing& q) { return p.order < q.order; });
        crossings_.push_back({0, edge.tb, edge.vb});
        for (std::size_t k = 0; k + 1 < crossings_.size(); ++k)
            emit(e, crossings_[k], crossings_[k + 1]);
    }

    /// Entirely right of, above or below the canvas.
    [[nodiscard]] bool outside(const GridNode& a, const GridNode& b) const {
        return std::min(a.hx, b.hx) > 2 * static_cast<HalfStep>(grid_.width) || std::max(a.hy, b.hy) < 0 ||
               std::min(a.hy, b.hy) > 2 * static_cast<HalfStep>(grid_.height);
    }

    /// Crossings with the lines strictly between the ends. A crossing in a corner belongs to the vertical line's list.
    void cross_lines(const Stretch& s, Axis axis, const GridNode& a, const GridNode& b) {
        const bool vertical = axis == Axis::X;
        const HalfStep from = vertical ? a.hx : a.hy, to = vertical ? b.hx : b.hy;
        const HalfStep step = to > from ? 1 : -1, dx = b.hx > a.hx ? 1 : -1, dy = b.hy > a.hy ? 1 : -1;
        for (HalfStep h = from + step; h != to && from != to; h += step) {
            if (!is_line(h)) continue;
            const double v = on_line(h, vertical ? grid_.px : grid_.py);
            Interval t = parameter_at(*s.curve, axis, s.range, vertical ? s.x_increasing : s.y_increasing, v);
            const PointEnclosure p = level_point(s, axis, v, t);
            const Interval w = vertical ? p.y : p.x;
            HalfStep hx = h, hy = h;
            if (vertical)
                hy = clamp_between(half_step(w, grid_.py, grid_.height), a.hy, b.hy);
            else
                hx = clamp_between(half_step(w, grid_.px, grid_.width), a.hx, b.hx);
            const HalfStep order = dx * (hx - a.hx) + dy * (hy - a.hy);
            const bool corner = is_line(hx) && is_line(hy);
            if (corner && std::any_of(crossings_.begin() + 1, crossings_.end(),
                                      [&](const Crossing& c) { return c.order == order; }))
                continue;
            if (at_end(hx, hy, a) || at_end(hx, hy, b)) continue;
            ++stats_.grid_crossings;
            crossings_.push_back({order, t, add_node(vertical ? Interval(v) : w, vertical ? w : Interval(v), hx, hy)});
        }
    }

    static bool at_end(HalfStep hx, HalfStep hy, const GridNode& n) {
        return is_line(hx) && is_line(hy) && n.hx == hx && n.hy == hy;
    }

    void emit(std::uint32_t e, const Crossing& p, const Crossing& q) {
        const GridNode &a = map_.nodes_[p.node], &b = map_.nodes_[q.node];
        if (a.hx == b.hx && is_line(a.hx)) {
            add_steps(e, a, b, static_cast<std::uint32_t>(a.hx / 2));
            return add_side_edge(Axis::X, p.node, q.node);
        }
        if (a.hy == b.hy && is_line(a.hy)) return add_side_edge(Axis::Y, p.node, q.node);
        const HalfStep column = std::min(a.hx, b.hx) >> 1, row = std::min(a.hy, b.hy) >> 1;
        if (column < 0) left_of_canvas(e, a, b);
        if (column < 0 || row < 0 || column >= static_cast<HalfStep>(grid_.width) ||
            row >= static_cast<HalfStep>(grid_.height))
            return;
        pieces_.push_back({{e, {p.t.lo, q.t.hi}, p.node, q.node},
                           static_cast<std::uint32_t>(row) * grid_.width + static_cast<std::uint32_t>(column)});
    }

    /// Only sides between two texels; the canvas border has nothing beyond it.
    void add_side_edge(Axis across, std::uint32_t n0, std::uint32_t n1) {
        const GridNode &a = map_.nodes_[n0], &b = map_.nodes_[n1];
        const HalfStep column = std::min(a.hx, b.hx) >> 1, row = std::min(a.hy, b.hy) >> 1;
        const bool inner = column >= (across == Axis::X ? 1 : 0) && row >= (across == Axis::Y ? 1 : 0) &&
                           column < static_cast<HalfStep>(grid_.width) && row < static_cast<HalfStep>(grid_.height);
        if (!inner) return;
        map_.side_edges_.push_back(
            {across, static_cast<std::uint32_t>(row) * grid_.width + static_cast<std::uint32_t>(column), n0, n1});
    }

    void left_of_canvas(std::uint32_t e, const GridNode& a, const GridNode& b) { add_steps(e, a, b, 0); }

    /// Rows whose top line the edge crosses, upper end included, lower end not; for the bottom border the other way
    /// round.
    void add_steps(std::uint32_t e, const GridNode& a, const GridNode& b, std::uint32_t line) {
        const HalfStep lo = std::min(a.hy, b.hy), hi = std::max(a.hy, b.hy);
        const std::uint32_t arc = map_.arrangement_.edges[e].arc;
        const std::int32_t sign = before(a, b) ? 1 : -1; // a is at the smaller parameter
        for (HalfStep j = std::max<HalfStep>(0, (lo + 1) / 2); 2 * j < hi && j < static_cast<HalfStep>(grid_.height);
             ++j) {
            map_.steps_.push_back({static_cast<std::uint32_t>(j), line, arc, sign});
        }
        const HalfStep bottom = 2 * static_cast<HalfStep>(grid_.height);
        if (lo < bottom && hi >= bottom) map_.steps_.push_back({grid_.height, line, arc, sign});
    }

    /// Nodes on one grid edge (or corner) whose enclosures overlap become one.
    void merge_nodes() {
        std::sort(placed_.begin(), placed_.end(), [](const Placed& p, const Placed& q) {
            return std::tuple(p.hx, p.hy, p.along.mid(), p.node) < std::tuple(q.hx, q.hy, q.along.mid(), q.node);
        });
        std::vector<std::uint32_t> same(map_.nodes_.size());
        std::iota(same.begin(), same.end(), 0u);
        for (std::size_t k = 0; k < placed_.size();) {
            Placed& first = placed_[k];
            const std::size_t begin = k;
            for (++k; k < placed_.size() && joins(first, placed_[k]); ++k) {
                same[placed_[k].node] = first.node;
                first.along = {std::max(first.along.lo, placed_[k].along.lo),
                               std::min(first.along.hi, placed_[k].along.hi)};
            }
            if (k - begin > 1) place_along(first);
        }
        for (Piece& piece : pieces_) {
            piece.sub.n0 = same[piece.sub.n0];
            piece.sub.n1 = same[piece.sub.n1];
        }
        for (SideEdge& s : map_.side_edges_)
            s.n0 = same[s.n0], s.n1 = same[s.n1];
        std::sort(map_.side_edges_.begin(), map_.side_edges_.end(), [](const SideEdge& a, const SideEdge& b) {
            return std::tie(a.across, a.texel, a.n0, a.n1) < std::tie(b.across, b.texel, b.n0, b.n1);
        });
    }

    static bool joins(const Placed& a, const Placed& b) {
        return a.hx == b.hx && a.hy == b.hy && a.along.overlaps(b.along);
    }

    /// The joined node stands where all enclosures agree (exactly, if one of them is exact).
    void place_along(const Placed& p) {
        if (is_line(p.hx) && is_line(p.hy)) return;
        (is_line(p.hx) ? map_.nodes_[p.node].y : map_.nodes_[p.node].x) = p.along.mid();
    }

    void sort_into_texels() {
        const std::size_t texels = static_cast<std::size_t>(grid_.width) * grid_.height;
        map_.texel_start_.assign(texels + 1, 0);
        std::erase_if(pieces_, [](const Piece& p) { return p.sub.n0 == p.sub.n1; });
        for (const Piece& p : pieces_)
            ++map_.texel_start_[p.texel + 1];
        std::partial_sum(map_.texel_start_.begin(), map_.texel_start_.end(), map_.texel_start_.begin());
        std::vector<std::uint32_t> next(map_.texel_start_.begin(), map_.texel_start_.end() - 1);
        map_.sub_edges_.resize(pieces_.size());
        for (const Piece& p : pieces_)
            map_.sub_edges_[next[p.texel]++] = p.sub;
    }

    void sort_steps() {
        std::sort(map_.steps_.begin(), map_.steps_.end(), [](const RowStep& a, const RowStep& b) {
            return std::tie(a.row, a.line, a.arc, a.sign) < std::tie(b.row, b.line, b.arc, b.sign);
        });
        map_.step_start_.assign(grid_.height + 2, 0);
        for (const RowStep& s : map_.steps_)
            ++map_.step_start_[s.row + 1];
        std::partial_sum(map_.step_start_.begin(), map_.step_start_.end(), map_.step_start_.begin());
    }

    PlanarMap& map_;
    const Grid& grid_;
    PlanarStats& stats_;
    std::vector<Crossing> crossings_;
    std::vector<Piece> pieces_;
    std::vector<Placed> placed_;
};

Result<PlanarMap> PlanarMap::build(const Scene& scene, const Grid& grid, unsigned threads, PlanarStats& stats) {
    Result<Arrangement> arrangement = arrange(scene, grid, threads, stats);
    if (!arrangement) return arrangement.error();
    PlanarMap map;
    map.grid_ = grid;
    map.arrangement_ = std::move(arrangement).value();
    Builder(map, stats).run();
    return map;
}

std::span<const SubEdge> PlanarMap::sub_edges(std::uint32_t i, std::uint32_t j) const {
    const std::size_t k = static_cast<std::size_t>(j) * grid_.width + i;
    return std::span(sub_edges_).subspan(texel_start_[k], texel_start_[k + 1] - texel_start_[k]);
}

bool PlanarMap::runs_along(Axis across, std::uint32_t i, std::uint32_t j, const LinePosition& from,
                           const LinePosition& to) const {
    const std::pair key(across, j * grid_.width + i);
    auto it = std::lower_bound(side_edges_.begin(), side_edges_.end(), key,
                               [](const SideEdge& s, const auto& k) { return std::pair(s.across, s.texel) < k; });
    for (; it != side_edges_.end() && std::pair(it->across, it->texel) == key; ++it) {
        const LinePosition a = along(nodes_[it->n0], across), b = along(nodes_[it->n1], across);
        if (std::min(a, b) < to && from < std::max(a, b)) return true;
    }
    return false;
}

Stretch PlanarMap::stretch_of(const SubEdge& s) const {
    const Arc& a = arrangement_.set.arcs[arrangement_.edges[s.edge].arc];
    return {&arrangement_.set.curves[a.curve], s.range, a.x_increasing, a.y_increasing};
}

std::span<const Contribution> PlanarMap::contributions_of(const SubEdge& s) const {
    return arrangement_.set.contributions_of(arrangement_.set.arcs[arrangement_.edges[s.edge].arc]);
}

std::span<const RowStep> PlanarMap::steps_of(std::uint32_t row) const {
    return std::span(steps_).subspan(step_start_[row], step_start_[row + 1] - step_start_[row]);
}

void PlanarMap::apply(Windings& w, const RowStep& step) const {
    for (const Contribution& c : arrangement_.set.contributions_of(arrangement_.set.arcs[step.arc])) {
        add_winding(w, c.shape, step.sign * c.winding);
    }
}

int PlanarMap::sweep_sign(const SubEdge& s) const { return before(nodes_[s.n0], nodes_[s.n1]) ? 1 : -1; }

void PlanarMap::cross_row_line(Windings& w, const SubEdge& s, HalfStep line) const {
    if (nodes_[s.n0].hy != line && nodes_[s.n1].hy != line) return;
    const int sign = sweep_sign(s);
    for (const Contribution& c : contributions_of(s))
        add_winding(w, c.shape, sign * c.winding);
}

} // namespace fetexc
