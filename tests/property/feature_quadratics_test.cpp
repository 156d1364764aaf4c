// SPDX-License-Identifier: GPL-3.0-or-later
/// Snapping of quadratics: valid signatures, curves within the distance reported, valid input unchanged. Tens of
/// thousands of networks more: tests/stress.
#include <algorithm>

#include "compiler/planar/grid.h"
#include "tests/support/quadratic_check.h"

namespace fetexc {
namespace {

using fetex::FeatureEdge;
using fetex::FeaturePoint;
using test::Random;
using enum fetex::FeatureEdge;

TEST(FeatureQuadratics, randomNetworksBecomeValidSignaturesAsNearAsReported) {
    SnapStats sum;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const auto width = static_cast<std::uint32_t>(random.integer(1, 16)),
                   height = static_cast<std::uint32_t>(random.integer(1, 16));
        const LatticeCurves curves = lattice_curves(test::random_curve_network(random, width, height)).value();
        const SnappedCurves snapped = snap_quadratics(curves, width, height);
        test::check_snapped(curves, snapped);
        sum.curved += snapped.stats.curved, sum.invalid += snapped.stats.invalid;
        sum.fitted += snapped.stats.fitted, sum.straightened += snapped.stats.straightened;
        if (HasFailure()) break;
    }
    EXPECT_GT(sum.curved, 5000u);
    EXPECT_GT(sum.fitted, 1000u);
    EXPECT_LT(sum.straightened, sum.curved / 5);
}

/// Any valid curves: drawn, they are what comes back, and nothing is said to have moved.
TEST(FeatureQuadratics, whatIsValidComesBackUnchanged) {
    const auto configurations = fetex::feature_configurations();
    constexpr std::uint32_t kSide = 8;
    // Well-conditioned: the lattice has 2^23 steps a texel.
    constexpr double kLeastHandle = 0.1, kLeastTurn = 0.2, kRounding = 1e-5;
    std::uint64_t drawn = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        SnappedCurves wanted;
        wanted.width = wanted.height = kSide;
        for (std::uint32_t k = 0; k < (kSide + 1) * (kSide + 1); ++k) {
            wanted.north.push_back(std::floor(random.between(1, 64)) / 64);
            wanted.west.push_back(std::floor(random.between(1, 64)) / 64);
            wanted.north_angle.push_back(random.between(0, std::numbers::pi));
            wanted.west_angle.push_back(random.between(0, std::numbers::pi));
        }
        wanted.texels.resize(kSide * kSide);
        Network network{kSide, kSide, {}};
        const auto is_good = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
            const ShownSegment s = shown_segment(wanted, i, j, k);
            const double first = std::hypot(s.curve[1].x - s.curve[0].x, s.curve[1].y - s.curve[0].y),
                         last = std::hypot(s.curve[1].x - s.curve[2].x, s.curve[1].y - s.curve[2].y);
            return s.fault == SignatureFault::None && std::min(first, last) > kLeastHandle &&
                   test::angle_between(test::tangent_angle(s.curve, false), test::tangent_angle(s.curve, true)) >
                       kLeastTurn;
        };
        for (std::uint32_t j = 0; j < kSide; ++j) {
            for (std::uint32_t i = 0; i < kSide; ++i) {
                SnappedTexel& t = wanted.texels[j * kSide + i];
                for (int tries = 0; tries < 30; ++tries) {
                    t.segments = t.curved =
                        segment_set(configurations[static_cast<std::size_t>(random.integer(1, 21))]);
                    bool good = true;
                    for (std::uint32_t k = 0; k < fetex::kFeatureSegmentCount; ++k)
                        good = good && ((t.segments >> k & 1u) == 0 || is_good(i, j, k));
                    if (good) break;
                    t.segments = t.curved = 0;
                }
                for (std::uint32_t k = 0; k < fetex::kFeatureSegmentCount; ++k) {
                    if ((t.segments >> k & 1u) == 0) continue;
                    const SegmentCurve s = shown_segment(wanted, i, j, k).curve;
                    const auto at = [&](FeaturePoint p) -> CanvasPoint { return {i + p.x, j + p.y}; };
                    network.curves.push_back({});
                    network.curves.back().segments = {{2, {at(s[0]), at(s[1]), at(s[2])}}};
                    ++drawn;
                }
            }
        }
        const SnappedCurves got = snap_quadratics(lattice_curves(network).value(), kSide, kSide);
        EXPECT_TRUE(got.moves.empty());
        EXPECT_EQ(got.stats.invalid, 0u);
        for (std::uint32_t j = 0; j < kSide; ++j) {
            for (std::uint32_t i = 0; i < kSide; ++i) {
                EXPECT_EQ(got.texel(i, j).segments, wanted.texel(i, j).segments) << "texel " << i << " " << j;
                EXPECT_EQ(got.texel(i, j).curved, wanted.texel(i, j).curved) << "texel " << i << " " << j;
                for (const FeatureEdge e : fetex::kFeatureEdges) {
                    if (!wanted.is_used(i, j, e)) continue;
                    EXPECT_EQ(got.position(i, j, e), wanted.position(i, j, e));
                    EXPECT_LE(test::angle_between(got.angle(i, j, e), wanted.angle(i, j, e)), kRounding);
                }
            }
        }
        if (HasFailure()) break;
    }
    EXPECT_GT(drawn, 1000u);
}

/// A network of lines has the same configurations and points either way, and stays straight but around corners.
TEST(FeatureQuadratics, linesSnapAsLinesDo) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        constexpr std::uint32_t kSide = 12;
        Network network{kSide, kSide, {}};
        for (int n = random.integer(1, 20); n > 0; --n) {
            const auto anywhere = [&]() -> CanvasPoint { return {random.between(-1, 13), random.between(-1, 13)}; };
            NetworkCurve curve;
            curve.segments = {{1, {anywhere(), anywhere()}}};
            network.curves.push_back(std::move(curve));
        }
        const SnappedCurves lines = snap_lines(lattice_lines(network, kSide, kSide).value(), kSide, kSide),
                            curves = snap_quadratics(lattice_curves(network).value(), kSide, kSide);
        EXPECT_EQ(lines.north, curves.north);
        EXPECT_EQ(lines.west, curves.west);
        for (std::size_t k = 0; k < lines.texels.size(); ++k) {
            EXPECT_EQ(lines.texels[k].segments, curves.texels[k].segments);
            EXPECT_EQ(curves.texels[k].curved, 0);
        }
        EXPECT_EQ(curves.stats.invalid, 0u);
    }
}

bool same(const SnappedCurves& a, const SnappedCurves& b) {
    const auto texels = [](const SnappedTexel& s, const SnappedTexel& t) {
        return s.segments == t.segments && s.curved == t.curved && s.kinds == t.kinds;
    };
    const auto moves = [](const FeatureMove& s, const FeatureMove& t) {
        return s.i == t.i && s.j == t.j && s.kinds == t.kinds && s.distance == t.distance;
    };
    return a.north == b.north && a.west == b.west && a.north_angle == b.north_angle && a.west_angle == b.west_angle &&
           std::ranges::equal(a.texels, b.texels, texels) && std::ranges::equal(a.moves, b.moves, moves);
}

TEST(FeatureQuadratics, anyNumberOfThreadsGivesTheSame) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const LatticeCurves curves = lattice_curves(test::random_curve_network(random, 16, 16)).value();
        const SnappedCurves one = snap_quadratics(curves, 16, 16, 1);
        for (const unsigned threads : {2u, 0u})
            EXPECT_TRUE(same(one, snap_quadratics(curves, 16, 16, threads)));
    }
}

} // namespace
} // namespace fetexc
