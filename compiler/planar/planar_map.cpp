// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/planar_map.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "compiler/diagnostics.h"
#include "compiler/planar/exact_points.h"

namespace fetexc {
namespace {

/// Half-step position of an enclosed coordinate; side(level): the exact side of a level inside the enclosure.
template <class Side> HalfStep half_step(const Interval& v, std::int64_t pitch, std::uint32_t lines, const Side& side) {
    const double p = static_cast<double>(pitch);
    const double nearest = std::clamp(std::round(v.mid() / p), 0.0, static_cast<double>(lines));
    if (v.contains(nearest * p))
        return 2 * static_cast<HalfStep>(nearest) + side(pitch * static_cast<std::int64_t>(nearest));
    if (v.mid() < 0) return -1;
    const double cell = std::floor(v.mid() / p);
    return cell >= lines ? 2 * static_cast<HalfStep>(lines) + 1 : 2 * static_cast<HalfStep>(cell) + 1;
}

HalfStep clamp_between(HalfStep v, HalfStep a, HalfStep b) { return std::clamp(v, std::min(a, b), std::max(a, b)); }

double on_line(HalfStep h, std::int64_t pitch) { return static_cast<double>(pitch * (h / 2)); }

bool is_line(HalfStep h) { return h >= 0 && h % 2 == 0; }

} // namespace

/// Walks a chunk of the edges over the grid. Chunks know nothing of each other: a node that one makes is numbered from
/// the number of the map's vertices on, until they are joined.
class PlanarMap::EdgeWalk {
  public:
    explicit EdgeWalk(const PlanarMap& map)
        : map_(map), grid_(map.grid_), vertices_(static_cast<std::uint32_t>(map.arrangement_.set.vertices.size())) {}

    void run(std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t e = first; e < last; ++e)
            walk(e);
    }

    struct Piece {
        SubEdge sub;
        std::uint32_t texel;
    };
    std::vector<GridNode> nodes; ///< with line_crossings, one each
    std::vector<LineCrossing> line_crossings;
    std::vector<Piece> pieces;
    std::vector<SideEdge> side_edges;
    std::vector<RowStep> steps;
    std::optional<PointEnclosure> undecided; ///< a point whose position on the grid couldn't be decided

    /// A node whose coordinates on grid lines are exactly the lines'.
    static GridNode node_at(const Grid& g, const Interval& x, const Interval& y, HalfStep hx, HalfStep hy) {
        const Interval xr = is_line(hx) ? Interval(on_line(hx, g.px)) : x,
                       yr = is_line(hy) ? Interval(on_line(hy, g.py)) : y;
        return {xr.mid(), yr.mid(), xr, yr, hx, hy};
    }

  private:
    struct Crossing {
        HalfStep order = 0; ///< position along the (monotone) edge
        Interval t;
        std::uint32_t node = 0;
    };

    [[nodiscard]] const GridNode& node(std::uint32_t n) const {
        return n < vertices_ ? map_.nodes_[n] : nodes[n - vertices_];
    }

