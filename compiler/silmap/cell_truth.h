// SPDX-License-Identifier: GPL-3.0-or-later
/// The regions of a cell in level slabs, for integrals: between the levels of a slab every chord is one line, and they
/// don't cross.
#pragma once

#include <span>
#include <vector>

#include "compiler/silmap/cell_drawing.h"

namespace fetexc {

/// x at the slab's top, what it grows by to the slab's bottom, and the result from there on to the right.
struct TruthLine {
    double top = 0, run = 0;
    ResultId right = 0;
};

struct TruthSlab {
    double y0 = 0, y1 = 0, per_height = 0; ///< 1 / (y1 − y0)
    ResultId left = 0;                     ///< up to the first line
    std::uint32_t first = 0, lines = 0;
};

/// Slabs of many cells, one after the other.
struct TruthSlabs {
    std::vector<TruthSlab> slabs;
    std::vector<TruthLine> lines;

    [[nodiscard]] std::span<const TruthLine> lines_of(const TruthSlab& s) const {
        return std::span(lines).subspan(s.first, s.lines);
    }
};

/// Appends a cell's slabs, from the top of the box, the part of the cell inside the canvas, to its bottom. Exact for
/// the chords but in cells with more than kMostLevels levels: there slabs are of equal heights, and lines upright.
class TruthBuilder {
  public:
    static constexpr std::size_t kMostLevels = 64;
    void add(const CellDrawing& drawing, const fetex::SilmapBox& box, TruthSlabs& out);
    /// Of a cell without visible edges.
    static void add_plain(ResultId result, const fetex::SilmapBox& box, TruthSlabs& out);

  private:
    void cut(const CellDrawing& drawing, const fetex::SilmapBox& box);
    void list_levels(const CellDrawing& drawing, const fetex::SilmapBox& box);
    void add_slab(const CellDrawing& drawing, const fetex::SilmapBox& box, double y0, double y1, TruthSlabs& out);

    struct Chord {
        double x0 = 0, y0 = 0, y1 = 0, slope = 0; ///< slope: dx/dy
        ResultId left = 0, right = 0;
        [[nodiscard]] double at(double y) const { return x0 + slope * (y - y0); }
    };
    struct Crossing {
        double middle = 0;
        const Chord* chord = nullptr;
    };
    void add_chord(const CellChord& c);
    std::vector<Chord> chords_; ///< by y0
    std::vector<double> levels_;
    std::vector<Crossing> crossings_;
    bool upright_ = false;
};

} // namespace fetexc
