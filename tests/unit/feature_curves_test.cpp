// SPDX-License-Identifier: GPL-3.0-or-later
/// Snapping (Parilov and Zorin 2008, §4): the table of transformations, crossings of the grid, and small networks whose
/// texture is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include "compiler/diagnostics.h"
#include "compiler/feature_curves/grid_walk.h"
#include "compiler/feature_curves/snapping.h"
#include "formats/validate.h"
#include "tests/support/random.h"

namespace fetexc {
namespace {

using fetex::FeatureConfiguration;
using fetex::FeatureEdge;
using fetex::FeatureSegment;
using test::Random;
using enum fetex::FeatureEdge;

// --- the table

/// Which edges' points curves join, directly or through each other: the crossing's segments meet.
using Joined = std::array<std::array<bool, 4>, 4>;
Joined joined_by(const std::vector<FeatureSegment>& segments) {
    Joined j{};
    const auto both = [&](std::size_t a, std::size_t b) { j[a][b] = j[b][a] = true; };
    bool north_south = false, east_west = false;
    for (const FeatureSegment s : segments) {
        both(fetex::feature_edge_index(s.first), fetex::feature_edge_index(s.second));
        north_south |= s == FeatureSegment{North, South};
        east_west |= s == FeatureSegment{East, West};
    }
    if (north_south && east_west) both(0, 1);
    for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t a = 0; a < 4; ++a)
            for (std::size_t b = 0; b < 4; ++b)
                j[a][b] = j[a][b] || (j[a][k] && j[k][b]);
    return j;
}

std::vector<FeatureSegment> segments_of(FeatureConfiguration c) {
    const fetex::FeatureSegmentList list = fetex::feature_unpack(c);
    return {list.begin(), list.end()};
}

template <class Test> void for_each_entry(const Test& test) {
    std::size_t entries = 0;
    for (const FeatureConfiguration c : fetex::feature_configurations()) {
        for (std::uint32_t k = 0; k < fetex::kFeatureSegmentCount; ++k, ++entries) {
            SCOPED_TRACE(fetex::feature_name(c) + " + " + std::to_string(k));
            test(c, k, configuration_of(kTransformations[segment_set(c)][k]));
        }
    }
    EXPECT_EQ(entries, 22u * 6);
}

TEST(Transformations, giveValidConfigurations) {
    for_each_entry([](FeatureConfiguration, std::uint32_t, FeatureConfiguration to) {
        EXPECT_TRUE(fetex::feature_valid(to));
        EXPECT_EQ(configuration_of(segment_set(to)), to);
    });
}

TEST(Transformations, addTheSegmentWhereThereIsRoom) {
    for_each_entry([](FeatureConfiguration from, std::uint32_t k, FeatureConfiguration to) {
        auto all = segments_of(from);
        all.push_back(fetex::kFeatureSegments[k]);
        const std::set<FeatureSegment> wanted(all.begin(), all.end());
        const auto got = segments_of(to);
        if (wanted.size() <= 2) {
            EXPECT_EQ(std::set<FeatureSegment>(got.begin(), got.end()), wanted);
        }
    });
}

TEST(Transformations, leaveNothingParted) {
    for_each_entry([](FeatureConfiguration from, std::uint32_t k, FeatureConfiguration to) {
        auto all = segments_of(from);
        all.push_back(fetex::kFeatureSegments[k]);
        EXPECT_EQ(joined_by(segments_of(to)), joined_by(all)); // nor join what wasn't
    });
}

TEST(Transformations, areTheSameInAMirror) {
    for_each_entry([](FeatureConfiguration from, std::uint32_t k, FeatureConfiguration to) {
        for (std::uint32_t s = 0; s < fetex::kFeatureSymmetries; ++s) {
            const FeatureSegment turned = fetex::feature_turned(s, fetex::kFeatureSegments[k]);
            const SegmentSet image = segment_set(fetex::feature_turned(s, from));
            EXPECT_EQ(configuration_of(kTransformations[image][segment_between(turned.first, turned.second)]),
                      fetex::feature_turned(s, to));
        }
    });
}

TEST(Transformations, takeASegmentTwiceAsOnce) {
    for_each_entry([](FeatureConfiguration, std::uint32_t k, FeatureConfiguration to) {
        EXPECT_EQ(configuration_of(kTransformations[segment_set(to)][k]), to);
    });
}

// --- the walk

struct Rational {
    __extension__ using Wide = __int128;
    Wide n = 0, d = 1; ///< d > 0
    friend bool operator<(const Rational& a, const Rational& b) { return a.n * b.d < b.n * a.d; }
    friend bool operator==(const Rational& a, const Rational& b) { return a.n * b.d == b.n * a.d; }
};

/// Crossings as the definition has them: every grid line between the ends' cells; in the order of their parameters, at
/// corners by the infinitely small move.
std::vector<GridCrossing> crossings_by_definition(const Grid& g, PlanarPoint a, PlanarPoint b) {
    struct Found {
        GridCrossing crossing;
        Rational t;
    };
    std::vector<Found> found;
    const auto lines = [&](bool vertical) {
        const std::int64_t from = vertical ? a.x : a.y, to = vertical ? b.x : b.y, pitch = vertical ? g.px : g.py;
        const std::uint32_t count = vertical ? g.width : g.height;
        const std::int32_t first = grid_cell(from, pitch, count), last = grid_cell(to, pitch, count);
        for (std::int32_t l = std::min(first, last) + 1; l <= std::max(first, last); ++l) {
            const std::int64_t way = to > from ? l * pitch - from : from - l * pitch;
            found.push_back({{vertical, l, 0, 0}, {way, to > from ? to - from : from - to}});
        }
    };
    lines(true), lines(false);
    const bool right = b.x > a.x;
    std::ranges::stable_sort(found, [&](const Found& p, const Found& q) {
        if (!(p.t == q.t)) return p.t < q.t;
        if (p.crossing.vertical == q.crossing.vertical) return false;
        const std::int32_t line = p.crossing.vertical ? p.crossing.line : q.crossing.line;
        return p.crossing.vertical == (right != (line == static_cast<std::int32_t>(g.width)));
    });
    std::int32_t column = grid_cell(a.x, g.px, g.width), row = grid_cell(a.y, g.py, g.height);
    std::vector<GridCrossing> out;
    for (Found& f : found) {
        GridCrossing& c = f.crossing;
        c.cell = c.vertical ? row : column;
        const double t = static_cast<double>(f.t.n) / static_cast<double>(f.t.d);
        const double at = c.vertical ? a.y + t * (b.y - a.y) : a.x + t * (b.x - a.x);
        c.position = at / (c.vertical ? g.py : g.px) - c.cell;
        if (c.vertical)
            column += right ? 1 : -1;
        else
            row += b.y > a.y ? 1 : -1;
        out.push_back(c);
    }
    return out;
}

TEST(GridWalk, findsTheCrossingsOfTheDefinition) {
    Random random(11);
    std::size_t total = 0;
    for (int n = 0; n < 40000; ++n) {
        const bool corners = n % 2 == 0; // ends on a coarse grid: through corners, along lines, on borders
        Grid g;
        g.width = 7, g.height = 5, g.px = corners ? 4 : 1000003, g.py = corners ? 4 : 999983;
        const auto coordinate = [&](std::int64_t pitch, std::uint32_t count) {
            return static_cast<std::int64_t>(
                std::floor(random.between(-2.0 * pitch, (count + 2.0) * static_cast<double>(pitch))));
        };
        const PlanarPoint a{coordinate(g.px, g.width), coordinate(g.py, g.height)},
            b{coordinate(g.px, g.width), coordinate(g.py, g.height)};
        const auto wanted = crossings_by_definition(g, a, b);
        std::size_t k = 0;
        walk_grid(g, a, b, [&](const GridCrossing& c) {
            ASSERT_LT(k, wanted.size());
            EXPECT_EQ(c.vertical, wanted[k].vertical);
            EXPECT_EQ(c.line, wanted[k].line);
            EXPECT_EQ(c.cell, wanted[k].cell);
            const auto cells = static_cast<std::int32_t>(c.vertical ? g.height : g.width);
            if (c.cell >= 0 && c.cell < cells) {
                EXPECT_GE(c.position, 0);
                EXPECT_LE(c.position, 1);
                EXPECT_NEAR(c.position, wanted[k].position, 1e-12);
            }
            ++k;
        });
        EXPECT_EQ(k, wanted.size());
        total += k;
    }
    EXPECT_GT(total, 100000u);
}

TEST(GridWalk, rowsHaveWhatTheWholeWalkHasThere) {
    Random random(12);
    std::size_t total = 0, steep = 0;
    for (int n = 0; n < 20000; ++n) {
        Grid g;
        const bool corners = n % 2 == 0;
        g.width = 7, g.height = 9, g.px = corners ? 4 : 1000003, g.py = corners ? 4 : 999983;
        const auto coordinate = [&](std::int64_t pitch, std::uint32_t count) {
            return static_cast<std::int64_t>(
                std::floor(random.between(-2.0 * pitch, (count + 2.0) * static_cast<double>(pitch))));
        };
        const PlanarPoint a{coordinate(g.px, g.width), coordinate(g.py, g.height)},
            b{coordinate(g.px, g.width), coordinate(g.py, g.height)};
        const auto first = static_cast<std::int32_t>(random.integer(0, 8)),
                   last = static_cast<std::int32_t>(random.integer(first + 1, 9));
        const GridRows rows{first, last};
        std::vector<GridCrossing> wanted, found;
        walk_grid(g, a, b, [&](const GridCrossing& c) {
            if (c.vertical ? rows.has(c.cell) : first <= c.line && c.line <= last) wanted.push_back(c);
        });
        walk_rows(g, a, b, rows, [&](const GridCrossing& c) { found.push_back(c); });
        ASSERT_EQ(found.size(), wanted.size()) << n;
        for (std::size_t k = 0; k < found.size(); ++k) {
            EXPECT_EQ(found[k].vertical, wanted[k].vertical);
            EXPECT_EQ(found[k].line, wanted[k].line);
            EXPECT_EQ(found[k].cell, wanted[k].cell);
            EXPECT_EQ(found[k].position, wanted[k].position);
            EXPECT_EQ(found[k].increasing, wanted[k].increasing);
        }
        total += found.size(), steep += found.size() > 1 && !found.front().vertical && !found.back().vertical;
    }
    EXPECT_GT(total, 40000u);
    EXPECT_GT(steep, 2000u);
}

/// Coordinates of the largest scenes: 2^28 steps times 2^14.
TEST(GridWalk, isExactAtTheLargestCoordinates) {
    Grid g;
    g.width = g.height = 16384, g.px = g.py = (std::int64_t{1} << 26) - 1;
    const std::int64_t far = (std::int64_t{1} << 41) + 12345;
    std::int64_t crossings = 0, column = -1, row = -1;
    walk_grid(g, {-far, -far - 1}, {far, far - 1}, [&](const GridCrossing& c) {
        (c.vertical ? column : row) += 1;
        EXPECT_EQ(c.line, c.vertical ? column : row);
        ++crossings;
    });
    EXPECT_EQ(crossings, 2 * 16385);
}

// --- networks

struct Drawn {
    LatticeLines lines;
    SnappedCurves curves;
};

/// Runs of points on a canvas of width × height texels.
Drawn snap_runs(const std::vector<std::vector<CanvasPoint>>& runs, std::uint32_t width, std::uint32_t height) {
    Network network{static_cast<double>(width), static_cast<double>(height), {}};
    for (const auto& run : runs) {
        NetworkCurve curve;
        for (std::size_t k = 1; k < run.size(); ++k)
            curve.segments.push_back({1, {run[k - 1], run[k]}});
        network.curves.push_back(std::move(curve));
    }
    Drawn d{lattice_lines(network, width, height).value(), {}};
    d.curves = snap_lines(d.lines, width, height);
    return d;
}

std::string name(const SnappedCurves& c, std::uint32_t i, std::uint32_t j) {
    return fetex::feature_name(configuration_of(c.texels[std::size_t{j} * c.width + i].segments));
}

TEST(Snapping, whatIsValidStaysWhereItIs) {
    const SnappedCurves c = snap_runs({{{0, 1.25}, {4, 2.25}}, {{1.5, 0}, {1.75, 4}}}, 4, 4).curves;
    EXPECT_TRUE(c.moves.empty());
    EXPECT_EQ(name(c, 0, 1), "E-W");
    EXPECT_EQ(name(c, 1, 1), "N-S E-W");
    EXPECT_EQ(c.position(0, 1, West), 0.25);
    EXPECT_EQ(c.position(1, 1, West), 0.5);
    EXPECT_EQ(c.position(1, 1, North), 0.5625);
    EXPECT_EQ(c.position(1, 3, South), 0.75);
}

TEST(Snapping, pointsOfAnEdgeBecomeTheirCentreOfMass) {
    const SnappedCurves c =
        snap_runs({{{0, 0.25}, {2, 0.25}}, {{0, 0.5}, {2, 0.5}}, {{0, 0.9375}, {2, 0.9375}}}, 2, 1).curves;
    EXPECT_EQ(c.position(0, 0, East), 0.5625);
    EXPECT_EQ(name(c, 0, 0), "E-W"); // and equal segments are one
    ASSERT_EQ(c.moves.size(), 2u);
    EXPECT_EQ(c.moves[0].kinds, kEdgeMerged);
    EXPECT_EQ(c.moves[0].distance, 0.375);
}

TEST(Snapping, endsInsideATexelAreCutAndTold) {
    const SnappedCurves c = snap_runs({{{0, 0.5}, {1.75, 0.5}}}, 2, 1).curves;
    EXPECT_EQ(name(c, 0, 0), "E-W");
    EXPECT_EQ(name(c, 1, 0), "empty");
    EXPECT_EQ(c.stats.ends_cut, 1u);
    ASSERT_EQ(c.moves.size(), 1u);
    EXPECT_EQ(c.moves[0].i, 1u);
    EXPECT_EQ(c.moves[0].kinds, kEndCut);
    EXPECT_EQ(c.moves[0].distance, 0.75);
    const auto said = snap_diagnostics(c);
    ASSERT_EQ(said.size(), 2u);
    EXPECT_EQ(said[0].code, diag::kFeatureMoved);
    EXPECT_EQ(said[0].place, "texel (1, 0)");
    EXPECT_EQ(said[1].code, diag::kFeatureEndsCut);
}

TEST(Snapping, cornersInsideATexelAreCutOff) {
    const SnappedCurves c = snap_runs({{{0, 0.5}, {0.75, 0.5}, {0.75, 1}}}, 1, 1).curves;
    EXPECT_EQ(name(c, 0, 0), "S-W");
    ASSERT_EQ(c.moves.size(), 1u);
    EXPECT_EQ(c.moves[0].kinds, kVertexCut);
    EXPECT_NEAR(c.moves[0].distance, 0.375 / std::hypot(0.75, 0.5), 1e-15); // (0.75, 0.5) from the chord
}

TEST(Snapping, cornersOnEdgesStay) {
    // V's that touch an edge from each side, and one that ends on it.
    const SnappedCurves c = snap_runs({{{1.5, 1}, {1, 1.25}, {1.5, 2}},
                                       {{2.5, 1}, {3, 1.75}, {2.5, 2}},
                                       {{1, 0.5}, {2, 0.75}},
                                       {{0.5, 2}, {0.25, 3}, {0.75, 2}}},
                                      4, 3)
                                .curves;
    EXPECT_EQ(name(c, 1, 1), "N-W S-W");
    EXPECT_EQ(c.position(1, 1, West), 0.25);
    EXPECT_EQ(name(c, 2, 1), "N-E E-S");
    EXPECT_EQ(name(c, 1, 0), "E-W");
    EXPECT_EQ(name(c, 0, 2), "N-S"); // both ways through the north edge: one point
    ASSERT_EQ(c.moves.size(), 1u);
    EXPECT_EQ(c.moves[0].j, 2u);
}

TEST(Snapping, linesAlongTheGridAndThroughItsCornersAreExact) {
    for (const auto& run : std::vector<std::vector<CanvasPoint>>{{{0, 0}, {4, 4}},
                                                                 {{4, 0}, {0, 4}},
                                                                 {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}}, // the border
                                                                 {{1, 1}, {3, 1}, {3, 3}, {1, 3}, {1, 1}},
                                                                 {{0, 2}, {2, 0}, {4, 2}, {2, 4}, {0, 2}},
                                                                 {{0, 1}, {4, 3}},
                                                                 {{2, 0}, {2, 4}}}) {
        const SnappedCurves c = snap_runs({run}, 4, 4).curves;
        EXPECT_TRUE(c.moves.empty()) << run[1].x << " " << run[1].y;
        EXPECT_EQ(c.stats.ends_cut + c.stats.folded + c.stats.lost_inside, 0u);
        EXPECT_GT(c.stats.segments, 3u);
    }
}