    void walk(std::uint32_t e) {
        const Edge& edge = map_.arrangement_.edges[e];
        const GridNode &a = node(edge.va), &b = node(edge.vb);
        if (outside(a, b)) return;
        if (std::max(a.hx, b.hx) < 0) return left_of_canvas(e, a, b);
        const Stretch s = map_.arrangement_.stretch_of(edge);
        crossings_.clear();
        crossings_.push_back({0, edge.ta, edge.va});
        const std::size_t before_lines = crossings_.size();
        cross_lines(e, s, Axis::X, a, b);
        cross_lines(e, s, Axis::Y, a, b);
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
    void cross_lines(std::uint32_t e, const Stretch& s, Axis axis, const GridNode& a, const GridNode& b) {
        const bool vertical = axis == Axis::X;
        const HalfStep from = vertical ? a.hx : a.hy, to = vertical ? b.hx : b.hy;
        const HalfStep step = to > from ? 1 : -1, dx = b.hx > a.hx ? 1 : -1, dy = b.hy > a.hy ? 1 : -1;
        Interval rest = s.range; // from the last crossing on
        for (HalfStep h = from + step; h != to && from != to; h += step) {
            if (!is_line(h)) continue;
            const std::int64_t level = (vertical ? grid_.px : grid_.py) * (h / 2);
            const auto v = static_cast<double>(level);
            Interval t = parameter_at(*s.curve, axis, rest, vertical ? s.x_increasing : s.y_increasing, v);
            const PointEnclosure p = level_point(s, axis, v, t);
            rest.lo = t.lo;
            const auto side = [&](std::int64_t other) {
                return decide(side_of_level(*s.curve, axis, level, t, other), p);
            };
            HalfStep hx = h, hy = h;
            if (vertical)
                hy = clamp_between(half_step(p.y, grid_.py, grid_.height, side), a.hy, b.hy);
            else
                hx = clamp_between(half_step(p.x, grid_.px, grid_.width, side), a.hx, b.hx);
            const HalfStep order = dx * (hx - a.hx) + dy * (hy - a.hy);
            const bool corner = is_line(hx) && is_line(hy);
            if (corner && std::any_of(crossings_.begin() + 1, crossings_.end(),
                                      [&](const Crossing& c) { return c.order == order; }))
                continue;
            if (at_end(hx, hy, a) || at_end(hx, hy, b)) continue;
            crossings_.push_back({order, t, vertices_ + static_cast<std::uint32_t>(nodes.size())});
            line_crossings.push_back({e, axis, level, t});
            nodes.push_back(node_at(grid_, p.x, p.y, hx, hy));
        }
    }

    int decide(std::optional<int> side, const PointEnclosure& p) {
        if (!side && !undecided) undecided = p;
        return side.value_or(0);
    }

    static bool at_end(HalfStep hx, HalfStep hy, const GridNode& n) {
        return is_line(hx) && is_line(hy) && n.hx == hx && n.hy == hy;
    }

    void emit(std::uint32_t e, const Crossing& p, const Crossing& q) {
        const GridNode &a = node(p.node), &b = node(q.node);
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
        pieces.push_back({{e, {p.t.lo, q.t.hi}, p.node, q.node},
                          static_cast<std::uint32_t>(row) * grid_.width + static_cast<std::uint32_t>(column)});
    }

    /// Only sides between two texels; the canvas border has nothing beyond it.
    void add_side_edge(Axis across, std::uint32_t n0, std::uint32_t n1) {
        const GridNode &a = node(n0), &b = node(n1);
        const HalfStep column = std::min(a.hx, b.hx) >> 1, row = std::min(a.hy, b.hy) >> 1;
        const bool inner = column >= (across == Axis::X ? 1 : 0) && row >= (across == Axis::Y ? 1 : 0) &&
                           column < static_cast<HalfStep>(grid_.width) && row < static_cast<HalfStep>(grid_.height);
        if (!inner) return;
        side_edges.push_back(
            {across, static_cast<std::uint32_t>(row) * grid_.width + static_cast<std::uint32_t>(column), n0, n1});
    }

    void left_of_canvas(std::uint32_t e, const GridNode& a, const GridNode& b) { add_steps(e, a, b, 0); }

    /// Rows whose top line the edge crosses, upper end included, lower end not; for the bottom border the other way
    /// round.
    void add_steps(std::uint32_t e, const GridNode& a, const GridNode& b, std::uint32_t line) {
        const HalfStep lo = std::min(a.hy, b.hy), hi = std::max(a.hy, b.hy);
        const std::uint32_t arc = map_.arrangement_.edges[e].arc;
        const std::int32_t sign = map_.arrangement_.set.arcs[arc].y_increasing ? 1 : -1;
        for (HalfStep j = std::max<HalfStep>(0, (lo + 1) / 2); 2 * j < hi && j < static_cast<HalfStep>(grid_.height);
             ++j) {
            steps.push_back({static_cast<std::uint32_t>(j), line, arc, sign});
        }
        const HalfStep bottom = 2 * static_cast<HalfStep>(grid_.height);
        if (lo < bottom && hi >= bottom) steps.push_back({grid_.height, line, arc, sign});
    }

    const PlanarMap& map_;
    const Grid& grid_;
    std::uint32_t vertices_;
    std::vector<Crossing> crossings_;
};

/// Cuts the arrangement at the grid, chunk by chunk, and joins the chunks in order: the same for any number of threads.
class PlanarMap::Builder {
  public:
    Builder(PlanarMap& map, unsigned threads, PlanarStats& stats)
        : map_(map), grid_(map.grid_), threads_(threads), stats_(stats) {}

