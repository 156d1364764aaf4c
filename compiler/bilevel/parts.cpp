// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/bilevel/parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <tuple>

#include "compiler/bilevel/threshold_cells.h"
#include "compiler/error_budget.h"
#include "compiler/parallel.h"
#include "compiler/union_find.h"

namespace fetexc {
namespace {

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

struct Texture {
    std::span<const std::uint8_t> values;
    std::uint32_t width = 0, height = 0;
    fetex::BilevelRule rule = fetex::BilevelRule::Single;

    [[nodiscard]] Window everything() const { return {0, width + 1, 0, height + 1}; }
    /// A channel's value at a texel, 0 … 1; those at the border repeated.
    [[nodiscard]] float value(std::int64_t i, std::int64_t j, std::uint32_t channel) const {
        const auto x = static_cast<std::uint64_t>(std::clamp<std::int64_t>(i, 0, std::int64_t{width} - 1)),
                   y = static_cast<std::uint64_t>(std::clamp<std::int64_t>(j, 0, std::int64_t{height} - 1));
        return static_cast<float>(values[(y * width + x) * fetex::bilevel_channels(rule) + channel]) * (1.0F / 255);
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

/// First row of a row of cells.
std::uint32_t first_row_of(std::uint32_t cell_row, std::uint32_t height, std::uint32_t per_texel) {
    return cell_row == 0 ? 0 : std::min(cell_row * per_texel - per_texel / 2, height * per_texel);
}

/// Of the texture, in a window. Half of the window's first and last cells may lie outside the canvas.
class TextureRows {
  public:
    TextureRows(const Texture& texture, const Window& window, std::uint32_t per_texel)
        : texture_(texture), window_(window), per_texel_(per_texel) {
        out_.first = first_row_of(window.first_row, texture.height, per_texel);
        for (std::uint32_t j = window.first_row; j < window.last_row; ++j)
            add_cell_row(j);
    }
    [[nodiscard]] Rows take() { return std::move(out_); }

  private:
    void add_cell_row(std::uint32_t j) {
        cells_.clear();
        for (std::uint32_t i = window_.first_column; i < window_.last_column; ++i) {
            if (i == window_.first_column || is_mixed(i, j)) cells_.push_back(i);
        }
        const std::uint32_t end = first_row_of(j + 1, texture_.height, per_texel_);
        for (std::uint32_t n = first_row_of(j, texture_.height, per_texel_); n < end; ++n)
            add_row(j, n);
    }

    [[nodiscard]] bool is_mixed(std::uint32_t i, std::uint32_t j) const {
        for (std::uint32_t c = 0; c < fetex::bilevel_channels(texture_.rule); ++c) {
            const auto above = [&](std::uint32_t di, std::uint32_t dj) {
                return texture_.value(std::int64_t{i} - 1 + di, std::int64_t{j} - 1 + dj, c) > 0.5F;
            };
            const bool first = above(0, 0);
            if (above(1, 0) != first || above(0, 1) != first || above(1, 1) != first) return true;
        }
        return false;
    }

    void add_row(std::uint32_t j, std::uint32_t n) {
        const double origin = std::int64_t{j} - 0.5;
        const auto across = static_cast<float>((n + 0.5) / per_texel_ - origin);
        double from = std::max(window_.first_column - 0.5, 0.0);
        bool now = false;
        for (const std::uint32_t i : cells_) {
            LineValues v;
            for (std::uint32_t c = 0; c < fetex::bilevel_channels(texture_.rule); ++c) {
                const auto between = [&](std::int64_t column) {
                    const float v0 = texture_.value(column, std::int64_t{j} - 1, c), v1 = texture_.value(column, j, c);
                    return v0 + (v1 - v0) * across;
                };
                v.from[c] = between(std::int64_t{i} - 1), v.to[c] = between(i);
            }
            const float low = i == 0 ? 0.5F : 0, high = i == texture_.width ? 0.5F : 1;
            const TextureCrossings t = texture_crossings(texture_.rule, v, low, high);
            if (i == window_.first_column) now = t.above_first;
            for (std::uint32_t k = 0; k < t.count; ++k) {
                const double at = i - 0.5 + static_cast<double>(t.at[k]);
                out_.add(from, at, now);
                from = std::max(from, at), now = !now;
            }
        }
        out_.add(from, std::min(window_.last_column - 0.5, double{1} * texture_.width), now);
        out_.end_row();
    }

    const Texture& texture_;
    const Window& window_;
    std::uint32_t per_texel_;
    std::vector<std::uint32_t> cells_; ///< of the row that aren't all alike, and the first
    Rows out_;
};

Rows texture_rows(const Texture& t, std::uint32_t per_texel, unsigned threads) {
    std::vector<Rows> strips(t.height + 1);
    parallel_for(strips.size(), threads, [&](std::size_t j) {
        const auto row = static_cast<std::uint32_t>(j);
        strips[j] = TextureRows(t, {0, t.width + 1, row, row + 1}, per_texel).take();
    });
    Rows out;
    for (const Rows& s : strips) {
        for (std::size_t k = 1; k < s.begin.size(); ++k)
            out.begin.push_back(static_cast<std::uint32_t>(out.runs.size()) + s.begin[k]);
        out.runs.insert(out.runs.end(), s.runs.begin(), s.runs.end());
    }
    return out;
}

/// Of the silhouette; every run knows its part.
class SilhouetteParts {
  public:
    SilhouetteParts(const ScannedOutline& scanned, std::span<const OutlineSegment> outline)
        : scanned_(scanned), segments_(static_cast<std::uint32_t>(outline.size())), lines_(scanned.rows().size()),
          sets_(std::size_t{2} * segments_ + std::size_t{2} * lines_) {
        std::vector<std::uint8_t> met(segments_, 0);
        join_ends(outline);
        for (std::uint32_t n = 0; n < lines_; ++n)
            join_row(n, met);
        for (std::uint32_t n = 0; n < lines_; ++n)
            add_row(n);
        count(outline, met);
    }

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

    /// Segments that share an end bound the same parts.
    void join_ends(std::span<const OutlineSegment> outline) {
        std::vector<std::tuple<double, double, std::uint32_t>> ends;
        for (std::uint32_t k = 0; k < segments_; ++k) {
            ends.emplace_back(outline[k].x0, outline[k].y0, k);
            ends.emplace_back(outline[k].x1, outline[k].y1, k);
        }
        std::ranges::sort(ends);
        for (std::size_t k = 1; k < ends.size(); ++k) {
            const auto& [x, y, segment] = ends[k];
            const auto& [before_x, before_y, before] = ends[k - 1];
            if (x != before_x || y != before_y) continue;
            sets_.unite(side(segment, true), side(before, true));
            sets_.unite(side(segment, false), side(before, false));
        }
    }

    void join_row(std::uint32_t n, std::vector<std::uint8_t>& met) {
        const auto all = scanned_.rows().crossings(n);
        std::uint32_t now = left(n);
        bool above = scanned_.above_at_start(true, n);
        for (const Crossing& c : all) {
            met[c.segment] = 1;
            sets_.unite(now, side(c.segment, above));
            above = c.enters, now = side(c.segment, above);
        }
        sets_.unite(now, right(n));
        if (n == 0) return;
        if (scanned_.above_at_start(true, n) == scanned_.above_at_start(true, n - 1)) sets_.unite(left(n), left(n - 1));
        if (last_above(n) == last_above(n - 1)) sets_.unite(right(n), right(n - 1));
    }

    void add_row(std::uint32_t n) {
        double from = 0;
        const double width = scanned_.columns().size() / static_cast<double>(scanned_.columns().per_texel());
        bool above = scanned_.above_at_start(true, n);
        std::uint32_t now = left(n);
        for (const Crossing& c : scanned_.rows().crossings(n)) {
            const double at = std::clamp(c.at, from, width);
            rows.add(from, at, above, sets_.find(now));
            from = at, above = c.enters, now = side(c.segment, above);
        }
        rows.add(from, width, above, sets_.find(now));
        rows.end_row();
    }

    void count(std::span<const OutlineSegment> outline, const std::vector<std::uint8_t>& met) {
        std::vector<std::uint8_t> seen(sets_.size(), 0);
        for (const Run& r : rows.runs)
            parts += seen[r.part] == 0 ? 1 : 0, seen[r.part] = 1;
        std::vector<std::uint8_t> reached(sets_.size(), 0);
        for (std::uint32_t k = 0; k < segments_; ++k) {
            if (met[k] != 0) reached[sets_.find(side(k, true))] = 1;
        }
        for (std::uint32_t k = 0; k < outline.size(); ++k) {
            std::uint8_t& known = reached[sets_.find(side(k, true))];
            if (known == 0) ++parts, unmet.push_back(k), known = 1;
        }
    }

    const ScannedOutline& scanned_;
    std::uint32_t segments_, lines_;
    UnionFind sets_; ///< sides of the segments; ends of the rows, left and right
};

/// Parts of the texture's runs: those that overlap in neighbouring rows.
UnionFind join_rows(const Rows& rows) {
    UnionFind out(rows.runs.size());
    for (std::uint32_t n = rows.first + 1; n < rows.end(); ++n)
        each_shared(rows.row(n - 1), rows.row(n),
                    [&](const Run& a, const Run& b) { out.unite(rows.index(a), rows.index(b)); });
    return out;
}

/// Where a part is.
struct PartExtent {
    std::uint32_t first_row = kNone, last_row = 0;
    double from = INFINITY, to = -INFINITY;

    void add(std::uint32_t row, const Run& r) {
        first_row = std::min(first_row, row), last_row = std::max(last_row, row);
        from = std::min(from, r.from), to = std::max(to, r.to);
    }
};

/// Whether a part of a window's rows goes on outside the window.
bool leaves(const PartExtent& e, const Window& w, const Rows& shown, const Texture& t) {
    return (w.first_column > 0 && e.from <= w.first_column - 0.5) ||
           (w.last_column <= t.width && e.to >= w.last_column - 0.5) ||
           (shown.first > 0 && e.first_row == shown.first) || (w.last_row <= t.height && e.last_row + 1 == shown.end());
}

/// What shows in one row alone is the tip of something or an island: seen along more rows.
class Specks {
  public:
    /// per_texel: of the rows that extents are of.
    Specks(std::span<const OutlineSegment> outline, std::uint32_t height, std::uint32_t per_texel)
        : outline_(outline), per_texel_(per_texel), beside_(height) {
        for (std::uint32_t k = 0; k < outline.size(); ++k) {
            const auto row = [&](double y) {
                return static_cast<std::uint32_t>(std::clamp(std::floor(y), 0.0, height - 1.0));
            };
            const auto [low, high] = std::minmax(outline[k].y0, outline[k].y1);
            for (std::uint32_t j = row(low); j <= row(high); ++j)
                beside_[j].push_back(k);
        }
    }

    /// Of a speck of the texture that is wrong in its row.
    [[nodiscard]] bool is_island(const PartExtent& e, bool above, const Texture& t) const {
        const double x = (e.from + e.to) / 2, y = (e.first_row + 0.5) / per_texel_;
        const Window w = window_of(e.from, e.to, y, t);
        const Rows shown = TextureRows(t, w, kRows).take();
        UnionFind sets = join_rows(shown);
        const auto n = std::clamp(static_cast<std::uint32_t>(y * kRows), shown.first, shown.end() - 1);
        std::uint32_t part = kNone;
        for (const Run& r : shown.row(n)) {
            if (r.above == above && r.from <= x && x <= r.to) part = sets.find(shown.index(r));
        }
        if (part == kNone) return false;
        PartExtent all;
        for (std::uint32_t k = shown.first; k < shown.end(); ++k) {
            for (const Run& r : shown.row(k)) {
                if (sets.find(shown.index(r)) == part) all.add(k, r);
            }
        }
        return all.first_row < all.last_row && !leaves(all, w, shown, t) && !meets_outline(all);
    }

  private:
    static constexpr std::uint32_t kRows = 257; ///< a texel

    [[nodiscard]] static Window window_of(double from, double to, double y, const Texture& t) {
        const auto cell = [](double at) { return static_cast<std::uint32_t>(std::floor(at + 0.5)); };
        const auto before = [](std::uint32_t v) { return v == 0 ? 0 : v - 1; };
        return {before(cell(from)),
                std::min(cell(to), t.width) + std::min(2U, t.width + 1 - std::min(cell(to), t.width)), before(cell(y)),
                std::min(cell(y) + 2, t.height + 1)};
    }

    [[nodiscard]] bool meets_outline(const PartExtent& e) const {
        const double low = (e.first_row - 0.5) / kRows, high = (e.last_row + 1.5) / kRows;
        const auto last = std::min(static_cast<std::size_t>(high), beside_.size() - 1);
        for (std::size_t j = static_cast<std::size_t>(std::max(low, 0.0)); j <= last; ++j) {
            for (const std::uint32_t k : beside_[j]) {
                const OutlineSegment& s = outline_[k];
                if (std::max(s.x0, s.x1) >= e.from && std::min(s.x0, s.x1) <= e.to && std::max(s.y0, s.y1) >= low &&
                    std::min(s.y0, s.y1) <= high)
                    return true;
            }
        }
        return false;
    }

    std::span<const OutlineSegment> outline_;
    std::uint32_t per_texel_;
    std::vector<std::vector<std::uint32_t>> beside_; ///< segments of a row of texels
};

/// Of a texture's rows, those of a window or all: parts that are wrong everywhere, and how many of the silhouette show.
struct Shown {
    std::vector<PartExtent> invented;
    std::vector<std::uint32_t> alive; ///< parts of the silhouette, ascending
};

Shown judge(const SilhouetteParts& wanted, const Specks& specks, const Texture& t, const Window& w, const Rows& shown) {
    Shown out;
    UnionFind sets = join_rows(shown);
    std::vector<std::uint8_t> right(sets.size(), 0);
    for (std::uint32_t n = shown.first; n < shown.end(); ++n)
        each_shared(wanted.rows.row(n), shown.row(n), [&](const Run& a, const Run& b) {
            if (out.alive.empty() || out.alive.back() != a.part) out.alive.push_back(a.part);
            right[sets.find(shown.index(b))] = 1;
        });
    std::ranges::sort(out.alive);
    out.alive.erase(std::unique(out.alive.begin(), out.alive.end()), out.alive.end());
    std::vector<PartExtent> extents(sets.size());
    for (std::uint32_t n = shown.first; n < shown.end(); ++n) {
        for (const Run& r : shown.row(n)) {
            const std::uint32_t part = sets.find(shown.index(r));
            if (right[part] == 0) extents[part].add(n, r);
        }
    }
    for (std::uint32_t k = 0; k < extents.size(); ++k) {
        const PartExtent& e = extents[k];
        if (e.first_row == kNone || leaves(e, w, shown, t)) continue;
        if (e.first_row < e.last_row || specks.is_island(e, shown.runs[k].above, t)) out.invented.push_back(e);
    }
    return out;
}

/// Parts of the silhouette that don't show. alive: ascending.
std::vector<PartExtent> lost_parts(const SilhouetteParts& wanted, const std::vector<std::uint32_t>& alive) {
    std::vector<PartExtent> extents(wanted.numbers()), out;
    for (std::uint32_t n = 0; n < wanted.rows.end(); ++n) {
        for (const Run& r : wanted.rows.row(n)) {
            if (!std::ranges::binary_search(alive, r.part)) extents[r.part].add(n, r);
        }
    }
    std::ranges::copy_if(extents, std::back_inserter(out), [](const PartExtent& e) { return e.first_row != kNone; });
    return out;
}

/// Changes of single bytes that leave fewer parts lost or invented.
class Mender {
  public:
    Mender(const ThresholdCells& fine, const SilhouetteParts& wanted, const Specks& specks, std::uint32_t per_texel,
           MidGreys greys, std::vector<std::uint8_t>& values)
        : fine_(fine), wanted_(wanted), specks_(specks), per_texel_(per_texel), greys_(greys), values_(values) {}

    std::uint64_t run() {
        for (int pass = 0; pass < kPasses; ++pass) {
            const std::uint64_t before = changed_;
            const Texture t = texture();
            const Shown now = judge(wanted_, specks_, t, t.everything(), texture_rows(t, per_texel_, 1));
            for (const PartExtent& e : now.invented)
                mend(e, [](const Shown& was, const Shown& is) {
                    return is.invented.size() < was.invented.size() && is.alive.size() >= was.alive.size();
                });
            for (const PartExtent& e : lost_parts(wanted_, now.alive))
                mend(e, [](const Shown& was, const Shown& is) {
                    return is.invented.size() <= was.invented.size() && is.alive.size() > was.alive.size();
                });
            if (changed_ == before) break;
        }
        return changed_;
    }

  private:
    struct Change {
        double cost = 0; ///< square texels
        std::size_t value = 0;
        std::uint8_t to = 0;
    };
    static constexpr int kPasses = 4;            ///< a change may uncover a part
    static constexpr std::uint32_t kLargest = 4; ///< cells along a part's sides: those that are larger stay

    [[nodiscard]] Texture texture() const { return {values_, fine_.width(), fine_.height(), fine_.rule()}; }

    template <class Better> void mend(const PartExtent& e, const Better& better) {
        const auto cell = [](double at) { return static_cast<std::uint32_t>(std::floor(at + 0.5)); };
        const auto row = [&](std::uint32_t n) { return cell((n + 0.5) / per_texel_); };
        const Window at{cell(e.from), std::min(cell(e.to), fine_.width()) + 1, row(e.first_row), row(e.last_row) + 1};
        if (at.last_column - at.first_column > kLargest || at.last_row - at.first_row > kLargest) return;
        // A byte changes the cells around it, and one more says whether what shows there goes on.
        const auto before = [](std::uint32_t v) { return v < 2 ? 0 : v - 2; };
        const Window around{before(at.first_column), std::min(at.last_column + 2, fine_.width() + 1),
                            before(at.first_row), std::min(at.last_row + 2, fine_.height() + 1)};
        const Shown now = state(around);
        for (const Change& c : changes(at)) {
            if (c.cost > budget::kWorthAPart) return;
            const std::uint8_t old = values_[c.value];
            values_[c.value] = c.to;
            if (better(now, state(around))) {
                ++changed_;
                return;
            }
            values_[c.value] = old;
        }
    }

    /// Of every byte at the cells' corners, the cheapest first.
    std::vector<Change> changes(const Window& at) {
        std::vector<Change> out;
        const std::uint32_t channels = fine_.channels();
        for (std::uint32_t j = at.first_row == 0 ? 0 : at.first_row - 1; j < std::min(at.last_row, fine_.height());
             ++j) {
            for (std::uint32_t i = at.first_column == 0 ? 0 : at.first_column - 1;
                 i < std::min(at.last_column, fine_.width()); ++i) {
                const std::uint32_t texel = j * fine_.width() + i;
                if (!std::ranges::binary_search(fine_.texels(), texel)) continue;
                for (std::uint32_t c = 0; c < channels; ++c)
                    add_changes(texel, std::size_t{texel} * channels + c, out);
            }
        }
        std::ranges::stable_sort(out, {}, &Change::cost);
        return out;
    }

    void add_changes(std::uint32_t texel, std::size_t value, std::vector<Change>& out) {
        const std::uint8_t old = values_[value];
        const double now = area_around(texel);
        for (int step = 1; step < 256; step *= 2) {
            for (const int by : {step, -step}) {
                const std::uint8_t to = moved(old, by, greys_);
                if (to == old) continue;
                values_[value] = to;
                out.push_back({area_around(texel) - now, value, to});
            }
        }
        values_[value] = old;
    }

    [[nodiscard]] double area_around(std::uint32_t texel) const {
        double sum = 0;
        for (const std::uint32_t c : fine_.around(texel))
            sum += fine_.wrong_area_in(values_, fine_.cells()[c]);
        return sum;
    }

    [[nodiscard]] Shown state(const Window& w) const {
        const Texture t = texture();
        return judge(wanted_, specks_, t, w, TextureRows(t, w, per_texel_).take());
    }

    const ThresholdCells& fine_;
    const SilhouetteParts& wanted_;
    const Specks& specks_;
    std::uint32_t per_texel_;
    MidGreys greys_;
    std::vector<std::uint8_t>& values_;
    std::uint64_t changed_ = 0;
};

} // namespace

PartCounts count_parts(const Silhouette& silhouette, const fetex::BilevelTexture& texture, std::uint32_t per_texel,
                       unsigned threads) {
    const std::vector<OutlineSegment> outline = outline_in_texels(silhouette, texture.width, texture.height);
    const ScannedOutline scanned(silhouette, outline, texture.width, texture.height, per_texel);
    const SilhouetteParts wanted(scanned, outline);
    const Texture t{texture.texels, texture.width, texture.height, texture.rule};
    const Specks specks(outline, texture.height, per_texel);
    const Shown found = judge(wanted, specks, t, t.everything(), texture_rows(t, per_texel, threads));
    const std::vector<PartExtent> lost = lost_parts(wanted, found.alive);
    PartCounts out{wanted.parts, lost.size() + wanted.unmet.size(), found.invented.size()};
    if (!lost.empty()) {
        const PartExtent& e = lost[0];
        out.lost_x = (e.from + e.to) / 2, out.lost_y = (e.first_row + e.last_row + 1.0) / 2 / per_texel;
    } else if (!wanted.unmet.empty()) {
        out.lost_x = outline[wanted.unmet[0]].x0, out.lost_y = outline[wanted.unmet[0]].y0;
    }
    return out;
}

std::uint64_t mend_parts(const ThresholdCells& fine, const ScannedOutline& finest,
                         std::span<const OutlineSegment> outline, MidGreys greys, std::vector<std::uint8_t>& values) {
    const SilhouetteParts wanted(finest, outline);
    const Specks specks(outline, fine.height(), finest.rows().per_texel());
    return Mender(fine, wanted, specks, finest.rows().per_texel(), greys, values).run();
}

} // namespace fetexc
