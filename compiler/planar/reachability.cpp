// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/reachability.h"

#include <algorithm>

#include "compiler/parallel.h"
#include "compiler/union_find.h"

namespace fetexc {
namespace {

void sort_unique(std::vector<ReachLink>& links) {
    std::sort(links.begin(), links.end());
    links.erase(std::unique(links.begin(), links.end()), links.end());
}

} // namespace

std::uint32_t ReachabilityRow::new_vertex(ResultId result) {
    column_.push_back(next_);
    result_.push_back(result);
    return static_cast<std::uint32_t>(result_.size() - 1);
}

void ReachabilityRow::link_to_left(const Parts& left) {
    bool undecided = false;
    facing(*map_, Axis::X, right_, left, 2 * static_cast<HalfStep>(row_) + 2, undecided,
           [&](std::uint32_t a, std::uint32_t b, const LinePosition& from, const LinePosition& to) {
               if (separation_ == Separation::Edges) {
                   if (!map_->runs_along(Axis::X, next_, row_, from, to, undecided)) links_.push_back({a, b});
               } else if (result_[a] == result_[b])
                   links_.push_back({a, b});
               else if (!conflict_ && !map_->runs_along(Axis::X, next_, row_, from, to, undecided))
                   conflict_ = {next_, row_};
           });
    if (undecided && !conflict_) conflict_ = {next_, row_};
}

std::uint32_t ReachabilityRow::add_empty(ResultId result) {
    if (run_ && separation_ == Separation::Results && result_.back() == result) {
        ++next_;
        return static_cast<std::uint32_t>(result_.size() - 1);
    }
    const std::uint32_t v = new_vertex(result);
    scratch_.assign(1, {{2 * static_cast<HalfStep>(row_)}, v});
    if (next_ > 0) link_to_left(scratch_);
    const LinePosition corner{2 * static_cast<HalfStep>(next_)};
    append_part(top_, corner, v), append_part(bottom_, corner, v);
    right_ = scratch_;
    run_ = true;
    ++next_;
    return v;
}

std::uint32_t ReachabilityRow::add_texel(const TexelMap& texel, std::span<const std::uint32_t> region_of_face,
                                         std::span<const ResultId> region_result) {
    const auto first = static_cast<std::uint32_t>(result_.size());
    for (const ResultId r : region_result)
        new_vertex(r);
    list_parts(texel, TexelSide::Left, region_of_face, first, scratch_);
    if (next_ > 0) link_to_left(scratch_);
    for (const auto& [side, line] : {std::pair(TexelSide::Top, &top_), std::pair(TexelSide::Bottom, &bottom_)}) {
        list_parts(texel, side, region_of_face, first, scratch_);
        for (const LinePart& p : scratch_)
            append_part(*line, p.from, p.vertex);
    }
    list_parts(texel, TexelSide::Right, region_of_face, first, right_);
    run_ = false;
    ++next_;
    return first;
}

void ReachabilityRow::list_parts(const TexelMap& texel, TexelSide side, std::span<const std::uint32_t> region_of_face,
                                 std::uint32_t first, Parts& out) const {
    const bool vertical = side == TexelSide::Left || side == TexelSide::Right;
    const LinePosition corner{vertical ? texel.frame.top : texel.frame.left};
    out.clear();
    for (const SidePart& p : texel.sweep.sides[static_cast<std::size_t>(side)]) {
        const LinePosition from =
            p.from == kNone ? corner : map_->position(texel.graph.nodes[p.from], vertical ? Axis::X : Axis::Y);
        append_part(out, from, first + region_of_face[p.face]);
    }
}

ReachabilityGraph::ReachabilityGraph(const PlanarMap& map, std::vector<ReachabilityRow>& rows, unsigned threads) {
    row_start_.push_back(0);
    for (const ReachabilityRow& row : rows) {
        column_.insert(column_.end(), row.column_.begin(), row.column_.end());
        result_.insert(result_.end(), row.result_.begin(), row.result_.end());
        row_start_.push_back(static_cast<std::uint32_t>(result_.size()));
    }
    std::vector<RowLinks> links(rows.size());
    parallel_for(rows.size(), threads, [&](std::size_t j) {
        links[j] = links_of(rows[j]);
        if (j + 1 < rows.size()) link_rows(map, rows[j], rows[j + 1], links[j]);
        sort_unique(links[j].links);
    });
    for (const RowLinks& row : links) {
        links_.insert(links_.end(), row.links.begin(), row.links.end());
        conflict_ = conflict_ ? conflict_ : row.conflict;
    }
    find_components();
}

ReachabilityGraph::RowLinks ReachabilityGraph::links_of(const ReachabilityRow& row) const {
    RowLinks out{row.links_, row.conflict_};
    for (ReachLink& l : out.links)
        l.a += row_start_[row.row_], l.b += row_start_[row.row_];
    return out;
}

void ReachabilityGraph::link_rows(const PlanarMap& map, const ReachabilityRow& above, const ReachabilityRow& below,
                                  RowLinks& out) const {
    bool undecided = false;
    facing(map, Axis::Y, above.bottom_, below.top_, 2 * static_cast<HalfStep>(map.grid().width), undecided,
           [&](std::uint32_t a, std::uint32_t b, const LinePosition& from, const LinePosition& to) {
               const bool linked = above.separation_ == Separation::Edges
                                       ? !map.runs_along(Axis::Y, static_cast<std::uint32_t>(from.h >> 1), below.row_,
                                                         from, to, undecided)
                                       : above.result_[a] == below.result_[b];
               if (above.separation_ == Separation::Edges && !linked) return;
               if (linked) {
                   out.links.push_back({row_start_[above.row_] + a, row_start_[below.row_] + b});
                   return;
               }
               const HalfStep last = (to.h - 1) >> 1; // texel that holds the stretch's end
               for (HalfStep h = from.h >> 1; h <= last && !out.conflict; ++h) {
                   const auto i = static_cast<std::uint32_t>(h);
                   if (!map.runs_along(Axis::Y, i, below.row_, from, to, undecided)) out.conflict = {i, below.row_};
               }
           });
    if (undecided && !out.conflict) out.conflict = {0, below.row_};
}

void ReachabilityGraph::find_components() {
    UnionFind sets(vertices());
    for (const ReachLink& l : links_)
        sets.unite(l.a, l.b);
    components_.resize(vertices());
    for (std::uint32_t v = 0; v < components_.size(); ++v) {
        components_[v] = sets.find(v);
        component_count_ += components_[v] == v ? 1 : 0;
    }
}

std::uint32_t ReachabilityGraph::first_vertex(std::uint32_t i, std::uint32_t j) const {
    const auto begin = column_.begin() + row_start_[j], end = column_.begin() + row_start_[j + 1];
    const auto after = std::upper_bound(begin, end, i); // a vertex whose column is at most i comes before it
    return static_cast<std::uint32_t>(std::lower_bound(begin, after, *(after - 1)) - column_.begin());
}

std::uint32_t ReachabilityGraph::row(std::uint32_t vertex) const {
    return static_cast<std::uint32_t>(std::upper_bound(row_start_.begin(), row_start_.end(), vertex) -
                                      row_start_.begin() - 1);
}

} // namespace fetexc
