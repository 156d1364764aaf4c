// SPDX-License-Identifier: GPL-3.0-or-later
/// Random networks of curves, and what has to hold for any network that was snapped. Header only: most test programs
/// have nothing to do with feature curves.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "compiler/error_budget.h"
#include "compiler/feature_curves/curve_texture.h"
#include "compiler/feature_curves/local_problem.h"
#include "compiler/feature_curves/signatures.h"
#include "formats/feature_curve_geometry.h"
#include "formats/validate.h"
#include "tests/support/random.h"

namespace fetexc::test {

/// Runs of lines, quadratics and cubics, smooth or with corners; every other network on multiples of a quarter texel.
inline Network random_curve_network(Random& random, std::uint32_t width, std::uint32_t height) {
    Network network{static_cast<double>(width), static_cast<double>(height), {}};
    const double step = random.chance(0.5) ? 0.25 : 0;
    const auto rounded = [&](double v) { return step > 0 ? std::round(v / step) * step : v; };
    const int most_degree = random.chance(0.8) ? 2 : 3; // a cubic becomes dozens of quadratics
    for (int runs = random.integer(1, 12); runs > 0; --runs) {
        const double reach = random.between(0.2, 6);
        const bool smooth = random.chance(0.5);
        const auto near = [&](CanvasPoint p) -> CanvasPoint {
            return {rounded(p.x + random.between(-reach, reach)), rounded(p.y + random.between(-reach, reach))};
        };
        NetworkCurve curve;
        CanvasPoint at{rounded(random.between(-1, width + 1.0)), rounded(random.between(-1, height + 1.0))},
            handle = near(at);
        for (int k = random.integer(1, 8); k > 0; --k) {
            CanvasSegment s;
            s.degree = random.integer(1, most_degree);
            s.p[0] = at;
            s.p[1] = smooth ? handle : near(at);
            for (int c = 2; c <= s.degree; ++c)
                s.p[static_cast<std::size_t>(c)] = near(at);
            const auto last = static_cast<std::size_t>(s.degree);
            at = s.p[last], handle = {2 * at.x - s.p[last - 1].x, 2 * at.y - s.p[last - 1].y};
            if (!is_point(s)) curve.segments.push_back(s);
        }
        if (!curve.segments.empty()) network.curves.push_back(std::move(curve));
    }
    return network;
}

inline fetex::FeaturePoint point_of(const SegmentCurve& c, double t) {
    const double a = (1 - t) * (1 - t), b = 2 * t * (1 - t), d = t * t;
    return {a * c[0].x + b * c[1].x + d * c[2].x, a * c[0].y + b * c[1].y + d * c[2].y};
}

/// Direction of a curve at its first or last point, as a line.
inline double tangent_angle(const SegmentCurve& c, bool last) {
    const fetex::FeaturePoint &from = last ? c[2] : c[0], to = c[1];
    return std::atan2(to.y - from.y, to.x - from.x);
}

inline double angle_between(double a, double b) { return std::abs(std::remainder(a - b, std::numbers::pi)); }

/// Every curved segment is valid, stays in its texel, and has the tangent that its edges say.
inline void check_signatures(const SnappedCurves& c) {
    constexpr double kTangents = 1e-9; // radians
    constexpr int kPoints = 16;
    for (std::uint32_t j = 0; j < c.height; ++j) {
        for (std::uint32_t i = 0; i < c.width; ++i) {
            const SnappedTexel& t = c.texel(i, j);
            EXPECT_EQ(t.curved & ~t.segments, 0);
            for (std::uint32_t k = 0; k < fetex::kFeatureSegmentCount; ++k) {
                if ((t.curved >> k & 1u) == 0) continue;
                const ShownSegment s = shown_segment(c, i, j, k);
                EXPECT_EQ(s.fault, SignatureFault::None) << "texel " << i << " " << j;
                const fetex::FeatureSegment edges = fetex::kFeatureSegments[k];
                EXPECT_LE(angle_between(tangent_angle(s.curve, false), c.angle(i, j, edges.first)), kTangents);
                EXPECT_LE(angle_between(tangent_angle(s.curve, true), c.angle(i, j, edges.second)), kTangents);
                for (int n = 1; n < kPoints; ++n) {
                    const fetex::FeaturePoint p = point_of(s.curve, n / double{kPoints});
                    EXPECT_TRUE(p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1) << "texel " << i << " " << j;
                }
            }
        }
    }
}

/// A straight segment ends in the tangent of what goes on there in a curve, but in and next to texels that are
/// reported.
inline void check_straight_ends(const SnappedCurves& c) {
    constexpr double kTangents = 1e-8;
    std::map<std::pair<std::uint32_t, std::uint32_t>, unsigned> kinds;
    for (const FeatureMove& m : c.moves)
        kinds[{m.i, m.j}] = m.kinds;
    const auto reported = [&](std::uint32_t i, std::uint32_t j) {
        constexpr unsigned kBends = kStraightened | kEdgeMerged | kRerouted | kVertexCut;
        return kinds.contains({i, j}) && (kinds[{i, j}] & kBends) != 0;
    };
    for (std::uint32_t j = 0; j < c.height; ++j) {
        for (std::uint32_t i = 0; i < c.width; ++i) {
            const SnappedTexel& t = c.texel(i, j);
            for (std::uint32_t k = 0; k < fetex::kFeatureSegmentCount; ++k) {
                if (((t.segments & ~t.curved) >> k & 1u) == 0 || reported(i, j)) continue;
                for (const fetex::FeatureEdge e :
                     {fetex::kFeatureSegments[k].first, fetex::kFeatureSegments[k].second}) {
                    const auto beside = across(c, i, j, e);
                    if (!beside || reported(beside->i, beside->j)) continue;
                    if (!straight_ends(c, i, j, e).angle) continue; // the input has a corner on the edge
                    const SegmentCurve s = shown_segment(c, i, j, k).curve;
                    if (std::hypot(s[2].x - s[0].x, s[2].y - s[0].y) == 0) continue;
                    const SegmentSet there = c.texel(beside->i, beside->j).curved;
                    if ((edges_of(there) >> fetex::feature_edge_index(beside->edge) & 1u) == 0) continue;
                    EXPECT_LE(angle_between(std::atan2(s[2].y - s[0].y, s[2].x - s[0].x), c.angle(i, j, e)), kTangents)
                        << "texel " << i << " " << j;
                }
            }
        }
    }
}

/// As written, in each format: valid, read back as it is here, tangents turned by no more than 1e-3.
inline void check_written(const SnappedCurves& c) {
    constexpr double kTangents = 1e-3;
    for (const auto format :
         {fetex::FeatureNumberFormat::Float, fetex::FeatureNumberFormat::Half, fetex::FeatureNumberFormat::Bits16}) {
        const QuadraticTexture written = quadratic_texture(c, format, 4);
        EXPECT_TRUE(fetex::validate_feature_curves(written.texture).empty());
        for (std::uint32_t j = 0; j < c.height; ++j) {
            for (std::uint32_t i = 0; i < c.width; ++i) {
                const auto word = written.texture.configurations[std::size_t{j} * c.width + i];
                EXPECT_EQ(segment_set(fetex::feature_edges(word)), c.texel(i, j).segments);
                const fetex::FeatureSegmentList list = fetex::feature_unpack(word);
                for (std::uint32_t k = 0; k < list.count; ++k) {
                    if (list.straight[k]) continue;
                    const fetex::FeatureQuadratic q = fetex::feature_segment_curve(written.texture, i, j, k);
                    const SegmentCurve read = {q.b0, q.b1, q.b2};
                    EXPECT_EQ(fault_of(read), SignatureFault::None);
                    const std::uint32_t segment = segment_between(list.segment[k].first, list.segment[k].second);
                    EXPECT_NE(c.texel(i, j).curved >> segment & 1u, 0u);
                    EXPECT_LE(angle_between(tangent_angle(read, false), c.angle(i, j, list.segment[k].first)),
                              kTangents);
                    EXPECT_LE(angle_between(tangent_angle(read, true), c.angle(i, j, list.segment[k].second)),
                              kTangents);
                }
            }
        }
    }
}

inline double to_stretch(fetex::FeaturePoint p, fetex::FeaturePoint a, fetex::FeaturePoint b) {
    const double dx = b.x - a.x, dy = b.y - a.y, n = dx * dx + dy * dy;
    const double t = n > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / n, 0.0, 1.0) : 0;
    return std::hypot(a.x + t * dx - p.x, a.y + t * dy - p.y);
}

