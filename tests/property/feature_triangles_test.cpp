// SPDX-License-Identifier: GPL-3.0-or-later
/// The rays of SPEC.md, 9.2, against the eight triangles of Parilov and Zorin (2008): what both promise, how far from
/// the exact distance each is, and which valid signatures have no such triangles (SPEC.md, 9.4).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "compiler/feature_curves/feature_curves_builder.h"
#include "compiler/feature_curves/signatures.h"
#include "compiler/scene/bezier.h"
#include "compiler/scene/curve_distance.h"
#include "formats/feature_sampler.h"
#include "tests/support/eight_triangles.h"
#include "tests/support/random.h"

namespace fetexc {
namespace {

using fetex::FeatureCurvesTexture;
using fetex::FeatureEdge;
using fetex::FeaturePoint;
using fetex::FeatureQuadratic;
using test::EightTriangles;
using test::Random;
using test::SegmentedTexel;
using enum fetex::FeatureEdge;

constexpr float kLimit = 4;
constexpr double kOnCurve = 1e-9; // texels: the promise is 1e-6
constexpr double kStep = 1e-7;    // texels between points that have nearly the same distance
constexpr double kSteepest = 1e3; // change of the distance per texel
constexpr double kNearAxes = 1.2; // how much worse rays may be there
constexpr int kSignatures = 60;   // of each configuration
constexpr int kPoints = 60;       // in each texel
constexpr double kStraight = 0.1; // texels a corner may be off the distance that a line through the nearest point has
constexpr double kSameWay = 0.9;  // cosine between its gradient and the line's normal
constexpr double kFromCorner = 0.05; // positions keep so far from corners

CanvasSegment canvas(const FeatureQuadratic& q, double i = 0, double j = 0) {
    const auto at = [&](FeaturePoint p) { return CanvasPoint{i + p.x, j + p.y}; };
    if (q.straight) return {1, {at(q.b0), at(q.b2)}};
    return {2, {at(q.b0), at(q.b1), at(q.b2)}};
}

struct Nearest {
    double distance = kLimit;
    CanvasPoint point;
};
Nearest nearest_to(const std::vector<CanvasSegment>& curves, double x, double y) {
    Nearest best;
    for (const CanvasSegment& s : curves) {
        const CurveDistance found = nearest_below(s, x, y, {best.distance, 0});
        if (found.distance < best.distance) best = {found.distance, bezier::point_at(s, found.t)};
    }
    return best;
}

/// All corners of the point's texel are nearest to one stretch of curve, nearly straight: no medial axis, no end. From
/// gradients that aren't smoothed.
bool is_plain(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j, FeaturePoint p, const Nearest& nearest) {
    const double nx = (i + p.x - nearest.point.x) / nearest.distance,
                 ny = (j + p.y - nearest.point.y) / nearest.distance;
    for (const std::uint32_t c : {0u, 1u, 2u, 3u}) {
        const std::uint32_t x = i + (c & 1), y = j + (c >> 1);
        const double from_line = (x - nearest.point.x) * nx + (y - nearest.point.y) * ny;
        const fetex::FeatureVector g = fetex::feature_gradient(t, x, y);
        const double cosine = (g.x * nx + g.y * ny) * (from_line < 0 ? -1 : 1);
        if (std::abs(fetex::feature_distance(t, x, y) - std::abs(from_line)) > kStraight || !(cosine >= kSameWay))
            return false;
    }
    return true;
}

SegmentedTexel texel_of(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j) {
    SegmentedTexel out;
    out.segments = fetex::feature_unpack(t.configurations[std::size_t{j} * t.width + i]);
    for (std::uint32_t k = 0; k < out.segments.count; ++k)
        out.curves[k] = fetex::feature_segment_curve(t, i, j, k);
    for (std::uint32_t c = 0; c < 4; ++c)
        out.distances[c] = fetex::feature_distance(t, i + (c & 1), j + (c >> 1));
    return out;
}

/// Curves that should cross once, or not at all but in a shared end, do so.
bool meet_as_they_should(const SegmentedTexel& t) {
    using fetex::FeatureSegment;
    const bool across =
        t.segments.segment[0] == FeatureSegment{North, South} && t.segments.segment[1] == FeatureSegment{East, West};
    if (t.segments.count < 2 || across) return true;
    const FeatureQuadratic &a = t.curves[0], &b = t.curves[1];
    // By chords, which is close enough to choose what is measured.
    constexpr int kChords = 32;
    const auto at = [](const FeatureQuadratic& q, int k) {
        return fetex::feature_curve_at(q, 1e-4 + (1 - 2e-4) * k / kChords);
    };
    const auto side = [](FeaturePoint p, FeaturePoint q, FeaturePoint r) {
        return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x) > 0;
    };
    for (int m = 0; m < kChords; ++m)
        for (int n = 0; n < kChords; ++n) {
            const FeaturePoint p = at(a, m), q = at(a, m + 1), r = at(b, n), s = at(b, n + 1);
            if (side(p, q, r) != side(p, q, s) && side(r, s, p) != side(r, s, q)) return false;
        }
    return true;
}

/// A texture of one texel with this configuration, curves bent wherever the signature is valid; distances exact.
FeatureCurvesTexture random_texture(Random& random, fetex::FeatureConfiguration c) {
    FeatureCurvesTexture t = fetex::feature_empty_texture(1, 1, fetex::FeatureNumberFormat::Float, false, kLimit);
    const fetex::FeatureSegmentList list = fetex::feature_unpack(c);
    const auto put = [&](FeatureEdge e) {
        const fetex::FeatureCrossing at{random.between(kFromCorner, 1 - kFromCorner),
                                        random.between(0, std::numbers::pi)};
        fetex::feature_set_crossing(t, e == East, e == South, e == East || e == West ? West : North, at);
    };
    for (const FeatureEdge e : fetex::kFeatureEdges)
        if (std::ranges::any_of(list, [&](auto s) { return s.first == e || s.second == e; })) put(e);
    const fetex::FeatureSignature signature = fetex::feature_signature(t, 0, 0);
    std::array<bool, 2> straight{};
    for (std::uint32_t k = 0; k < list.count; ++k) {
        const auto q = fetex::feature_curve(signature, list.segment[k], false);
        straight[k] = !q || fault_of({q->b0, q->b1, q->b2}) != SignatureFault::None;
    }
    if (list.count == 1) straight[1] = straight[0];
    t.configurations[0] = fetex::feature_pack(list.segment[0], list.segment[1], straight[0], straight[1]);
    std::vector<CanvasSegment> curves;
    for (std::uint32_t k = 0; k < list.count; ++k)
        curves.push_back(canvas(fetex::feature_segment_curve(t, 0, 0, k)));
    for (const std::uint32_t corner : {0u, 1u, 2u, 3u})
        fetex::feature_set_distance(t, corner & 1, corner >> 1, nearest_to(curves, corner & 1, corner >> 1).distance);
    return t;
}

struct Errors {
    std::vector<double> all;
    [[nodiscard]] double mean() const {
        double sum = 0;
        for (const double e : all)
            sum += e;
        return sum / static_cast<double>(all.size());
    }
    [[nodiscard]] double high() { // 99 % are below
        std::ranges::sort(all);
        return all[all.size() * 99 / 100];
    }
};

/// Of signatures: those whose curves meet as they should.
struct Counts {
    int valid = 0, crossed = 0, zero = 0, no_ray = 0, good = 0;
    Errors rays, triangles;             ///< of good ones
    Errors rays_all, triangles_all;     ///< of all that have a distance
    Errors rays_plain, triangles_plain; ///< of good ones, of plain points
};

void measure(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j, const std::vector<CanvasSegment>& curves,
             Random& random, Counts& out) {
    const SegmentedTexel texel = texel_of(t, i, j);
    if (!meet_as_they_should(texel)) return;
    ++out.valid;
    const EightTriangles triangles(texel);
    struct Error {
        double rays = 0, triangles = 0;
        bool plain = false;
    };
    std::vector<Error> errors;
    bool no_ray = false;
    for (int n = 0; n < kPoints; ++n) {
        const FeaturePoint p{random.unit(), random.unit()};
        const Nearest nearest = nearest_to(curves, i + p.x, j + p.y);
        const double exact = nearest.distance;
        const std::optional<double> d = triangles.distance(p);
        no_ray = no_ray || !d;
        if (exact > 1 || !d) continue;
        errors.push_back({std::abs(fetex::feature_at_local(t, i, j, p.x, p.y).distance - exact), std::abs(*d - exact),
                          exact > 0 && is_plain(t, i, j, p, nearest)});
    }
    const bool crossed = !triangles.well_formed(), zero = triangles.has_area_of_zero();
    out.crossed += crossed, out.zero += zero, out.no_ray += no_ray && !crossed;
    const bool good = !crossed && !zero && !no_ray;
    out.good += good;
    for (const Error& e : errors) {
        out.rays_all.all.push_back(e.rays), out.triangles_all.all.push_back(e.triangles);
        if (!good) continue;
        out.rays.all.push_back(e.rays), out.triangles.all.push_back(e.triangles);
        if (e.plain) out.rays_plain.all.push_back(e.rays), out.triangles_plain.all.push_back(e.triangles);
    }
}

void print(const char* what, Counts& c) {
    std::printf("%s: %d signatures, %d crossed, %d with an area of 0, %d without a ray, %d good\n", what, c.valid,
                c.crossed, c.zero, c.no_ray, c.good);
    std::printf("  good ones: rays %.4f (99 %% below %.4f), eight triangles %.4f (%.4f)\n", c.rays.mean(),
                c.rays.high(), c.triangles.mean(), c.triangles.high());
    if (!c.rays_plain.all.empty())
        std::printf("  of them %zu plain points: rays %.5f (%.5f), eight triangles %.5f (%.5f)\n",
                    c.rays_plain.all.size(), c.rays_plain.mean(), c.rays_plain.high(), c.triangles_plain.mean(),
                    c.triangles_plain.high());
    std::printf("  all: rays %.4f (%.4f), eight triangles %.4f (%.4f)\n", c.rays_all.mean(), c.rays_all.high(),
                c.triangles_all.mean(), c.triangles_all.high());
}

void expect_no_worse(Errors& rays, Errors& triangles) {
    EXPECT_LE(rays.mean(), triangles.mean());
    EXPECT_LE(rays.high(), triangles.high());
}

TEST(FeatureTriangles, raysAreNoWorseOnRandomSignatures) {
    Random random(1);
    Counts one, two;
    for (const fetex::FeatureConfiguration c : fetex::feature_configurations()) {
        const std::uint32_t count = fetex::feature_unpack(c).count;
        for (int n = 0; n < kSignatures && count > 0; ++n) {
            const FeatureCurvesTexture t = random_texture(random, c);
            std::vector<CanvasSegment> curves;
            for (std::uint32_t k = 0; k < count; ++k)
                curves.push_back(canvas(fetex::feature_segment_curve(t, 0, 0, k)));
            measure(t, 0, 0, curves, random, count == 1 ? one : two);
        }
    }
    print("one segment", one), print("two segments", two);
    for (Counts* c : {&one, &two})
        expect_no_worse(c->rays, c->triangles), expect_no_worse(c->rays_all, c->triangles_all);
    EXPECT_GT(one.crossed, one.valid / 10);
    EXPECT_GT(two.crossed, two.valid / 10);
    EXPECT_GT(two.zero, two.valid / 2);
    EXPECT_GT(std::min(one.good, two.good), 100);
    EXPECT_EQ(one.no_ray + two.no_ray, 0); // as the paper says
}

/// Where corners of a texel are nearest to different curves, neither follows the medial axis: there rays are a little
/// worse than good triangles.
TEST(FeatureTriangles, raysAreNoWorseOnNetworksAwayFromMedialAxes) {
    constexpr std::uint32_t kSide = 64;
    for (const auto& [degree, count] : {std::pair(1, 6), {1, 20}, {2, 6}, {2, 20}, {3, 6}}) {
        Random random(static_cast<std::uint64_t>(degree));
        Network network{kSide, kSide, {}};
        for (int k = 0; k < count; ++k) {
            CanvasSegment s{degree, {}};
            for (std::size_t at = 0; at <= static_cast<std::size_t>(degree); ++at)
                s.p[at] = {random.between(0, kSide), random.between(0, kSide)};
            network.curves.push_back({"", {s}, false, "", {}, {}});
        }
        FeatureCurvesOptions options;
        options.size = {kSide, kSide}, options.limit = kLimit, options.numbers = fetex::FeatureNumberFormat::Float;
        options.smooth = 0;
        const FeatureCurvesBuild build = compile_feature_curves(network, options).value();
        const TextureSegments segments(build.texture);
        std::vector<CanvasSegment> curves;
        const auto for_each_texel = [&](const auto& visit) {
            for (std::uint32_t j = 0; j < kSide; ++j)
                for (std::uint32_t i = 0; i < kSide; ++i)
                    if (build.texture.configurations[std::size_t{j} * kSide + i] != 0) visit(i, j);
        };
        for_each_texel([&](std::uint32_t i, std::uint32_t j) {
            segments.visit_texel(i, j, [&](const TextureSegment& s) { curves.push_back(curve_of(s)); });
        });
        Counts counts;
        for_each_texel([&](std::uint32_t i, std::uint32_t j) { measure(build.texture, i, j, curves, random, counts); });
        print((std::to_string(count) + " curves of degree " + std::to_string(degree)).c_str(), counts);
        expect_no_worse(counts.rays_plain, counts.triangles_plain);
        EXPECT_LE(counts.rays_all.mean(), counts.triangles_all.mean());
        EXPECT_LE(counts.rays.mean(), kNearAxes * counts.triangles.mean());
        EXPECT_LE(counts.rays.high(), kNearAxes * counts.triangles.high());
        EXPECT_GT(counts.zero, 0);
    }
}

/// Both are 0 on curves, and have no jumps, where the triangles are what they should be.
TEST(FeatureTriangles, bothAreZeroOnCurvesAndContinuous) {
    Random random(2);
    int tried = 0;
    for (const fetex::FeatureConfiguration c : fetex::feature_configurations()) {
        for (int n = 0; n < kSignatures && c != 0; ++n) {
            const FeatureCurvesTexture t = random_texture(random, c);
            const SegmentedTexel texel = texel_of(t, 0, 0);
            const EightTriangles triangles(texel);
            if (!meet_as_they_should(texel) || !triangles.well_formed()) continue;
            const auto both = [&](FeaturePoint p) {
                const double rays = fetex::feature_at_local(t, 0, 0, p.x, p.y).distance;
                return std::array{rays, triangles.distance(p).value_or(rays)};
            };
            for (std::uint32_t k = 0; k < texel.segments.count; ++k) {
                for (double u = 1.0 / 64; u < 1; u += 1.0 / 64) {
                    const auto [rays, eight] = both(fetex::feature_curve_at(texel.curves[k], u));
                    EXPECT_LE(rays, kOnCurve) << fetex::feature_name(c) << ' ' << u;
                    EXPECT_LE(std::abs(eight), kOnCurve) << fetex::feature_name(c) << ' ' << u;
                    ++tried;
                }
            }
            for (int m = 0; m < kPoints; ++m) {
                // Bisects to where the distance changes most between two points of a line.
                FeaturePoint a{random.unit(), random.unit()}, b{random.unit(), random.unit()};
                for (std::size_t which : {0u, 1u}) {
                    FeaturePoint from = a, to = b;
                    double left = both(from)[which], right = both(to)[which];
                    while (std::hypot(to.x - from.x, to.y - from.y) > kStep) {
                        const FeaturePoint middle{(from.x + to.x) / 2, (from.y + to.y) / 2};
                        const double value = both(middle)[which];
                        if (std::abs(value - left) > std::abs(right - value))
                            to = middle, right = value;
                        else
                            from = middle, left = value;
                    }
                    EXPECT_LE(std::abs(right - left), kStep * kSteepest) << fetex::feature_name(c) << ' ' << which;
                }
            }
        }
    }
    EXPECT_GT(tried, 10000);
}

/// All pairs of segments but those that cut two neighbouring corners off: a triangle has its three vertices on curves,
/// and no curve for one of its sides. Between edges' middles that is an eighth of the texel at least; rays have no such
/// area.
TEST(FeatureTriangles, mostPairsOfSegmentsHaveAnAreaOfZero) {
    constexpr int kRow = 40;
    int areas = 0;
    for (const fetex::FeatureConfiguration c : fetex::feature_configurations()) {
        if (c == 0) continue;
        FeatureCurvesTexture t = fetex::feature_empty_texture(1, 1, fetex::FeatureNumberFormat::Float, true, kLimit);
        t.configurations[0] = c;
        const EightTriangles triangles(texel_of(t, 0, 0));
        int zeros = 0;
        for (int n = 0; n < kRow * kRow; ++n) {
            const FeaturePoint p{(n % kRow + 0.3) / kRow, (n / kRow + 0.6) / kRow}; // on no segment
            zeros += std::abs(triangles.distance(p).value()) < kOnCurve;
            EXPECT_GT(fetex::feature_at_local(t, 0, 0, p.x, p.y).distance, kOnCurve) << fetex::feature_name(c);
        }
        areas += triangles.has_area_of_zero();
        EXPECT_EQ(zeros >= kRow * kRow / 10, triangles.has_area_of_zero()) << fetex::feature_name(c);
        EXPECT_EQ(zeros > 0, triangles.has_area_of_zero()) << fetex::feature_name(c);
    }
    EXPECT_EQ(areas, 11);
}

/// The curve of SPEC.md, 9.4.
TEST(FeatureTriangles, aBulgingCurveCrossesTheirSides) {
    SegmentedTexel t;
    t.segments = fetex::feature_unpack(fetex::feature_pack({North, South}, {North, South}));
    t.curves[0] = {{0.5, 0}, {0.95, 0.1}, {0.5, 1}, false};
    EXPECT_FALSE(EightTriangles(t).well_formed());
    t.curves[0].b1 = {0.6, 0.5};
    EXPECT_TRUE(EightTriangles(t).well_formed());
}

} // namespace
} // namespace fetexc
