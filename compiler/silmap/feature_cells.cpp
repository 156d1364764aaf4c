// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/feature_cells.h"

#include <algorithm>

#include "compiler/parallel.h"
#include "compiler/silmap/silmap_cells.h"
#include "compiler/union_find.h"

namespace fetexc {
namespace {

using Corners = FaceRow::Corners;

const Corners* find(const FaceRow& row, std::uint32_t i) {
    const auto it = std::ranges::lower_bound(row.corners(), i, {}, &Corners::i);
    return it != row.corners().end() && it->i == i ? &*it : nullptr;
}

/// Vertices that links join.
class Joined {
  public:
    explicit Joined(const ReachabilityGraph& graph) : graph_(graph) {}

    /// Whether a is reached from b through the vertices of two cells, first_… to first_… + count_… − 1.
    bool operator()(std::uint32_t a, std::uint32_t b, std::uint32_t first_p, std::uint32_t count_p,
                    std::uint32_t first_q, std::uint32_t count_q) const {
        UnionFind sets(count_p + count_q);
        const auto index = [&](std::uint32_t v) { return v - first_p < count_p ? v - first_p : v - first_q + count_p; };
        const auto in_q = [&](std::uint32_t v) { return v - first_q < count_q; };
        for (std::uint32_t v = first_p; v < first_p + count_p; ++v) {
            const auto links = graph_.links();
            for (auto l = std::ranges::lower_bound(links, v, {}, &ReachLink::a); l != links.end() && l->a == v; ++l) {
                if (in_q(l->b)) sets.unite(index(l->a), index(l->b));
            }
        }
        return sets.find(index(a)) == sets.find(index(b));
    }

  private:
    const ReachabilityGraph& graph_;
};

/// Of the cells left and right of an upright side, or above and below a level one, the corners that they share.
struct SharedCorners {
    std::uint32_t first, last; ///< in the left or upper cell
};
constexpr SharedCorners kAcrossX{fetex::kSilmapNE, fetex::kSilmapSE}, kAcrossY{fetex::kSilmapSW, fetex::kSilmapSE};

class BoundaryFinder {
  public:
    BoundaryFinder(const std::vector<FaceRow>& rows, const ReachabilityGraph& graph)
        : rows_(rows), graph_(graph), joined_(graph) {}

    /// Of the side between (i,j) and the cell right of it or below it. Cells of one face separate nothing.
    [[nodiscard]] bool apart(std::uint32_t i, std::uint32_t j, bool right) const {
        const std::uint32_t ni = right ? i + 1 : i, nj = right ? j : j + 1;
        const Corners *p = find(rows_[j], i), *q = nj < rows_.size() ? find(rows_[nj], ni) : nullptr;
        if (p == nullptr || q == nullptr) return false;
        const SharedCorners shared = right ? kAcrossX : kAcrossY;
        if (p->faces[shared.first] == p->faces[shared.last]) return false;
        const std::uint32_t first_p = graph_.first_vertex(i, j), first_q = graph_.first_vertex(ni, nj);
        return !joined_(graph_.row_start(j) + p->vertices[shared.first], graph_.row_start(j) + p->vertices[shared.last],
                        first_p, vertices_of(i, j), first_q, vertices_of(ni, nj));
    }

  private:
    /// Vertices of a cell with edges: up to the next cell's.
    [[nodiscard]] std::uint32_t vertices_of(std::uint32_t i, std::uint32_t j) const {
        const std::uint32_t first = graph_.first_vertex(i, j);
        std::uint32_t v = first;
        while (v < graph_.row_start(j + 1) && graph_.column(v) == i)
            ++v;
        return v - first;
    }

