// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/bilevel/part_rows.h"

#include "compiler/parallel.h"

namespace fetexc {
namespace {

/// First row of a row of cells.
std::uint32_t first_row_of(std::uint32_t cell_row, std::uint32_t height, std::uint32_t per_texel) {
    return cell_row == 0 ? 0 : std::min(cell_row * per_texel - per_texel / 2, height * per_texel);
}

class TextureRows {
  public:
    TextureRows(const TextureValues& texture, const Window& window, std::uint32_t per_texel)
        : texture_(texture), window_(window), per_texel_(per_texel) {
        out_.first = first_row_of(window.first_row, texture.height, per_texel);
        for (std::uint32_t j = window.first_row; j < window.last_row; ++j)
            add_cell_row(j);
    }
    [[nodiscard]] Rows take() { return std::move(out_); }

  private:
    /// A cell's corners, upper and lower.
    struct Corners {
        std::uint32_t i = 0;
        LineValues upper, lower;
    };

    void add_cell_row(std::uint32_t j) {
        cells_.clear();
        for (std::uint32_t i = window_.first_column; i < window_.last_column; ++i) {
            const Corners c = corners(i, j);
            if (i == window_.first_column || is_mixed(c)) cells_.push_back(c);
        }
        const std::uint32_t end = first_row_of(j + 1, texture_.height, per_texel_);
        for (std::uint32_t n = first_row_of(j, texture_.height, per_texel_); n < end; ++n)
            add_row(j, n);
    }

    [[nodiscard]] Corners corners(std::uint32_t i, std::uint32_t j) const {
        Corners out{i, {}, {}};
        const std::int64_t left = std::int64_t{i} - 1, above = std::int64_t{j} - 1;
        for (std::uint32_t c = 0; c < texture_.channels; ++c) {
            out.upper.from[c] = texture_.value(left, above, c), out.upper.to[c] = texture_.value(i, above, c);
            out.lower.from[c] = texture_.value(left, j, c), out.lower.to[c] = texture_.value(i, j, c);
        }
        return out;
    }

    [[nodiscard]] bool is_mixed(const Corners& corners) const {
        for (std::uint32_t c = 0; c < texture_.channels; ++c) {
            const bool first = corners.upper.from[c] > 0.5F;
            if ((corners.upper.to[c] > 0.5F) != first || (corners.lower.from[c] > 0.5F) != first ||
                (corners.lower.to[c] > 0.5F) != first)
                return true;
        }
        return false;
    }

    [[nodiscard]] LineValues between(const Corners& corners, float across) const {
        LineValues out;
        for (std::uint32_t c = 0; c < texture_.channels; ++c) {
            out.from[c] = corners.upper.from[c] + (corners.lower.from[c] - corners.upper.from[c]) * across;
            out.to[c] = corners.upper.to[c] + (corners.lower.to[c] - corners.upper.to[c]) * across;
        }
        return out;
    }

    void add_row(std::uint32_t j, std::uint32_t n) {
        const double origin = std::int64_t{j} - 0.5;
        const auto across = static_cast<float>((n + 0.5) / per_texel_ - origin);
        double from = std::max(window_.first_column - 0.5, 0.0);
        bool now = false;
        for (const Corners& c : cells_) {
            const float low = c.i == 0 ? 0.5F : 0, high = c.i == texture_.width ? 0.5F : 1;
            const TextureCrossings t = texture_crossings(texture_.rule, between(c, across), low, high);
            if (c.i == window_.first_column) now = t.above_first;
            for (std::uint32_t k = 0; k < t.count; ++k) {
                const double at = c.i - 0.5 + static_cast<double>(t.at[k]);
                out_.add(from, at, now);
                from = std::max(from, at), now = !now;
            }
        }
        out_.add(from, std::min(window_.last_column - 0.5, double{1} * texture_.width), now);
        out_.end_row();
    }

    const TextureValues& texture_;
    const Window& window_;
    std::uint32_t per_texel_;
    std::vector<Corners> cells_; ///< of the row that aren't all alike, and the first
    Rows out_;
};

} // namespace

Rows texture_rows(const TextureValues& t, const Window& window, std::uint32_t per_texel) {
    return TextureRows(t, window, per_texel).take();
}

Rows texture_rows(const TextureValues& t, std::uint32_t per_texel, unsigned threads) {
    std::vector<Rows> strips(t.height + 1);
    parallel_for(strips.size(), threads, [&](std::size_t j) {
        const auto row = static_cast<std::uint32_t>(j);
        strips[j] = texture_rows(t, {0, t.width + 1, row, row + 1}, per_texel);
    });
    Rows out;
    for (const Rows& s : strips) {
        for (std::size_t k = 1; k < s.begin.size(); ++k)
            out.begin.push_back(static_cast<std::uint32_t>(out.runs.size()) + s.begin[k]);
        out.runs.insert(out.runs.end(), s.runs.begin(), s.runs.end());
    }
    return out;
}

UnionFind join_rows(const Rows& rows) {
    UnionFind out(rows.runs.size());
    for (std::uint32_t n = rows.first + 1; n < rows.end(); ++n)
        each_shared(rows.row(n - 1), rows.row(n),
                    [&](const Run& a, const Run& b) { out.unite(rows.index(a), rows.index(b)); });
    return out;
}

} // namespace fetexc
