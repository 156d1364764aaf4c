// SPDX-License-Identifier: GPL-3.0-or-later
/// Where lines along the texels' rows and columns cross an outline.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/bilevel/silhouette.h"

namespace fetexc {

struct Crossing {
    double at = 0;             ///< along the line, texels
    double lean = 0;           ///< of the outline: change of `at` per texel across the lines
    bool enters = false;       ///< above follows it
    std::uint32_t segment = 0; ///< of the outline
};

/// Of one axis: `per_texel` lines a texel, evenly spread, line n at (n + 1/2) / per_texel texels.
class ScanLines {
  public:
    /// across: texels across the lines; level: lines along x. above_everywhere: of lines where nothing tells.
    ScanLines(std::span<const OutlineSegment> outline, std::uint32_t across, std::uint32_t per_texel, bool level);

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(first_.size()) - 1; }
    [[nodiscard]] double position(std::uint32_t n) const { return (n + 0.5) / per_texel_; }
    [[nodiscard]] std::uint32_t per_texel() const { return per_texel_; }
    /// In order along the line.
    [[nodiscard]] std::span<const Crossing> crossings(std::uint32_t n) const {
        return std::span(crossings_).subspan(first_[n], first_[n + 1] - first_[n]);
    }
    /// At a point of a line that has crossings.
    [[nodiscard]] bool above(std::uint32_t n, double at) const;

  private:
    std::uint32_t per_texel_;
    std::vector<std::uint32_t> first_;
    std::vector<Crossing> crossings_;
};

/// Both axes, and the lines that meet no edge.
class ScannedOutline {
  public:
    ScannedOutline(const Silhouette& silhouette, std::span<const OutlineSegment> outline, std::uint32_t width,
                   std::uint32_t height, std::uint32_t per_texel);
    [[nodiscard]] const ScanLines& rows() const { return rows_; }
    [[nodiscard]] const ScanLines& columns() const { return columns_; }
    /// Before the first crossing of a row (level) or column.
    [[nodiscard]] bool above_at_start(bool level, std::uint32_t n) const {
        return (level ? row_start_ : column_start_)[n] != 0;
    }
    [[nodiscard]] bool above(double x, double y) const;

  private:
    ScanLines rows_, columns_;
    std::vector<std::uint8_t> row_start_, column_start_;
};

} // namespace fetexc