    const std::vector<FaceRow>& rows_;
    const ReachabilityGraph& graph_;
    Joined joined_;
};

/// At the border of the canvas a cell has the texels inside twice.
void repeat_corners(SilmapCellData& c, std::uint32_t width, std::uint32_t height) {
    using namespace fetex;
    const auto repeat = [&](std::uint32_t to, std::uint32_t from) { c.faces[to] = c.faces[from]; };
    if (c.i == 0) repeat(kSilmapNW, kSilmapNE), repeat(kSilmapSW, kSilmapSE);
    if (c.i == width) repeat(kSilmapNE, kSilmapNW), repeat(kSilmapSE, kSilmapSW);
    if (c.j == 0) repeat(kSilmapNW, kSilmapSW), repeat(kSilmapNE, kSilmapSE);
    if (c.j == height) repeat(kSilmapSW, kSilmapNW), repeat(kSilmapSE, kSilmapNE);
}

/// Corners that no boundary parts are one: where a feature ends in the next cell, what it parts in this one is joined
/// there. Then nothing of the cell depends on where its point is.
void join_corners(SilmapCellData& c) {
    using namespace fetex;
    struct Side {
        std::uint32_t link, a, b;
    };
    constexpr std::array<Side, 4> sides{{{kSilmapWest, kSilmapNW, kSilmapSW},
                                         {kSilmapNorth, kSilmapNW, kSilmapNE},
                                         {kSilmapEast, kSilmapNE, kSilmapSE},
                                         {kSilmapSouth, kSilmapSW, kSilmapSE}}};
    for (const Side& s : sides) {
        if ((c.apart >> s.link & 1) != 0) continue;
        const ResultId kept = c.faces[s.a], gone = c.faces[s.b];
        c.joined = c.joined || kept != gone;
        std::ranges::replace(c.faces, gone, kept);
    }
}

} // namespace

void FaceRow::add(const TexelMap& cell) {
    region_of_face_.assign(cell.results.size(), kNone);
    region_result_.clear();
    for (std::size_t f = 0; f < cell.results.size(); ++f) {
        std::uint32_t& region = region_of_face_[cell.results[f]]; // united faces have one result: one of their numbers
        if (region == kNone) {
            region = static_cast<std::uint32_t>(region_result_.size());
            region_result_.push_back(cell.results[f]);
        }
        region_of_face_[f] = region;
    }
    Corners c;
    c.i = cell.i;
    const std::uint32_t first = reach_.add_texel(cell, region_of_face_, region_result_);
    const auto& left = cell.sweep.sides[static_cast<std::size_t>(TexelSide::Left)];
    const auto& right = cell.sweep.sides[static_cast<std::size_t>(TexelSide::Right)];
    const std::array<std::uint32_t, 4> faces{left.front().face, right.front().face, left.back().face,
                                             right.back().face};
    for (std::size_t k = 0; k < faces.size(); ++k)
        c.faces[k] = cell.results[faces[k]], c.vertices[k] = first + region_of_face_[faces[k]];
    if (region_result_.size() > 1) corners_.push_back(c); // one face is one side of everything
}

bool find_boundaries(SilmapCells& cells, const PlanarMap& map, std::vector<FaceRow>& rows, unsigned threads) {
    std::vector<ReachabilityRow> reach;
    for (FaceRow& row : rows)
        reach.push_back(std::move(row.reach()));
    const ReachabilityGraph graph(map, reach, threads);
    if (graph.conflict()) return false;
    const BoundaryFinder finder(rows, graph);
    constexpr std::size_t kChunk = 256;
    parallel_for_chunks(cells.cells.size(), kChunk, threads, [&](std::size_t first, std::size_t end) {
        for (std::size_t k = first; k < end; ++k) {
            SilmapCellData& c = cells.cells[k];
            if (const Corners* corners = find(rows[c.j], c.i)) c.faces = corners->faces;
            repeat_corners(c, cells.width, cells.height);
            const auto set = [&](std::uint32_t link, bool apart) { c.apart |= apart ? 1u << link : 0; };
            set(fetex::kSilmapEast, c.i < cells.width && finder.apart(c.i, c.j, true));
            set(fetex::kSilmapSouth, c.j < cells.height && finder.apart(c.i, c.j, false));
            set(fetex::kSilmapWest, c.i > 0 && finder.apart(c.i - 1, c.j, true));
            set(fetex::kSilmapNorth, c.j > 0 && finder.apart(c.i, c.j - 1, false));
            // Beyond the border cells repeat.
            if (c.i == 0) set(fetex::kSilmapWest, (c.apart >> fetex::kSilmapEast & 1) != 0);
            if (c.i == cells.width) set(fetex::kSilmapEast, (c.apart >> fetex::kSilmapWest & 1) != 0);
            if (c.j == 0) set(fetex::kSilmapNorth, (c.apart >> fetex::kSilmapSouth & 1) != 0);
            if (c.j == cells.height) set(fetex::kSilmapSouth, (c.apart >> fetex::kSilmapNorth & 1) != 0);
            join_corners(c);
        }
    });
    return true;
}

} // namespace fetexc
