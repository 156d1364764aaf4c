// SPDX-License-Identifier: GPL-3.0-or-later
/// Snapping of quadratics on random networks: valid signatures, curves within the distance reported, valid input
/// unchanged.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "compiler/feature_curves/signatures.h"
#include "compiler/feature_curves/snapping.h"
#include "tests/support/random.h"

namespace fetexc {
namespace {

using fetex::FeatureEdge;
using fetex::FeaturePoint;
using test::Random;

/// Runs of lines, quadratics and cubics, smooth or with corners; every other network on multiples of a quarter texel.
Network random_network(Random& random, std::uint32_t width, std::uint32_t height) {
    Network network{static_cast<double>(width), static_cast<double>(height), {}};
    const double step = random.chance(0.5) ? 0.25 : 0;
    const auto rounded = [&](double v) { return step > 0 ? std::round(v / step) * step : v; };
    const int runs = random.integer(1, 12);
    for (int n = 0; n < runs; ++n) {
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
            s.degree = random.integer(1, 3);
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

TEST(FeatureQuadratics, randomNetworksBecomeValidSignatures) {
    SnapStats sum;
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const auto width = static_cast<std::uint32_t>(random.integer(1, 16)),
                   height = static_cast<std::uint32_t>(random.integer(1, 16));
        const LatticeCurves curves = lattice_curves(random_network(random, width, height)).value();
        const SnappedCurves snapped = snap_quadratics(curves, width, height);
        for (std::uint32_t j = 0; j < height; ++j)
            for (std::uint32_t i = 0; i < width; ++i)
                EXPECT_FALSE(has_fault(snapped, i, j));
        const SnapStats& s = snapped.stats;
        sum.lines += s.lines, sum.crossings += s.crossings, sum.segments += s.segments, sum.rerouted += s.rerouted;
        sum.curved += s.curved, sum.invalid += s.invalid, sum.problems += s.problems, sum.fitted += s.fitted;
        sum.straightened += s.straightened, sum.folded += s.folded, sum.ends_cut += s.ends_cut;
        if (HasFailure()) break;
    }
    std::printf("lines %lu crossings %lu segments %lu rerouted %lu curved %lu invalid %lu problems %lu fitted %lu "
                "straightened %lu folded %lu ends %lu\n",
                sum.lines, sum.crossings, sum.segments, sum.rerouted, sum.curved, sum.invalid, sum.problems, sum.fitted,
                sum.straightened, sum.folded, sum.ends_cut);
}

} // namespace
} // namespace fetexc
