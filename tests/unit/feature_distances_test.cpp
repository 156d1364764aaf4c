// SPDX-License-Identifier: GPL-3.0-or-later
/// Distance and gradient maps (Parilov and Zorin 2008, §4) against every curve, one after the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "compiler/feature_curves/distance_map.h"
#include "compiler/feature_curves/snapping.h"
#include "tests/support/random.h"

namespace fetexc {
namespace {

using fetex::FeatureCurvesTexture;
using fetex::FeatureEdge;
using test::Random;
using enum fetex::FeatureEdge;

constexpr double kRounding = 1e-9; // of coordinates up to 100, a dozen operations
constexpr float kLimit = 3;

FeatureCurvesTexture empty(std::uint32_t width, std::uint32_t height) {
    return fetex::feature_empty_texture(width, height, fetex::FeatureNumberFormat::Float, true, kLimit);
}

void put(FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j, FeatureEdge e, double position) {
    if (e == East) return put(t, i + 1, j, West, position);
    if (e == South) return put(t, i, j + 1, North, position);
    fetex::feature_set_crossing(t, i, j, e, {position, 0});
}

/// Segments between edges' points; positions by feature_edge_index.
void put(FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j, fetex::FeatureSegment a, fetex::FeatureSegment b,
         std::array<double, 4> positions) {
    t.configurations[std::size_t{j} * t.width + i] = fetex::feature_pack(a, b);
    for (const fetex::FeatureSegment s : {a, b})
        for (const FeatureEdge e : {s.first, s.second})
            put(t, i, j, e, positions[fetex::feature_edge_index(e)]);
}

Network random_network(Random& random, double reach) {
    Network n{20, 20, {}};
    const auto count = random.integer(1, 12);
    for (int k = 0; k < count; ++k) {
        const CanvasPoint a{random.between(-2, 22), random.between(-2, 22)};
        const CanvasPoint b{a.x + random.between(-reach, reach), a.y + random.between(-reach, reach)};
        n.curves.push_back({"", {{1, {a, b}}}, false, "", {}, {}});
    }
    return n;
}

FeatureCurvesTexture snapped(const Network& network, std::uint32_t width, std::uint32_t height) {
    auto lines = lattice_lines(network, width, height);
    EXPECT_TRUE(lines);
    return linear_texture(snap_lines(lines.value(), width, height), fetex::FeatureNumberFormat::Float, kLimit);
}

std::vector<TextureSegment> all_of(const FeatureCurvesTexture& t) {
    std::vector<TextureSegment> all;
    for (std::uint32_t j = 0; j < t.height; ++j) {
        for (std::uint32_t i = 0; i < t.width; ++i) {
            const fetex::FeatureSignature s = fetex::feature_signature(t, i, j);
            const auto point = [&](FeatureEdge e) -> CanvasPoint {
                const fetex::FeaturePoint p = fetex::feature_point(e, s[fetex::feature_edge_index(e)].position);
                return {i + p.x, j + p.y};
            };
            for (const fetex::FeatureSegment e : fetex::feature_unpack(t.configurations[std::size_t{j} * t.width + i]))
                all.push_back({point(e.first), point(e.second), {}, e});
        }
    }
    return all;
}

CanvasPoint nearest_point(const std::vector<TextureSegment>& segments, CanvasPoint p) {
    CanvasPoint best{};
    double least = std::numeric_limits<double>::infinity();
    for (const TextureSegment& s : segments) {
        const double dx = s.to.x - s.from.x, dy = s.to.y - s.from.y, n = dx * dx + dy * dy;
        const double t = n > 0 ? std::clamp(((p.x - s.from.x) * dx + (p.y - s.from.y) * dy) / n, 0.0, 1.0) : 0;
        const CanvasPoint q{s.from.x + t * dx, s.from.y + t * dy};
        if (const double d = std::hypot(q.x - p.x, q.y - p.y); d < least) least = d, best = q;
    }
    return best;
}

struct Corners {
    std::size_t near = 0, far = 0;
};

void expect_exact(const FeatureCurvesTexture& t, double limit, Corners& corners) {
    const DistanceMap map = distance_map(TextureSegments(t), limit, 1);
    const std::vector<TextureSegment> all = all_of(t);
    if (all.empty()) return;
    for (std::uint32_t j = 0; j <= t.height; ++j) {
        for (std::uint32_t i = 0; i <= t.width; ++i) {
            const std::size_t at = std::size_t{j} * (t.width + 1) + i;
            const CanvasPoint q = nearest_point(all, {double(i), double(j)});
            const double d = std::hypot(q.x - i, q.y - j);
            ASSERT_NEAR(map.distances[at], std::min<double>(d, limit), kRounding) << i << ' ' << j;
            const DistanceGradient g = map.gradients[at];
            if (d > limit) {
                ++corners.far;
                ASSERT_EQ(g, DistanceGradient{});
                continue;
            }
            // Between two points as near as each other either direction is right: so the point it points to counts.
            ++corners.near;
            const CanvasPoint to{i - d * g.x, j - d * g.y}, on = nearest_point(all, to);
            ASSERT_NEAR(std::hypot(on.x - to.x, on.y - to.y), 0, kRounding) << i << ' ' << j;
            ASSERT_NEAR(std::hypot(g.x, g.y), 1, kRounding);
        }
    }
}

TEST(DistanceMap, isExactOnRandomNetworks) {
    Random random(1);
    Corners corners;
    for (int k = 0; k < 40; ++k)
        expect_exact(snapped(random_network(random, k % 2 == 0 ? 5 : 25), 30, 17), kLimit, corners);
    EXPECT_GT(corners.near, 5000u);
    EXPECT_GT(corners.far, 500u);
}

TEST(DistanceMap, isExactFarFromFewCurves) {
    Random random(5);
    for (const double limit : {0.7, 1.3, 2.0, 9.0, 23.0, 65504.0}) {
        Corners corners;
        for (int k = 0; k < 20; ++k)
            expect_exact(snapped(random_network(random, 1 + k % 2), 70, 41), limit, corners);
        EXPECT_GT(corners.near, 300u);
        if (limit < 10) {
            EXPECT_GT(corners.far, 5000u);
        }
    }
}

TEST(DistanceMap, hasTheSameBitsForAnyNumberOfThreads) {
    Random random(2);
    const FeatureCurvesTexture t = snapped(random_network(random, 25), 150, 97);
    const auto made = [&](unsigned threads) {
        DistanceMap map = distance_map(TextureSegments(t), kLimit, threads);
        smooth_gradients(map, t, kGradientIterations, threads);
        return map;
    };
    const DistanceMap one = made(1), more = made(0);
    EXPECT_EQ(one.distances, more.distances);
    EXPECT_EQ(one.gradients, more.gradients);
}

TEST(DistanceMap, isTheLimitWithoutCurves) {
    const FeatureCurvesTexture t = empty(3, 5);
    DistanceMap map = distance_map(TextureSegments(t), 2.5, 1);
    smooth_gradients(map, t, 3, 1);
    EXPECT_EQ(map.distances, std::vector<double>(4 * 6, 2.5));
    EXPECT_EQ(map.gradients, std::vector<DistanceGradient>(4 * 6));
}

// The sampler tells sides by edges, not by places: a point at the end of its edge leaves the corner on its side.
TEST(DistanceMap, cornersOnACurvePointToTheirOwnSide) {
    for (const std::uint32_t at : {0u, 2u}) { // both borders
        for (const double end : {0.0, 1.0}) {
            FeatureCurvesTexture t = empty(3, 3);
            put(t, at, 1, {North, South}, {North, South}, {end, 0, end, 0});
            const DistanceMap map = distance_map(TextureSegments(t), kLimit, 1);
            for (const std::uint32_t j : {1u, 2u}) {
                const std::size_t corner = j * 4 + at + (end == 1 ? 1 : 0);
                EXPECT_EQ(map.distances[corner], 0);
                EXPECT_EQ(map.gradients[corner], (DistanceGradient{end == 1 ? 1.0 : -1.0, 0})) << at << ' ' << end;
            }
        }
    }
}

TEST(DistanceMap, cornersOnADiagonalPointAwayFromItOrAreAllOnOneSide) {
    FeatureCurvesTexture t = empty(1, 1);
    // From the upper right corner, which is right of North's point, to the lower left one, left of South's.
    put(t, 0, 0, {North, South}, {North, South}, {1, 0, 0, 0});
    const DistanceMap map = distance_map(TextureSegments(t), kLimit, 1);
    const double r = std::sqrt(0.5);
    EXPECT_NEAR(map.gradients[0].x, -r, kRounding); // upper left
    EXPECT_NEAR(map.gradients[1].x, r, kRounding);  // on the curve, to the right
    EXPECT_NEAR(map.gradients[1].y, r, kRounding);
    EXPECT_NEAR(map.gradients[2].x, -r, kRounding); // on the curve, to the left
    EXPECT_NEAR(map.gradients[2].y, -r, kRounding);
    EXPECT_NEAR(map.gradients[3].x, r, kRounding);
}

TEST(GradientSmoothing, leavesStraightLinesAlone) {
    FeatureCurvesTexture t = empty(6, 6);
    for (std::uint32_t j = 0; j < 6; ++j)
        put(t, 2, j, {North, South}, {North, South}, {0.25, 0, 0.25, 0});
    DistanceMap map = distance_map(TextureSegments(t), kLimit, 1);
    const DistanceMap before = map;
    smooth_gradients(map, t, kGradientIterations, 1);
    EXPECT_EQ(map.gradients, before.gradients);
    EXPECT_EQ(map.distances, before.distances);
    EXPECT_EQ(map.gradients[2].x, -1);
    EXPECT_EQ(map.gradients[3].x, 1);
}

/// The mean of what is joined by grid edges without a point, worked out one corner after the other.
std::vector<DistanceGradient> smoothed_once(const DistanceMap& map, const std::set<std::pair<int, int>>& cut) {
    std::vector<DistanceGradient> out = map.gradients;
    const int columns = static_cast<int>(map.width) + 1, rows = static_cast<int>(map.height) + 1;
    for (int at = 0; at < columns * rows; ++at) {
        double x = 0, y = 0, n = 0;
        for (const auto& [dx, dy] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}}) {
            const int i = at % columns + dx, j = at / columns + dy, other = j * columns + i;
            if (i < 0 || j < 0 || i >= columns || j >= rows) continue;
            if (cut.contains(std::minmax(at, other))) continue;
            if (!(map.distances[static_cast<std::size_t>(other)] < map.limit)) continue;
            x += map.gradients[static_cast<std::size_t>(other)].x,
                y += map.gradients[static_cast<std::size_t>(other)].y, ++n;
        }
        DistanceGradient& g = out[static_cast<std::size_t>(at)];
        if (n > 0 && map.distances[static_cast<std::size_t>(at)] < map.limit)
            g = {(g.x + x / n) / 2, (g.y + y / n) / 2};
    }
    return out;
}

