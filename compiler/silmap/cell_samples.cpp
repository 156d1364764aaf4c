// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/cell_samples.h"

#include <algorithm>
#include <bit>

namespace fetexc {
namespace {

using fetex::SilmapPoint;

/// Places, in the middles of `count` parts of 0 … 1, before a coordinate.
std::uint32_t places_before(double v, std::uint32_t count) {
    return static_cast<std::uint32_t>(std::clamp(v * count + 0.5, 0.0, static_cast<double>(count)));
}

constexpr std::uint64_t first_bits(std::uint32_t n) { return (std::uint64_t{1} << n) - 1; }

/// Of a line, 0 … 16; what lies beyond is never used.
constexpr std::uint32_t kLineBits = 32;
constexpr std::array<std::uint16_t, kLineBits> kFirstBits = [] {
    std::array<std::uint16_t, kLineBits> out{};
    for (std::uint32_t n = 0; n < kLineBits; ++n)
        out[n] = static_cast<std::uint16_t>(first_bits(std::min(n, 16u)));
    return out;
}();

/// Lines of a word from one, of 0 … 4, on.
constexpr std::uint64_t lines_from(std::uint32_t first) { return first < 4 ? ~std::uint64_t{0} << 16 * first : 0; }

/// Bits of a by fours, 0 … 4.
constexpr std::uint64_t counted_by_fours(std::uint64_t a) {
    constexpr std::uint64_t pairs = 0x5555'5555'5555'5555, fours = 0x3333'3333'3333'3333;
    a -= a >> 1 & pairs;
    return (a & fours) + (a >> 2 & fours);
}

/// Bits of a more than of b, by bytes, 8 added to each.
constexpr std::uint64_t more_by_bytes(std::uint64_t a, std::uint64_t b) {
    constexpr std::uint64_t four = 0x4444'4444'4444'4444, bytes = 0x0f0f'0f0f'0f0f'0f0f;
    const std::uint64_t more = counted_by_fours(a) + four - counted_by_fours(b); // 0 … 8 each
    return (more & bytes) + (more >> 4 & bytes);
}

constexpr int sum_of_bytes(std::uint64_t bytes) {
    constexpr std::uint64_t even = 0x00ff'00ff'00ff'00ff;
    return static_cast<int>(((bytes & even) + (bytes >> 8 & even)) * 0x0001'0001'0001'0001 >> 48);
}

} // namespace

CellSamples::Sides CellSamples::nothing() {
    static constexpr Mask none{};
    return {none.data(), none.data()};
}

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
        const std::uint32_t word = j / kRows, shift = j % kRows * kColumns;
        std::uint32_t from = i0;
        const auto fill = [&](std::uint32_t to, ResultId result) {
            if (to <= from) return;
            const std::uint64_t bits = (first_bits(to) ^ first_bits(from)) << shift;
            for (std::uint32_t k = 0; k < 4; ++k)
                of_corner_[k][word] |= corners[k] == result ? bits : 0;
            from = to;
        };
        const double u = (y - slab->y0) * slab->per_height;
        ResultId result = slab->left;
        for (const TruthLine& line : truth.all.lines_of(*slab)) {
            fill(std::min(places_before(line.top + u * line.run, kColumns), i1), result);
            result = line.right;
        }
        fill(i1, result);
    }
}

double CellSamples::all_but_last() const {
    std::uint64_t bytes = 0;
    for (const std::uint64_t word : of_corner_[fetex::kSilmapSE])
        bytes += more_by_bytes(word, 0);
    return area_of_places(static_cast<int>(inside_) - (sum_of_bytes(bytes) - 64 * static_cast<int>(kMostLines / kRows)));
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
    // middles of places have them left; from the first line of a word on.
    constexpr double unit = 1 << 16, rounding = kMostLines / unit;
    const double run = (bottom.x - top.x) * kColumns / ((bottom.y - top.y) * lines_);
    const std::uint32_t first = j / kRows, last = (end - 1) / kRows;
    const auto step = static_cast<std::uint32_t>(static_cast<std::int64_t>(run * unit));
    auto x = static_cast<std::uint32_t>(
                 static_cast<std::int64_t>((top.x * kColumns + 0.5 + rounding + (j + 0.5 - top.y * lines_) * run) * unit)) -
             j % kRows * step;
    std::uint64_t bytes = 0;
    for (std::uint32_t word = first; word <= last; ++word) {
        std::uint64_t left = 0;
        for (std::uint32_t k = 0; k < kRows; ++k, x += step)
            left |= std::uint64_t{kFirstBits[(x >> 16) % kLineBits]} << k * kColumns;
        if (word == first) left &= lines_from(j % kRows);
        if (word == last) left &= ~lines_from(end - word * kRows);
        bytes += more_by_bytes(of_corner_[plus][word] & left, of_corner_[minus][word] & left);
    }
    const int added = 64 * static_cast<int>(last - first + 1);
    const int sum = sum_of_bytes(bytes) - added;
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
