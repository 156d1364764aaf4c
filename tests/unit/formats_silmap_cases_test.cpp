// SPDX-License-Identifier: GPL-3.0-or-later
/// Silhouette-map textures: which corners a point is filtered from, and how, against the paper's equations (Sen 2004,
/// §2.1, §3.2, Table 1), written here in the paper's frame: the cell's corners are A (north-east), B (south-east), C
/// (south-west) and D (north-west), x goes to the right and y up from C.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <string>

#include "formats/silmap.h"
#include "formats/validate.h"
#include "tests/support/random.h"

namespace fetex {
namespace {

using fetexc::test::Random;

/// In the paper's order A, B, C, D, our corners.
constexpr std::array<std::uint32_t, 4> kCorners = {kSilmapNE, kSilmapSE, kSilmapSW, kSilmapNW};
constexpr int kA = 0, kB = 1, kC = 2, kD = 3;

struct Boundaries {
    bool n = false, e = false, s = false, w = false;
    explicit Boundaries(unsigned bits) : n(bits & 1), e(bits & 2), s(bits & 4), w(bits & 8) {}
    [[nodiscard]] std::uint32_t set() const {
        return std::uint32_t{n} << kSilmapNorth | std::uint32_t{e} << kSilmapEast | std::uint32_t{s} << kSilmapSouth |
               std::uint32_t{w} << kSilmapWest;
    }
};

using Included = std::array<bool, 4>; ///< A, B, C, D

/// Rules 1 to 3 for a point in the quadrant of each corner (§2.1; §3.2 writes out that of a).
Included rules(int point, const Boundaries& b) {
    switch (point) {
    case kA:
        return {true, !b.e, (!b.n && !b.w) || (!b.e && !b.s), !b.n};
    case kB:
        return {!b.e, true, !b.s, (!b.e && !b.n) || (!b.s && !b.w)};
    case kC:
        return {(!b.s && !b.e) || (!b.w && !b.n), !b.s, true, !b.w};
    default:
        return {!b.n, (!b.w && !b.s) || (!b.n && !b.e), !b.w, true};
    }
}

Included included(std::uint32_t set) {
    Included out{};
    for (std::size_t k = 0; k < 4; ++k)
        out[k] = (set >> kCorners[k] & 1u) != 0;
    return out;
}

/// Some values at the corners: A, B, C, D.
using Values = std::array<double, 4>;

double g(const Values& v, double x, double y) {
    return (1 - y) * ((1 - x) * v[kC] + x * v[kB]) + y * ((1 - x) * v[kD] + x * v[kA]);
}

/// A row of Table 1. Of a set of three, the plane holds where `triangle` is at most 1.
struct Row {
    const char* corners;
    std::function<double(const Values&, double x, double y)> f;
    std::function<double(double x, double y)> triangle = {};
    int diagonal[2] = {};

