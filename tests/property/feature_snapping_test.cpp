// SPDX-License-Identifier: GPL-3.0-or-later
/// Snapping on random networks: valid textures, curves within the distance reported, valid input unchanged, stars that
/// stay joined.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "compiler/feature_curves/snapping.h"
#include "compiler/planar/grid.h"
#include "compiler/union_find.h"
#include "formats/validate.h"
#include "tests/support/random.h"

namespace fetexc {
namespace {

using fetex::FeatureEdge;
using test::Random;
using enum fetex::FeatureEdge;

struct Point {
    double x = 0, y = 0;
};
using Stretch = std::array<Point, 2>;

constexpr double kRounding = 1e-9; // of coordinates up to 16, a dozen operations

double to_stretch(Point p, const Stretch& s) {
    const double dx = s[1].x - s[0].x, dy = s[1].y - s[0].y, n = dx * dx + dy * dy;
    const double t = n > 0 ? std::clamp(((p.x - s[0].x) * dx + (p.y - s[0].y) * dy) / n, 0.0, 1.0) : 0;
    return std::hypot(s[0].x + t * dx - p.x, s[0].y + t * dy - p.y);
}

Point on(const Stretch& s, double t) { return {std::lerp(s[0].x, s[1].x, t), std::lerp(s[0].y, s[1].y, t)}; }

Point point(const SnappedCurves& c, std::uint32_t i, std::uint32_t j, FeatureEdge e) {
    const fetex::FeaturePoint p = fetex::feature_point(e, c.position(i, j, e));
    return {i + p.x, j + p.y};
}

/// What the texture shows in a texel: its segments, and the points on its boundary where others' end.
std::vector<Stretch> shown(const SnappedCurves& c, std::uint32_t i, std::uint32_t j) {
    std::vector<Stretch> out;
    for (const fetex::FeatureSegment s :
         fetex::feature_unpack(configuration_of(c.texels[std::size_t{j} * c.width + i].segments)))
        out.push_back({point(c, i, j, s.first), point(c, i, j, s.second)});
    for (const FeatureEdge e : fetex::kFeatureEdges)
        if (c.is_used(i, j, e)) out.push_back({point(c, i, j, e), point(c, i, j, e)});
    return out;
}

double to_nearest(Point p, const std::vector<Stretch>& of) {
    double least = std::numeric_limits<double>::infinity();
    for (const Stretch& s : of)
        least = std::min(least, to_stretch(p, s));
    return least;
}

/// Lines of the network in texels.
std::vector<Stretch> input(const LatticeLines& lines, const SnappedCurves& c) {
    const double sx = static_cast<double>(c.width) / static_cast<double>(lines.extent.lattice_w),
                 sy = static_cast<double>(c.height) / static_cast<double>(lines.extent.lattice_h);
    std::vector<Stretch> out;
    for (const auto& [a, b] : lines.lines) {
        const LatticePoint &p = lines.vertices[a], &q = lines.vertices[b];
        out.push_back({Point{static_cast<double>(p.x) * sx, static_cast<double>(p.y) * sy},
                       Point{static_cast<double>(q.x) * sx, static_cast<double>(q.y) * sy}});
    }
    return out;
}

/// The part of a stretch in a closed texel, grown by `touch`, if there is any.
bool clip(Stretch& s, std::uint32_t i, std::uint32_t j, double touch) {
    double low = 0, high = 1;
    const auto cut = [&](double from, double to, double least) {
        const double d = to - from;
        const double most = least + 1 + touch;
        least -= touch;
        if (d == 0) return from >= least && from <= most;
        const auto [t0, t1] = std::minmax({(least - from) / d, (most - from) / d});
        low = std::max(low, t0), high = std::min(high, t1);
        return low <= high;
    };
    if (!cut(s[0].x, s[1].x, i) || !cut(s[0].y, s[1].y, j)) return false;
    s = {on(s, low), on(s, high)};
    return true;
}

struct Reported {
    std::uint8_t kinds = 0;
    double distance = 0;
};

/// Every input point of a texel is as near to what is shown there as reported, and the other way round.
void check_distances(const LatticeLines& lines, const SnappedCurves& c) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, Reported> reported;
    for (const FeatureMove& m : c.moves) {
        EXPECT_NE(m.kinds, 0);
        EXPECT_TRUE((reported.insert({{m.i, m.j}, {m.kinds, m.distance}}).second));
    }
    const std::vector<Stretch> all = input(lines, c);
    constexpr int kPoints = 8;
    for (std::uint32_t j = 0; j < c.height; ++j) {
        for (std::uint32_t i = 0; i < c.width; ++i) {
            const Reported r = reported.contains({i, j}) ? reported[{i, j}] : Reported{};
            const std::vector<Stretch> after = shown(c, i, j);
            std::vector<Stretch> before; // with lines that only pass through a corner
            for (Stretch s : all)
                if (clip(s, i, j, kRounding)) before.push_back(s);
            for (Stretch s : all) {
                if (!clip(s, i, j, 0)) continue;
                // A line along a grid line is shown in one of the two texels beside it.
                const auto border = [](double a, double b) {
                    return std::max(std::abs(a - std::round(a)), std::abs(b - std::round(a))) < kRounding;
                };
                if (border(s[0].x, s[1].x) || border(s[0].y, s[1].y)) continue;
                for (int k = 0; k <= kPoints && (r.kinds & kLostInside) == 0; ++k)
                    EXPECT_LE(to_nearest(on(s, k / double{kPoints}), after), r.distance + kRounding)
                        << "texel " << i << " " << j << " kinds " << int{r.kinds};
            }
            for (const Stretch& s : after) {
                if (s[0].x == s[1].x && s[0].y == s[1].y) continue;
                for (int k = 0; k <= kPoints; ++k)
                    EXPECT_LE(to_nearest(on(s, k / double{kPoints}), before), r.distance + kRounding)
                        << "texel " << i << " " << j << " kinds " << int{r.kinds};
            }
        }
    }
}

void check_texture(const SnappedCurves& c) {
    for (const auto format :
         {fetex::FeatureNumberFormat::Float, fetex::FeatureNumberFormat::Half, fetex::FeatureNumberFormat::Bits16})
        EXPECT_TRUE(fetex::validate_feature_curves(linear_texture(c, format, 4)).empty());
}

struct Drawn {
    LatticeLines lines;
    SnappedCurves curves;
};

Drawn snap(const Network& network, std::uint32_t width, std::uint32_t height) {
    Drawn d{lattice_lines(network, width, height).value(), {}};
    d.curves = snap_lines(d.lines, width, height);
    return d;
}

void add_run(Network& network, const std::vector<Point>& points) {
    NetworkCurve curve;
    for (std::size_t k = 1; k < points.size(); ++k)
        curve.segments.push_back({1, {{{points[k - 1].x, points[k - 1].y}, {points[k].x, points[k].y}}}});
    network.curves.push_back(std::move(curve));
}

/// Lines, runs, stars and meshes; every other network on multiples of a quarter texel.
Network random_network(Random& random, std::uint32_t width, std::uint32_t height) {
    Network network{static_cast<double>(width), static_cast<double>(height), {}};
    const double step = random.chance(0.5) ? 0.25 : 0;
    const auto rounded = [&](double v) { return step > 0 ? std::round(v / step) * step : v; };
    const auto anywhere = [&]() -> Point {
        return {rounded(random.between(-1, width + 1.0)), rounded(random.between(-1, height + 1.0))};
    };
    const int runs = static_cast<int>(random.between(1, 12));
    std::vector<Point> known = {anywhere()};
    for (int n = 0; n < runs; ++n) {
        const double reach = random.between(0.2, 6);
        std::vector<Point> run = {
            random.chance(0.4) ? known[static_cast<std::size_t>(random.between(0, double(known.size())))] : anywhere()};
        for (int k = static_cast<int>(random.between(1, 8)); k > 0; --k)
            run.push_back({rounded(run.back().x + random.between(-reach, reach)),
                           rounded(run.back().y + random.between(-reach, reach))});
        known.insert(known.end(), run.begin(), run.end());
        add_run(network, run);
    }
    return network;
}

TEST(FeatureSnapping, randomNetworksBecomeValidTexturesAsNearAsReported) {
    std::uint64_t lines = 0, moved = 0;
    for (std::uint64_t seed = 0; seed < 1500; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const auto width = static_cast<std::uint32_t>(random.between(1, 9)),
                   height = static_cast<std::uint32_t>(random.between(1, 9));
        const Drawn d = snap(random_network(random, width, height), width, height);
        check_texture(d.curves);
        check_distances(d.lines, d.curves);
        if (HasFailure()) break;
        lines += d.lines.lines.size(), moved += d.curves.moves.size();
    }
    EXPECT_GT(lines, 10000u);
    EXPECT_GT(moved, 5000u);
}

/// Any points on the edges and any configuration in each texel: drawn as lines, they are what comes back, bit for bit.
TEST(FeatureSnapping, whatIsValidComesBackUnchanged) {
    const auto configurations = fetex::feature_configurations();
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        constexpr std::uint32_t kSide = 8;
        SnappedCurves wanted;
        wanted.width = wanted.height = kSide;
        for (std::uint32_t k = 0; k < (kSide + 1) * (kSide + 1); ++k) {
            wanted.north.push_back(std::floor(random.between(1, 64)) / 64);
            wanted.west.push_back(std::floor(random.between(1, 64)) / 64);
        }
        Network network{kSide, kSide, {}};
        for (std::uint32_t j = 0; j < kSide; ++j) {
            for (std::uint32_t i = 0; i < kSide; ++i) {
                const bool none = random.chance(0.3);
                const auto c = configurations[none ? 0 : static_cast<std::size_t>(random.between(0, 22))];
                wanted.texels.push_back({segment_set(c), segment_set(c)});
                for (const fetex::FeatureSegment s : fetex::feature_unpack(c))
                    add_run(network, {point(wanted, i, j, s.first), point(wanted, i, j, s.second)});
            }
        }
        const SnappedCurves got = snap(network, kSide, kSide).curves;
        EXPECT_TRUE(got.moves.empty());
        for (std::uint32_t j = 0; j < kSide; ++j) {
            for (std::uint32_t i = 0; i < kSide; ++i) {
                const SnappedTexel &a = got.texels[j * kSide + i], &b = wanted.texels[j * kSide + i];
                EXPECT_EQ(a.segments, b.segments) << "texel " << i << " " << j;
                for (const FeatureEdge e : fetex::kFeatureEdges)
                    EXPECT_EQ(got.position(i, j, e), got.is_used(i, j, e) ? wanted.position(i, j, e) : 0.5);
            }
        }
        if (HasFailure()) break;
    }
}

