// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Cells: packing, skewed quadrants, reachable corners, weights, areas.
#include "formats/silmap.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "formats/fbt_samples.h"

namespace fetex {
namespace {

SilmapCell cell_at(const SilmapTexture& t, std::int64_t i, std::int64_t j) {
    const auto column = static_cast<std::size_t>(std::clamp<std::int64_t>(i, 0, t.width)),
               row = static_cast<std::size_t>(std::clamp<std::int64_t>(j, 0, t.height));
    return silmap_unpack_cell(t.cell_format, t.cells[row * silmap_columns(t) + column]);
}

constexpr bool in_set(std::uint32_t set, std::uint32_t member) { return (set >> member & 1u) != 0; }

/// The corner that differs in the bit.
constexpr std::uint32_t beside(std::uint32_t corner, std::uint32_t bit) { return corner ^ bit; }
constexpr std::uint32_t kEastBit = 1, kSouthBit = 2;

/// The link that parts a corner from the one beside it along x, and along y.
std::uint32_t link_along_x(std::uint32_t corner) { return corner & kSouthBit ? kSilmapSouth : kSilmapNorth; }
std::uint32_t link_along_y(std::uint32_t corner) { return corner & kEastBit ? kSilmapEast : kSilmapWest; }

/// Mean of clamp(u, 0, w) while u goes evenly from a to b.
double mean_clamped(double a, double b, double w) {
    const double low = std::min(a, b), high = std::max(a, b);
    if (!(high > low)) return std::clamp(low, 0.0, w);
    const double inside = std::clamp(-low / (high - low), 0.0, 1.0),
                 beyond = std::clamp((w - low) / (high - low), 0.0, 1.0);
    return (beyond - inside) * (std::clamp(low, 0.0, w) + std::clamp(high, 0.0, w)) / 2 + (1 - beyond) * w;
}

/// ∫ clamp(x − x0, 0, x1 − x0) dy along a line, y cut to the box, with the sign of its way down.
double area_left_of(const SilmapPoint& from, const SilmapPoint& to, const SilmapBox& box) {
    const double y_from = std::clamp(from.y, box.y0, box.y1), y_to = std::clamp(to.y, box.y0, box.y1);
    if (y_from == y_to) return 0;
    const auto x_at = [&](double y) { return std::lerp(from.x, to.x, (y - from.y) / (to.y - from.y)); };
    return (y_to - y_from) * mean_clamped(x_at(y_from) - box.x0, x_at(y_to) - box.x0, box.x1 - box.x0);
}

} // namespace

std::uint16_t silmap_pack_cell(SilmapCellFormat format, const SilmapCell& cell) {
    const unsigned bits = silmap_step_bits(format);
    return static_cast<std::uint16_t>(cell.x | cell.y << bits | std::uint32_t{cell.east} << (2 * bits) |
                                      std::uint32_t{cell.south} << (2 * bits + 1));
}

SilmapCell silmap_unpack_cell(SilmapCellFormat format, std::uint16_t packed) {
    const unsigned bits = silmap_step_bits(format);
    const std::uint32_t mask = silmap_steps(format) - 1;
    return {packed & mask, packed >> bits & mask, (packed >> (2 * bits) & 1) != 0, (packed >> (2 * bits + 1) & 1) != 0};
}

std::uint64_t silmap_gpu_bytes(const SilmapTexture& t) {
    const std::uint64_t cell_bytes = t.cell_format == SilmapCellFormat::Bits8 ? 1 : 2;
    const std::uint64_t color_bytes = t.sample_format == SilmapSampleFormat::Rgb8 ? 3 : 4;
    return cell_bytes * t.cells.size() + color_bytes * t.colors.size() + 4 * std::uint64_t{t.mips.size()};
}

SilmapShape silmap_shape(const SilmapTexture& texture, std::uint32_t i, std::uint32_t j) {
    const std::int64_t column = std::min(i, texture.width), row = std::min(j, texture.height);
    const auto at = [&](const SilmapCell& cell, double right, double down) -> SilmapPoint {
        return {silmap_position(texture.cell_format, cell.x) + right,
                silmap_position(texture.cell_format, cell.y) + down};
    };
    const SilmapCell own = cell_at(texture, column, row), west = cell_at(texture, column - 1, row),
                     north = cell_at(texture, column, row - 1), east = cell_at(texture, column + 1, row),
                     south = cell_at(texture, column, row + 1);
    SilmapShape shape;
    shape.point = at(own, 0, 0);
    shape.across = {at(west, -1, 0), at(north, 0, -1), at(east, 1, 0), at(south, 0, 1)};
    shape.boundaries = std::uint32_t{west.east} << kSilmapWest | std::uint32_t{north.south} << kSilmapNorth |
                       std::uint32_t{own.east} << kSilmapEast | std::uint32_t{own.south} << kSilmapSouth;
    return shape;
}

std::uint32_t silmap_quadrant(const SilmapShape& shape, double x, double y) {
    const double dx = x - shape.point.x, dy = y - shape.point.y;
    const bool right = dx >= 0, below = dy >= 0;
    // The line to the corner on this side tells which side of the cell lies behind the point, seen from the cell's
    // point; the link across that side tells its two corners apart (the paper, Fig. 4). The other link's ray may pass
    // on the wrong side where the angle between links exceeds 180 degrees.
    const double room_x = right ? 1 - shape.point.x : shape.point.x, room_y = below ? 1 - shape.point.y : shape.point.y;
    const bool sideways = std::abs(dx) * room_y > std::abs(dy) * room_x;
    const SilmapPoint& across =
        shape.across[sideways ? (right ? kSilmapEast : kSilmapWest) : (below ? kSilmapSouth : kSilmapNorth)];
    const double turn = dy * (across.x - shape.point.x) - dx * (across.y - shape.point.y);
    const bool east = sideways ? right : (below ? turn <= 0 : turn >= 0);
    const bool south = sideways ? (right ? turn >= 0 : turn <= 0) : below;
    return (east ? kEastBit : 0) | (south ? kSouthBit : 0);
}

std::uint32_t silmap_reachable(std::uint32_t corner, std::uint32_t boundaries) {
    const std::uint32_t next_x = beside(corner, kEastBit), next_y = beside(corner, kSouthBit),
                        opposite = beside(next_x, kSouthBit);
    const bool to_x = !in_set(boundaries, link_along_x(corner)), to_y = !in_set(boundaries, link_along_y(corner));
    const bool by_x = to_x && !in_set(boundaries, link_along_y(next_x)),
               by_y = to_y && !in_set(boundaries, link_along_x(next_y));
    return 1u << corner | std::uint32_t{to_x} << next_x | std::uint32_t{to_y} << next_y |
           std::uint32_t{by_x || by_y} << opposite;
}

std::array<double, 4> silmap_weights(std::uint32_t corners, double x, double y) {
    std::array<double, 4> weights{};
    const auto along_x = [&](std::uint32_t c) { return c & kEastBit ? x : 1 - x; };
    const auto along_y = [&](std::uint32_t c) { return c & kSouthBit ? y : 1 - y; };
    if (std::popcount(corners) == 3) {
        // From the corner of the right angle: u along x, v along y. Beyond the diagonal u + v = 1, onto it.
        const auto missing = static_cast<std::uint32_t>(std::countr_zero(~corners & 15u));
        const std::uint32_t next_x = beside(missing, kSouthBit), next_y = beside(missing, kEastBit);
        const double u = along_x(next_x), v = along_y(next_y), beyond = std::max(u + v - 1, 0.0) / 2;
        weights[next_x] = u - beyond, weights[next_y] = v - beyond;
        weights[beside(next_x, kEastBit)] = std::max(1 - u - v, 0.0);
        return weights;
    }
    for (std::uint32_t c = 0; c < 4; ++c) {
        if (!in_set(corners, c)) continue;
        weights[c] = (in_set(corners, beside(c, kEastBit)) ? along_x(c) : 1) *
                     (in_set(corners, beside(c, kSouthBit)) ? along_y(c) : 1);
    }
    return weights;
}

std::array<double, 4> silmap_areas(const SilmapShape& shape, const SilmapBox& box) {
    const SilmapPoint& p = shape.point;
    std::array<double, 4> left{}; // by link
    for (std::uint32_t link = 0; link < 4; ++link)
        left[link] = area_left_of(p, shape.across[link], box);
    // Round each quadrant: out along one link, along a border to the right of the box or beyond it, back along the
    // next. What links have beyond the cell lies beyond the box too: below or above it, left of it, where nothing
    // counts, or right of it, where the border between them gives it back.
    const double width = box.x1 - box.x0, end = std::clamp(shape.across[kSilmapEast].y, box.y0, box.y1);
    std::array<double, 4> areas{};
    areas[kSilmapNW] = left[kSilmapWest] - left[kSilmapNorth];
    areas[kSilmapNE] = left[kSilmapNorth] - left[kSilmapEast] + width * (end - box.y0);
    areas[kSilmapSE] = left[kSilmapEast] - left[kSilmapSouth] + width * (box.y1 - end);
    areas[kSilmapSW] = left[kSilmapSouth] - left[kSilmapWest];
    for (double& area : areas)
        area = std::max(area, 0.0); // rounding
    return areas;
}

} // namespace fetex
