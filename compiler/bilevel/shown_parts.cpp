// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/bilevel/shown_parts.h"

#include <algorithm>
#include <iterator>

namespace fetexc {
namespace {

constexpr std::uint32_t kSpeckRows = 257; ///< a texel, of a closer look

/// Whether a part of a window's rows goes on outside the window.
bool leaves(const PartExtent& e, const Window& w, const Rows& shown, const TextureValues& t) {
    return (w.first_column > 0 && e.from <= w.first_column - 0.5) ||
           (w.last_column <= t.width && e.to >= w.last_column - 0.5) ||
           (shown.first > 0 && e.first_row == shown.first) || (w.last_row <= t.height && e.last_row + 1 == shown.end());
}

/// The cells of a speck and those around it.
Window cells_around(double from, double to, double y, const TextureValues& t) {
    const auto cell = [](double at) { return static_cast<std::uint32_t>(std::floor(at + 0.5)); };
    const auto before = [](std::uint32_t v) { return v == 0 ? 0 : v - 1; };
    return {before(cell(from)), std::min(cell(to), t.width) + std::min(2U, t.width + 1 - std::min(cell(to), t.width)),
            before(cell(y)), std::min(cell(y) + 2, t.height + 1)};
}

} // namespace

PartJudge::PartJudge(const ScannedOutline& scanned, std::span<const OutlineSegment> outline, std::uint32_t height)
    : per_texel_(scanned.rows().per_texel()), wanted_(scanned, outline), outline_(outline), beside_(height) {
    for (std::uint32_t k = 0; k < outline.size(); ++k) {
        const auto row = [&](double y) {
            return static_cast<std::uint32_t>(std::clamp(std::floor(y), 0.0, height - 1.0));
        };
        const auto [low, high] = std::minmax(outline[k].y0, outline[k].y1);
        for (std::uint32_t j = row(low); j <= row(high); ++j)
            beside_[j].push_back(k);
    }
}

/// Of a speck of the texture that is wrong in its row: an island, or the tip of something.
bool PartJudge::is_island(const PartExtent& e, bool above, const TextureValues& t) const {
    const double x = (e.from + e.to) / 2, y = (e.first_row + 0.5) / per_texel_;
    const Window w = cells_around(e.from, e.to, y, t);
    const Rows shown = texture_rows(t, w, kSpeckRows);
    UnionFind sets = join_rows(shown);
    const auto n = std::clamp(static_cast<std::uint32_t>(y * kSpeckRows), shown.first, shown.end() - 1);
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

bool PartJudge::meets_outline(const PartExtent& e) const {
    const double low = (e.first_row - 0.5) / kSpeckRows, high = (e.last_row + 1.5) / kSpeckRows;
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

Shown PartJudge::judge(const TextureValues& t, const Window& w, const Rows& shown) const {
    Shown out;
    UnionFind sets = join_rows(shown);
    std::vector<std::uint8_t> right(sets.size(), 0);
    for (std::uint32_t n = shown.first; n < shown.end(); ++n)
        each_shared(wanted_.rows.row(n), shown.row(n), [&](const Run& a, const Run& b) {
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
        if (e.first_row < e.last_row || is_island(e, shown.runs[k].above, t)) out.invented.push_back(e);
    }
    return out;
}

Shown PartJudge::shown(const TextureValues& t, const Window& w) const {
    return judge(t, w, texture_rows(t, w, per_texel_));
}

Shown PartJudge::shown(const TextureValues& t, unsigned threads) const {
    return judge(t, t.everything(), texture_rows(t, per_texel_, threads));
}

std::vector<PartExtent> PartJudge::lost(const Shown& shown) const {
    std::vector<PartExtent> extents(wanted_.numbers()), out;
    for (std::uint32_t n = 0; n < wanted_.rows.end(); ++n) {
        for (const Run& r : wanted_.rows.row(n)) {
            if (!std::ranges::binary_search(shown.alive, r.part)) extents[r.part].add(n, r);
        }
    }
    std::ranges::copy_if(extents, std::back_inserter(out), [](const PartExtent& e) { return e.first_row != kNone; });
    return out;
}

} // namespace fetexc
