// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/sweep.h"

#include <algorithm>
#include <array>

namespace fetexc {

bool Sweep::run(std::span<const SubEdge> sub_edges, const SweepGraph& graph, std::span<const Cut> cuts,
                TexelFrame frame, SweepResult& out) {
    sub_edges_ = sub_edges, nodes_ = graph.nodes, ranks_ = graph.ranks, edges_ = graph.edges, frame_ = frame,
    out_ = &out;
    decided_ = true;
    out.clear();
    has_cuts_ = !cuts.empty();
    prepare(nodes_.size());
    gaps_.push_back(open_gap(new_face(), 0, kNone));
    for (std::uint32_t k = 0; k < nodes_.size(); ++k) {
        if (!seen_first_slab_ && node(k).hy > frame.top) rank_top_line();
        if (!cuts.empty() && cuts.front().first == k) {
            if (!cut(cuts.front())) return false;
            k = cuts.front().last - 1;
            cuts = cuts.subspan(1);
        } else if (!at_node(k)) {
            return false;
        }
    }
    if (!seen_first_slab_) rank_top_line();
    if (side(TexelSide::Bottom).empty()) side(TexelSide::Bottom).push_back({kNone, gaps_.front().face});
    for (const Gap& g : gaps_)
        close_gap(g, kNone);
    return decided_ && status_.empty() && cuts.empty();
}

void Sweep::prepare(std::size_t nodes) {
    status_.clear(), gaps_.clear(), band_ = 0, seen_first_slab_ = false;
    portion_.assign(edges_.size(), 0);
    level_on_cut_.assign(edges_.size(), false);
    in_count_.assign(nodes, 0);
    first_out_.assign(nodes + 1, 0);
    for (const SweepEdge& e : edges_)
        ++first_out_[e.top + 1], ++in_count_[e.bottom];
    for (std::size_t k = 1; k < first_out_.size(); ++k)
        first_out_[k] += first_out_[k - 1];
    out_edges_.resize(edges_.size());
    next_out_.assign(first_out_.begin(), first_out_.end() - 1);
    for (std::uint32_t e = 0; e < edges_.size(); ++e)
        out_edges_[next_out_[edges_[e].top]++] = e;
}

Sweep::Side Sweep::side_of(std::uint32_t k) const {
    const GridNode& n = node(k);
    if (n.hy == frame_.top) return Side::Top;
    if (n.hy == frame_.top + 2) return Side::Bottom;
    if (n.hx == frame_.left) return Side::Left;
    return n.hx == frame_.left + 2 ? Side::Right : Side::Interior;
}

bool Sweep::at_node(std::uint32_t k) {
    collect_outgoing(k);
    std::size_t from = 0;
    if (in_count_[k] > 0) {
        if (!find_incoming(k, from)) return false;
    } else if (!outgoing_.empty()) {
        from = locate(k, outgoing_.front());
    } else {
        return true;
    }
    const std::uint32_t left = gaps_[from].face, right = gaps_[from + in_count_[k]].face;
    replace(k, from, in_count_[k], side_of(k));
    note_node_on_side(k, side_of(k), left, right);
    return true;
}

/// left, right: the faces beside the node before it was processed.
void Sweep::note_node_on_side(std::uint32_t k, Side where, std::uint32_t left, std::uint32_t right) {
    if (has_cuts_) return;
    if (where == Side::Left) side(TexelSide::Left).push_back({k, gaps_.front().face});
    if (where == Side::Right) side(TexelSide::Right).push_back({k, gaps_.back().face});
    if (where != Side::Bottom) return;
    std::vector<SidePart>& bottom = side(TexelSide::Bottom);
    if (bottom.empty()) bottom.push_back({kNone, left});
    bottom.push_back({k, right});
}

/// A band line: what reaches it ends there, what crosses it starts anew, what leaves it starts in the next band.
bool Sweep::cut(Cut range) {
    for (std::uint32_t k = range.first; k < range.last; ++k) {
        for (std::uint32_t i = first_out_[k]; i < first_out_[k + 1]; ++i) {
            const SweepEdge& e = edges_[out_edges_[i]];
            if (e.bottom >= range.last) continue;
            level_on_cut_[out_edges_[i]] = true;
            --in_count_[e.bottom];
        }
    }
    outgoing_.clear();
    for (std::uint32_t k = range.first; k < range.last; ++k) {
        std::size_t from = 0;
        if (in_count_[k] == 0) continue;
        if (!find_incoming(k, from)) return false;
        replace(k, from, in_count_[k], Side::Bottom);
    }
    next_band();
    for (std::uint32_t k = range.first; k < range.last; ++k) {
        collect_outgoing(k);
        if (!outgoing_.empty()) replace(k, locate(k, outgoing_.front()), 0, Side::Top);
    }
    rank_top_line();
    return true;
}

/// The band's top line is complete: what crosses it now starts there, and the faces between are known.
void Sweep::rank_top_line() {
    if (!seen_first_slab_) note_first_slab();
    seen_first_slab_ = true;
    for (std::size_t i = 0; i < status_.size(); ++i) {
        Portion& p = out_->portions[portion_[status_[i]]];
        p.rank = static_cast<std::uint32_t>(i);
        p.left = gaps_[i].face, p.right = gaps_[i + 1].face;
    }
}

void Sweep::note_first_slab() {
    out_->first_face = gaps_.front().face;
    if (has_cuts_) return;
    side(TexelSide::Left).push_back({kNone, gaps_.front().face});
    side(TexelSide::Right).push_back({kNone, gaps_.back().face});
    side(TexelSide::Top).push_back({kNone, gaps_.front().face});
    for (std::size_t i = 0; i < status_.size(); ++i)
        side(TexelSide::Top).push_back({edges_[status_[i]].top, gaps_[i + 1].face});
}

void Sweep::collect_outgoing(std::uint32_t k) {
    outgoing_.clear();
    for (std::uint32_t i = first_out_[k]; i < first_out_[k + 1]; ++i) {
        if (!level_on_cut_[out_edges_[i]]) outgoing_.push_back(out_edges_[i]);
    }
    constexpr std::size_t few = 16;
    if (outgoing_.size() > few) {
        std::stable_sort(outgoing_.begin(), outgoing_.end(),
                         [&](std::uint32_t e, std::uint32_t f) { return left_of(e, f); });
        return;
    }
    for (std::size_t i = 1; i < outgoing_.size(); ++i) {
        for (std::size_t p = i; p > 0 && left_of(outgoing_[p], outgoing_[p - 1]); --p)
            std::swap(outgoing_[p], outgoing_[p - 1]);
    }
}

/// The edges that end at node k must be neighbours in the status.
bool Sweep::find_incoming(std::uint32_t k, std::size_t& from) const {
    from = 0;
    while (from < status_.size() && edges_[status_[from]].bottom != k)
        ++from;
    for (std::size_t i = from; i < from + in_count_[k]; ++i) {
        if (i >= status_.size() || edges_[status_[i]].bottom != k) return false;
    }
    return true;
}

/// Position of an edge that starts at node k among the edges in the status.
std::size_t Sweep::locate(std::uint32_t k, std::uint32_t edge) {
    if (node(k).hx == frame_.left) return 0;
    if (node(k).hx == frame_.left + 2) return status_.size();
    std::size_t lo = 0, hi = status_.size();
    while (lo < hi) {
        const std::size_t mid = (lo + hi) / 2;
        if (left_of(edge, status_[mid]))
            hi = mid;
        else
            lo = mid + 1;
    }
    return lo;
}

/// The incoming edges [from, from+count) end at node k, its outgoing edges take their place. On a side of the band the
/// faces left and right of the node aren't connected around it.
void Sweep::replace(std::uint32_t k, std::size_t from, std::size_t count, Side side) {
    const std::size_t fresh = outgoing_.size();
    const std::uint32_t left = gaps_[from].face, right = gaps_[from + count].face;
    for (std::size_t i = 0; i <= count; ++i)
        close_gap(gaps_[from + i], k);
    const auto position = static_cast<std::ptrdiff_t>(from), removed = static_cast<std::ptrdiff_t>(count);
    status_.erase(status_.begin() + position, status_.begin() + position + removed);
    status_.insert(status_.begin() + position, outgoing_.begin(), outgoing_.end());
    gaps_.erase(gaps_.begin() + position, gaps_.begin() + position + removed + 1);
    gaps_.insert(gaps_.begin() + position, fresh + 1, Gap{});
    if (fresh == 0) {
        if (side == Side::Interior) unite(left, right);
        gaps_[from] = open_gap(side == Side::Right ? left : right, from, k);
        return;
    }
    for (std::size_t i = 0; i <= fresh; ++i) {
        std::uint32_t face = 0;
        if (i == 0)
            face = side == Side::Left ? new_face() : left;
        else if (i == fresh)
            face = side == Side::Top || side == Side::Right ? new_face() : right;
        else
            face = new_face();
        gaps_[from + i] = open_gap(face, from + i, k);
    }
    for (std::size_t i = 0; i < fresh; ++i) {
        add_portion(outgoing_[i], false);
        Portion& p = out_->portions.back();
        p.left = gaps_[from + i].face, p.right = gaps_[from + i + 1].face;
    }
}

void Sweep::next_band() {
    ++band_;
    for (std::uint32_t e : status_)
        out_->portions[portion_[e]].to_cut = true;
    for (std::size_t g = 0; g < gaps_.size(); ++g) {
        close_gap(gaps_[g], kNone);
        gaps_[g] = open_gap(new_face(), g, kNone);
    }
    for (std::uint32_t e : status_)
        add_portion(e, true);
}

namespace {

struct Range {
    std::uint32_t lo = 0, hi = 0; ///< ranks
};

Range common(Range a, Range b) { return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)}; }

