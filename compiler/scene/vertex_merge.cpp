// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/vertex_merge.h"

#include <optional>

#include "compiler/error_budget.h"

namespace fetexc {
namespace {

constexpr auto kReach = static_cast<std::int64_t>(budget::kMergeDistance);

std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

/// Much larger than the reach, so that most points look into one cell only; leaders stay few per cell, being apart.
constexpr std::int64_t kCell = 8 * kReach;

LatticePoint cell_of(LatticePoint p) { return {floor_div(p.x, kCell), floor_div(p.y, kCell)}; }

std::int64_t squared_distance(LatticePoint a, LatticePoint b) {
    const std::int64_t dx = a.x - b.x, dy = a.y - b.y;
    return dx * dx + dy * dy;
}

} // namespace

std::size_t LatticePointHash::operator()(const LatticePoint& p) const noexcept {
    // splitmix64 finaliser over both coordinates
    std::uint64_t h = static_cast<std::uint64_t>(p.x) * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(p.y);
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    return static_cast<std::size_t>(h ^ (h >> 31));
}

VertexMerge::VertexMerge(std::size_t points) {
    vertices_.reserve(points);
    leaders_in_cell_.reserve(points);
    order_.reserve(points);
    leaders_.reserve(points);
}

void VertexMerge::add(LatticePoint p) {
    const auto [it, fresh] = vertices_.try_emplace(p);
    ++it->second.uses;
    if (fresh) order_.push_back(&*it);
}

void VertexMerge::settle(LatticePoint p, Vertex& vertex) {
    const LatticePoint low = cell_of({p.x - kReach, p.y - kReach}), high = cell_of({p.x + kReach, p.y + kReach});
    std::optional<LatticePoint> nearest;
    std::int64_t best = kReach * kReach; // strictly closer only
    for (std::int64_t cy = low.y; cy <= high.y; ++cy)
        for (std::int64_t cx = low.x; cx <= high.x; ++cx) {
            const auto found = leaders_in_cell_.find({cx, cy});
            if (found == leaders_in_cell_.end()) continue;
            for (std::uint32_t k = found->second.first; k != kNone; k = leaders_[k].next) {
                const LatticePoint candidate = leaders_[k].point;
                if (const std::int64_t d = squared_distance(p, candidate); d < best) best = d, nearest = candidate;
            }
        }
    vertex.leader = nearest.value_or(p);
    if (nearest)
        merged_ += vertex.uses;
    else
        add_leader(p);
}

void VertexMerge::add_leader(LatticePoint p) {
    const auto k = static_cast<std::uint32_t>(leaders_.size());
    leaders_.push_back({p, kNone});
    const auto [it, fresh] = leaders_in_cell_.try_emplace(cell_of(p), Chain{k, k});
    if (fresh) return;
    leaders_[it->second.last].next = k;
    it->second.last = k;
}

void VertexMerge::run() {
    for (auto* entry : order_)
        if (entry->second.uses > 1) settle(entry->first, entry->second);
    for (auto* entry : order_)
        if (entry->second.uses == 1) settle(entry->first, entry->second);
}

} // namespace fetexc
