// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/cell_samples.h"

#include <algorithm>

namespace fetexc {
namespace {

using fetex::SilmapPoint;

/// Places, in the middles of `count` parts of 0 … 1, before a coordinate.
std::uint32_t places_before(double v, std::uint32_t count) {
    return static_cast<std::uint32_t>(std::clamp(v * count + 0.5, 0.0, static_cast<double>(count)));
}

/// A bit of each place of a line.
constexpr std::uint64_t kEach = 0x1111'1111'1111'1111;

/// All bits of the first 0 … 16 places of a line; what lies beyond is never used.
constexpr std::uint32_t kCounts = 32;
constexpr std::array<std::uint64_t, kCounts> kFirst = [] {
    std::array<std::uint64_t, kCounts> out{};
    for (std::uint32_t n = 0; n < kCounts; ++n)
        out[n] = n < CellSamples::kColumns ? (std::uint64_t{1} << 4 * n) - 1 : ~std::uint64_t{0};
    return out;
}();

/// Lines whose sums by column fit in four bits, and all together in eight.
constexpr std::uint32_t kLinesSummed = 8;

/// Of sums by column.
constexpr int total(std::uint64_t columns) {
    constexpr std::uint64_t bytes = 0x0f0f'0f0f'0f0f'0f0f, each = 0x0101'0101'0101'0101;
    return static_cast<int>(((columns & bytes) + (columns >> 4 & bytes)) * each >> 56);
}

} // namespace

CellSamples::CellSamples(const CellTruth& truth, const std::array<ResultId, 4>& corners, std::uint32_t lines)
    : lines_(lines) {
    const std::uint32_t i0 = places_before(truth.box.x0, kColumns), i1 = places_before(truth.box.x1, kColumns),
                        j0 = places_before(truth.box.y0, lines), j1 = places_before(truth.box.y1, lines);
    inside_ = (i1 - i0) * (j1 - j0);
    const TruthSlab *slab = truth.slabs.data(), *last = slab + truth.slabs.size() - 1;
    for (std::uint32_t j = j0; j < j1; ++j) {
        const double y = (j + 0.5) / lines;
        while (slab != last && slab->y1 <= y)
            ++slab;
        std::uint64_t places = 0;
        std::uint32_t from = i0;
        const auto fill = [&](std::uint32_t to, ResultId result) {
            if (to <= from) return;
            std::uint64_t set = 0;
            for (std::uint32_t k = 0; k < 4; ++k)
                set |= std::uint64_t{corners[k] == result} << k;
            places |= (kFirst[to] ^ kFirst[from]) & set * kEach;
            from = to;
        };
        const double u = (y - slab->y0) * slab->per_height;
        ResultId result = slab->left;
        for (const TruthLine& line : truth.all.lines_of(*slab)) {
            fill(std::min(places_before(line.top + u * line.run, kColumns), i1), result);
            result = line.right;
        }
        fill(i1, result);
        places_[j] = places;
    }
}

double CellSamples::all_but_last() const {
    int last = 0;
    for (std::uint32_t j = 0; j < lines_;) {
        std::uint64_t sums = 0;
        for (const std::uint32_t end = j + kLinesSummed; j < end; ++j)
            sums += places_[j] >> fetex::kSilmapSE & kEach;
        last += total(sums);
    }
    return area_of_places(static_cast<int>(inside_) - last);
}

/// Places left of the way from one point to another, of those with one result less those with another, with the sign
/// of its way down.
int CellSamples::count_left(const SilmapPoint& from, const SilmapPoint& to, std::uint32_t plus,
                            std::uint32_t minus) const {
    const bool down = from.y < to.y;
    const SilmapPoint &top = down ? from : to, &bottom = down ? to : from;
    const std::uint32_t end = places_before(bottom.y, lines_);
    std::uint32_t j = places_before(top.y, lines_);
    if (j >= end) return 0;
    // As places_before, in 2^-16 of a place, and by more than rounding adds up to farther on, so that ways through the
    // middles of places have them left.
    constexpr double unit = 1 << 16, rounding = kMostLines / unit;
    const double run = (bottom.x - top.x) * kColumns / ((bottom.y - top.y) * lines_);
    const auto step = static_cast<std::uint32_t>(static_cast<std::int64_t>(run * unit));
    auto x = static_cast<std::uint32_t>(
        static_cast<std::int64_t>((top.x * kColumns + 0.5 + rounding + (j + 0.5 - top.y * lines_) * run) * unit));
    int sum = 0;
    while (j < end) {
        std::uint64_t more = 0, less = 0;
        for (const std::uint32_t next = std::min(end, j + kLinesSummed); j < next; ++j, x += step) {
            const std::uint64_t left = places_[j] & kFirst[(x >> 16) % kCounts];
            more += left >> plus & kEach, less += left >> minus & kEach;
        }
        sum += total(more) - total(less);
    }
    return down ? sum : -sum;
}

double CellSamples::link_area(const SilmapPoint& point, std::uint32_t link, double exit,
                              const std::array<ResultId, 4>& corners) const {
    using namespace fetex;
    const auto between = [&](const SilmapPoint& from, const SilmapPoint& to, std::uint32_t plus, std::uint32_t minus) {
        return corners[plus] == corners[minus] ? 0 : count_left(from, to, plus, minus);
    };
    switch (link) {
    case kSilmapWest:
        return area_of_places(between({0, exit}, point, kSilmapSW, kSilmapNW));
    case kSilmapNorth:
        return area_of_places(between({exit, 0}, point, kSilmapNW, kSilmapNE));
    case kSilmapSouth:
        return area_of_places(between(point, {exit, 1}, kSilmapSW, kSilmapSE));
    default: // and what lies above it, along the whole level
        return area_of_places(between({1, exit}, point, kSilmapNE, kSilmapSE) +
                              between({1, 0}, {1, exit}, kSilmapNE, kSilmapSE));
    }
}

} // namespace fetexc
