// SPDX-License-Identifier: GPL-3.0-or-later
/// The visible edges of a cell as chords, and the points where they turn or meet. A cell is a texel of make_cell_grid;
/// its frame is local, x right, y down, 0 … 1.
#pragma once

#include <vector>

#include "compiler/planar/texel_map.h"
#include "formats/silmap.h"

namespace fetexc {

/// From top to bottom. left, right: at smaller and larger x; where it is level, below and above.
struct CellChord {
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    ResultId left = 0, right = 0;
};

/// Where edges turn (kCornerTurn) or more than two of them meet.
struct CellCorner {
    fetex::SilmapPoint at;
    std::uint32_t edges = 0;
    double turn = 0; ///< radians, of two edges; else 0
};

/// Down the left side of the cell: the result from a level on.
struct SideResult {
    double y = 0;
    ResultId result = 0;
};

struct CellDrawing {
    std::vector<CellChord> chords;    ///< edge by edge
    std::vector<CellCorner> corners;  ///< strictly inside the cell
    std::vector<SideResult> left;     ///< the first from 0
    std::vector<double> crossings[4]; ///< by link: where visible edges end on that side, x or y

    void clear();
};

/// Reads cell after cell, keeping its scratch memory.
class CellReader {
  public:
    /// chord: cells; what chords may miss edges by.
    CellReader(const PlanarMap& map, double chord) : map_(map), chord_(chord) {}
    void read(const TexelMap& cell, CellDrawing& out);
    void read(const LoneEdge& edge, CellDrawing& out);

  private:
    struct Polygon;
    struct EdgeEnd {
        std::uint32_t node = 0; ///< of the sweep
        fetex::SilmapPoint direction;
    };
    [[nodiscard]] Polygon polygon_of(const LoneEdge& edge) const;
    void add_chords(const Polygon& edge, ResultId left, ResultId right, CellDrawing& out) const;
    void add_edge(const TexelMap& cell, const Portion& p, CellDrawing& out);
    void find_corners(const TexelMap& cell, CellDrawing& out);
    /// Of a map node, in the cell's frame.
    [[nodiscard]] fetex::SilmapPoint place_of(std::uint32_t i, std::uint32_t j, std::uint32_t node) const;

    const PlanarMap& map_;
    double chord_;
    std::vector<EdgeEnd> ends_;
};

} // namespace fetexc
