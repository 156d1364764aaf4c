// SPDX-License-Identifier: GPL-3.0-or-later
/// Pairs that come to exact arithmetic: nearly the same, at ends of stretches, or known already. What the certificates
/// say is what exclusion with CGAL's roots says.
#include <gtest/gtest.h>

#include <algorithm>

#include "compiler/geometry/exact.h"
#include "compiler/geometry/monotone.h"
#include "tests/support/random.h"

namespace fetexc::test {
namespace {

const Interval kWhole{0, 1};

Stretch stretch_of(const Curve& c, const Interval& range) {
    const auto grows = [&](Axis axis) { return value_double(c, axis, range.lo) <= value_double(c, axis, range.hi); };
    return {&c, range, grows(Axis::X), grows(Axis::Y)};
}

std::vector<ExactHit> common_points(const Stretch& a, const Stretch& b, std::span<const Contact> known = {}) {
    std::vector<ExactHit> hits;
    EXPECT_EQ(intersect_exact(a, b, hits, known), ExactOutcome::Done);
    return hits;
}

void expect_as_by_kernel(const Stretch& a, const Stretch& b, const std::string& name) {
    std::vector<ExactHit> expected;
    ASSERT_EQ(intersect_by_kernel(a, b, expected), ExactOutcome::Done) << name;
    const std::vector<ExactHit> hits = common_points(a, b);
    ASSERT_EQ(hits.size(), expected.size()) << name;
    for (const ExactHit& e : expected) {
        EXPECT_TRUE(std::any_of(hits.begin(), hits.end(), [&](const ExactHit& h) {
            return h.s.overlaps(e.s) && h.t.overlaps(e.t);
        })) << name;
    }
}

TEST(IntersectExact, ArcsOfOneEllipseCrossSeveralTimes) {
    // Pieces of a stroked ellipse, each a cubic of its own, that overlap in half of their length.
    const Curve a = make_curve(3, {{{0, 184954}, {0, 280096}, {558327, 368009}, {1464672, 415580}}}),
                b = make_curve(3, {{{392458, 51801}, {-130823, 134196}, {-130823, 235711}, {392458, 318106}}}),
                c = make_curve(3, {{{392458, 318106}, {915739, 400501}, {1882793, 451259}, {2929355, 451259}}});
    const Stretch upper = stretch_of(b, {std::nextafter(0.5, 0), 1});
    EXPECT_EQ(common_points(stretch_of(a, kWhole), upper).size(), 3u);
    EXPECT_EQ(common_points(stretch_of(a, kWhole), stretch_of(c, kWhole)).size(), 3u);
    expect_as_by_kernel(stretch_of(a, kWhole), upper, "a, upper half of b");
    expect_as_by_kernel(stretch_of(a, kWhole), stretch_of(c, kWhole), "a, c");
}

TEST(IntersectExact, NearlyEqualCubicsMeetWhereTheKernelSays) {
    std::size_t crossings = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        std::array<IntPoint, 4> p{}, q{};
        for (std::size_t i = 0; i < p.size(); ++i) { // monotone
            p[i] = {static_cast<std::int64_t>(i << 20) + random.integer(0, 1 << 18), random.integer(0, 1 << 18)};
            if (i > 0) p[i].y += p[i - 1].y;
            q[i] = {p[i].x + random.integer(-3, 3), p[i].y + random.integer(-3, 3)};
        }
        const Curve a = make_curve(3, p), b = make_curve(3, q);
        expect_as_by_kernel(stretch_of(a, kWhole), stretch_of(b, kWhole), "seed " + std::to_string(seed));
        crossings += common_points(stretch_of(a, kWhole), stretch_of(b, kWhole)).size();
    }
    EXPECT_GT(crossings, 20u);
}

TEST(IntersectExact, CrossingsJustBeyondAStretchAreNotItsOwn) {
    constexpr std::int64_t size = std::int64_t{1} << 30;
    const Curve arc = make_curve(2, {{{0, 0}, {size / 2, size}, {size, 0}, {}}}); // x = size·t
    for (const int bits : {12, 17, 18, 20, 24}) {
        for (const std::int64_t side : {-1, 1}) {
            const std::int64_t x = 3 * size / 4 + side * (size >> bits);
            const Curve line = make_curve(1, {{{x, -size}, {x, size}, {}, {}}});
            const auto crossings = [&](const Interval& range) {
                return common_points(stretch_of(arc, range), stretch_of(line, kWhole)).size();
            };
            EXPECT_EQ(crossings({0.5, 1}), 1u) << bits;
            EXPECT_EQ(crossings({0.5, 0.75}), side < 0 ? 1u : 0u) << bits;
            EXPECT_EQ(crossings({0.75, 1}), side < 0 ? 0u : 1u) << bits;
        }
    }
}

TEST(IntersectExact, ACrossingInTheMiddleIsExactlyThere) {
    const Curve a = make_curve(3, {{{0, 0}, {100, 300}, {200, -100}, {300, 200}}}),
                b = make_curve(3, {{{0, 200}, {100, -100}, {200, 300}, {300, 0}}}); // its mirror image
    const std::vector<ExactHit> hits = common_points(stretch_of(a, {0.25, 0.75}), stretch_of(b, {0.25, 0.75}));
    ASSERT_EQ(hits.size(), 1u);
    EXPECT_TRUE(hits[0].narrow.s.lo <= 0.5 && hits[0].narrow.s.hi >= 0.5);
    EXPECT_TRUE(hits[0].narrow.t.lo <= 0.5 && hits[0].narrow.t.hi >= 0.5);
}

TEST(IntersectExact, ATangencyAtAKnownEndIsNoOther) {
    // A quarter round that ends on an upright line, tangent to it.
    const Curve line = make_curve(1, {{{1354061191, 2097152}, {1354061191, 9087659}, {}, {}}}),
                round = make_curve(
                    3, {{{1201524527, 3120888}, {1299192090, 3776375}, {1354061191, 4665406}, {1354061191, 5592405}}});
    const Stretch a = stretch_of(line, kWhole), b = stretch_of(round, kWhole);
    const std::vector<ExactHit> unknown = common_points(a, b);
    ASSERT_EQ(unknown.size(), 1u);
    EXPECT_TRUE(unknown[0].t.contains(1));
    const std::array<Contact, 1> known{{{unknown[0].s, Interval(1)}}};
    EXPECT_TRUE(common_points(a, b, known).empty());
}

} // namespace
} // namespace fetexc::test
