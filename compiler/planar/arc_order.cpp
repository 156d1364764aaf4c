// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/arc_order.h"

#include <algorithm>
#include <tuple>

#include "compiler/planar/exact_points.h"

namespace fetexc {

int ArcOrder::compare(const Arc& arc, const OnArc& p, const OnArc& q) {
    if (same_.find(p.vertex) == same_.find(q.vertex)) return 0;
    const std::optional<int> c =
        compare_along(set_, arc, set_.vertices[p.vertex], p.t, set_.vertices[q.vertex], q.t, stats_.exact_comparisons);
    if (!c && !conflict_) conflict_ = p.vertex;
    return c.value_or(0);
}

/// Into the sorted part from `cluster` on, whose enclosures overlap in a row.
void ArcOrder::place(const Arc& arc, std::size_t cluster, const OnArc& entry) {
    std::size_t lo = cluster, hi = sorted_.size();
    while (lo < hi) {
        const std::size_t mid = (lo + hi) / 2;
        const int c = compare(arc, entry, sorted_[mid]);
        if (c == 0) {
            OnArc& there = sorted_[mid];
            same_.unite(there.vertex, entry.vertex);
            const Interval t(std::max(there.t.lo, entry.t.lo), std::min(there.t.hi, entry.t.hi));
            if (t.lo <= t.hi) there.t = t;
            return;
        }
        if (c < 0)
            hi = mid;
        else
            lo = mid + 1;
    }
    sorted_.insert(sorted_.begin() + static_cast<std::ptrdiff_t>(lo), entry);
}

void ArcOrder::sort(const Arc& arc, std::vector<OnArc>& entries) {
    std::sort(entries.begin(), entries.end(), [](const OnArc& p, const OnArc& q) {
        return std::tuple(p.t.lo, p.t.hi, p.vertex) < std::tuple(q.t.lo, q.t.hi, q.vertex);
    });
    sorted_.clear();
    std::size_t cluster = 0;
    double reach = -1; // largest upper bound so far
    for (const OnArc& e : entries) {
        if (e.t.lo > reach) cluster = sorted_.size();
        reach = std::max(reach, e.t.hi);
        place(arc, cluster, e);
    }
    entries = sorted_;
    const auto is = [&](const OnArc& e, std::uint32_t v) { return same_.find(e.vertex) == same_.find(v); };
    if (!conflict_ && !is(entries.front(), arc.v0)) conflict_ = entries.front().vertex;
    if (!conflict_ && !is(entries.back(), arc.v1)) conflict_ = entries.back().vertex;
}

} // namespace fetexc
