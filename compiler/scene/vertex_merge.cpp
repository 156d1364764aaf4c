// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/vertex_merge.h"

#include <bit>

#include "compiler/error_budget.h"

namespace fetexc {
namespace {

constexpr auto kReach = static_cast<std::int64_t>(budget::kMergeDistance);

/// Much larger than the reach, so that most points look into one cell only; leaders stay few per cell, being apart.
constexpr int kCellBits = std::countr_zero(8 * static_cast<std::uint64_t>(kReach));

LatticePoint cell_of(LatticePoint p) { return {p.x >> kCellBits, p.y >> kCellBits}; }

std::uint64_t packed(LatticePoint p) {
    return std::uint64_t{static_cast<std::uint32_t>(p.x)} << 32 | static_cast<std::uint32_t>(p.y);
}

std::int64_t squared_distance(LatticePoint a, LatticePoint b) {
    const std::int64_t dx = a.x - b.x, dy = a.y - b.y;
    return dx * dx + dy * dy;
}

} // namespace

VertexMerge::VertexMerge(std::size_t points) : numbers_(points) { vertices_.reserve(points); }

std::uint32_t VertexMerge::add(LatticePoint p) {
    const auto [number, fresh] = numbers_.try_emplace(packed(p), static_cast<std::uint32_t>(vertices_.size()));
    if (fresh) vertices_.push_back({p});
    ++vertices_[number].uses;
    return number;
}

void VertexMerge::settle(std::uint32_t point) {
    Vertex& vertex = vertices_[point];
    const LatticePoint p = vertex.at;
    const LatticePoint low = cell_of({p.x - kReach, p.y - kReach}), high = cell_of({p.x + kReach, p.y + kReach});
    vertex.leader = point;
    std::int64_t best = kReach * kReach; // strictly closer only
    for (std::int64_t cy = low.y; cy <= high.y; ++cy)
        for (std::int64_t cx = low.x; cx <= high.x; ++cx) {
            const std::uint32_t last = last_in_cell_.find(packed({cx, cy}));
            if (last == kNone) continue;
            std::uint32_t k = last;
            do {
                k = vertices_[k].next; // from the first on
                if (const std::int64_t d = squared_distance(p, vertices_[k].at); d < best) best = d, vertex.leader = k;
            } while (k != last);
        }
    if (vertex.leader == point)
        add_leader(point);
    else
        merged_ += vertex.uses;
}

void VertexMerge::add_leader(std::uint32_t point) {
    const auto [last, fresh] = last_in_cell_.try_emplace(packed(cell_of(vertices_[point].at)), point);
    vertices_[point].next = fresh ? point : vertices_[last].next;
    vertices_[last].next = point;
    last = point;
}

void VertexMerge::run() {
    last_in_cell_.reserve(vertices_.size());
    for (const bool shared : {true, false})
        for (std::uint32_t k = 0; k < vertices_.size(); ++k)
            if ((vertices_[k].uses > 1) == shared) settle(k);
}

} // namespace fetexc
