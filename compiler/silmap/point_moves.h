// SPDX-License-Identifier: GPL-3.0-or-later
/// Moves of one cell's point that lower the wrong area of the cell and its neighbours.
#pragma once

#include "compiler/silmap/cell_samples.h"
#include "compiler/silmap/silmap_cells.h"

namespace fetexc {

/// Reads and writes the cell and those next to it; of those beyond, it reads points.
class PointMoves {
  public:
    /// samples: by cell, in place of the exact areas; none: exact.
    PointMoves(SilmapCells& cells, fetex::SilmapCellFormat format, std::span<const CellSamples> samples = {})
        : cells_(cells), format_(format), steps_(fetex::silmap_steps(format)), samples_(samples) {}

    /// From place to place a stride away, where the most is won, until nothing is. Looks ahead only, where edges lie on
    /// one side of the links. Returns what was won, square cells.
    double walk(std::uint32_t cell, std::int64_t stride);
    /// Straight ahead to where edges lie evenly on both sides of the links, by strides, if that wins anything, and once
    /// more while it wins much: of each way the two places at its end are tried. Half of what walk() wins, in a tenth
    /// of the time. Cells that have little wrong area, with their neighbours, stay as they are.
    [[nodiscard]] bool is_worth_settling(std::uint32_t cell) const;
    double settle(std::uint32_t cell, std::span<const std::int64_t> strides);
    /// The best of all places whose steps are multiples of the first stride, walked from with the others.
    double search(std::uint32_t cell, std::span<const std::int64_t> strides);
    /// Of the cell and its neighbours.
    [[nodiscard]] double wrong_around(std::uint32_t cell) const;
    [[nodiscard]] std::uint64_t tried() const { return tried_; } ///< places

  private:
    struct Trial {
        std::int64_t x = -1, y = -1;
        fetex::SilmapPoint point;
        std::array<double, 4> exit{}, right{};                     ///< own, by link
        std::array<double, 4> neighbour_exit{}, neighbour_right{}; ///< of the neighbour there, its link back
        double gain = 0;
    };
    double settle_once(SilmapCellData& c, std::span<const std::int64_t> strides);
    bool try_at(const SilmapCellData& c, std::int64_t x, std::int64_t y, Trial& best);
    void evaluate(const SilmapCellData& c, double bar, Trial& t) const;
    void accept(SilmapCellData& c, const Trial& t);
    [[nodiscard]] double area(const SilmapCellData& c, const fetex::SilmapPoint& point, std::uint32_t link,
                              double exit) const;
    [[nodiscard]] const CellSamples& samples_of(const SilmapCellData& c) const {
        return samples_[static_cast<std::size_t>(&c - cells_.cells.data())];
    }
    [[nodiscard]] fetex::SilmapPoint gradient(const SilmapCellData& c, const fetex::SilmapPoint& p) const;
    [[nodiscard]] double balance_of(const SilmapCellData& c, const fetex::SilmapPoint& p, std::uint32_t link,
                                    const fetex::SilmapPoint& way) const;
    [[nodiscard]] double sampled_balance_of(const SilmapCellData& c, const fetex::SilmapPoint& p, std::uint32_t link,
                                            const fetex::SilmapPoint& way) const;
    [[nodiscard]] fetex::SilmapPoint place(std::int64_t x, std::int64_t y) const {
        return {fetex::silmap_position(format_, static_cast<std::uint32_t>(x)),
                fetex::silmap_position(format_, static_cast<std::uint32_t>(y))};
    }

    SilmapCells& cells_;
    fetex::SilmapCellFormat format_;
    std::int64_t steps_;
    std::span<const CellSamples> samples_;
    std::uint64_t tried_ = 0;
};

} // namespace fetexc
