// SPDX-License-Identifier: GPL-3.0-or-later
/// Crossings of lines against rational arithmetic, over the whole range of coordinates.
#include <gtest/gtest.h>

#include "compiler/geometry/precise.h"
#include "tests/support/random.h"

namespace fetexc::test {
namespace {

IntPoint random_point(Random& random) {
    const auto coordinate = [&] {
        const auto v = static_cast<std::int64_t>(random.unit() * 0x1p44) - (std::int64_t{1} << 43);
        return v >> random.integer(0, 43);
    };
    const std::int64_t x = coordinate();
    return {x, coordinate()};
}

mpq_class rational(std::int64_t v) { return mpq_class(static_cast<long>(v)); }

/// Twice the signed area.
mpq_class area(IntPoint o, IntPoint a, IntPoint b) {
    return rational(a.x - o.x) * rational(b.y - o.y) - rational(a.y - o.y) * rational(b.x - o.x);
}

void expect_tight(const Interval& v, const mpq_class& exact, std::uint64_t seed) {
    EXPECT_TRUE(mpq_class(v.lo) <= exact && exact <= mpq_class(v.hi)) << "seed " << seed;
    EXPECT_LE(v.width(), 16 * budget::kUnitRoundoff * v.magnitude() + 0x1p-62) << "seed " << seed;
}

TEST(ContactPoint, OfLinesIsTheRationalOneRoundedOutwards) {
    int crossings = 0;
    for (std::uint64_t seed = 0; seed < 20000; ++seed) {
        Random random(seed);
        const IntPoint p = random_point(random), q = random_point(random), u = random_point(random),
                       v = random_point(random);
        const mpq_class from = area(u, v, p), to = area(u, v, q), other = area(p, q, u) * area(p, q, v);
        if (sgn(from) * sgn(to) >= 0 || sgn(other) >= 0) continue;
        ++crossings;
        const mpq_class s = from / (from - to);
        Contact c{Interval(0, 1), Interval(0, 1)};
        const PointEnclosure at = contact_point(make_curve(1, {p, q, {}, {}}), make_curve(1, {u, v, {}, {}}), c);
        expect_tight(at.x, rational(p.x) + s * rational(q.x - p.x), seed);
        expect_tight(at.y, rational(p.y) + s * rational(q.y - p.y), seed);
    }
    EXPECT_GT(crossings, 1000);
}

} // namespace
} // namespace fetexc::test
