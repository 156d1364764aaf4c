// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/silmap_cells.h"

#include <algorithm>

namespace fetexc {
namespace {

using fetex::SilmapPoint;

/// Texels of a cell's columns or rows: the one before its middle, and the one behind.
std::array<std::uint32_t, 2> texels_beside(std::uint32_t cell, std::uint32_t texels) {
    return {cell > 0 ? cell - 1 : 0, std::min(cell, texels - 1)};
}

std::array<ResultId, 4> corners_of(const SilmapCells& cells, std::uint32_t i, std::uint32_t j) {
    const auto [left, right] = texels_beside(i, cells.width);
    const auto [above, below] = texels_beside(j, cells.height);
    const ResultId *top = cells.results.data() + std::size_t{above} * cells.width,
                   *bottom = cells.results.data() + std::size_t{below} * cells.width;
    return {top[left], top[right], bottom[left], bottom[right]};
}

/// Set of links between corners of different results.
std::uint32_t boundaries_between(const std::array<ResultId, 4>& r) {
    using namespace fetex;
    const auto link = [](std::uint32_t k, bool apart) { return apart ? 1u << k : 0u; };
    return link(kSilmapWest, r[kSilmapNW] != r[kSilmapSW]) | link(kSilmapNorth, r[kSilmapNW] != r[kSilmapNE]) |
           link(kSilmapEast, r[kSilmapNE] != r[kSilmapSE]) | link(kSilmapSouth, r[kSilmapSW] != r[kSilmapSE]);
}

void link(SilmapCells& cells, SilmapCellData& c) {
    using namespace fetex;
    c.shown.corners = cells.of_features ? c.faces : corners_of(cells, c.i, c.j);
    c.boundaries = cells.of_features ? c.apart : boundaries_between(c.shown.corners);
    for (std::uint32_t k = 0; k < 4; ++k) {
        c.neighbours[k] = kNone;
        if ((c.boundaries >> k & 1) == 0) continue;
        const std::int64_t i = std::int64_t{c.i} + (k == kSilmapEast) - (k == kSilmapWest),
                           j = std::int64_t{c.j} + (k == kSilmapSouth) - (k == kSilmapNorth);
        if (i < 0 || j < 0 || i > cells.width || j > cells.height) {
            c.neighbours[k] = kOwnPoint;
            continue;
        }
        const SilmapCellData* there = j == c.j ? &c + (k == kSilmapEast ? 1 : -1) // it has the boundary, too
                                               : cells.find(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
        c.neighbours[k] = static_cast<std::uint32_t>(there - cells.cells.data());
    }
}

} // namespace

const SilmapCellData* SilmapCells::find(std::uint32_t i, std::uint32_t j) const {
    const auto begin = cells.begin() + row_start[j], end = cells.begin() + row_start[j + 1];
    const auto it = std::lower_bound(begin, end, i, [](const SilmapCellData& c, std::uint32_t v) { return c.i < v; });
    return it != end && it->i == i ? &*it : nullptr;
}

ResultId SilmapCells::corner(std::uint32_t i, std::uint32_t j, std::uint32_t corner) const {
    return results[std::size_t{texels_beside(j, height)[corner >> 1]} * width + texels_beside(i, width)[corner & 1]];
}

ResultId SilmapCells::inside(std::uint32_t i, std::uint32_t j) const {
    return i == 0 ? left[j] : j == 0 ? top[i] : results[std::size_t{j - 1} * width + i - 1];
}

SilmapPoint point_across(const SilmapCells& cells, const SilmapCellData& c, const SilmapPoint& point,
                         std::uint32_t link) {
    const std::uint32_t neighbour = c.neighbours[link];
    const SilmapPoint& p = neighbour == kOwnPoint ? point : cells.cells[neighbour].shown.point;
    return {p.x + kToNeighbour[link].x, p.y + kToNeighbour[link].y};
}

std::array<double, 4> exits_of(const SilmapCells& cells, const SilmapCellData& c, const SilmapPoint& point) {
    std::array<double, 4> exit{point.y, point.x, point.y, point.x};
    for (std::uint32_t link = 0; link < 4; ++link) {
        if (c.neighbours[link] != kNone)
            exit[link] = ShownCell::exit_of(point, link, point_across(cells, c, point, link));
    }
    return exit;
}

void SilmapCells::measure(SilmapCellData& c) const {
    const CellTruth t = truth_of(c);
    c.wrong = (t.box.x1 - t.box.x0) * (t.box.y1 - t.box.y0) - area_of(t, c.shown.corners[fetex::kSilmapSE]);
    for (std::uint32_t link = 0; link < 4; ++link) {
        c.right[link] = link_area(t, c.shown.point, link, c.shown.exit[link], c.shown.corners);
        c.wrong -= c.right[link];
    }
}

void relink_cell(SilmapCells& cells, SilmapCellData& c) {
    link(cells, c);
    c.shown.exit = exits_of(cells, c, c.shown.point);
    cells.measure(c);
}

namespace {

template <class Visit> void each_cell(SilmapCells& cells, unsigned threads, const Visit& visit) {
    constexpr std::size_t chunk = 256;
    parallel_for_chunks(cells.cells.size(), chunk, threads, [&](std::size_t first, std::size_t end) {
        for (std::size_t k = first; k < end; ++k)
            visit(cells.cells[k]);
    });
}

} // namespace

void join_cells(SilmapCells& cells, unsigned threads) {
    each_cell(cells, threads, [&](SilmapCellData& c) { link(cells, c); });
}

void measure_cells(SilmapCells& cells, unsigned threads) {
    each_cell(cells, threads, [&](SilmapCellData& c) {
        c.shown.exit = exits_of(cells, c, c.shown.point);
        cells.measure(c);
    });
}

void link_cells(SilmapCells& cells, unsigned threads) {
    join_cells(cells, threads);
    measure_cells(cells, threads);
}

} // namespace fetexc
