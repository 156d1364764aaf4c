// SPDX-License-Identifier: GPL-3.0-or-later
/// Fixed-point evaluation and narrowed contacts against GMP, over the whole range of coordinates.
#include <gtest/gtest.h>

#include "compiler/geometry/polynomial.h"
#include "compiler/geometry/precise.h"
#include "tests/support/random.h"

namespace fetexc::test {
namespace {

mpq_class rational(Fixed v, int bits) {
    mpq_class q(to_integer(v));
    mpq_div_2exp(q.get_mpq_t(), q.get_mpq_t(), static_cast<mp_bitcnt_t>(bits));
    return q;
}

IntPoint random_point(Random& random, int bits) {
    const auto coordinate = [&] { return static_cast<std::int64_t>((random.unit() * 2 - 1) * std::ldexp(1.0, bits)); };
    const std::int64_t x = coordinate();
    return {x, coordinate()};
}

Curve random_curve(Random& random, int bits) {
    const int degree = static_cast<int>(random.integer(1, 3));
    std::array<IntPoint, 4> p{};
    for (int i = 0; i <= degree; ++i)
        p[static_cast<std::size_t>(i)] = random_point(random, bits);
    return make_curve(degree, p);
}

bool holds(const Interval& v, const mpq_class& exact) { return mpq_class(v.lo) <= exact && exact <= mpq_class(v.hi); }

TEST(FixedCoordinate, ErrsByLessThanTheBudgetSays) {
    const mpq_class budget = rational(budget::kShortError, budget::kFixedBits);
    for (std::uint64_t seed = 0; seed < 20000; ++seed) {
        Random random(seed);
        const Curve c = random_curve(random, static_cast<int>(random.integer(1, 43)));
        const auto t = static_cast<std::int64_t>((random.unit() * 4 - 2) * 0x1p62);
        for (const Axis axis : {Axis::X, Axis::Y}) {
            const mpq_class exact = evaluate(power_basis(c, axis), rational(t, budget::kShortBits));
            const mpq_class error = rational(FixedCoordinate(c, axis).at(t), budget::kFixedBits) - exact;
            ASSERT_LT(abs(error), budget) << "seed " << seed;
        }
    }
}

TEST(FixedCoordinate, EnclosesTheCurveOverAParameter) {
    for (std::uint64_t seed = 0; seed < 20000; ++seed) {
        Random random(seed);
        const Curve c = random_curve(random, static_cast<int>(random.integer(1, 43)));
        const double lo = random.unit(), hi = lo + std::ldexp(random.unit(), -static_cast<int>(random.integer(0, 60)));
        const ShortParameter t(Interval(lo, hi));
        ASSERT_TRUE(t.range().lo <= lo && hi <= t.range().hi) << "seed " << seed;
        for (const Axis axis : {Axis::X, Axis::Y}) {
            const Interval v = FixedCoordinate(c, axis).over(t, derivative_over(c, axis, t.range()));
            for (const double u : {lo, 0.5 * (lo + hi), hi})
                ASSERT_TRUE(holds(v, evaluate(power_basis(c, axis), mpq_class(u)))) << "seed " << seed;
        }
    }
}

TEST(EnclosedFixed, HoldsItsEndsAndLittleElse) {
    for (std::uint64_t seed = 0; seed < 20000; ++seed) {
        Random random(seed);
        const Fixed v = (static_cast<Fixed>(static_cast<std::int64_t>((random.unit() * 2 - 1) * 0x1p60)) << 64 |
                         static_cast<Fixed>(static_cast<std::uint64_t>(random.unit() * 0x1p63))) >>
                        random.integer(0, 120);
        const Interval out = enclose_fixed(v, v, 72);
        ASSERT_TRUE(holds(out, rational(v, 72))) << "seed " << seed;
        ASSERT_LE(out.width(), 8 * budget::kUnitRoundoff * out.magnitude() + 4 * budget::kUnderflowGuard)
            << "seed " << seed;
    }
}

TEST(WholeLevel, IsExactWhereTheCurvePassesAnIntegerPoint) {
    // (0,0) (2,2) (6,2) (8,0): half way at (4, 3/2).
    const Curve c = make_curve(3, {IntPoint{0, 0}, {2, 2}, {6, 2}, {8, 0}});
    const auto p = whole_level(c, Axis::X, 4, {0.5 - 0x1p-50, 0.5 + 0x1p-49});
    ASSERT_TRUE(p);
    EXPECT_EQ(p->x, Fixed{4} << budget::kFixedBits);
    EXPECT_EQ(p->y, Fixed{3} << (budget::kFixedBits - 1));
    EXPECT_FALSE(whole_level(c, Axis::X, 3, {0.3, 0.5}));            // 3/8: another value
    EXPECT_FALSE(whole_level(c, Axis::X, 4, {0.5 + 0x1p-50, 0.51})); // doesn't hold it
}

/// Up to the rounding of v.
bool holds(const Interval& range, Fixed v) {
    return mpq_class(range.lo) <= rational(v + 1, budget::kFixedBits) &&
           rational(v - 1, budget::kFixedBits) <= mpq_class(range.hi);
}

/// A crossing of two random quadratics, at angles down to 2^-20, against 192 bits.
TEST(ContactPoint, HoldsTheOneOfGmp) {
    int crossings = 0, tight = 0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        Random random(seed);
        const int bits = static_cast<int>(random.integer(12, 42)), flat = static_cast<int>(random.integer(0, 20));
        const std::int64_t size = std::int64_t{1} << bits, rise = std::max<std::int64_t>(1, size >> flat);
        const auto bend = [&] { return static_cast<std::int64_t>((random.unit() - 0.5) * static_cast<double>(rise)); };
        const Curve a = make_curve(2, {IntPoint{-size, -rise + bend()}, {0, bend()}, {size, rise + bend()}, {}});
        const Curve b = make_curve(2, {IntPoint{-size, rise + bend()}, {7, bend()}, {size, -rise + bend()}, {}});
        if (a.degree == 1 && b.degree == 1) continue;
        const Stretch sa{&a, {0, 1}, true, true}, sb{&b, {0, 1}, true, false};
        std::vector<Contact> found;
        if (intersect_certified(ControlPolygon(sa), ControlPolygon(sb), {}, found) != PairOutcome::Certified) continue;
        for (Contact& c : found) {
            const auto narrow = narrow_contact(a, b, c);
            ASSERT_TRUE(narrow) << "seed " << seed;
            const PointEnclosure p = contact_point(a, b, c);
            EXPECT_TRUE(mpq_class(c.s.lo) <= narrow->s.hi && narrow->s.lo <= mpq_class(c.s.hi)) << "seed " << seed;
            EXPECT_TRUE(mpq_class(c.t.lo) <= narrow->t.hi && narrow->t.lo <= mpq_class(c.t.hi)) << "seed " << seed;
            const FixedPoint exact = fixed_contact(a, *narrow);
            EXPECT_TRUE(holds(p.x, exact.x)) << "seed " << seed;
            EXPECT_TRUE(holds(p.y, exact.y)) << "seed " << seed;
            ++crossings;
            if (p.width() <= budget::kPointWidth * static_cast<double>(2 * size)) ++tight;
        }
    }
    EXPECT_GT(crossings, 3000);
    EXPECT_EQ(tight, crossings);
}

} // namespace
} // namespace fetexc::test
