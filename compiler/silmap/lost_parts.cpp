// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/lost_parts.h"

#include <algorithm>
#include <array>
#include <map>

#include "compiler/error_budget.h"
#include "compiler/silmap/part_area.h"

namespace fetexc {
namespace {

constexpr std::array<TexelSide, 4> kSides{TexelSide::Top, TexelSide::Bottom, TexelSide::Left, TexelSide::Right};

struct Ends {
    std::uint32_t first, last; ///< corners of the cell
};
constexpr std::array<Ends, 4> kEnds{{{fetex::kSilmapNW, fetex::kSilmapNE},
                                     {fetex::kSilmapSW, fetex::kSilmapSE},
                                     {fetex::kSilmapNW, fetex::kSilmapSW},
                                     {fetex::kSilmapNE, fetex::kSilmapSE}}};

bool is_upright(TexelSide side) { return side == TexelSide::Left || side == TexelSide::Right; }
Axis across(TexelSide side) { return is_upright(side) ? Axis::X : Axis::Y; }

/// Half steps where a side of cell (i,j) begins.
HalfStep begin_of(TexelSide side, std::uint32_t i, std::uint32_t j) {
    return 2 * static_cast<HalfStep>(is_upright(side) ? j : i);
}

} // namespace

PartsRow::Cell& PartsRow::new_cell(std::uint32_t i) {
    Cell c;
    c.i = i, c.first_region = static_cast<std::uint32_t>(regions_.size());
    cells_.push_back(c);
    return cells_.back();
}

std::uint32_t PartsRow::new_region(ResultId result) {
    ++cells_.back().regions;
    regions_.push_back({result, static_cast<std::uint32_t>(cells_.size() - 1), 0});
    return static_cast<std::uint32_t>(regions_.size() - 1);
}

/// Of the newest cell, in the order of TexelSide.
void PartsRow::add_side(TexelSide side, std::span<const LinePart> parts) {
    const auto k = static_cast<std::size_t>(side);
    regions_[parts.front().vertex].corners |= 1u << kEnds[k].first;
    regions_[parts.back().vertex].corners |= 1u << kEnds[k].last;
    Cell& c = cells_.back();
    c.parts[k] = static_cast<std::uint32_t>(parts_.size());
    parts_.insert(parts_.end(), parts.begin(), parts.end());
    c.parts[k + 1] = static_cast<std::uint32_t>(parts_.size());
}

/// Regions: faces joined over edges that can't be seen.
void PartsRow::add(const PlanarMap& map, const TexelMap& cell) {
    const SweepResult& s = cell.sweep;
    if (std::ranges::all_of(s.portions, [&](const Portion& p) { return cell.left_result(p) == cell.right_result(p); }))
        return;
    joined_.reset(s.faces.size());
    for (std::uint32_t f = 0; f < s.faces.size(); ++f)
        joined_.unite(f, s.face(f));
    for (const Portion& p : s.portions) {
        if (cell.left_result(p) == cell.right_result(p)) joined_.unite(p.left, p.right);
    }
    new_cell(cell.i);
    region_of_face_.resize(s.faces.size());
    for (std::uint32_t f = 0; f < s.faces.size(); ++f) { // a representative comes first
        const std::uint32_t r = joined_.find(f);
        region_of_face_[f] = r == f ? new_region(cell.results[f]) : region_of_face_[r];
    }
    for (const TexelSide side : kSides) {
        const HalfStep begin = begin_of(side, cell.i, cell.j);
        side_.clear();
        for (const SidePart& p : s.sides[static_cast<std::size_t>(side)]) {
            const LinePosition from =
                p.from == kNone ? LinePosition{begin} : map.position(cell.graph.nodes[p.from], across(side));
            append_part(side_, from, region_of_face_[p.face]);
        }
        if (side_.size() > 1 && side_.back().from == LinePosition{begin + 2}) side_.pop_back();
        add_side(side, side_);
    }
}

void PartsRow::add(const PlanarMap& map, const LoneEdge& e) {
    if (e.left == e.right) return;
    new_cell(e.i);
    const GridNode &top = map.node(e.top), &bottom = map.node(e.bottom);
    const HalfStep west = 2 * static_cast<HalfStep>(e.i), north = 2 * static_cast<HalfStep>(e.j);
    const std::uint32_t left = new_region(e.left), right = new_region(e.right);
    const auto on = [&](const GridNode& n, TexelSide side) {
        switch (side) {
        case TexelSide::Top:
            return n.hy == north;
        case TexelSide::Bottom:
            return n.hy == north + 2;
        case TexelSide::Left:
            return n.hx == west;
        default:
            return n.hx == west + 2;
        }
    };
    const auto other = [&](std::uint32_t region) { return left + right - region; };
    const auto add_from = [&](TexelSide side, std::uint32_t region) {
        side_.assign(1, {{begin_of(side, e.i, e.j)}, region});
        for (const auto& [node, n] : {std::pair(e.top, &top), std::pair(e.bottom, &bottom)}) {
            if (on(*n, side)) side_.push_back({map.position(node, across(side)), region = other(region)});
        }
        add_side(side, side_);
        return region;
    };
    const std::uint32_t nw = on(top, TexelSide::Left) ? right : left;
    const std::uint32_t ne = add_from(TexelSide::Top, nw);
    const bool west_parted = on(top, TexelSide::Left) || on(bottom, TexelSide::Left);
    add_from(TexelSide::Bottom, west_parted ? other(nw) : nw);
    add_from(TexelSide::Left, nw);
    add_from(TexelSide::Right, ne);
}

const PartsRow::Cell* PartsRow::find(std::uint32_t i) const {
    const auto it = std::ranges::lower_bound(cells_, i, {}, &Cell::i);
    return it != cells_.end() && it->i == i ? &*it : nullptr;
}

class PartsFinder {
  public:
    PartsFinder(const PlanarMap& map, std::vector<PartsRow>& rows, const SilmapCells& cells, unsigned threads)
        : map_(map), rows_(rows), cells_(cells), threads_(threads), start_{0} {
        for (PartsRow& row : rows_) {
            row.shown_.assign(row.regions_.size(), 0);
            start_.push_back(start_.back() + static_cast<std::uint32_t>(row.regions_.size()));
        }
    }