    /// Returns a point whose position on the grid couldn't be decided.
    std::optional<PointEnclosure> run() {
        add_vertices();
        walk_edges();
        join();
        stats_.grid_crossings = map_.line_crossings_.size();
        sort_side_edges();
        sort_into_texels();
        sort_steps();
        return undecided_;
    }

  private:
    static constexpr std::size_t kChunk = 1024;
    static std::size_t chunks(std::size_t items) { return (items + kChunk - 1) / kChunk; }

    void add_vertices() {
        const ArcSet& set = map_.arrangement_.set;
        map_.nodes_.resize(set.vertices.size());
        std::vector<std::optional<PointEnclosure>> undecided(chunks(set.vertices.size()));
        parallel_for(undecided.size(), threads_, [&](std::size_t c) {
            for (std::size_t k = c * kChunk; k < std::min(set.vertices.size(), (c + 1) * kChunk); ++k) {
                const Vertex& v = set.vertices[k];
                const auto side = [&](Axis axis) {
                    return [&, axis](std::int64_t level) {
                        const std::optional<int> s = side_of_level(set, v, axis, level);
                        if (!s && !undecided[c]) undecided[c] = PointEnclosure{v.x, v.y};
                        return s.value_or(0);
                    };
                };
                map_.nodes_[k] =
                    EdgeWalk::node_at(grid_, v.x, v.y, half_step(v.x, grid_.px, grid_.width, side(Axis::X)),
                                      half_step(v.y, grid_.py, grid_.height, side(Axis::Y)));
            }
        });
        for (const auto& p : undecided)
            undecided_ = undecided_ ? undecided_ : p;
    }

    void walk_edges() {
        const std::size_t edges = map_.arrangement_.edges.size();
        for (std::size_t c = 0; c < chunks(edges); ++c)
            walks_.emplace_back(map_);
        parallel_for(walks_.size(), threads_, [&](std::size_t c) {
            walks_[c].run(static_cast<std::uint32_t>(c * kChunk),
                          static_cast<std::uint32_t>(std::min(edges, (c + 1) * kChunk)));
        });
    }

    /// The nodes that a chunk made follow those of the chunks before, and so does all else.
    void join() {
        const std::size_t vertices = map_.nodes_.size();
        const auto nodes = room(map_.nodes_, &EdgeWalk::nodes);
        const auto line_crossings = room(map_.line_crossings_, &EdgeWalk::line_crossings);
        const auto side_edges = room(map_.side_edges_, &EdgeWalk::side_edges);
        const auto steps = room(map_.steps_, &EdgeWalk::steps);
        parallel_for(walks_.size(), threads_, [&](std::size_t c) {
            EdgeWalk& w = walks_[c];
            const auto shift = static_cast<std::uint32_t>(nodes[c] - vertices);
            const auto renumber = [&](std::uint32_t& n) { n += n < vertices ? 0 : shift; };
            for (EdgeWalk::Piece& p : w.pieces)
                renumber(p.sub.n0), renumber(p.sub.n1);
            for (SideEdge& e : w.side_edges)
                renumber(e.n0), renumber(e.n1);
            move_to(map_.nodes_, nodes[c], w.nodes);
            move_to(map_.line_crossings_, line_crossings[c], w.line_crossings);
            move_to(map_.side_edges_, side_edges[c], w.side_edges);
            move_to(map_.steps_, steps[c], w.steps);
        });
        for (const EdgeWalk& w : walks_)
            undecided_ = undecided_ ? undecided_ : w.undecided;
    }