/// Distance from what a texel shows.
inline double to_shown(const SnappedCurves& c, std::uint32_t i, std::uint32_t j, fetex::FeaturePoint p) {
    constexpr int kChords = 32;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t k = 0; k < fetex::kFeatureSegmentCount; ++k) {
        if ((c.texel(i, j).segments >> k & 1u) == 0) continue;
        const SegmentCurve s = shown_segment(c, i, j, k).curve;
        for (int n = 0; n < kChords; ++n)
            least = std::min(least,
                             to_stretch(p, point_of(s, n / double{kChords}), point_of(s, (n + 1) / double{kChords})));
    }
    for (const fetex::FeatureEdge e : fetex::kFeatureEdges) {
        if (!c.is_used(i, j, e)) continue;
        const fetex::FeaturePoint q = fetex::feature_point(e, c.position(i, j, e));
        least = std::min(least, std::hypot(p.x - q.x, p.y - q.y));
    }
    return least;
}

/// No point of the input is farther from what its texel shows than is reported.
inline void check_distances(const LatticeCurves& curves, const SnappedCurves& c) {
    constexpr double kSlack = 2e-3;  // the chords of to_shown, 1/(4·32²) of a bend of at most 4 texels
    constexpr double kBorder = 1e-6; // points so close to a grid line may be of either texel
    constexpr int kPoints = 40;
    std::map<std::pair<std::uint32_t, std::uint32_t>, FeatureMove> reported;
    for (const FeatureMove& m : c.moves) {
        EXPECT_NE(m.kinds, 0);
        EXPECT_TRUE((reported.insert({{m.i, m.j}, m}).second));
    }
    const double sx = static_cast<double>(c.width) / static_cast<double>(curves.extent.lattice_w),
                 sy = static_cast<double>(c.height) / static_cast<double>(curves.extent.lattice_h);
    const auto texels = [&](const LatticePoint& p) -> fetex::FeaturePoint {
        return {static_cast<double>(p.x) * sx, static_cast<double>(p.y) * sy};
    };
    for (const LatticeCurve& curve : curves.curves) {
        const fetex::FeaturePoint a = texels(curves.vertices[curve.a]), b = texels(curves.vertices[curve.b]);
        const fetex::FeaturePoint middle =
            curve.straight ? fetex::FeaturePoint{(a.x + b.x) / 2, (a.y + b.y) / 2} : texels(curve.middle);
        for (int n = 0; n <= kPoints; ++n) {
            const fetex::FeaturePoint p = point_of({a, middle, b}, n / double{kPoints});
            if (p.x <= 0 || p.y <= 0 || p.x >= c.width || p.y >= c.height) continue;
            if (std::abs(p.x - std::round(p.x)) < kBorder || std::abs(p.y - std::round(p.y)) < kBorder) continue;
            const auto i = static_cast<std::uint32_t>(p.x), j = static_cast<std::uint32_t>(p.y);
            const auto found = reported.find({i, j});
            if (found != reported.end() && (found->second.kinds & kLostInside) != 0) continue;
            const double most = found == reported.end() ? budget::kFeatureMoveNoise : found->second.distance;
            EXPECT_LE(to_shown(c, i, j, {p.x - i, p.y - j}), most + kSlack) << "texel " << i << " " << j;
        }
    }
}

inline void check_snapped(const LatticeCurves& curves, const SnappedCurves& c) {
    check_signatures(c);
    check_straight_ends(c);
    check_written(c);
    check_distances(curves, c);
}

} // namespace fetexc::test
