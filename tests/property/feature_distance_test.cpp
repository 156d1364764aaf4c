// SPDX-License-Identifier: GPL-3.0-or-later
/// The reference sampler's distance against the exact one to the texture's curves, within a texel of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "compiler/feature_curves/distance_map.h"
#include "compiler/feature_curves/feature_curves_builder.h"
#include "compiler/scene/curve_distance.h"
#include "formats/feature_sampler.h"
#include "tests/support/random.h"

namespace fetexc {
namespace {

using test::Random;

constexpr std::uint32_t kSide = 64;
constexpr double kNear = 1;       // texels
constexpr double kStraight = 0.1; // texels a corner may be off the distance that a line through the nearest point has
constexpr double kSameWay = 0.9;  // cosine between its gradient and the line's normal

Network random_network(Random& random, int degree, int curves) {
    Network n{kSide, kSide, {}};
    const auto point = [&] { return CanvasPoint{random.between(0, kSide), random.between(0, kSide)}; };
    for (int k = 0; k < curves; ++k) {
        CanvasSegment s{degree, {}};
        for (int at = 0; at <= degree; ++at)
            s.p[static_cast<std::size_t>(at)] = point();
        n.curves.push_back({"", {s}, false, "", {}, {}});
    }
    return n;
}

struct Nearest {
    double distance = 2 * kSide;
    CanvasPoint point;
};

Nearest nearest_to(const std::vector<CanvasSegment>& curves, CanvasPoint p) {
    Nearest best;
    for (const CanvasSegment& s : curves) {
        const CurveDistance found = nearest_below(s, p.x, p.y, {best.distance, 0});
        if (!(found.distance < best.distance)) continue;
        CanvasSegment part = s; // de Casteljau
        for (int level = s.degree; level > 0; --level)
            for (std::size_t k = 0; k < static_cast<std::size_t>(level); ++k)
                part.p[k] = {std::lerp(part.p[k].x, part.p[k + 1].x, found.t),
                             std::lerp(part.p[k].y, part.p[k + 1].y, found.t)};
        best = {found.distance, part.p[0]};
    }
    return best;
}

/// All four corners of the point's texel are nearest to one stretch of curve, nearly straight: no medial axis, no end.
bool is_plain(const DistanceMap& map, CanvasPoint p, const Nearest& nearest) {
    if (!(nearest.distance > 0)) return false;
    const double nx = (p.x - nearest.point.x) / nearest.distance, ny = (p.y - nearest.point.y) / nearest.distance;
    const auto i = static_cast<std::uint32_t>(p.x), j = static_cast<std::uint32_t>(p.y);
    for (const auto& [x, y] : {std::pair(i, j), {i + 1, j}, {i, j + 1}, {i + 1, j + 1}}) {
        const std::size_t at = std::size_t{y} * (kSide + 1) + x;
        const double signed_distance = (x - nearest.point.x) * nx + (y - nearest.point.y) * ny;
        const double cosine = (map.gradients[at].x * nx + map.gradients[at].y * ny) * (signed_distance < 0 ? -1 : 1);
        if (std::abs(map.distances[at] - std::abs(signed_distance)) > kStraight || cosine < kSameWay) return false;
    }
    return true;
}

std::vector<double> errors_of(Random& random, const Network& network) {
    FeatureCurvesOptions options;
    options.size = {kSide, kSide}, options.limit = 4, options.smooth = 0;
    const auto built = compile_feature_curves(network, options);
    EXPECT_TRUE(built.ok());
    const fetex::FeatureCurvesTexture& t = built.value().texture;
    const TextureSegments segments(t);
    const DistanceMap map = distance_map(segments, options.limit, 1);
    std::vector<CanvasSegment> curves;
    for (std::uint32_t j = 0; j < kSide; ++j)
        for (std::uint32_t i = 0; i < kSide; ++i)
            segments.visit_texel(i, j, [&](const TextureSegment& s) { curves.push_back(curve_of(s)); });
    std::vector<double> errors;
    for (int k = 0; k < 4000; ++k) {
        const CanvasPoint p{random.between(0, kSide), random.between(0, kSide)};
        const Nearest nearest = nearest_to(curves, p);
        if (nearest.distance > kNear || !is_plain(map, p, nearest)) continue;
        errors.push_back(std::abs(fetex::feature_at(t, p.x, p.y).distance - nearest.distance));
    }
    return errors;
}

TEST(FeatureDistance, isNearTheExactOneAwayFromMedialAxes) {
    for (const auto& [degree, curves] : {std::pair(1, 6), {1, 20}, {2, 6}, {3, 6}}) {
        Random random(static_cast<std::uint64_t>(10 * degree + curves));
        std::vector<double> errors;
        for (int n = 0; n < 4; ++n) {
            const std::vector<double> more = errors_of(random, random_network(random, degree, curves));
            errors.insert(errors.end(), more.begin(), more.end());
        }
        ASSERT_GT(errors.size(), 500u);
        std::ranges::sort(errors);
        double sum = 0;
        for (const double e : errors)
            sum += e;
        const double mean = sum / static_cast<double>(errors.size()), high = errors[errors.size() * 99 / 100];
        RecordProperty("mean" + std::to_string(degree) + "_" + std::to_string(curves), std::to_string(mean));
        EXPECT_LE(mean, 0.02) << degree << ' ' << curves;
        EXPECT_LE(high, 0.1) << degree << ' ' << curves;
        std::printf("degree %d, %d curves: %zu points, mean %.5f, 99 %% below %.4f, most %.4f texels\n", degree, curves,
                    errors.size(), mean, high, errors.back());
    }
}

} // namespace
} // namespace fetexc