    std::optional<LostParts> run(std::span<const std::uint32_t> lent) {
        for (const std::uint32_t texel : lent)
            show_around(texel);
        parallel_for(rows_.size(), threads_, [&](std::size_t j) { show_row(static_cast<std::uint32_t>(j)); });
        std::vector<Links> links(rows_.size());
        parallel_for(rows_.size(), threads_,
                     [&](std::size_t j) { links[j] = links_of(static_cast<std::uint32_t>(j)); });
        UnionFind parts(start_.back());
        for (const Links& row : links) {
            if (row.undecided) return std::nullopt;
            for (const auto& [a, b] : row.pairs)
                parts.unite(a, b);
        }
        return measure(parts);
    }

  private:
    using Cell = PartsRow::Cell;
    struct Links {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs; ///< regions of all rows
        bool undecided = false;
    };

    void show_around(std::uint32_t texel) {
        const std::uint32_t i = texel % cells_.width, j = texel / cells_.width;
        for (const auto& [di, dj] : {std::pair(0u, 0u), {1u, 0u}, {0u, 1u}, {1u, 1u}}) {
            PartsRow& row = rows_[j + dj];
            const Cell* c = row.find(i + di);
            for (std::uint32_t r = 0; c != nullptr && r < c->regions; ++r) {
                if (row.regions_[c->first_region + r].result == cells_.results[texel])
                    row.shown_[c->first_region + r] = 1;
            }
        }
    }

    /// Whether the texel in a corner of cell (i,j) has the result. Beyond the canvas there is none.
    [[nodiscard]] bool texel_has(std::uint32_t i, std::uint32_t j, std::uint32_t corner, ResultId result) const {
        const std::uint32_t x = i + (corner & 1), y = j + (corner >> 1);
        return x > 0 && y > 0 && x <= cells_.width && y <= cells_.height &&
               cells_.results[std::size_t{y - 1} * cells_.width + x - 1] == result;
    }
    [[nodiscard]] bool shows(std::uint32_t i, std::uint32_t j, std::uint32_t corners, ResultId result) const {
        for (std::uint32_t corner = 0; corner < 4; ++corner) {
            if ((corners >> corner & 1) != 0 && texel_has(i, j, corner, result)) return true;
        }
        return false;
    }

    void show_row(std::uint32_t j) {
        PartsRow& row = rows_[j];
        for (std::uint32_t r = 0; r < row.regions_.size(); ++r) {
            const PartsRow::Region& region = row.regions_[r];
            Cell& c = row.cells_[region.cell];
            if (row.shown_[r] == 0) row.shown_[r] = shows(c.i, j, region.corners, region.result) ? 1 : 0;
            c.lost = c.lost || row.shown_[r] == 0;
        }
        for (const Cell& c : row.cells_) {
            for (std::size_t side = 0; c.lost && side < kSides.size(); ++side)
                show_beside_empty(row, c, j, kSides[side]);
        }
    }

    [[nodiscard]] const Cell* neighbour(std::uint32_t i, std::uint32_t j, TexelSide side) const {
        switch (side) {
        case TexelSide::Top:
            return j > 0 ? rows_[j - 1].find(i) : nullptr;
        case TexelSide::Bottom:
            return j < cells_.height ? rows_[j + 1].find(i) : nullptr;
        case TexelSide::Left:
            return i > 0 ? rows_[j].find(i - 1) : nullptr;
        default:
            return i < cells_.width ? rows_[j].find(i + 1) : nullptr;
        }
    }

