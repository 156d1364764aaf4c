// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/row_index.h"

#include <algorithm>
#include <cmath>

#include "compiler/error_budget.h"

namespace fetexc {
namespace {

constexpr std::size_t kMaxRows = 8192;
constexpr std::size_t kMaxEntriesPerItem = 16; ///< on average: bounds the memory when items are tall

} // namespace

RowIndex::RowIndex(const std::vector<RowInterval>& items) {
    choose_rows(items);
    for (const RowInterval& item : items)
        for (std::size_t row = row_of(item.y0), last = row_of(item.y1); row <= last; ++row)
            ++first_[row + 1];
    for (std::size_t row = 1; row < first_.size(); ++row)
        first_[row] += first_[row - 1];
    items_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < items.size(); ++i)
        for (std::size_t row = row_of(items[i].y0), last = row_of(items[i].y1); row <= last; ++row)
            items_[next[row]++] = i;
}

void RowIndex::choose_rows(const std::vector<RowInterval>& items) {
    first_.assign(2, 0);
    if (items.empty()) return;
    y0_ = items.front().y0;
    double y1 = items.front().y1, sum = 0;
    for (const RowInterval& item : items)
        y0_ = std::min(y0_, item.y0), y1 = std::max(y1, item.y1), sum += item.y1 - item.y0;
    const double range = y1 - y0_;
    if (!(range > 0)) return;
    std::size_t rows = std::min(items.size(), kMaxRows);
    const auto budget = static_cast<double>(kMaxEntriesPerItem * items.size());
    while (rows > 1 && sum / range * static_cast<double>(rows) + static_cast<double>(items.size()) > budget)
        rows /= 2;
    height_ = range / static_cast<double>(rows);
    first_.assign(rows + 1, 0);
}

std::size_t RowIndex::row_of(double y) const {
    const double row = std::floor((y - y0_) / height_);
    return static_cast<std::size_t>(std::clamp(row, 0.0, static_cast<double>(rows() - 1)));
}

std::span<const std::uint32_t> RowIndex::items(std::size_t row) const {
    return {items_.data() + first_[row], first_[row + 1] - first_[row]};
}

double RowIndex::distance_to_row(double y, std::size_t row) const {
    const std::size_t own = row_of(y);
    if (row == own) return 0;
    // the border towards the point; the neighbour's border may be off by a rounding of row_of, hence one row less is
    // assumed
    const double border = y0_ + height_ * static_cast<double>(row < own ? row + 1 : row);
    return std::max(0.0, std::abs(y - border) - height_ * budget::kRowSlack);
}

} // namespace fetexc