TEST(Snapping, fourWaysMeetInTheTexelThreeOnAnEdge) {
    const SnappedCurves four =
        snap_runs({{{0, 1.5}, {1.5, 1.5}}, {{3, 1.5}, {1.5, 1.5}}, {{1.5, 0}, {1.5, 1.5}}, {{1.5, 3}, {1.5, 1.5}}}, 3,
                  3)
            .curves;
    EXPECT_EQ(name(four, 1, 1), "N-S E-W");
    EXPECT_TRUE(four.moves.empty() || four.moves[0].distance < 1e-15);
    const SnappedCurves three =
        snap_runs({{{0, 1.5}, {1.25, 1.5}}, {{3, 1.5}, {1.25, 1.5}}, {{1.25, 0}, {1.25, 1.5}}}, 3, 3).curves;
    EXPECT_EQ(name(three, 1, 1), "N-W E-W"); // west is nearest
    ASSERT_EQ(three.moves.size(), 1u);
    EXPECT_NEAR(three.moves[0].distance, 0.25, 1e-6); // a third of the canvas isn't on the lattice
    EXPECT_EQ(three.stats.junctions, 1u);
}

TEST(Snapping, curvesInsideATexelAreToldAsLost) {
    const SnappedCurves c =
        snap_runs({{{0.25, 0.25}, {0.5, 0.75}, {0.75, 0.25}, {0.25, 0.25}}, {{1.5, 0.5}, {2.5, 0.5}}}, 3, 1).curves;
    EXPECT_EQ(c.stats.lost_inside, 1u);
    EXPECT_EQ(c.stats.ends_cut, 2u);
    ASSERT_EQ(c.moves.size(), 3u);
    EXPECT_EQ(c.moves[0].kinds, kLostInside);
    EXPECT_EQ(c.moves[1].kinds, kEndCut | kLostInside); // both of its texels see one end: nothing is left of it
    EXPECT_EQ(c.position(1, 0, East), 0.5);
    EXPECT_EQ(snap_diagnostics(c).back().code, diag::kFeatureLost);
}

TEST(Snapping, texturesAreValidInEveryFormat) {
    const SnappedCurves c = snap_runs({{{0, 0.3}, {4, 3.7}}, {{4, 0.1}, {0.2, 4}}, {{0, 2}, {4, 2.2}}}, 4, 4).curves;
    for (const auto format :
         {fetex::FeatureNumberFormat::Float, fetex::FeatureNumberFormat::Half, fetex::FeatureNumberFormat::Bits16}) {
        const fetex::FeatureCurvesTexture t = linear_texture(c, format, 4);
        EXPECT_TRUE(fetex::validate_feature_curves(t).empty());
        EXPECT_NEAR(fetex::feature_signature(t, 1, 1)[0].position, c.position(1, 1, North), 0x1p-12);
    }
}

} // namespace
} // namespace fetexc
