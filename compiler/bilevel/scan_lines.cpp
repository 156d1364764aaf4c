// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/bilevel/scan_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace fetexc {

ScanLines::ScanLines(std::span<const OutlineSegment> outline, std::uint32_t across, std::uint32_t per_texel, bool level)
    : per_texel_(per_texel) {
    const std::int64_t lines = std::int64_t{across} * per_texel;
    // Half-open: a line through a point that two segments share crosses one of them.
    const auto each = [&](const auto& visit) {
        for (std::uint32_t k = 0; k < outline.size(); ++k) {
            const OutlineSegment& s = outline[k];
            const double u0 = level ? s.y0 : s.x0, u1 = level ? s.y1 : s.x1;
            const double v0 = level ? s.x0 : s.y0, v1 = level ? s.x1 : s.y1;
            const auto line_after = [&](double u) { return static_cast<std::int64_t>(std::ceil(u * per_texel - 0.5)); };
            const std::int64_t begin = std::max<std::int64_t>(line_after(std::min(u0, u1)), 0);
            const std::int64_t end = std::min(line_after(std::max(u0, u1)), lines);
            for (std::int64_t n = begin; n < end; ++n) {
                const double u = position(static_cast<std::uint32_t>(n));
                // Above is on the left: right of what runs down, below what runs left.
                visit(static_cast<std::size_t>(n),
                      Crossing{v0 + (v1 - v0) * ((u - u0) / (u1 - u0)), (v1 - v0) / (u1 - u0), (u1 > u0) == level, k});
            }
        }
    };
    first_.assign(static_cast<std::size_t>(lines) + 1, 0);
    each([&](std::size_t n, const Crossing&) { ++first_[n + 1]; });
    for (std::size_t n = 1; n < first_.size(); ++n)
        first_[n] += first_[n - 1];
    crossings_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    each([&](std::size_t n, const Crossing& c) { crossings_[next[n]++] = c; });
    std::uint32_t kept = 0;
    for (std::size_t n = 0; n + 1 < first_.size(); ++n) {
        const auto begin = crossings_.begin() + first_[n], end = crossings_.begin() + first_[n + 1];
        std::stable_sort(begin, end, [](const Crossing& x, const Crossing& y) { return x.at < y.at; });
        first_[n] = kept;
        // Two at the same point, a vertex that the line touches, leave all as it was.
        for (auto c = begin; c != end; ++c) {
            if (kept > first_[n] && crossings_[kept - 1].at == c->at && crossings_[kept - 1].enters != c->enters)
                --kept;
            else
                crossings_[kept++] = *c;
        }
    }
    first_.back() = kept;
    crossings_.resize(kept);
}

bool ScanLines::above(std::uint32_t n, double at) const {
    const std::span<const Crossing> all = crossings(n);
    const auto next =
        std::upper_bound(all.begin(), all.end(), at, [](double v, const Crossing& c) { return v < c.at; });
    return next == all.begin() ? !next->enters : std::prev(next)->enters;
}

namespace {

/// Of every line. One without crossings is as any line across it that has some is where they meet.
std::vector<std::uint8_t> starts(const ScanLines& lines, const ScanLines& others, bool otherwise) {
    std::optional<std::uint32_t> other;
    for (std::uint32_t n = 0; n < others.size() && !other; ++n) {
        if (!others.crossings(n).empty()) other = n;
    }
    std::vector<std::uint8_t> out(lines.size());
    for (std::uint32_t n = 0; n < lines.size(); ++n) {
        if (!lines.crossings(n).empty())
            out[n] = lines.crossings(n)[0].enters ? 0 : 1;
        else
            out[n] = (other ? others.above(*other, lines.position(n)) : otherwise) ? 1 : 0;
    }
    return out;
}

} // namespace

ScannedOutline::ScannedOutline(const Silhouette& silhouette, std::span<const OutlineSegment> outline,
                               std::uint32_t width, std::uint32_t height, std::uint32_t per_texel)
    : rows_(outline, height, per_texel, true), columns_(outline, width, per_texel, false),
      row_start_(starts(rows_, columns_, silhouette.above_everywhere)),
      column_start_(starts(columns_, rows_, silhouette.above_everywhere)) {}

bool ScannedOutline::above(double x, double y) const {
    const auto n = static_cast<std::uint32_t>(std::clamp(y * rows_.per_texel(), 0.0, rows_.size() - 1.0));
    return rows_.crossings(n).empty() ? row_start_[n] != 0 : rows_.above(n, x);
}

} // namespace fetexc