/// Edges' points that curves join, over the whole texture.
UnionFind joined_points(const SnappedCurves& c,
                        const std::function<std::uint32_t(std::uint32_t, std::uint32_t, FeatureEdge)>& number) {
    UnionFind sets(2 * (std::size_t{c.width} + 1) * (c.height + 1));
    for (std::uint32_t j = 0; j < c.height; ++j) {
        for (std::uint32_t i = 0; i < c.width; ++i) {
            const SegmentSet set = c.texels[std::size_t{j} * c.width + i].segments;
            for (const fetex::FeatureSegment s : fetex::feature_unpack(configuration_of(set)))
                sets.unite(number(i, j, s.first), number(i, j, s.second));
            if (set == kCrossing) sets.unite(number(i, j, North), number(i, j, East));
        }
    }
    return sets;
}

/// Fig. 17: however many curves meet in a point, what leaves the canvas stays joined.
TEST(FeatureSnapping, starsStayJoined) {
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        constexpr std::uint32_t kSide = 16;
        Network network{kSide, kSide, {}};
        const bool on_grid = random.chance(0.5);
        const auto middle = [&] {
            const double v = random.between(5, 11);
            return on_grid ? std::round(2 * v) / 2 : v;
        };
        const Point centre{middle(), middle()};
        const int arms = static_cast<int>(random.between(3, 64));
        const double first = random.chance(0.3) ? 0 : random.between(0, 1);
        for (int k = 0; k < arms; ++k) {
            const double angle = 2 * std::numbers::pi * (k + first) / arms;
            add_run(network, {centre, {centre.x + 24 * std::cos(angle), centre.y + 24 * std::sin(angle)}});
        }
        const Drawn d = snap(network, kSide, kSide);
        check_texture(d.curves);
        check_distances(d.lines, d.curves);
        EXPECT_EQ(d.curves.stats.ends_cut + d.curves.stats.folded + d.curves.stats.lost_inside, 0u);
        const auto number = [](std::uint32_t i, std::uint32_t j, FeatureEdge e) {
            const std::uint32_t column = i + (e == East), row = j + (e == South);
            return 2 * (row * (kSide + 1) + column) + (e == East || e == West);
        };
        UnionFind sets = joined_points(d.curves, number);
        std::uint32_t some = kNone;
        for (std::uint32_t k = 0; k < kSide; ++k) {
            for (const auto& [i, j, e] : {std::tuple{k, 0u, North}, std::tuple{k, kSide - 1, South},
                                          std::tuple{0u, k, West}, std::tuple{kSide - 1, k, East}}) {
                if (!d.curves.is_used(i, j, e)) continue;
                const std::uint32_t set = sets.find(number(i, j, e));
                if (some == kNone) some = set;
                EXPECT_EQ(set, some) << i << " " << j;
            }
        }
        EXPECT_NE(some, kNone);
        if (HasFailure()) break;
    }
}

