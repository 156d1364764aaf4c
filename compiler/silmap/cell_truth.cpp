// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/cell_truth.h"

#include <algorithm>
#include <functional>

#include "compiler/silmap/small_sort.h"

namespace fetexc {
void TruthBuilder::add_chord(const CellChord& c) {
    if (c.y0 < c.y1) chords_.push_back({c.x0, c.y0, c.y1, (c.x1 - c.x0) / (c.y1 - c.y0), c.left, c.right});
}

/// What isn't level, cut where it crosses the box's side inside the cell, so that every chord lies on one side of it.
void TruthBuilder::cut(const CellDrawing& drawing, const fetex::SilmapBox& box) {
    chords_.clear();
    const double side = box.x0 > 0 ? box.x0 : box.x1;
    for (CellChord c : drawing.chords) {
        if (side < 1 && (c.x0 - side) * (c.x1 - side) < 0) {
            const double y = std::clamp(c.y0 + (c.y1 - c.y0) * ((side - c.x0) / (c.x1 - c.x0)), c.y0, c.y1);
            add_chord({c.x0, c.y0, side, y, c.left, c.right});
            c.x0 = side, c.y0 = y;
        }
        add_chord(c);
    }
    small_sort(chords_, [](const Chord& a, const Chord& b) { return a.y0 < b.y0; });
}

void TruthBuilder::list_levels(const CellDrawing& drawing, const fetex::SilmapBox& box) {
    levels_.assign({box.y0, box.y1});
    const auto add = [&](double y) {
        if (box.y0 < y && y < box.y1) levels_.push_back(y);
    };
    for (const Chord& c : chords_)
        add(c.y0), add(c.y1);
    for (const CellChord& c : drawing.chords) {
        if (c.y0 == c.y1) add(c.y0);
    }
    small_sort(levels_, std::less());
    levels_.erase(std::unique(levels_.begin(), levels_.end()), levels_.end());
    upright_ = levels_.size() > kMostLevels;
    if (!upright_) return;
    levels_.resize(kMostLevels);
    for (std::size_t k = 0; k < kMostLevels; ++k)
        levels_[k] = box.y0 + (box.y1 - box.y0) * (static_cast<double>(k) / (kMostLevels - 1));
}

void TruthBuilder::add_slab(const CellDrawing& drawing, const fetex::SilmapBox& box, double y0, double y1,
                            TruthSlabs& out) {
    const double middle = (y0 + y1) / 2;
    crossings_.clear();
    for (const Chord& c : chords_) {
        if (c.y0 > middle) break;
        if (middle < c.y1) crossings_.push_back({c.at(middle), &c});
    }
    small_sort(crossings_, [](const Crossing& a, const Crossing& b) { return a.middle < b.middle; });
    TruthSlab slab{y0, y1, 1 / (y1 - y0), 0, static_cast<std::uint32_t>(out.lines.size()), 0};
    if (!crossings_.empty()) {
        slab.left = crossings_.front().chord->left;
    } else {
        const auto below = std::upper_bound(drawing.left.begin(), drawing.left.end(), middle,
                                            [](double y, const SideResult& r) { return y < r.y; });
        slab.left = below == drawing.left.begin() ? drawing.left.front().result : std::prev(below)->result;
    }
    ResultId so_far = slab.left;
    for (const Crossing& x : crossings_) {
        if (x.middle >= box.x1) break;
        if (x.middle <= box.x0) {
            slab.left = so_far = x.chord->right;
            continue;
        }
        if (x.chord->right == so_far) continue;
        so_far = x.chord->right;
        if (upright_)
            out.lines.push_back({x.middle, 0, so_far});
        else
            out.lines.push_back({x.chord->at(y0), x.chord->slope * (y1 - y0), so_far});
    }
    slab.lines = static_cast<std::uint32_t>(out.lines.size()) - slab.first;
    out.slabs.push_back(slab);
}

void TruthBuilder::add(const CellDrawing& drawing, const fetex::SilmapBox& box, TruthSlabs& out) {
    cut(drawing, box);
    list_levels(drawing, box);
    for (std::size_t k = 0; k + 1 < levels_.size(); ++k)
        add_slab(drawing, box, levels_[k], levels_[k + 1], out);
}

void TruthBuilder::add_plain(ResultId result, const fetex::SilmapBox& box, TruthSlabs& out) {
    out.slabs.push_back(
        {box.y0, box.y1, 1 / (box.y1 - box.y0), result, static_cast<std::uint32_t>(out.lines.size()), 0});
}

} // namespace fetexc