bool rises(const Stretch& s, Axis axis) { return axis == Axis::X ? s.x_increasing : s.y_increasing; }

/// Position along the other axis where the stretch passes the level.
Interval position_at(const Stretch& s, Axis level_axis, double level) {
    const Interval t = parameter_at(*s.curve, level_axis, s.range, rises(s, level_axis), level);
    return value_over(*s.curve, other(level_axis), t);
}

const Interval& range_along(const GridNode& n, Axis axis) { return axis == Axis::X ? n.x_range : n.y_range; }

} // namespace

/// e runs left of f where both run. They don't cross, so boxes or one common level decide.
bool Sweep::left_of(std::uint32_t e, std::uint32_t f) {
    const auto x_range = [&](const SweepEdge& s) {
        const std::uint32_t a = ranks_[s.top].x, b = ranks_[s.bottom].x;
        return Range{std::min(a, b), std::max(a, b)};
    };
    const Range ex = x_range(edges_[e]), fx = x_range(edges_[f]);
    if (ex.hi <= fx.lo && ex.lo < fx.hi) return true;
    if (fx.hi <= ex.lo && fx.lo < ex.hi) return false;
    return left_of_within(e, f);
}

/// The boxes overlap.
bool Sweep::left_of_within(std::uint32_t e, std::uint32_t f) {
    const SweepEdge &se = edges_[e], &sf = edges_[f];
    const Range ey{ranks_[se.top].y, ranks_[se.bottom].y}, fy{ranks_[sf.top].y, ranks_[sf.bottom].y};
    const Range y = common(ey, fy);
    const std::uint32_t y_from = ey.lo >= fy.lo ? se.top : sf.top, y_to = ey.hi <= fy.hi ? se.bottom : sf.bottom;
    if (se.top != sf.top) {
        if (y.lo < y.hi) return order_between(e, f, Axis::Y, y_from, y_to) < 0;
        if (fy.hi <= ey.lo) return ranks_[se.top].x < ranks_[sf.bottom].x; // f ends on the level where e starts
        if (fy.lo >= ey.lo) return ranks_[se.top].x < ranks_[sf.top].x;    // e is level, f starts on its level
        return level_edge_against(e, f) < 0;
    }
    // From a common top on: along the axis where both reach.
    if (y.lo < y.hi) return order_between(e, f, Axis::Y, y_from, y_to) < 0;
    // One of them is level and runs right; the boxes overlap, so the other does, too: the lower one is left.
    const std::uint32_t x_to = ranks_[se.bottom].x <= ranks_[sf.bottom].x ? se.bottom : sf.bottom;
    return order_between(e, f, Axis::X, se.top, x_to) > 0;
}

