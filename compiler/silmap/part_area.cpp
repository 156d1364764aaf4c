// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/part_area.h"

#include <algorithm>
#include <vector>

#include "compiler/union_find.h"

namespace fetexc {
namespace {

/// What a slab has of the result between two lines, or a line and the box.
struct Piece {
    std::size_t slab = 0;
    double top0 = 0, top1 = 0, bottom0 = 0, bottom1 = 0, area = 0;
    bool first = false, last = false; ///< from the box's left on, up to its right
};

std::vector<Piece> pieces_of(const CellTruth& truth, ResultId result) {
    std::vector<Piece> out;
    for (std::size_t s = 0; s < truth.slabs.size(); ++s) {
        const TruthSlab& slab = truth.slabs[s];
        double top = truth.box.x0, bottom = truth.box.x0;
        ResultId is = slab.left;
        bool first = true;
        const auto end = [&](double to_top, double to_bottom, bool last) {
            if (is == result) {
                const double width = (to_top - top + to_bottom - bottom) / 2;
                out.push_back({s, top, to_top, bottom, to_bottom, (slab.y1 - slab.y0) * width, first, last});
            }
            top = to_top, bottom = to_bottom, first = false;
        };
        for (const TruthLine& line : truth.all.lines_of(slab)) {
            end(line.top, line.top + line.run, false);
            is = line.right;
        }
        end(truth.box.x1, truth.box.x1, true);
    }
    return out;
}

bool holds_one_of(const Piece& s, std::size_t slabs, std::uint32_t corners) {
    using namespace fetex;
    const auto holds = [&](std::uint32_t corner, bool there) { return there && (corners >> corner & 1) != 0; };
    const bool top = s.slab == 0, bottom = s.slab + 1 == slabs;
    return holds(kSilmapNW, top && s.first) || holds(kSilmapNE, top && s.last) || holds(kSilmapSW, bottom && s.first) ||
           holds(kSilmapSE, bottom && s.last);
}

} // namespace

double area_apart_from(const CellTruth& truth, ResultId result, std::uint32_t corners) {
    const std::vector<Piece> all = pieces_of(truth, result);
    UnionFind joined(all.size());
    for (std::uint32_t a = 0; a < all.size(); ++a) {
        for (std::uint32_t b = a + 1; b < all.size() && all[b].slab <= all[a].slab + 1; ++b) {
            const bool below = all[b].slab > all[a].slab;
            if (below && std::max(all[a].bottom0, all[b].top0) < std::min(all[a].bottom1, all[b].top1))
                joined.unite(a, b);
        }
    }
    std::vector<bool> held(all.size(), false);
    for (std::uint32_t a = 0; a < all.size(); ++a) {
        if (holds_one_of(all[a], truth.slabs.size(), corners)) held[joined.find(a)] = true;
    }
    double sum = 0;
    for (std::uint32_t a = 0; a < all.size(); ++a)
        sum += held[joined.find(a)] ? 0 : all[a].area;
    return sum;
}

} // namespace fetexc
