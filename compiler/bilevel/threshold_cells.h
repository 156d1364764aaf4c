// SPDX-License-Identifier: GPL-3.0-or-later
/// How much of the canvas a texture that is cut at one half gets wrong, exactly along scan lines, and where.
///
/// Texels stand in the middles of squares of the canvas (bi-level textures), or at their corners, from border to border
/// (pinchmaps, one more along each side). A *cell* lies between four of them (of the first kind at the border: a texel
/// and the border); there the texture is bilinear, so linear along a scan line: where it crosses one half is known, and
/// so is the length on which it and the outline disagree. Each cell is scanned along rows or along columns, whichever
/// the outline in it crosses more often.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compiler/bilevel/scan_lines.h"
#include "compiler/lanes.h"
#include "formats/bilevel.h"

namespace fetexc {

/// A scan line's part in a cell. Local frame of the cell: 0…1 from centre to centre, `at` along the line, `across`
/// across it.
struct CellLine {
    float across = 0;
    bool above_first = false; ///< at the part's beginning
    std::uint32_t first = 0;  ///< in the crossings
    std::uint32_t crossings = 0;
};

struct Cell {
    std::uint32_t column = 0, row = 0; ///< between texels column − 1 and column, row − 1 and row
    bool along_rows = true;
    float low = 0, high = 1; ///< of the lines: 1/2 where the cell is half a cell
    std::uint32_t first_line = 0, lines = 0;
    std::uint32_t first_block = 0;          ///< of lines, four at a time
    std::uint32_t first_thin = 0, thin = 0; ///< lines that the outline crosses twice or more
    bool holds_outline = false;
};

/// Texels at the corners of a cell, in the order (0,0), (1,0), (0,1), (1,1); those at the border are repeated.
using CellTexels = std::array<std::uint32_t, 4>;

/// Values of a rule's channels on a line: at its 0 and its 1.
struct LineValues {
    std::array<float, 3> from{}, to{};
};

/// Where texels stand on the canvas.
enum class TexelPlaces : std::uint8_t {
    Centres, ///< texel i at i + 1/2, of a canvas as many squares wide
    Corners, ///< texel i at i, of a canvas one square less wide
};

/// Cells around a texel. Those of a cell's texels are all there.
using CellsAround = std::array<std::uint32_t, 4>;

class ThresholdCells {
  public:
    ThresholdCells(const ScannedOutline& scanned, std::uint32_t width, std::uint32_t height, fetex::BilevelRule rule)
        : ThresholdCells(scanned, width, height, rule, TexelPlaces::Centres, {}) {}
    /// width, height: texels. also: texels (1) whose values matter wherever the outline is; empty: none.
    ThresholdCells(const ScannedOutline& scanned, std::uint32_t width, std::uint32_t height, fetex::BilevelRule rule,
                   TexelPlaces places, std::span<const std::uint8_t> also);

    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }
    [[nodiscard]] fetex::BilevelRule rule() const { return rule_; }
    [[nodiscard]] std::uint32_t channels() const { return channels_; }
    /// Where texel 0 stands along each axis.
    [[nodiscard]] double first_place() const { return places_ == TexelPlaces::Centres ? 0.5 : 0; }
    /// Texels at corners of cells that hold some of the outline or touch one of `also`; ascending. No other's value
    /// matters.
    [[nodiscard]] std::span<const std::uint32_t> texels() const { return texels_; }
    /// Cells with such a texel.
    [[nodiscard]] std::span<const Cell> cells() const { return cells_; }
    [[nodiscard]] std::span<const CellLine> lines(const Cell& c) const {
        return std::span(lines_).subspan(c.first_line, c.lines);
    }
    [[nodiscard]] std::span<const float> crossings(const CellLine& l) const {
        return std::span(crossings_).subspan(l.first, l.crossings);
    }
    [[nodiscard]] CellTexels corners(const Cell& c) const;
    [[nodiscard]] double line_width() const { return 1.0 / per_texel_; }

    [[nodiscard]] CellsAround around(std::uint32_t texel) const {
        const std::size_t k = std::size_t{texel / width_} * (width_ + 1) + texel % width_;
        return {cell_at_[k], cell_at_[k + 1], cell_at_[k + width_ + 1], cell_at_[k + width_ + 2]};
    }

    /// Square texels on which the texture and the outline disagree. values: channels() bytes a texel of the texture.
    [[nodiscard]] double wrong_area(std::span<const std::uint8_t> values) const;
    [[nodiscard]] double wrong_area(std::span<const float> values) const;
    /// The same in a cell.
    [[nodiscard]] double wrong_area_in(std::span<const std::uint8_t> values, const Cell& c) const;
    [[nodiscard]] double wrong_area_in(std::span<const float> values, const Cell& c) const;

  private:
    /// Between the border of a cell and the texel before it, which has its number less 1.
    [[nodiscard]] double shift() const { return 1 - first_place(); }
    [[nodiscard]] std::uint32_t squares(std::uint32_t texels) const {
        return places_ == TexelPlaces::Centres ? texels : texels - 1;
    }
    void choose_texels(const std::vector<std::uint32_t>& across_rows, const std::vector<std::uint32_t>& across_columns,
                       std::span<const std::uint8_t> also);
    void scan(Cell& c, const ScannedOutline& scanned);
    void add_blocks(Cell& c);
    template <fetex::BilevelRule Rule, class Stored>
    [[nodiscard]] double wrong_area_of(std::span<const Stored> values, const Cell& c) const;
    template <class Stored>
    [[nodiscard]] double wrong_area_by_rule(std::span<const Stored> values, const Cell& c) const;

    std::uint32_t width_, height_, per_texel_;
    fetex::BilevelRule rule_;
    TexelPlaces places_;
    std::uint32_t channels_;
    std::vector<std::uint32_t> texels_;
    std::vector<Cell> cells_;
    std::vector<std::uint32_t> cell_at_; ///< kNone: of no such texel
    std::vector<CellLine> lines_;
    std::vector<float> crossings_;
    /// Four lines. Those that the outline crosses twice or more have no weight.
    struct Block {
        Lanes across, from, to, weight; ///< from … to: above; with Max, below
    };
    std::vector<Block> blocks_;
    std::vector<std::uint32_t> thin_; ///< in lines_
};

/// Where the texture crosses one half on a line, in order, as the rule has it.
struct TextureCrossings {
    bool above_first = false;
    std::uint32_t count = 0;
    std::array<float, 3> at{};
    std::array<std::uint8_t, 3> channel{}; ///< which of them does
};
TextureCrossings texture_crossings(fetex::BilevelRule rule, const LineValues& v, float low, float high);

} // namespace fetexc
