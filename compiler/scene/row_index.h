// SPDX-License-Identifier: GPL-3.0-or-later
/// Buckets of items by y-interval: the ground truth's only acceleration.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fetexc {

struct RowInterval {
    double y0 = 0, y1 = 0; ///< closed, y0 <= y1
};

/// Each bucket lists the items whose interval meets it, in item order. Rows are equally high over the items' whole
/// range.
class RowIndex {
  public:
    explicit RowIndex(const std::vector<RowInterval>& items);

    [[nodiscard]] std::size_t rows() const { return first_.size() - 1; }
    /// Row of a y; values outside the range give the first or last row.
    [[nodiscard]] std::size_t row_of(double y) const;
    [[nodiscard]] std::span<const std::uint32_t> items(std::size_t row) const;
    /// Distance in y from a point to the nearest part of a row.
    [[nodiscard]] double distance_to_row(double y, std::size_t row) const;

  private:
    void choose_rows(const std::vector<RowInterval>& items);
    double y0_ = 0, height_ = 1; ///< of the whole range; of one row
    std::vector<std::size_t> first_;
    std::vector<std::uint32_t> items_;
};

} // namespace fetexc