    /// What goes on in a cell without visible edges that shows it.
    void show_beside_empty(PartsRow& row, const Cell& c, std::uint32_t j, TexelSide side) const {
        const bool first = side == TexelSide::Top || side == TexelSide::Left;
        const std::uint32_t at = is_upright(side) ? c.i : j, end = is_upright(side) ? cells_.width : cells_.height;
        if (first ? at == 0 : at == end) return;
        if (neighbour(c.i, j, side) != nullptr) return;
        const std::uint32_t next = first ? at - 1 : at + 1, i = is_upright(side) ? next : c.i,
                            k = is_upright(side) ? j : next;
        const SilmapCellData* plain = cells_.find(i, k);
        const ResultId result = plain != nullptr ? cells_.truth_of(*plain).slabs.front().left : cells_.inside(i, k);
        constexpr std::uint32_t all = 15;
        if (!shows(i, k, all, result)) return;
        for (const LinePart& p : row.parts_of(c, side)) {
            if (row.regions_[p.vertex].result == result) row.shown_[p.vertex] = 1;
        }
    }

    /// Regions of one result that face each other, where one of them isn't shown: to the right, and below.
    [[nodiscard]] Links links_of(std::uint32_t j) const {
        Links out;
        const std::vector<Cell>& row = rows_[j].cells_;
        for (std::size_t k = 0; k + 1 < row.size(); ++k) {
            if (row[k + 1].i == row[k].i + 1) link(TexelSide::Right, j, row[k], row[k + 1], out);
        }
        if (j == cells_.height) return out;
        const std::vector<Cell>& next = rows_[j + 1].cells_;
        for (auto a = row.begin(), b = next.begin(); a != row.end() && b != next.end();) {
            if (a->i == b->i) link(TexelSide::Bottom, j, *a, *b, out);
            const bool advance_b = b->i <= a->i;
            if (a->i <= b->i) ++a;
            if (advance_b) ++b;
        }
        return out;
    }

    /// Across that side of a cell in row j.
    void link(TexelSide side, std::uint32_t j, const Cell& c, const Cell& next, Links& out) const {
        if (!c.lost && !next.lost) return;
        const std::uint32_t next_row = side == TexelSide::Bottom ? j + 1 : j;
        const PartsRow &a = rows_[j], &b = rows_[next_row];
        facing(map_, across(side), a.parts_of(c, side),
               b.parts_of(next, side == TexelSide::Right ? TexelSide::Left : TexelSide::Top),
               begin_of(side, c.i, j) + 2, out.undecided,
               [&](std::uint32_t p, std::uint32_t q, const LinePosition&, const LinePosition&) {
                   if (a.regions_[p].result == b.regions_[q].result && (a.shown_[p] & b.shown_[q]) == 0)
                       out.pairs.emplace_back(start_[j] + p, start_[next_row] + q);
               });
    }

    [[nodiscard]] LostParts measure(UnionFind& parts) const {
        std::vector<bool> shown(start_.back(), false);
        each_region([&](std::uint32_t j, std::uint32_t r) {
            if (rows_[j].shown_[r] != 0) shown[parts.find(start_[j] + r)] = true;
        });
        struct Lost {
            double area = 0;
            std::uint32_t i = 0, j = 0;
        };
        std::map<std::uint32_t, Lost> lost;
        each_region([&](std::uint32_t j, std::uint32_t r) {
            const std::uint32_t part = parts.find(start_[j] + r);
            if (shown[part]) return;
            const PartsRow::Region& region = rows_[j].regions_[r];
            const std::uint32_t i = rows_[j].cells_[region.cell].i;
            const auto [it, fresh] = lost.try_emplace(part, Lost{0, i, j});
            it->second.area += area_in(i, j, region.result);
        });
        LostParts out;
        for (const auto& [part, l] : lost) {
            if (l.area < budget::kSilmapLostPart) continue;
            ++out.count;
            if (l.area > out.largest) out.largest = l.area, out.i = l.i, out.j = l.j;
        }
        return out;
    }
    template <class Visit> void each_region(const Visit& visit) const {
        for (std::uint32_t j = 0; j < rows_.size(); ++j) {
            for (std::uint32_t r = 0; r < rows_[j].regions_.size(); ++r)
                visit(j, r);
        }
    }

    /// Of all that has the result in the cell and isn't shown there: parts in one cell are taken for one.
    [[nodiscard]] double area_in(std::uint32_t i, std::uint32_t j, ResultId result) const {
        const SilmapCellData* c = cells_.find(i, j);
        if (c == nullptr) return 0;
        std::uint32_t shown = 0; // corners
        for (std::uint32_t corner = 0; corner < 4; ++corner)
            shown |= texel_has(i, j, corner, result) ? 1u << corner : 0;
        return area_apart_from(cells_.truth_of(*c), result, shown);
    }

    const PlanarMap& map_;
    std::vector<PartsRow>& rows_;
    const SilmapCells& cells_;
    unsigned threads_;
    std::vector<std::uint32_t> start_; ///< of each row's regions
};

std::optional<LostParts> lost_parts(const PlanarMap& map, std::vector<PartsRow>& rows, const SilmapCells& cells,
                                    std::span<const std::uint32_t> lent, unsigned threads) {
    return PartsFinder(map, rows, cells, threads).run(lent);
}

} // namespace fetexc
