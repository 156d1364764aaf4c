// SPDX-License-Identifier: GPL-3.0-or-later
/// Textures with feature curves: the valid configurations against the paper's rules (Parilov and Zorin 2008, §4), their
/// symmetries, and how signatures are stored.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "formats/feature_curve_geometry.h"
#include "formats/feature_curves.h"
#include "formats/validate.h"
#include "tests/support/random.h"

namespace fetex {
namespace {

using fetexc::test::Random;
using enum FeatureEdge;

static_assert(feature_configuration_count() == 22);

/// The rules as the paper has them, over sets of segments: none of three, no end off the boundary, one point an edge
/// (which a set of pairs of edges can't break).
std::set<std::set<FeatureSegment>> sets_of_two_at_most() {
    std::set<std::set<FeatureSegment>> sets = {{}};
    for (const FeatureSegment a : kFeatureSegments)
        for (const FeatureSegment b : kFeatureSegments)
            sets.insert({a, b});
    return sets;
}

std::set<FeatureSegment> set_of(FeatureConfiguration c) {
    const FeatureSegmentList list = feature_unpack(c);
    return {list.begin(), list.end()};
}

TEST(FeatureConfigurations, areTheSetsOfUpToTwoSegments) {
    std::set<std::set<FeatureSegment>> found;
    for (const FeatureConfiguration c : feature_configurations())
        EXPECT_TRUE(found.insert(set_of(c)).second) << feature_name(c) << " has two words";
    EXPECT_EQ(found, sets_of_two_at_most());
    EXPECT_EQ(found.size(), 1u + 6 + 15);
}

TEST(FeatureConfigurations, haveOneWordEach) {
    std::size_t words = 0;
    for (std::uint32_t w = 0; w <= 0xffff; ++w) {
        const auto c = static_cast<FeatureConfiguration>(w);
        if (!feature_valid(c) || c == 0) continue;
        const FeatureSegmentList list = feature_unpack(c);
        EXPECT_EQ(feature_pack(list.segment[0], list.segment[1], list.straight[0], list.straight[1]), c);
        EXPECT_EQ(feature_pack(list.segment[1], list.segment[0], list.straight[1], list.straight[0]), c);
        ++words;
    }
    EXPECT_EQ(words, 6u * 2 + 15 * 4);                             // straight or not
    EXPECT_EQ(feature_pack({North, East}, {North, East}), 0x2121); // the paper's two copies
    EXPECT_EQ(feature_pack({East, West}, {North, South}), 0x4231);
}

TEST(FeatureConfigurations, refusesWhatBreaksARule) {
    EXPECT_FALSE(feature_valid(0x0021)); // one pair only
    EXPECT_FALSE(feature_valid(0x1111)); // from an edge to itself
    EXPECT_FALSE(feature_valid(0x1212)); // greater edge first
    EXPECT_FALSE(feature_valid(0x3142)); // greater pair first
    EXPECT_FALSE(feature_valid(0x5121)); // there is no edge 5
    EXPECT_FALSE(feature_valid(0x2101)); // ends inside the texel
    EXPECT_FALSE(feature_valid(0x2129)); // one segment, straight and not
    EXPECT_FALSE(feature_valid(0x0008)); // straight, and none there
    EXPECT_FALSE(feature_valid(0x21a1)); // the greater edge's fourth bit
}

TEST(FeatureConfigurations, namesDiffer) {
    std::set<std::string> names;
    for (const FeatureConfiguration c : feature_configurations())
        names.insert(feature_name(c));
    EXPECT_EQ(names.size(), feature_configuration_count());
    EXPECT_EQ(feature_name(0), "empty");
    EXPECT_EQ(feature_name(0x4231), "N-S E-W");
    EXPECT_EQ(feature_name(0x4a31), "N-S E|W");
}

TEST(FeatureConfigurations, symmetriesMapThemOntoThemselves) {
    for (std::uint32_t s = 0; s < kFeatureSymmetries; ++s) {
        std::set<FeatureConfiguration> images;
        for (const FeatureConfiguration c : feature_configurations()) {
            const FeatureConfiguration image = feature_turned(s, c);
            EXPECT_TRUE(feature_valid(image));
            std::set<FeatureSegment> turned;
            for (const FeatureSegment seg : feature_unpack(c))
                turned.insert(feature_turned(s, seg));
            EXPECT_EQ(set_of(image), turned);
            images.insert(image);
        }
        EXPECT_EQ(images.size(), feature_configuration_count());
    }
}

TEST(FeatureConfigurations, symmetriesKeepWhichSegmentIsStraight) {
    const FeatureConfiguration c = feature_pack({North, East}, {North, South}, true, false);
    for (std::uint32_t s = 0; s < kFeatureSymmetries; ++s) {
        const FeatureSegmentList list = feature_unpack(feature_turned(s, c));
        for (std::uint32_t k = 0; k < 2; ++k)
            EXPECT_EQ(list.straight[k], list.segment[k] == feature_turned(s, FeatureSegment{North, East}));
    }
}

/// Seven kinds: none; a corner cut off, a way across; two corners cut off; two ways across; a corner and a way across
/// from one point; two corners from one point.
TEST(FeatureConfigurations, areOfSevenKinds) {
    std::map<FeatureConfiguration, std::size_t> orbits;
    for (const FeatureConfiguration c : feature_configurations()) {
        FeatureConfiguration least = c;
        for (std::uint32_t s = 0; s < kFeatureSymmetries; ++s)
            least = std::min(least, feature_turned(s, c));
        ++orbits[least];
    }
    std::multiset<std::size_t> sizes;
    for (const auto& [least, size] : orbits)
        sizes.insert(size);
    EXPECT_EQ(sizes, (std::multiset<std::size_t>{1, 4, 2, 2, 1, 8, 4}));
}

/// A symmetry as a map of points of the texel.
FeaturePoint turned(std::uint32_t symmetry, FeaturePoint p) {
    if (symmetry & 1) p.x = 1 - p.x;
    if (symmetry & 2) p.y = 1 - p.y;
    return symmetry & 4 ? FeaturePoint{p.y, p.x} : p;
}

TEST(FeatureSignatures, turnAsPointsAndTangentsDo) {
    Random random(3);
    for (int n = 0; n < 1000; ++n) {
        FeatureSignature in;
        for (FeatureCrossing& c : in)
            c = {random.between(0, 1), random.between(0, std::numbers::pi)};
        for (std::uint32_t s = 0; s < kFeatureSymmetries; ++s) {
            const FeatureSignature out = feature_turned(s, in);
            for (const FeatureEdge e : kFeatureEdges) {
                const FeatureCrossing &a = in[feature_edge_index(e)],
                                      &b = out[feature_edge_index(feature_turned(s, e))];
                const FeaturePoint from = feature_point(e, a.position), to = turned(s, from),
                                   tip = turned(s, {from.x + std::cos(a.angle), from.y + std::sin(a.angle)});
                const FeaturePoint at = feature_point(feature_turned(s, e), b.position);
                EXPECT_NEAR(at.x, to.x, 1e-15);
                EXPECT_NEAR(at.y, to.y, 1e-15);
                EXPECT_NEAR((tip.x - to.x) * std::sin(b.angle), (tip.y - to.y) * std::cos(b.angle), 1e-12);
                EXPECT_GE(b.angle, 0);
                EXPECT_LT(b.angle, std::numbers::pi);
            }
        }
    }
}

struct Format {
    FeatureNumberFormat format;
    double position, angle, distance; ///< what rounding may err by, of position and angle, and per texel of the limit
};
constexpr Format kFormats[] = {{FeatureNumberFormat::Float, 0x1p-25, 0x1p-23, 0x1p-24},
                               {FeatureNumberFormat::Half, 0x1p-12, 0x1p-10, 0x1p-11},
                               {FeatureNumberFormat::Bits16, 0x1p-16, 0x1p-15, 0x1p-16}};

TEST(FeatureSignatures, comeBackAsTheyWereStored) {
    Random random(5);
    constexpr float kLimit = 6;
    for (const Format& f : kFormats) {
        for (const bool linear : {true, false}) {
            FeatureCurvesTexture t = feature_empty_texture(3, 2, f.format, linear, kLimit);
            EXPECT_EQ(t.signatures.size() + t.distances.size(),
                      12u * (linear ? 3 : 5) * feature_number_bytes(f.format)); // the paper's three and five numbers
            for (int n = 0; n < 500; ++n) {
                const FeatureCrossing north{random.between(0, 1), random.between(0, std::numbers::pi)},
                    west{random.between(0, 1), random.between(0, std::numbers::pi)};
                const double distance = random.between(0, 8);
                feature_set_crossing(t, 2, 1, North, north);
                feature_set_crossing(t, 2, 1, West, west);
                feature_set_distance(t, 2, 1, distance);
                const FeatureSignature own = feature_signature(t, 2, 1), left = feature_signature(t, 1, 1),
                                       above = feature_signature(t, 2, 0);
                EXPECT_NEAR(own[0].position, north.position, f.position);
                EXPECT_NEAR(own[3].position, west.position, f.position);
                EXPECT_EQ(left[1], own[3]); // one point, seen from both texels
                EXPECT_EQ(above[2], own[0]);
                const double turn = std::abs(own[0].angle - (linear ? 0 : north.angle));
                EXPECT_LE(std::min(turn, std::numbers::pi - turn), f.angle);
                EXPECT_NEAR(feature_distance(t, 2, 1), std::min<double>(distance, kLimit), kLimit * f.distance);
            }
        }
    }
}

TEST(FeatureSignatures, defaultsAndEndsAreExactInEveryFormat) {
    for (const Format& f : kFormats) {
        FeatureCurvesTexture t = feature_empty_texture(2, 2, f.format, false, 1);
        for (const FeatureCrossing& c : feature_signature(t, 1, 1))
            EXPECT_EQ(c, FeatureCrossing{});
        for (const double v : {0.0, 0.25, 1.0}) {
            feature_set_crossing(t, 0, 0, North, {v, std::numbers::pi});
            EXPECT_EQ(feature_signature(t, 0, 0)[0], (FeatureCrossing{v, 0}));
            feature_set_distance(t, 0, 0, 0);
            EXPECT_EQ(feature_distance(t, 0, 0), 0);
        }
    }
}

FindingCode first_finding(const FeatureCurvesTexture& t) {
    const auto findings = validate_feature_curves(t);
    return findings.empty() ? FindingCode{} : findings[0].code;
}

TEST(FeatureValidator, takesWhatTheRulesAllow) {
    for (const Format& f : kFormats)
        for (const bool linear : {true, false}) {
            FeatureCurvesTexture t = feature_empty_texture(4, 3, f.format, linear, 2);
            t.configurations[5] = feature_pack({North, West}, {East, West}, !linear, !linear); // may end on a boundary
            feature_set_crossing(t, 1, 1, North, {0.2, 3});
            feature_set_crossing(t, 1, 1, West, {1, 2});
            feature_set_crossing(t, 2, 1, West, {0, 1});
            EXPECT_EQ(first_finding(t), FindingCode{});
        }
}

TEST(FeatureValidator, refusesWhatTheyDont) {
    const FeatureCurvesTexture good = feature_empty_texture(4, 3, FeatureNumberFormat::Half, false, 2);
    const auto with = [&](auto change) {
        FeatureCurvesTexture t = good;
        change(t);
        return first_finding(t);
    };
    EXPECT_EQ(with([](auto& t) { t.width = 5; }), FindingCode::FeatureDimensions);
    EXPECT_EQ(with([](auto& t) { t.height = 0; }), FindingCode::FeatureDimensions);
    EXPECT_EQ(with([](auto& t) { t.signatures.pop_back(); }), FindingCode::FeatureDimensions);
    EXPECT_EQ(with([](auto& t) { t.linear = true; }), FindingCode::FeatureDimensions);
    EXPECT_EQ(with([](auto& t) { t.format = static_cast<FeatureNumberFormat>(3); }), FindingCode::FeatureFormat);
    EXPECT_EQ(with([](auto& t) { t.distance_limit = NAN; }), FindingCode::FeatureFormat);
    EXPECT_EQ(with([](auto& t) { t.configurations[3] = 0x1111; }), FindingCode::FeatureBadTexel);
    EXPECT_EQ(with([](auto& t) {
                  t.configurations[3] = feature_pack({North, South}, {North, South});
              }),
              FindingCode::FeatureNoCurve);                                                // angles of 0
    EXPECT_EQ(with([](auto& t) { t.signatures[1] = 0x7c; }), FindingCode::FeatureNumber);  // infinite
    EXPECT_EQ(with([](auto& t) { t.signatures[1] = 0xb8; }), FindingCode::FeatureNumber);  // -1/2
    EXPECT_EQ(with([](auto& t) { t.signatures[3] = 0x43; }), FindingCode::FeatureNumber);  // 3.5 radians
    EXPECT_EQ(with([](auto& t) { t.distances[0] = 1; }), FindingCode::FeatureNumber);      // beyond the limit
    EXPECT_EQ(with([](auto& t) { t.signatures[0] = 1; }), FindingCode::FeatureUnusedEdge); // no curve there
}

TEST(FeatureValidator, knowsNoStraightSegmentsInLinearTextures) {
    FeatureCurvesTexture t = feature_empty_texture(4, 3, FeatureNumberFormat::Float, true, 2);
    t.configurations[0] = feature_pack({North, South}, {North, South}, true, true);
    EXPECT_EQ(first_finding(t), FindingCode::FeatureBadTexel);
}

/// Tangents from the middle of the north edge and from `position` of the east edge.
std::optional<FeaturePoint> middle_of(double north_angle, double position, double east_angle) {
    return feature_middle_point({0.5, north_angle}, {0.5, 0}, {position, east_angle}, {1, position});
}

TEST(FeatureCurve, middlePointIsWhereTheTangentsMeetInTheTexel) {
    const auto corner = middle_of(std::numbers::pi / 2, 0.5, 0);
    ASSERT_TRUE(corner);
    EXPECT_NEAR(corner->x, 0.5, 1e-15);
    EXPECT_NEAR(corner->y, 0.5, 1e-15);
    EXPECT_FALSE(middle_of(std::numbers::pi / 2, 0.5, 0.9));                           // above the texel
    EXPECT_FALSE(middle_of(1, 0.5, 1));                                                // parallel
    EXPECT_FALSE(middle_of(std::numbers::pi / 4, 0.5, std::numbers::pi / 4 + 0.0009)); // hardly a turn
    EXPECT_TRUE(middle_of(std::numbers::pi / 4 + 0.0005, 0.5, std::numbers::pi / 4 - 0.0005));
}

TEST(FeatureCurve, goesThroughItsEndsInTheirDirections) {
    Random random(11);
    int curves = 0;
    for (int n = 0; n < 4000; ++n) {
        FeatureSignature s;
        for (FeatureCrossing& c : s)
            c = {random.between(0, 1), random.between(0, std::numbers::pi)};
        for (const FeatureSegment segment : kFeatureSegments) {
            const auto q = feature_curve(s, segment, false);
            if (!q) continue;
            ++curves;
            for (const bool last : {false, true}) {
                const FeatureEdge e = last ? segment.second : segment.first;
                const FeatureCrossing& c = s[feature_edge_index(e)];
                const FeaturePoint at = feature_curve_at(*q, last), to = feature_curve_derivative(*q, last);
                EXPECT_EQ(at.x, feature_point(e, c.position).x);
                EXPECT_EQ(at.y, feature_point(e, c.position).y);
                EXPECT_NEAR(to.x * std::sin(c.angle), to.y * std::cos(c.angle), 1e-12);
            }
            for (double u = 0.1; u < 1; u += 0.2) {
                const FeaturePoint p = feature_curve_at(*q, u);
                EXPECT_TRUE(p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1);
            }
        }
    }
    EXPECT_GT(curves, 1000);
}

TEST(FeatureCurve, isReadFromTheTexturesEdges) {
    FeatureCurvesTexture t = feature_empty_texture(2, 2, FeatureNumberFormat::Float, false, 1);
    t.configurations[3] = feature_pack({North, East}, {North, West}, true, false);
    feature_set_crossing(t, 1, 1, North, {0.75, std::numbers::pi / 2});
    feature_set_crossing(t, 1, 1, West, {0.5, 0});
    feature_set_crossing(t, 2, 1, West, {0.25, 0});
    ASSERT_EQ(first_finding(t), FindingCode{});
    const FeatureQuadratic straight = feature_segment_curve(t, 1, 1, 0), bent = feature_segment_curve(t, 1, 1, 1);
    EXPECT_TRUE(straight.straight);
    EXPECT_EQ(straight.b1.x, 0.875);
    EXPECT_EQ(straight.b1.y, 0.125);
    EXPECT_FALSE(bent.straight);
    EXPECT_NEAR(bent.b1.x, 0.75, 1e-6);
    EXPECT_NEAR(bent.b1.y, 0.5, 1e-6);
    EXPECT_EQ(bent.b2.x, 0);
}

} // namespace
} // namespace fetex