/// Sign of e − f, in position, on a level strictly between two nodes.
int Sweep::order_between(std::uint32_t e, std::uint32_t f, Axis axis, std::uint32_t from, std::uint32_t to) {
    const Stretch a = map_.stretch_of(sub_edges_[edges_[e].sub]), b = map_.stretch_of(sub_edges_[edges_[f].sub]);
    const double lo = range_along(node(from), axis).hi, hi = range_along(node(to), axis).lo;
    const double gap = 64 * budget::kUnitRoundoff * (std::fabs(lo) + std::fabs(hi));
    for (const double w : {0.5, 0.9375, 0.25}) {
        if (!(hi - lo > gap)) break;
        const double level = lo + w * (hi - lo);
        if (const int c = compare(position_at(a, axis, level), position_at(b, axis, level)); c != 0) return c;
    }
    ++stats_.exact_comparisons;
    const mpq_class level = order_.level_between(nodes_[from], nodes_[to], axis);
    const int c = compare_positions_exact(a, b, axis, level);
    decided_ = decided_ && c != 0;
    return c;
}

/// Sign of e − f, in position, for a level edge e that f passes: any point of e decides, its middle does best.
int Sweep::level_edge_against(std::uint32_t e, std::uint32_t f) {
    const GridNode &p = node(edges_[e].top), &q = node(edges_[e].bottom);
    const Stretch s = map_.stretch_of(sub_edges_[edges_[f].sub]);
    const double middle = 0.5 * (p.x + q.x);
    if (p.y_range.lo == p.y_range.hi) {
        if (const int c = compare(Interval(middle), position_at(s, Axis::Y, p.y)); c != 0) return c;
    }
    ++stats_.exact_comparisons;
    const std::uint32_t a = nodes_[edges_[e].top], b = nodes_[edges_[e].bottom];
    const mpq_class x = (order_.coordinate(a, Axis::X) + order_.coordinate(b, Axis::X)) / 2;
    const int c = -compare_position_exact(s, Axis::Y, order_.coordinate(a, Axis::Y), x);
    decided_ = decided_ && c != 0;
    return c;
}

std::uint32_t Sweep::new_face() {
    out_->faces.push_back(static_cast<std::uint32_t>(out_->faces.size()));
    return out_->faces.back();
}

Sweep::Gap Sweep::open_gap(std::uint32_t face, std::size_t position, std::uint32_t top_node) {
    const std::uint32_t left = position == 0 ? kNone : status_[position - 1];
    const std::uint32_t right = position == status_.size() ? kNone : status_[position];
    out_->trapezoids.push_back({left, right, top_node, kNone, face});
    return {face, static_cast<std::uint32_t>(out_->trapezoids.size() - 1)};
}

void Sweep::close_gap(const Gap& gap, std::uint32_t bottom_node) {
    out_->trapezoids[gap.trapezoid].bottom_node = bottom_node;
}

void Sweep::unite(std::uint32_t a, std::uint32_t b) {
    a = out_->face(a), b = out_->face(b);
    out_->faces[std::max(a, b)] = std::min(a, b);
}

void Sweep::add_portion(std::uint32_t edge, bool from_cut) {
    portion_[edge] = static_cast<std::uint32_t>(out_->portions.size());
    out_->portions.push_back({edge, band_, 0, 0, from_cut, false});
}

} // namespace fetexc
