// SPDX-License-Identifier: GPL-3.0-or-later
/// The reference sampler of textures with feature curves, on random ones (any configuration beside any other, many
/// ends) and on circles and lines whose distances are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "formats/feature_curve_geometry.h"
#include "formats/feature_sampler.h"
#include "formats/validate.h"
#include "tests/support/random.h"
#include "tests/support/random_features.h"

namespace fetexc {
namespace {

using namespace fetex;
using enum FeatureEdge;
using test::Random;
using test::random_features;

constexpr std::uint32_t kSide = 12;

void for_each_texture(const std::function<void(const FeatureCurvesTexture&)>& visit) {
    for (std::uint64_t seed = 1; seed <= 24; ++seed)
        visit(random_features(seed, {.width = kSide,
                                     .height = kSide,
                                     .format = test::kFeatureNumberFormats[seed % 3],
                                     .linear = seed % 4 == 0,
                                     .coverage = seed % 2 == 0 ? 0.3 : 0.9}));
}

template <class Visit> void for_each_segment(const FeatureCurvesTexture& t, const Visit& visit) {
    for (std::uint32_t j = 0; j < t.height; ++j)
        for (std::uint32_t i = 0; i < t.width; ++i)
            for (std::uint32_t k = 0; k < feature_unpack(t.configurations[j * t.width + i]).count; ++k)
                visit(i, j, feature_segment_curve(t, i, j, k));
}

TEST(FeatureSampler, distanceIsZeroOnCurvesAndAboveElsewhere) {
    double most = 0;
    std::size_t zeros = 0, points = 0;
    Random random(1);
    for_each_texture([&](const FeatureCurvesTexture& t) {
        ASSERT_TRUE(validate_feature_curves(t).empty());
        for_each_segment(t, [&](std::uint32_t i, std::uint32_t j, const FeatureQuadratic& q) {
            for (double u = 0; u <= 1; u += 1.0 / 64) {
                const FeaturePoint p = feature_curve_at(q, u);
                most = std::max(most, feature_at_local(t, i, j, p.x, p.y).distance);
            }
        });
        for (int n = 0; n < 2000; ++n, ++points)
            zeros += feature_at(t, random.between(0, kSide), random.between(0, kSide)).distance <= 0 ? 1 : 0;
    });
    EXPECT_LE(most, 1e-12); // the promise is 1e-6
    EXPECT_LE(zeros, points / 1000);
}

double difference(const FeatureAt& a, const FeatureAt& b) {
    return std::max({std::abs(a.gradient.x - b.gradient.x), std::abs(a.gradient.y - b.gradient.y),
                     std::abs(a.base.r - b.base.r), std::abs(a.base.g - b.base.g), std::abs(a.base.b - b.base.b)});
}

/// Seen from both texels; ends of curves, where the texel across knows nothing of them but that, included.
TEST(FeatureSampler, continuesAcrossTexelsEdges) {
    double distance = 0, rest = 0;
    for_each_texture([&](const FeatureCurvesTexture& t) {
        for (std::uint32_t j = 0; j + 1 < t.height; ++j)
            for (std::uint32_t i = 0; i + 1 < t.width; ++i)
                for (double along = 1.0 / 74; along < 1; along += 1.0 / 37) {
                    const auto compare = [&](const FeatureAt& a, const FeatureAt& b, double q) {
                        distance = std::max(distance, std::abs(a.distance - b.distance));
                        if (std::abs(along - q) > 1e-4) rest = std::max(rest, difference(a, b));
                    };
                    compare(feature_at_local(t, i, j, 1, along), feature_at_local(t, i + 1, j, 0, along),
                            feature_crossing(t, i + 1, j, West).position);
                    compare(feature_at_local(t, i, j, along, 1), feature_at_local(t, i, j + 1, along, 0),
                            feature_crossing(t, i, j + 1, North).position);
                }
    });
    EXPECT_LE(distance, 1e-12);
    EXPECT_LE(rest, 1e-4); // maps are taken 2^-20 inside, here 1/74 from a corner
}

/// On an edge distances are linear between its corners and its point, if a curve goes through or ends there.
TEST(FeatureSampler, isLinearAlongEdges) {
    for_each_texture([&](const FeatureCurvesTexture& t) {
        for (std::uint32_t j = 0; j < t.height; ++j)
            for (std::uint32_t i = 0; i < t.width; ++i) {
                const double a = feature_distance(t, i, j), b = feature_distance(t, i, j + 1),
                             q = feature_crossing(t, i, j, West).position;
                bool used = (feature_open_edges(t, i, j) >> feature_edge_index(West) & 1u) != 0;
                for (const FeatureSegment s : feature_unpack(t.configurations[j * t.width + i]))
                    used |= s.second == West;
                for (double y = 0; y <= 1; y += 1.0 / 16) {
                    const double whole = a + y * (b - a), parted = y < q ? a * (1 - y / q) : b * (y - q) / (1 - q);
                    EXPECT_NEAR(feature_at_local(t, i, j, 0, y).distance, used ? parted : whole, 1e-12);
                }
            }
    });
}

/// Inside: nothing jumps but base and gradient, at curves. Steps as small as these change a distance by little,
/// whatever its slope.
TEST(FeatureSampler, distanceHasNoJumps) {
    Random random(7);
    double most = 0;
    for_each_texture([&](const FeatureCurvesTexture& t) {
        for_each_segment(t, [&](std::uint32_t i, std::uint32_t j, const FeatureQuadratic& q) {
            for (int n = 0; n < 16; ++n) {
                const FeaturePoint p = feature_curve_at(q, random.unit());
                const double angle = random.between(0, 2 * std::numbers::pi);
                const FeatureAt near =
                    feature_at_local(t, i, j, p.x + 1e-9 * std::cos(angle), p.y + 1e-9 * std::sin(angle));
                most = std::max(most, near.distance);
            }
        });
        for (int n = 0; n < 4000; ++n) {
            const double x = random.between(0, kSide), y = random.between(0, kSide);
            most = std::max(most, std::abs(feature_at(t, x, y).distance - feature_at(t, x + 1e-9, y + 1e-9).distance));
        }
    });
    EXPECT_LE(most, 1e-5);
}

double difference(const std::array<double, kFeatureProfilesMost>& a,
                  const std::array<double, kFeatureProfilesMost>& b) {
    double most = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
        most = std::max(most, std::abs(a[k] - b[k]));
    return most;
}

void for_each_texture_of_profiles(const std::function<void(const FeatureCurvesTexture&)>& visit) {
    for (std::uint64_t seed = 1; seed <= 24; ++seed)
        visit(random_features(seed, {.width = kSide,
                                     .height = kSide,
                                     .format = test::kFeatureNumberFormats[seed % 3],
                                     .linear = seed % 4 == 0,
                                     .profiles = static_cast<std::uint32_t>(2 + seed % 7),
                                     .coverage = seed % 2 == 0 ? 0.3 : 0.9}));
}

TEST(FeatureProfiles, partsAreSharesOfOne) {
    Random random(11);
    for_each_texture_of_profiles([&](const FeatureCurvesTexture& t) {
        ASSERT_TRUE(validate_feature_curves(t).empty()) << validate_feature_curves(t)[0].message;
        for (int n = 0; n < 2000; ++n) {
            const FeatureAt at = feature_at(t, random.between(0, kSide), random.between(0, kSide));
            double sum = 0;
            for (std::size_t k = 0; k < at.profiles.size(); ++k) {
                EXPECT_GE(at.profiles[k], 0);
                EXPECT_TRUE(k < t.profiles || at.profiles[k] == 0);
                sum += at.profiles[k];
            }
            EXPECT_NEAR(sum, 1, 1e-12);
        }
    });
}

/// A segment's own, from that of its first end to that of its second, whatever else is in the texel.
TEST(FeatureProfiles, aCurveHasItsOwn) {
    for_each_texture_of_profiles([&](const FeatureCurvesTexture& t) {
        for (std::uint32_t j = 0; j < t.height; ++j)
            for (std::uint32_t i = 0; i < t.width; ++i) {
                const FeatureSegmentList list = feature_unpack(t.configurations[j * t.width + i]);
                const FeatureTexelProfiles own = feature_texel_profiles(t, i, j);
                for (std::uint32_t k = 0; k < list.count; ++k) {
                    const FeatureQuadratic q = feature_segment_curve(t, i, j, k);
                    for (const double u : {0.0, 0.1234, 0.4321, 0.7654, 1.0}) {
                        std::array<double, kFeatureProfilesMost> wanted{};
                        wanted[own.edges[feature_edge_index(list.segment[k].first)]] += 1 - u;
                        wanted[own.edges[feature_edge_index(list.segment[k].second)]] += u;
                        const FeaturePoint p = feature_curve_at(q, u);
                        EXPECT_LE(difference(feature_at_local(t, i, j, p.x, p.y).profiles, wanted), 1e-9);
                    }
                }
            }
    });
}

/// Seen from both texels, ends of curves included.
TEST(FeatureProfiles, continueAcrossTexelsEdges) {
    double most = 0;
    for_each_texture_of_profiles([&](const FeatureCurvesTexture& t) {
        for (std::uint32_t j = 0; j + 1 < t.height; ++j)
            for (std::uint32_t i = 0; i + 1 < t.width; ++i)
                for (double along = 1.0 / 74; along < 1; along += 1.0 / 37) {
                    most = std::max({most,
                                     difference(feature_at_local(t, i, j, 1, along).profiles,
                                                feature_at_local(t, i + 1, j, 0, along).profiles),
                                     difference(feature_at_local(t, i, j, along, 1).profiles,
                                                feature_at_local(t, i, j + 1, along, 0).profiles)});
                }
    });
    EXPECT_LE(most, 1e-4); // corners are taken 2^-20 inside, here 1/74 from one
}

/// Across curves neither, nor beside the ends of others; where two meet every part may be had within a step.
TEST(FeatureProfiles, haveNoJumps) {
    Random random(13);
    double most = 0;
    for_each_texture_of_profiles([&](const FeatureCurvesTexture& t) {
        for_each_segment(t, [&](std::uint32_t i, std::uint32_t j, const FeatureQuadratic& q) {
            if (feature_unpack(t.configurations[j * t.width + i]).count != 1) return;
            for (int n = 0; n < 16; ++n) {
                const FeaturePoint p = feature_curve_at(q, random.between(0.1, 0.9));
                const double angle = random.between(0, 2 * std::numbers::pi), x = 1e-9 * std::cos(angle),
                             y = 1e-9 * std::sin(angle);
                most = std::max(most, difference(feature_at_local(t, i, j, p.x + x, p.y + y).profiles,
                                                 feature_at_local(t, i, j, p.x - x, p.y - y).profiles));
            }
        });
        for (int n = 0; n < 4000; ++n) {
            const double x = random.between(0, kSide), y = random.between(0, kSide);
            most = std::max(most, difference(feature_at(t, x, y).profiles, feature_at(t, x + 1e-9, y + 1e-9).profiles));
        }
    });
    EXPECT_LE(most, 1e-5);
}

/// A texture of closed and straight curves given by what crosses the texels' edges: every edge at most once.
struct Crossings {
    /// Where the curve crosses from (x,y) to (x+1,y) or (x,y+1), and its tangent's angle.
    std::function<std::optional<FeatureCrossing>(double x, double y, bool along_x)> crossing;
    std::function<double(double x, double y)> distance; ///< of a point, with its sign
};

constexpr float kLimit = 4;

FeatureCurvesTexture texture_of(const Crossings& curve, bool linear) {
    FeatureCurvesTexture t = feature_empty_texture(16, 16, FeatureNumberFormat::Float, linear, kLimit);
    for (std::uint32_t j = 0; j <= t.height; ++j)
        for (std::uint32_t i = 0; i <= t.width; ++i) {
            feature_set_distance(t, i, j, std::abs(curve.distance(i, j)));
            constexpr double step = 1e-6;
            const double sign = curve.distance(i, j) < 0 ? -1 : 1;
            feature_set_gradient(t, i, j,
                                 {sign * (curve.distance(i + step, j) - curve.distance(i - step, j)) / (2 * step),
                                  sign * (curve.distance(i, j + step) - curve.distance(i, j - step)) / (2 * step)});
            if (i < t.width)
                if (const auto c = curve.crossing(i, j, true)) feature_set_crossing(t, i, j, North, *c);
            if (j < t.height)
                if (const auto c = curve.crossing(i, j, false)) feature_set_crossing(t, i, j, West, *c);
        }
    for (std::uint32_t j = 0; j < t.height; ++j)
        for (std::uint32_t i = 0; i < t.width; ++i) {
            std::vector<FeatureEdge> edges;
            if (curve.crossing(i, j, true)) edges.push_back(North);
            if (curve.crossing(i + 1, j, false)) edges.push_back(East);
            if (curve.crossing(i, j + 1, true)) edges.push_back(South);
            if (curve.crossing(i, j, false)) edges.push_back(West);
            EXPECT_TRUE(edges.empty() || edges.size() == 2);
            if (edges.size() != 2) continue;
            const FeatureSegment s{edges[0], edges[1]};
            const bool straight = !linear && !feature_curve(feature_signature(t, i, j), s, false);
            t.configurations[j * t.width + i] = feature_pack(s, s, straight, straight);
        }
    EXPECT_TRUE(validate_feature_curves(t).empty());
    return t;
}

/// Both ends on different sides: the crossing by bisection.
Crossings by_distance(std::function<double(double, double)> distance) {
    const auto crossing = [distance](double x, double y, bool along_x) -> std::optional<FeatureCrossing> {
        const auto at = [&](double s) { return distance(along_x ? x + s : x, along_x ? y : y + s); };
        if ((at(0) < 0) == (at(1) < 0)) return std::nullopt;
        double low = 0, high = 1;
        for (int n = 0; n < 60; ++n)
            ((at((low + high) / 2) < 0) == (at(0) < 0) ? low : high) = (low + high) / 2;
        const double cx = along_x ? x + low : x, cy = along_x ? y : y + low, step = 1e-6;
        const double gx = distance(cx + step, cy) - distance(cx - step, cy),
                     gy = distance(cx, cy + step) - distance(cx, cy - step);
        const double angle = std::atan2(gx, -gy); // of the tangent (−gy, gx)
        return FeatureCrossing{low, angle < 0 ? angle + std::numbers::pi : angle};
    };
    return {crossing, distance};
}

struct Errors {
    double mean = 0, most = 0, gradient = 0;
};

Errors errors_of(const FeatureCurvesTexture& t, const Crossings& curve) {
    Random random(3);
    Errors e;
    int points = 0;
    for (int n = 0; n < 60000; ++n) {
        const double x = random.between(1, 15), y = random.between(1, 15), truth = curve.distance(x, y);
        if (std::abs(truth) > 1) continue;
        const FeatureAt at = feature_at(t, x, y);
        const double error = std::abs(at.distance - std::abs(truth));
        e.mean += error, e.most = std::max(e.most, error), ++points;
        constexpr double step = 1e-6;
        const double sign = truth < 0 ? -1 : 1,
                     gx = sign * (curve.distance(x + step, y) - curve.distance(x - step, y)) / (2 * step),
                     gy = sign * (curve.distance(x, y + step) - curve.distance(x, y - step)) / (2 * step);
        if (std::abs(truth) > 10 * step)
            e.gradient = std::max(e.gradient, std::hypot(at.gradient.x - gx, at.gradient.y - gy));
    }
    e.mean /= points;
    return e;
}

Crossings circle(double x, double y, double r) {
    return by_distance([=](double px, double py) { return std::hypot(px - x, py - y) - r; });
}

Crossings line(double angle, double offset) {
    return by_distance(
        [=](double x, double y) { return (x - 8) * std::cos(angle) + (y - 8) * std::sin(angle) - offset; });
}

TEST(FeatureSampler, isExactBesideLines) {
    for (double angle = 0.05; angle < 6.28; angle += 0.37)
        for (const bool linear : {false, true}) {
            const Crossings curve = line(angle, 0.21);
            const Errors e = errors_of(texture_of(curve, linear), curve);
            EXPECT_LE(e.most, 1e-5) << angle; // what floats of the crossings and distances leave
            EXPECT_LE(e.gradient, 1e-5) << angle;
        }
}

/// What is left is the distance's own curvature between samples: 1/r on the curve, more inside. Lines instead of curves
/// leave a third more.
TEST(FeatureSampler, isNearTheDistanceBesideCircles) {
    for (const double r : {2.6, 3.7, 6.1}) {
        const Crossings curve = circle(8.13, 7.91, r);
        const Errors e = errors_of(texture_of(curve, false), curve), flat = errors_of(texture_of(curve, true), curve);
        EXPECT_LE(e.mean, 0.056 / r);
        EXPECT_LE(e.most, 0.1) << r;
        EXPECT_LT(1.3 * e.mean, flat.mean) << r;
    }
}

/// A corner whose bisector runs through the texel: the nearer of the two lines, where the eight triangles have 0
/// throughout the middle.
TEST(FeatureSampler, isNotZeroBetweenTwoCorners) {
    FeatureCurvesTexture t = feature_empty_texture(1, 1, FeatureNumberFormat::Float, true, kLimit);
    t.configurations[0] = feature_pack({North, East}, {South, West});
    feature_set_crossing(t, 0, 0, North, {0.75, 0}), feature_set_crossing(t, 1, 0, West, {0.25, 0});
    feature_set_crossing(t, 0, 1, North, {0.25, 0}), feature_set_crossing(t, 0, 0, West, {0.75, 0});
    const double half = std::numbers::sqrt2 / 2, corner = 0.75 * half;
    for (const std::uint32_t c : {0u, 1u, 2u, 3u})
        feature_set_distance(t, c & 1, c >> 1, c == 0 || c == 3 ? corner : 0.25 * half);
    for (double along = -0.3; along <= 0.31; along += 0.1)   // the diagonal from the first corner to the last
        for (double off = -0.15; off <= 0.15; off += 0.05) { // and off it
            const double truth = (0.75 - 2 * std::abs(off)) * half;
            const double d = feature_at(t, 0.5 + along - off, 0.5 + along + off).distance;
            EXPECT_NEAR(d, truth, 1e-6) << along << ' ' << off;
        }
}

} // namespace
} // namespace fetexc
