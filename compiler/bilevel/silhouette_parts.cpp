// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/bilevel/silhouette_parts.h"

#include <algorithm>
#include <tuple>

namespace fetexc {

SilhouetteParts::SilhouetteParts(const ScannedOutline& scanned, std::span<const OutlineSegment> outline)
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

/// Segments that share an end bound the same parts.
void SilhouetteParts::join_ends(std::span<const OutlineSegment> outline) {
    std::vector<std::tuple<double, double, std::uint32_t>> ends;
    for (std::uint32_t k = 0; k < segments_; ++k) {
        ends.emplace_back(outline[k].x0, outline[k].y0, k);
        ends.emplace_back(outline[k].x1, outline[k].y1, k);
    }
    std::ranges::sort(ends);
    const auto alike = [&](std::size_t a, std::size_t b) {
        return b < ends.size() && std::get<0>(ends[a]) == std::get<0>(ends[b]) &&
               std::get<1>(ends[a]) == std::get<1>(ends[b]);
    };
    for (std::size_t k = 0; k < ends.size(); ++k) {
        const std::uint32_t segment = std::get<2>(ends[k]);
        if (alike(k, k + 1)) {
            sets_.unite(side(segment, true), side(std::get<2>(ends[k + 1]), true));
            sets_.unite(side(segment, false), side(std::get<2>(ends[k + 1]), false));
        } else if (k == 0 || !alike(k, k - 1)) {
            open_.push_back(segment);
        }
    }
}

void SilhouetteParts::join_row(std::uint32_t n, std::vector<std::uint8_t>& met) {
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

void SilhouetteParts::add_row(std::uint32_t n) {
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

void SilhouetteParts::count(std::span<const OutlineSegment> outline, const std::vector<std::uint8_t>& met) {
    std::vector<std::uint8_t> seen(sets_.size(), 0);
    for (const Run& r : rows.runs)
        parts += seen[r.part] == 0 ? 1 : 0, seen[r.part] = 1;
    std::vector<std::uint8_t> reached(sets_.size(), 0);
    for (std::uint32_t k = 0; k < segments_; ++k) {
        if (met[k] != 0) reached[sets_.find(side(k, true))] = 1;
    }
    // Pieces from border to border between two rows part nothing that the rows don't know.
    for (const std::uint32_t k : open_)
        reached[sets_.find(side(k, true))] = 1;
    for (std::uint32_t k = 0; k < outline.size(); ++k) {
        std::uint8_t& known = reached[sets_.find(side(k, true))];
        if (known == 0) ++parts, unmet.push_back(k), known = 1;
    }
}

} // namespace fetexc
