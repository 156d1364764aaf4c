// SPDX-License-Identifier: GPL-3.0-or-later
/// Connected parts of a silhouette, of above and of below, along scan lines.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/bilevel/part_rows.h"
#include "compiler/bilevel/scan_lines.h"

namespace fetexc {

/// Of the silhouette; every run knows its part.
class SilhouetteParts {
  public:
    SilhouetteParts(const ScannedOutline& scanned, std::span<const OutlineSegment> outline);

    Rows rows;
    std::uint64_t parts = 0;                                           ///< all
    std::vector<std::uint32_t> unmet;                                  ///< of those that no row meets: a segment
    [[nodiscard]] std::size_t numbers() const { return sets_.size(); } ///< above those of the runs' parts

  private:
    /// The side of a segment.
    [[nodiscard]] static std::uint32_t side(std::uint32_t segment, bool above) { return 2 * segment + (above ? 0 : 1); }
    [[nodiscard]] std::uint32_t left(std::uint32_t n) const { return 2 * segments_ + n; }
    [[nodiscard]] std::uint32_t right(std::uint32_t n) const { return 2 * segments_ + lines_ + n; }
    [[nodiscard]] bool last_above(std::uint32_t n) const {
        const auto all = scanned_.rows().crossings(n);
        return all.empty() ? scanned_.above_at_start(true, n) : all.back().enters;
    }

    void join_ends(std::span<const OutlineSegment> outline);
    void join_row(std::uint32_t n, std::vector<std::uint8_t>& met);
    void add_row(std::uint32_t n);
    void count(std::span<const OutlineSegment> outline, const std::vector<std::uint8_t>& met);

    const ScannedOutline& scanned_;
    std::uint32_t segments_, lines_;
    std::vector<std::uint32_t> open_; ///< segments with an end that no other has: at the canvas' border
    UnionFind sets_;                  ///< sides of the segments; ends of the rows, left and right
};

} // namespace fetexc