    [[nodiscard]] Included set() const {
        Included out{};
        for (std::size_t k = 0; k < 4; ++k)
            out[k] = std::string(corners).find("ABCD"[k]) != std::string::npos;
        return out;
    }
};

const std::array<Row, 13>& table() {
    using V = Values;
    static const std::array<Row, 13> rows = {{
        {"D", [](const V& v, double, double) { return g(v, 0, 1); }},
        {"C", [](const V& v, double, double) { return g(v, 0, 0); }},
        {"CD", [](const V& v, double, double y) { return g(v, 0, y); }},
        {"B", [](const V& v, double, double) { return g(v, 1, 0); }},
        {"BC", [](const V& v, double x, double) { return g(v, x, 0); }},
        {"BCD",
         [](const V& v, double x, double y) { return g(v, x, 0) + g(v, 0, y) - g(v, 0, 0); },
         [](double x, double y) { return x + y; },
         {kB, kD}},
        {"A", [](const V& v, double, double) { return g(v, 1, 1); }},
        {"AD", [](const V& v, double x, double) { return g(v, x, 1); }},
        {"ACD",
         [](const V& v, double x, double y) { return g(v, x, 1) + g(v, 0, y) - g(v, 0, 1); },
         [](double x, double y) { return x + (1 - y); },
         {kA, kC}},
        {"AB", [](const V& v, double, double y) { return g(v, 1, y); }},
        {"ABD",
         [](const V& v, double x, double y) { return g(v, x, 1) + g(v, 1, y) - g(v, 1, 1); },
         [](double x, double y) { return (1 - x) + (1 - y); },
         {kB, kD}},
        {"ABC",
         [](const V& v, double x, double y) { return g(v, x, 0) + g(v, 1, y) - g(v, 1, 0); },
         [](double x, double y) { return (1 - x) + y; },
         {kA, kC}},
        {"ABCD", [](const V& v, double x, double y) { return g(v, x, y); }},
    }};
    return rows;
}

TEST(SilmapRules, areThoseOfThePaper) {
    for (int point = 0; point < 4; ++point)
        for (unsigned bits = 0; bits < 16; ++bits) {
            const Boundaries b(bits);
            EXPECT_EQ(included(silmap_reachable(kCorners[point], b.set())), rules(point, b)) << point << " " << bits;
        }
}

/// No corners, and two across: these three never come about.
TEST(SilmapRules, giveThirteenSetsAndNoOthers) {
    std::set<Included> found, expected;
    for (const std::uint32_t corner : kCorners)
        for (std::uint32_t boundaries = 0; boundaries < 16; ++boundaries)
            found.insert(included(silmap_reachable(corner, boundaries)));
    for (const Row& row : table())
        expected.insert(row.set());
    EXPECT_EQ(expected.size(), 13u);
    EXPECT_EQ(found, expected);
    EXPECT_EQ(found.count({false, false, false, false}), 0u);
    EXPECT_EQ(found.count({true, false, true, false}), 0u);
    EXPECT_EQ(found.count({false, true, false, true}), 0u);
}

/// Fig. 3B: one boundary, to the north. d filters between B, C and D, c between all.
TEST(SilmapRules, ofTheFigureWithOneBoundary) {
    const std::uint32_t north = 1u << kSilmapNorth;
    EXPECT_EQ(included(silmap_reachable(kSilmapNW, north)), (Included{false, true, true, true}));
    EXPECT_EQ(included(silmap_reachable(kSilmapSW, north)), (Included{true, true, true, true}));
}

/// The four equations of §2.1, as they stand there: corner C; C and D; B, C and D; all.
TEST(SilmapFilter, hasTheFourEquations) {
    const Values v = {0.9, 0.25, 0.5, 0.125};
    const auto ours = [&](std::initializer_list<int> corners, double x, double y) {
        std::uint32_t set = 0;
        for (const int k : corners)
            set |= 1u << kCorners[static_cast<std::size_t>(k)];
        const auto weights = silmap_weights(set, x, 1 - y);
        double sum = 0;
        for (std::size_t k = 0; k < 4; ++k)
            sum += weights[kCorners[k]] * v[k];
        return sum;
    };
    const double x = 0.3, y = 0.45;
    EXPECT_NEAR(ours({kC}, x, y), v[kC], 1e-15);
    EXPECT_NEAR(ours({kC, kB}, x, y), (1 - x) * v[kC] + x * v[kB], 1e-15);
    EXPECT_NEAR(ours({kB, kC, kD}, x, y), (1 - x - y) * v[kC] + x * v[kB] + y * v[kD], 1e-15);
    EXPECT_NEAR(ours({kA, kB, kC, kD}, x, y),
                (1 - y) * ((1 - x) * v[kC] + x * v[kB]) + y * ((1 - x) * v[kD] + x * v[kA]), 1e-15);
}

/// A cell, its neighbours' points and its boundaries, in the paper's frame; steps of 1/8, y up.
struct Cell {
    struct Place {
        int x = 0, y = 0;
    };
    Place own;
    std::array<Place, 4> across;  ///< N, E, S, W, each in its own cell
    std::array<bool, 4> boundary; ///< N, E, S, W
    Values values;                ///< A, B, C, D
};

Cell random_cell(Random& random, unsigned boundaries) {
    Cell cell;
    const auto place = [&] { return Cell::Place{random.integer(0, 7), random.integer(0, 7)}; };
    cell.own = place();
    for (std::size_t k = 0; k < 4; ++k)
        cell.across[k] = place(), cell.boundary[k] = (boundaries >> k & 1) != 0,
        cell.values[k] = random.integer(0, 255) / 255.0;
    return cell;
}

/// The cell in the middle of two by two texels. It is (1,1); its west and north links are those of (0,1) and (1,0).
SilmapTexture texture_of(const Cell& cell) {
    SilmapTexture t;
    t.width = t.height = 2;
    t.cells.resize(9);
    const auto put = [&](std::size_t i, std::size_t j, Cell::Place at, bool east, bool south) {
        t.cells[3 * j + i] = silmap_pack_cell(
            t.cell_format, {static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(7 - at.y), east, south});
    };
    put(1, 1, cell.own, cell.boundary[1], cell.boundary[2]);
    put(1, 0, cell.across[0], true, cell.boundary[0]);
    put(2, 1, cell.across[1], true, true);
    put(1, 2, cell.across[2], true, true);
    put(0, 1, cell.across[3], cell.boundary[3], true);
    const auto grey = [](double v) {
        const auto byte = static_cast<std::uint32_t>(std::lround(v * 255));
        return 0xff000000u | byte << 16 | byte << 8 | byte;
    };
    t.colors = {grey(cell.values[kD]), grey(cell.values[kA]), grey(cell.values[kC]), grey(cell.values[kB])};
    EXPECT_TRUE(validate_silmap(t).empty());
    return t;
}

/// One of the square's symmetries: bit 0 mirrors left and right, bit 1 top and bottom, bit 2 swaps x and y after that.
struct Symmetry {
    unsigned bits = 0;
    [[nodiscard]] Cell::Place of(Cell::Place p) const {
        if (bits & 1) p.x = 7 - p.x;
        if (bits & 2) p.y = 7 - p.y;
        return bits & 4 ? Cell::Place{p.y, p.x} : p;
    }
    [[nodiscard]] std::array<double, 2> of(double x, double y) const {
        if (bits & 1) x = 1 - x;
        if (bits & 2) y = 1 - y;
        if (bits & 4) std::swap(x, y);
        return {x, y};
    }
    /// Where a direction goes, N, E, S, W, and a corner, A, B, C, D.
    [[nodiscard]] std::size_t direction(std::size_t k) const {
        constexpr double towards[4][2] = {{0.5, 1}, {1, 0.5}, {0.5, 0}, {0, 0.5}};
        return nearest(of(towards[k][0], towards[k][1]), towards);
    }
    [[nodiscard]] std::size_t corner(std::size_t k) const {
        constexpr double towards[4][2] = {{1, 1}, {1, 0}, {0, 0}, {0, 1}};
        return nearest(of(towards[k][0], towards[k][1]), towards);
    }
    [[nodiscard]] Cell of(const Cell& cell) const {
        Cell out;
        out.own = of(cell.own);
        for (std::size_t k = 0; k < 4; ++k) {
            out.across[direction(k)] = of(cell.across[k]);
            out.boundary[direction(k)] = cell.boundary[k];
            out.values[corner(k)] = cell.values[k];
        }
        return out;
    }