    /// Makes room for the chunks' items; returns where each chunk's begin.
    template <class T, class Allocator>
    std::vector<std::size_t> room(std::vector<T, Allocator>& to, std::vector<T> EdgeWalk::*items) const {
        std::vector<std::size_t> first;
        std::size_t end = to.size();
        for (const EdgeWalk& w : walks_) {
            first.push_back(end);
            end += (w.*items).size();
        }
        to.resize(end);
        return first;
    }

    /// Frees the source.
    template <class T, class Allocator>
    static void move_to(std::vector<T, Allocator>& to, std::size_t first, std::vector<T>& from) {
        std::copy(from.begin(), from.end(), to.begin() + static_cast<std::ptrdiff_t>(first));
        from = {};
    }

    void sort_side_edges() {
        std::sort(map_.side_edges_.begin(), map_.side_edges_.end(), [](const SideEdge& a, const SideEdge& b) {
            return std::tie(a.across, a.texel, a.n0, a.n1) < std::tie(b.across, b.texel, b.n0, b.n1);
        });
    }

    /// Each thread has a range of the texels and takes their pieces out of all chunks, in order.
    void sort_into_texels() {
        const std::size_t texels = static_cast<std::size_t>(grid_.width) * grid_.height;
        const std::size_t range = texels / thread_count(threads_) + 1;
        const auto each_piece = [&](const auto& visit) {
            parallel_for_chunks(texels, range, threads_, [&](std::size_t first, std::size_t end) {
                for (const EdgeWalk& w : walks_) {
                    for (const EdgeWalk::Piece& p : w.pieces) {
                        if (first <= p.texel && p.texel < end) visit(p);
                    }
                }
            });
        };
        map_.texel_start_.assign(texels + 1, 0);
        each_piece([&](const EdgeWalk::Piece& p) { ++map_.texel_start_[p.texel + 1]; });
        std::partial_sum(map_.texel_start_.begin(), map_.texel_start_.end(), map_.texel_start_.begin());
        std::vector<std::uint32_t> next(map_.texel_start_.begin(), map_.texel_start_.end() - 1);
        map_.sub_edges_.resize(map_.texel_start_.back());
        each_piece([&](const EdgeWalk::Piece& p) { map_.sub_edges_[next[p.texel]++] = p.sub; });
        walks_.clear();
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
    unsigned threads_;
    PlanarStats& stats_;
    std::vector<EdgeWalk> walks_;
    std::optional<PointEnclosure> undecided_;
};

Result<PlanarMap> PlanarMap::build(const Scene& scene, const Grid& grid, unsigned threads, PlanarStats& stats,
                                   const SkipRules& skip) {
    Result<Arrangement> arrangement = arrange(scene, grid, threads, stats, skip);
    if (!arrangement) return arrangement.error();
    PlanarMap map;
    map.grid_ = grid;
    map.arrangement_ = std::move(arrangement).value();
    if (const auto undecided = Builder(map, threads, stats).run()) {
        return Error{ErrorClass::Runtime, diag::kPlanarInconsistent,
                     "the side of a grid line can't be decided; please report this file",
                     grid.texel_name(undecided->x.mid(), undecided->y.mid())};
    }
    return map;
}

std::optional<FixedPoint> PlanarMap::fixed(std::uint32_t n) const {
    const std::size_t vertices = arrangement_.set.vertices.size();
    if (n < vertices) return fixed_point(arrangement_.set, arrangement_.set.vertices[n]);
    const LineCrossing& c = line_crossings_[n - vertices];
    const Curve& curve = arrangement_.set.curves[arrangement_.set.arcs[arrangement_.edges[c.edge].arc].curve];
    return fixed_level(curve, c.axis, c.level, c.t);
}

AlgebraicCoordinate PlanarMap::algebraic(std::uint32_t n, Axis axis) const {
    const std::size_t vertices = arrangement_.set.vertices.size();
    if (n < vertices) return algebraic_coordinate(arrangement_.set, arrangement_.set.vertices[n], axis);
    const LineCrossing& c = line_crossings_[n - vertices];
    AlgebraicCoordinate out;
    out.axis = axis;
    if (axis == c.axis) {
        out.level = c.level;
        return out;
    }
    out.curve = &arrangement_.set.curves[arrangement_.set.arcs[arrangement_.edges[c.edge].arc].curve];
    out.parameter = {minus(power_basis(*out.curve, c.axis), to_mpz(c.level)), mpq_class(c.t.lo), mpq_class(c.t.hi)};
    return out;
}

LinePosition PlanarMap::position(std::uint32_t n, Axis across) const {
    const HalfStep h = across == Axis::X ? nodes_[n].hy : nodes_[n].hx;
    return {h, is_line(h) ? kNone : n};
}

bool PlanarMap::before(const LinePosition& a, const LinePosition& b, Axis across, bool& undecided) const {
    if (a.h != b.h) return a.h < b.h;
    if (a.node == b.node) return false;
    const GridNode &p = nodes_[a.node], &q = nodes_[b.node];
    const Interval &u = across == Axis::X ? p.y_range : p.x_range, &v = across == Axis::X ? q.y_range : q.x_range;
    if (const int c = compare(u, v); c != 0) return c < 0;
    const std::optional<FixedPoint> s = fixed(a.node), t = fixed(b.node);
    if (s && t) {
        if (const int c = certain_sign(across == Axis::X ? s->y - t->y : s->x - t->x); c != 0) return c < 0;
    }
    const std::optional<int> c = compare(algebraic(a.node, other(across)), algebraic(b.node, other(across)));
    undecided = undecided || !c;
    return c.value_or(0) < 0;
}

std::span<const SubEdge> PlanarMap::sub_edges(std::uint32_t i, std::uint32_t j) const {
    const std::size_t k = static_cast<std::size_t>(j) * grid_.width + i;
    return std::span(sub_edges_).subspan(texel_start_[k], texel_start_[k + 1] - texel_start_[k]);
}

bool PlanarMap::runs_along(Axis across, std::uint32_t i, std::uint32_t j, const LinePosition& from,
                           const LinePosition& to, bool& undecided) const {
    const std::pair key(across, j * grid_.width + i);
    auto it = std::lower_bound(side_edges_.begin(), side_edges_.end(), key,
                               [](const SideEdge& s, const auto& k) { return std::pair(s.across, s.texel) < k; });
    for (; it != side_edges_.end() && std::pair(it->across, it->texel) == key; ++it) {
        LinePosition a = position(it->n0, across), b = position(it->n1, across);
        if (before(b, a, across, undecided)) std::swap(a, b);
        if (before(a, to, across, undecided) && before(from, b, across, undecided)) return true;
    }
    return false;
}

Stretch PlanarMap::stretch_of(const SubEdge& s) const {
    const Arc& a = arrangement_.set.arcs[arrangement_.edges[s.edge].arc];
    const Interval range(std::max(s.range.lo, a.t0.lo), std::min(s.range.hi, a.t1.hi));
    return {&arrangement_.set.curves[a.curve], range, a.x_increasing, a.y_increasing};
}

std::span<const Contribution> PlanarMap::contributions_of(const SubEdge& s) const {
    return arrangement_.set.contributions_of(arrangement_.set.arcs[arrangement_.edges[s.edge].arc]);
}

std::span<const RowStep> PlanarMap::steps_of(std::uint32_t row) const {
    return std::span(steps_).subspan(step_start_[row], step_start_[row + 1] - step_start_[row]);
}

void PlanarMap::apply(Windings& w, const RowStep& step) const {
    add_windings(w, arrangement_.set.contributions_of(arrangement_.set.arcs[step.arc]), step.sign);
}

bool PlanarMap::runs_down(const SubEdge& s) const {
    return arrangement_.set.arcs[arrangement_.edges[s.edge].arc].y_increasing;
}

void PlanarMap::cross_row_line(Windings& w, const SubEdge& s, HalfStep line) const {
    if (nodes_[s.n0].hy != line && nodes_[s.n1].hy != line) return;
    const int sign = runs_down(s) ? 1 : -1;
    add_windings(w, contributions_of(s), sign);
}

} // namespace fetexc