TEST(GradientSmoothing, takesMeansOfCornersThatNoPointSeparates) {
    // A corner of two segments that meet on the edge between texels (1,1) and (2,1), and an end on the border of (2,1).
    FeatureCurvesTexture t = empty(4, 4);
    put(t, 1, 1, {North, East}, {North, East}, {0.5, 0.25, 0, 0});
    put(t, 2, 1, {South, West}, {South, West}, {0, 0, 0.75, 0.25});
    DistanceMap map = distance_map(TextureSegments(t), 2, 1);
    const int c = 5;
    const std::set<std::pair<int, int>> cut = {{c + 1, c + 2}, {c + 2, 2 * c + 2}, {2 * c + 2, 2 * c + 3}};
    for (int k = 0; k < 3; ++k) {
        const std::vector<DistanceGradient> wanted = smoothed_once(map, cut);
        smooth_gradients(map, t, 1, 1);
        for (std::size_t at = 0; at < wanted.size(); ++at) {
            EXPECT_NEAR(map.gradients[at].x, wanted[at].x, kRounding) << at;
            EXPECT_NEAR(map.gradients[at].y, wanted[at].y, kRounding) << at;
        }
    }
}

TEST(GradientSmoothing, bringsDirectionsAcrossAMedialAxisTogether) {
    FeatureCurvesTexture t = empty(9, 4); // two lines, 5 texels apart: the axis is in the middle of texels
    for (std::uint32_t j = 0; j < 4; ++j)
        for (const std::uint32_t i : {1u, 6u})
            put(t, i, j, {North, South}, {North, South}, {0.5, 0, 0.5, 0});
    DistanceMap map = distance_map(TextureSegments(t), kLimit, 1);
    EXPECT_EQ(map.gradients[3].x - map.gradients[5].x, 2); // corners 3 (d = 1.5) and 5 (d = 1.5) of row 0; 4 has 2.5
    smooth_gradients(map, t, kGradientIterations, 1);
    EXPECT_LT(map.gradients[3].x - map.gradients[5].x, 1);
    EXPECT_EQ(map.gradients[1].x, -1); // beyond the lines nothing changed
    EXPECT_EQ(map.gradients[8].x, 1);
}

} // namespace
} // namespace fetexc