  private:
    static std::size_t nearest(std::array<double, 2> p, const double (&towards)[4][2]) {
        for (std::size_t k = 0; k < 4; ++k)
            if (towards[k][0] == p[0] && towards[k][1] == p[1]) return k;
        ADD_FAILURE();
        return 0;
    }
};

class SilmapCases : public testing::TestWithParam<std::tuple<std::size_t, unsigned>> {};

/// Every cell and point that the rules filter from the row's corners, drawn as the row's image under the symmetry: the
/// row's function of the place before it was mirrored. Beyond the diagonal of three corners the paper clamps to the
/// greater of its ends, component by component; we are between both, at the nearest point of the diagonal.
TEST_P(SilmapCases, showTheRowsFunction) {
    const Row& row = table()[std::get<0>(GetParam())];
    const Symmetry symmetry{std::get<1>(GetParam())};
    Random random(1 + std::get<0>(GetParam()));
    std::size_t compared = 0, beyond = 0;
    for (int round = 0; round < 40; ++round) {
        for (unsigned bits = 0; bits < 16; ++bits) {
            const Cell cell = random_cell(random, bits);
            const SilmapTexture original = texture_of(cell), image = texture_of(symmetry.of(cell));
            for (int k = 0; k < 20; ++k) {
                const double x = random.unit(), y = random.unit();
                const SilmapRegion region = silmap_locate(original, 0.5 + x, 1.5 - y);
                const auto point = static_cast<int>(std::ranges::find(kCorners, region.corner) - kCorners.begin());
                if (rules(point, Boundaries(bits)) != row.set()) continue;
                const auto [ix, iy] = symmetry.of(x, y);
                const double shown = silmap_sample(image, 0.5 + ix, 1.5 - iy).g;
                ++compared;
                const double share = row.triangle ? row.triangle(x, y) : 0;
                if (share <= 1) {
                    ASSERT_NEAR(shown, row.f(cell.values, x, y), 1e-12) << row.corners << " at " << x << ", " << y;
                    continue;
                }
                ++beyond;
                const double a = cell.values[static_cast<std::size_t>(row.diagonal[0])],
                             b = cell.values[static_cast<std::size_t>(row.diagonal[1])];
                ASSERT_LE(shown, std::max(a, b) + 1e-12);
                ASSERT_GE(shown, std::min(a, b) - 1e-12);
                // The nearest point of the diagonal: a step of (share − 1)/2 along both axes, towards the right angle.
                const double step = (share - 1) / 2, right = row.triangle(1, 0.5) > row.triangle(0, 0.5) ? -1 : 1,
                             up = row.triangle(0.5, 1) > row.triangle(0.5, 0) ? -1 : 1;
                ASSERT_NEAR(shown, row.f(cell.values, x + right * step, y + up * step), 1e-12);
            }
        }
    }
    EXPECT_GT(compared, 50u);
    EXPECT_EQ(beyond > 0, static_cast<bool>(row.triangle));
}

std::string name_of(const testing::TestParamInfo<std::tuple<std::size_t, unsigned>>& tested) {
    constexpr const char* images[] = {"",           "MirroredX",   "MirroredY",  "Turned180",
                                      "Transposed", "TurnedRight", "TurnedLeft", "Antitransposed"};
    return table()[std::get<0>(tested.param)].corners + std::string(images[std::get<1>(tested.param)]);
}

INSTANTIATE_TEST_SUITE_P(Table1, SilmapCases,
                         testing::Combine(testing::Range<std::size_t>(0, 13), testing::Range(0u, 8u)), name_of);

/// Where both ends of the diagonal are alike and the corner of the right angle is darker, the plane exceeds them, and
/// the paper's clamp is ours.
TEST(SilmapFilter, clampsThreeCornersAsThePaperDoes) {
    const Values v = {0, 0.75, 0.25, 0.75};
    const std::uint32_t set = 1u << kSilmapSE | 1u << kSilmapSW | 1u << kSilmapNW;
    for (double x = 0; x <= 1; x += 0.0625)
        for (double y = 0; y <= 1; y += 0.0625) {
            const auto weights = silmap_weights(set, x, 1 - y);
            const double ours = weights[kSilmapSE] * v[kB] + weights[kSilmapSW] * v[kC] + weights[kSilmapNW] * v[kD];
            const double plane = (1 - x - y) * v[kC] + x * v[kB] + y * v[kD];
            EXPECT_NEAR(ours, std::min(plane, std::max(v[kB], v[kD])), 1e-15);
            EXPECT_EQ(weights[kSilmapNE], 0);
        }
}

} // namespace
} // namespace fetex