/// Lines are inserted in bands of rows, curves in one go: what no line is fitted in is the same.
TEST(FeatureSnapping, bandsOfRowsMakeNoDifference) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        Network network{40, 100, {}};
        for (int k = 0; k < 40; ++k) {
            const auto point = [&]() -> CanvasPoint {
                if (k % 2 == 0) return {random.between(-3, 43), random.between(-3, 103)};
                return {random.integer(0, 10) * 4.0, random.integer(0, 25) * 4.0};
            };
            network.curves.push_back({"", {{1, {point(), point()}}}, false, "", {}, {}});
        }
        const LatticeLines lines = lattice_lines(network, 40, 100).value();
        const SnappedCurves bands = snap_lines(lines, 40, 100, 0),
                            whole = snap_quadratics(lattice_curves(lines), 40, 100, 1);
        EXPECT_EQ(bands.stats.crossings, whole.stats.crossings);
        EXPECT_EQ(bands.stats.segments, whole.stats.segments);
        EXPECT_GT(bands.stats.crossings, 1000u);
        for (std::uint32_t j = 0; j < 100; ++j) {
            for (std::uint32_t i = 0; i < 40; ++i) {
                EXPECT_EQ(bands.texel(i, j).segments, whole.texel(i, j).segments) << i << ' ' << j;
                EXPECT_EQ(bands.texel(i, j).inserted, whole.texel(i, j).inserted) << i << ' ' << j;
                if (whole.stats.fitted > 0) continue;
                EXPECT_EQ(bands.position(i, j, North), whole.position(i, j, North)) << i << ' ' << j;
                EXPECT_EQ(bands.position(i, j, West), whole.position(i, j, West)) << i << ' ' << j;
            }
        }
    }
}

} // namespace
} // namespace fetexc
