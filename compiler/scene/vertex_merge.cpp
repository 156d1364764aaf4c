// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/vertex_merge.h"

#include <optional>

#include "compiler/error_budget.h"

namespace fetexc {
namespace {

constexpr auto kReach = static_cast<std::int64_t>(budget::kMergeDistance);

std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

LatticePoint cell_of(LatticePoint p) { return {floor_div(p.x, kReach), floor_div(p.y, kReach)}; }

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

void VertexMerge::add(LatticePoint p) {
    Vertex& vertex = vertices_[p];
    if (vertex.uses++ == 0) order_.push_back(p);
}

void VertexMerge::settle(LatticePoint p) {
    const LatticePoint cell = cell_of(p);
    std::optional<LatticePoint> nearest;
    std::int64_t best = kReach * kReach; // strictly closer only
    for (std::int64_t cy = cell.y - 1; cy <= cell.y + 1; ++cy)
        for (std::int64_t cx = cell.x - 1; cx <= cell.x + 1; ++cx) {
            const auto found = leaders_by_cell_.find({cx, cy});
            if (found == leaders_by_cell_.end()) continue;
            for (const LatticePoint& candidate : found->second)
                if (const std::int64_t d = squared_distance(p, candidate); d < best) best = d, nearest = candidate;
        }
    Vertex& vertex = vertices_.at(p);
    vertex.leader = nearest.value_or(p);
    if (nearest)
        merged_ += vertex.uses;
    else
        leaders_by_cell_[cell].push_back(p);
}

void VertexMerge::run() {
    for (const LatticePoint& p : order_)
        if (vertices_.at(p).uses > 1) settle(p);
    for (const LatticePoint& p : order_)
        if (vertices_.at(p).uses == 1) settle(p);
}

} // namespace fetexc
