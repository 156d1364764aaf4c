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

    /// Places of a cell with the result of one corner, and those with another's.
    struct Sides {
        const std::uint64_t *plus = nullptr, *minus = nullptr;

        /// 1, −1, or 0 with neither; place: column + kColumns · line.
        [[nodiscard]] int operator()(std::uint32_t place) const {
            const std::uint32_t word = place / kPlaces, bit = place % kPlaces;
            return static_cast<int>(plus[word] >> bit & 1) - static_cast<int>(minus[word] >> bit & 1);
        }
    };
    [[nodiscard]] Sides sides(std::uint32_t plus, std::uint32_t minus) const {
        return {of_corner_[plus].data(), of_corner_[minus].data()};
    }
    /// Nowhere anything.
    static Sides nothing();
    [[nodiscard]] std::uint32_t lines() const { return lines_; }

  private:
    static constexpr std::uint32_t kRows = 4; ///< lines in a word
    static constexpr std::uint32_t kPlaces = kRows * kColumns;
    using Mask = std::array<std::uint64_t, kMostLines / kRows>;
    [[nodiscard]] int count_left(const fetex::SilmapPoint& from, const fetex::SilmapPoint& to, std::uint32_t plus,
                                 std::uint32_t minus) const;
    [[nodiscard]] double area_of_places(int places) const {
        return static_cast<double>(places) / static_cast<double>(kColumns * lines_);
    }

    std::array<Mask, 4> of_corner_{}; ///< places with the result of that corner
    std::uint32_t lines_ = kMostLines;
    std::uint32_t inside_ = 0; ///< places in the canvas
};

} // namespace fetexc
