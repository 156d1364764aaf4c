// SPDX-License-Identifier: GPL-3.0-or-later
/// The drawing in a cell at a grid of places: areas to 1/256 or 1/128 of a cell in a fifth of the time that exact ones
/// take, for points that are only settled.
#pragma once

#include <array>
#include <cstdint>

#include "compiler/silmap/link_area.h"

namespace fetexc {

class CellSamples {
  public:
    static constexpr std::uint32_t kColumns = 16, kMostLines = 16;

    CellSamples() = default;
    /// lines: of places, 8 or 16: a power of two.
    CellSamples(const CellTruth& truth, const std::array<ResultId, 4>& corners, std::uint32_t lines);

    /// As link_area of link_area.h, with the corners it was made with.
    [[nodiscard]] double link_area(const fetex::SilmapPoint& point, std::uint32_t link, double exit,
                                   const std::array<ResultId, 4>& corners) const;
    /// Square cells: inside the canvas, without the south-east corner's result.
    [[nodiscard]] double all_but_last() const;

    /// 1 where the place has the result of the one corner, −1 where that of the other, else 0.
    [[nodiscard]] int side(std::uint32_t column, std::uint32_t line, std::uint32_t plus, std::uint32_t minus) const {
        const std::uint64_t corners = places_[line] >> 4 * column;
        return static_cast<int>(corners >> plus & 1) - static_cast<int>(corners >> minus & 1);
    }
    [[nodiscard]] std::uint32_t lines() const { return lines_; }

  private:
    [[nodiscard]] int count_left(const fetex::SilmapPoint& from, const fetex::SilmapPoint& to, std::uint32_t plus,
                                 std::uint32_t minus) const;
    [[nodiscard]] double area_of_places(int places) const {
        return static_cast<double>(places) / static_cast<double>(kColumns * lines_);
    }

    /// By line, four bits a place: the set of corners with its result.
    std::array<std::uint64_t, kMostLines> places_{};
    std::uint32_t lines_ = kMostLines;
    std::uint32_t inside_ = 0; ///< places in the canvas
};

} // namespace fetexc
