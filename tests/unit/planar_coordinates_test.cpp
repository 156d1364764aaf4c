// SPDX-License-Identifier: GPL-3.0-or-later
/// Coordinates as algebraic numbers: equal ones of mirror images, and neighbours of them.
#include <gtest/gtest.h>

#include <algorithm>

#include "compiler/planar/algebraic_coordinate.h"
#include "compiler/planar/exact_points.h"
#include "tests/support/random.h"

namespace fetexc::test {
namespace {

/// The ordinate of a cubic where its abscissa is `at`.
AlgebraicCoordinate ordinate(const Curve& c, std::int64_t at) {
    AlgebraicCoordinate out;
    out.curve = &c;
    out.axis = Axis::Y;
    out.parameter = {minus(power_basis(c, Axis::X), to_mpz(at)), 0, 1};
    return out;
}

Curve cubic(std::array<IntPoint, 4> p, std::int64_t up = 0) {
    for (IntPoint& q : p)
        q.y += up;
    return make_curve(3, p);
}

constexpr std::array<IntPoint, 4> kRising{{{0, 24598266}, {99627, 24540746}, {212640, 24510464}, {327680, 24500464}}};
constexpr std::int64_t kWidth = 2 * 327680;

/// x → width − x; run the same way, or the other way.
std::array<IntPoint, 4> mirrored(std::array<IntPoint, 4> p, bool reversed) {
    for (IntPoint& q : p)
        q.x = kWidth - q.x;
    if (reversed) std::reverse(p.begin(), p.end());
    return p;
}

TEST(AlgebraicCoordinate, MirrorImagesAreLevel) {
    const Curve c = cubic(kRising);
    for (const bool reversed : {false, true}) {
        for (const std::int64_t up : {-1, 0, 1}) {
            const Curve image = cubic(mirrored(kRising, reversed), up);
            const AlgebraicCoordinate a = ordinate(c, 163841), b = ordinate(image, kWidth - 163841);
            EXPECT_EQ(compare(a, b), static_cast<int>(-up)) << reversed;
            EXPECT_EQ(compare(b, a), static_cast<int>(up)) << reversed;
        }
    }
}

TEST(AlgebraicCoordinate, OneCurveAtTwoPlacesIsNotLevel) {
    const Curve c = cubic(kRising), image = cubic(mirrored(kRising, true));
    EXPECT_EQ(compare(ordinate(c, 163841), ordinate(c, 163842)), 1) << "it falls";
    EXPECT_EQ(compare(ordinate(c, 163841), ordinate(image, kWidth - 163840)), -1);
}

TEST(AlgebraicCoordinate, ScaledCurvesAreLevelThroughTheirImages) {
    // Twice as far and elsewhere: other polynomials of the parameter, the same ordinates.
    std::array<IntPoint, 4> wide = kRising;
    for (IntPoint& q : wide)
        q.x = 2 * q.x + 7;
    const Curve c = cubic(kRising), other = cubic(wide);
    EXPECT_EQ(compare(ordinate(c, 163841), ordinate(other, 2 * 163841 + 7)), 0);
    EXPECT_EQ(compare(ordinate(c, 163841), ordinate(other, 2 * 163841 + 8)), 1);
}

TEST(SideOfLevel, OfLinesIsTheRationalOne) {
    std::array<int, 3> seen{};
    for (std::uint64_t seed = 0; seed < 20000; ++seed) {
        Random random(seed);
        std::array<IntPoint, 4> p{};
        for (std::size_t i = 0; i < 2; ++i)
            p[i] = {random.integer(-9, 9), random.integer(-9, 9)};
        const Axis axis = random.chance(0.5) ? Axis::X : Axis::Y;
        const std::int64_t level = random.integer(-9, 9), v = random.integer(-9, 9);
        const Curve line = make_curve(1, p);
        const Polynomial along = power_basis(line, axis), across = minus(power_basis(line, other(axis)), to_mpz(v));
        if (line.along(axis).magnitude == 0) continue;
        const mpz_class rise = along[1];
        const mpq_class t = mpq_class(to_mpz(level) - along[0]) / rise;
        if (t < 0 || t > 1) continue;
        const int side = sgn(evaluate(across, t));
        ++seen[static_cast<std::size_t>(side + 1)];
        EXPECT_EQ(side_of_level(line, axis, level, {0, 1}, v), side) << "seed " << seed;
    }
    EXPECT_GT(*std::min_element(seen.begin(), seen.end()), 100);
}

} // namespace
} // namespace fetexc::test
