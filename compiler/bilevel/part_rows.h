// SPDX-License-Identifier: GPL-3.0-or-later
/// Pieces of rows that a silhouette or a texture has above and below.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "compiler/bilevel/threshold_cells.h"
#include "compiler/union_find.h"

namespace fetexc {

/// A piece of a row on one side.
struct Run {
    double from = 0, to = 0; ///< texels; from < to
    std::uint32_t part = 0;
    bool above = false;
};

/// Cells first … last − 1 of each axis (ThresholdCells), and the rows in them.
struct Window {
    std::uint32_t first_column = 0, last_column = 0, first_row = 0, last_row = 0;
};

/// The values of a texture.
struct TextureValues {
    std::span<const std::uint8_t> values;
    std::uint32_t width = 0, height = 0;
    fetex::BilevelRule rule = fetex::BilevelRule::Single;
    std::uint32_t channels = fetex::bilevel_channels(rule);

    [[nodiscard]] Window everything() const { return {0, width + 1, 0, height + 1}; }
    /// A channel's value at a texel, 0 … 1; those at the border repeated.
    [[nodiscard]] float value(std::int64_t i, std::int64_t j, std::uint32_t channel) const {
        const auto x = static_cast<std::uint64_t>(std::clamp<std::int64_t>(i, 0, std::int64_t{width} - 1)),
                   y = static_cast<std::uint64_t>(std::clamp<std::int64_t>(j, 0, std::int64_t{height} - 1));
        return static_cast<float>(values[(y * width + x) * channels + channel]) * (1.0F / 255);
    }
};

/// Rows n = first … of the canvas, row n at (n + 1/2) / per_texel.
struct Rows {
    std::uint32_t first = 0;
    std::vector<std::uint32_t> begin{0};
    std::vector<Run> runs;

    [[nodiscard]] std::uint32_t end() const { return first + static_cast<std::uint32_t>(begin.size()) - 1; }
    [[nodiscard]] std::span<const Run> row(std::uint32_t n) const {
        return std::span(runs).subspan(begin[n - first], begin[n - first + 1] - begin[n - first]);
    }
    [[nodiscard]] std::uint32_t index(const Run& r) const { return static_cast<std::uint32_t>(&r - runs.data()); }
    void add(double from, double to, bool above, std::uint32_t part = 0) {
        if (from < to) runs.push_back({from, to, part, above});
    }
    void end_row() { begin.push_back(static_cast<std::uint32_t>(runs.size())); }
};

/// Where a part is.
struct PartExtent {
    std::uint32_t first_row = kNone, last_row = 0;
    double from = INFINITY, to = -INFINITY;

    void add(std::uint32_t row, const Run& r) {
        first_row = std::min(first_row, row), last_row = std::max(last_row, row);
        from = std::min(from, r.from), to = std::max(to, r.to);
    }
};

/// Calls visit(a, b) for each two runs of two rows that overlap and are on the same side.
template <class Visit> void each_shared(std::span<const Run> a, std::span<const Run> b, const Visit& visit) {
    for (std::size_t i = 0, k = 0; i < a.size() && k < b.size();) {
        if (a[i].above == b[k].above && std::max(a[i].from, b[k].from) < std::min(a[i].to, b[k].to)) visit(a[i], b[k]);
        if (a[i].to < b[k].to)
            ++i;
        else
            ++k;
    }
}

/// Of the texture, in a window; every row from the window's left to its right. Half of its first and last cells may lie
/// outside the canvas.
Rows texture_rows(const TextureValues& t, const Window& window, std::uint32_t per_texel);
/// All of it.
Rows texture_rows(const TextureValues& t, std::uint32_t per_texel, unsigned threads);

/// The parts of runs that overlap in neighbouring rows.
UnionFind join_rows(const Rows& rows);

} // namespace fetexc
