// SPDX-License-Identifier: GPL-3.0-or-later
/// The arithmetic core: enclosures against exact rationals, the intersection filter against exact arithmetic, tables of
/// hard cases.
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "compiler/geometry/monotone.h"
#include "compiler/geometry/polynomial.h"
#include "compiler/geometry/precise.h"
#include "tests/support/random.h"

namespace fetexc::test {
namespace {

using Points = std::vector<IntPoint>;

Curve curve(const Points& p) {
    std::array<IntPoint, 4> a{};
    std::copy(p.begin(), p.end(), a.begin());
    return make_curve(static_cast<int>(p.size()) - 1, a);
}

Curve random_curve(Random& random, int degree, int range) {
    Points p;
    for (int i = 0; i <= degree; ++i)
        p.push_back({random.integer(-range, range), random.integer(-range, range)});
    return curve(p);
}

mpq_class exact_value(const Curve& c, Axis axis, double t) { return evaluate(power_basis(c, axis), mpq_class(t)); }

bool encloses(const Interval& v, const mpq_class& exact) {
    return mpq_class(v.lo) <= exact && exact <= mpq_class(v.hi);
}

/// The monotone stretches of a curve.
std::vector<Stretch> stretches(const Curve& c) {
    std::vector<Interval> cuts = extrema(c);
    cuts.insert(cuts.begin(), Interval(0));
    cuts.emplace_back(1);
    std::vector<Stretch> out;
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
        const double a = cuts[k].mid(), b = cuts[k + 1].mid();
        out.push_back({&c,
                       {cuts[k].lo, cuts[k + 1].hi},
                       value_double(c, Axis::X, a) <= value_double(c, Axis::X, b),
                       value_double(c, Axis::Y, a) <= value_double(c, Axis::Y, b)});
    }
    return out;
}

TEST(Interval, OperationsEncloseTheExactResult) {
    Random random(1);
    for (int k = 0; k < 20000; ++k) {
        const double a = random.between(-1e6, 1e6), b = random.between(-1, 1) * 0x1p-30, c = random.between(0.5, 3);
        EXPECT_TRUE(encloses(Interval(a) + Interval(b), mpq_class(a) + mpq_class(b)));
        EXPECT_TRUE(encloses(Interval(a) - Interval(b), mpq_class(a) - mpq_class(b)));
        EXPECT_TRUE(encloses(Interval(a) * Interval(b), mpq_class(a) * mpq_class(b)));
        EXPECT_TRUE(encloses(Interval(a) / Interval(c), mpq_class(a) / mpq_class(c)));
    }
}

TEST(Curve, ValuesAreEnclosedAndTight) {
    Random random(2);
    for (int k = 0; k < 20000; ++k) {
        const Curve c = random_curve(random, 1 + k % 3, 1 << 28);
        const double t = random.unit();
        const Interval v = value_at(c, Axis::X, t);
        ASSERT_TRUE(encloses(v, exact_value(c, Axis::X, t))) << "case " << k;
        EXPECT_LT(v.width(), 0x1p-16) << "2^-44 of the extent";
    }
}

TEST(Curve, DerivativeHullHoldsEveryDerivative) {
    Random random(3);
    for (int k = 0; k < 2000; ++k) {
        const Curve c = random_curve(random, 3, 1 << 20);
        const double a = random.unit(), b = a + (1 - a) * random.unit();
        const Interval d = derivative_over(c, Axis::Y, {a, b});
        for (const double w : {0.0, 0.3, 1.0})
            EXPECT_TRUE(d.contains(derivative_double(c, Axis::Y, a + w * (b - a))));
    }
}

TEST(Curve, ReducesDegreesExactly) {
    EXPECT_EQ(curve({{0, 0}, {10, 20}, {20, 40}, {30, 60}}).degree, 1);
    EXPECT_EQ(curve({{0, 0}, {50, 100}, {20, 40}, {30, 60}}).degree, 1)
        << "collinear, doubling back: same winding as its chord";
    EXPECT_EQ(curve({{0, 0}, {20, 40}, {40, 40}, {60, 0}}).degree, 2) << "an elevated quadratic";
    EXPECT_EQ(curve({{0, 0}, {20, 40}, {40, 41}, {60, 0}}).degree, 3);
    EXPECT_EQ(curve({{0, 0}, {1, 1}, {3, 0}}).degree, 2);
}

TEST(Extrema, Table) {
    struct Case {
        const char* name;
        Points p;
        std::vector<double> at;
    };
    const std::array<Case, 8> cases{{
        {"line", {{0, 0}, {5, 7}}, {}},
        {"parabola", {{0, 0}, {10, 20}, {20, 0}}, {0.5}},
        {"two of each",
         {{320, 128}, {192, 384}, {448, 128}, {128, 320}},
         {0.23670068381445486, 0.4, 0.56329931618554514, 2.0 / 3}},
        {"horizontal start and end: none inside", {{0, 0}, {10, 0}, {10, 10}, {20, 10}}, {}},
        {"zero handles", {{0, 0}, {0, 0}, {10, 10}, {10, 10}}, {}},
        {"inflection with level tangent: no sign change",
         {{0, 0}, {10, 8}, {20, -8}, {30, 0}},
         {0.21132486540518713, 0.78867513459481287}},
        {"cusp", {{0, 0}, {20, 20}, {0, 20}, {20, 0}}, {0.5}},
        {"loop", {{0, 0}, {30, 20}, {-10, 20}, {20, 0}}, {0.5}},
    }};
    for (const Case& c : cases) {
        const std::vector<Interval> found = extrema(curve(c.p));
        const bool loop = std::string(c.name) == "loop"; // two more, in x, around the middle
        ASSERT_EQ(found.size(), c.at.size() + (loop ? 2u : 0u)) << c.name;
        for (std::size_t k = 0; k < c.at.size(); ++k)
            EXPECT_NEAR(found[loop ? 1 : k].mid(), c.at[k], 1e-7) << c.name;
    }
}

/// A cubic whose x' has the coefficients a, 2b, c (over 3) and whose y' is 3(t² + 2t − 1), with the root √2 − 1.
Curve with_extrema(std::int64_t a, std::int64_t b, std::int64_t c) {
    const std::int64_t d0 = c, d1 = c + b, d2 = a + 2 * b + c;
    return make_curve(3, {IntPoint{0, 0}, {d0, -1}, {d0 + d1, -1}, {d0 + d1 + d2, 1}});
}

/// Roots, what lies next to them, and anything, against rationals.
TEST(QuadraticSign, IsTheRationalOne) {
    std::array<int, 3> seen{};
    for (std::uint64_t seed = 0; seed < 20000; ++seed) {
        Random random(seed);
        const double size = std::ldexp(1.0, static_cast<int>(random.integer(2, 46)));
        const auto coefficient = [&] { return static_cast<std::int64_t>((random.unit() * 2 - 1) * size); };
        double t = random.chance(0.1) ? std::ldexp(random.unit(), -static_cast<int>(random.integer(0, 60)))
                                      : static_cast<double>(random.integer(0, 64)) / 64;
        const std::int64_t a = coefficient(), b = coefficient();
        // The root at t, where it has few bits.
        const std::int64_t c =
            random.chance(0.5)
                ? coefficient()
                : static_cast<std::int64_t>(-(static_cast<double>(a) * t + 2.0 * static_cast<double>(b)) * t);
        if (random.chance(0.3)) t = std::nextafter(t, random.chance(0.5) ? 0.0 : 1.0);
        const mpq_class u(t);
        const int expected =
            sgn(mpq_class((u * static_cast<long>(a) + 2 * static_cast<long>(b)) * u + static_cast<long>(c)));
        ASSERT_EQ(quadratic_sign(a, b, c, t), expected) << "seed " << seed;
        ++seen[static_cast<std::size_t>(expected + 1)];
    }
    EXPECT_GT(*std::min_element(seen.begin(), seen.end()), 200);
}

TEST(Extrema, NearCuspsAreCounted) {
    const long double r = std::sqrt(2.0L) - 1;
    Random random(11);
    int tried = 0, near = 0;
    while (near < 3) {
        ASSERT_LT(++tried, 1000000);
        const std::int64_t a = std::int64_t{random.integer(1 << 29, 1 << 30)} << 9,
                           b = std::int64_t{random.integer(1 << 29, 1 << 30)} << 9;
        const long double level = r * (r * static_cast<long double>(a) + 2 * static_cast<long double>(b));
        const long double rest = level - std::round(level);
        if (std::abs(rest) > 0x1p-14L || std::abs(rest) < 0x1p-20L) continue; // roots 2^-54 to 2^-60 apart
        ++near;
        std::uint64_t near_cusps = 0;
        EXPECT_EQ(extrema(with_extrema(a, b, -static_cast<std::int64_t>(std::round(level))), &near_cusps).size(), 1u);
        EXPECT_EQ(near_cusps, 1u);
    }
    std::uint64_t near_cusps = 0;
    EXPECT_EQ(extrema(curve({{0, 0}, {20, 20}, {0, 20}, {20, 0}}), &near_cusps).size(), 1u); // a cusp
    EXPECT_EQ(extrema(with_extrema(1 << 20, 1 << 20, -(1 << 20) + 1), &near_cusps).size(), 2u);
    EXPECT_EQ(near_cusps, 0u);
}

/// Quadratics have no cusps: their extrema at quotients of neighbouring Fibonacci numbers, 1.5e-16 apart, are two.
TEST(Extrema, NearCuspsOfQuadraticsAreCounted) {
    std::uint64_t near_cusps = 0;
    EXPECT_EQ(extrema(curve({{0, 0}, {-39088169, -63245986}, {-14930352, -24157817}}), &near_cusps).size(), 1u);
    EXPECT_EQ(near_cusps, 1u);
}

TEST(ParameterAt, EnclosesTheExactRoot) {
    Random random(4);
    for (int k = 0; k < 5000; ++k) {
        const Curve c = random_curve(random, 2 + k % 2, 1 << 24);
        for (const Stretch& s : stretches(c)) {
            const double t = s.range.lo + random.unit() * (s.range.hi - s.range.lo),
                         y = std::floor(value_double(c, Axis::Y, t));
            const mpq_class y0 = exact_value(c, Axis::Y, s.range.lo), y1 = exact_value(c, Axis::Y, s.range.hi);
            if ((mpq_class(y) - y0) * (mpq_class(y) - y1) >= 0) continue;
            const Interval found = parameter_at(c, Axis::Y, s.range, s.y_increasing, y);
            const mpq_class lo = exact_value(c, Axis::Y, found.lo) - y, hi = exact_value(c, Axis::Y, found.hi) - y;
            ASSERT_LE(lo * hi, 0) << "case " << k;
        }
    }
}

TEST(ImplicitSign, VanishesExactlyOnTheCurve) {
    const Curve parabola = curve({{0, 0}, {2, 4}, {4, 0}}); // passes (2,2), y = x(4−x)/2
    EXPECT_EQ(implicit_sign(parabola, {2, 2}), 0);
    EXPECT_EQ(implicit_sign(parabola, {-2, -6}), 0) << "beyond the end, on the same parabola";
    EXPECT_NE(implicit_sign(parabola, {2, 1}), 0);
    EXPECT_EQ(implicit_sign(parabola, {2, 1}), -implicit_sign(parabola, {2, 3}));
    const Curve cubic = curve({{0, 0}, {8, 24}, {16, -24}, {24, 0}});
    EXPECT_EQ(implicit_sign(cubic, {12, 0}), 0);
    EXPECT_NE(implicit_sign(cubic, {12, 1}), 0);
}

/// Filter and exact arithmetic see the same common points.
void expect_same_contacts(const Curve& a, const Curve& b, const std::string& name, int* undecided = nullptr) {
    for (const Stretch& s : stretches(a)) {
        for (const Stretch& t : stretches(b)) {
            std::vector<Contact> found;
            if (intersect_certified(s, t, {}, found) == PairOutcome::Undecided) {
                EXPECT_TRUE(found.empty()) << name;
                if (undecided != nullptr) ++*undecided;
                continue;
            }
            std::vector<ExactHit> exact;
            ASSERT_EQ(intersect_exact(s, t, exact), ExactOutcome::Done) << name;
            ASSERT_EQ(found.size(), exact.size()) << name;
            for (const ExactHit& e : exact) {
                EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const Contact& c) {
                    return c.s.overlaps(e.s) && c.t.overlaps(e.t);
                })) << name;
            }
        }
    }
}

TEST(Intersect, FilterEqualsExactOnRandomPairs) {
    Random random(5);
    int undecided = 0;
    for (int k = 0; k < 400; ++k) {
        const Curve a = random_curve(random, 2 + k % 2, 1 << 24), b = random_curve(random, 1 + k % 3, 1 << 24);
        expect_same_contacts(a, b, "random " + std::to_string(k), &undecided);
    }
    EXPECT_EQ(undecided, 0) << "generic pairs need no exact arithmetic";
}

TEST(Intersect, FilterEqualsExactOnNearTangentPairs) {
    // y = x²-like arcs against a level line at a shrinking distance from the top.
    for (int exponent = 0; exponent <= 24; ++exponent) {
        const std::int64_t top = std::int64_t{1} << 26, gap = top >> exponent;
        const Curve arc = curve({{-top, 0}, {0, 2 * top}, {top, 0}}); // top at (0, top)
        const Curve line = curve({{-top, top - gap}, {top, top - gap}});
        expect_same_contacts(arc, line, "gap 2^-" + std::to_string(exponent));
    }
}

TEST(Intersect, TangentPairIsLeftToExactArithmetic) {
    const Curve arc = curve({{-64, 0}, {0, 128}, {64, 0}}),
                line = curve({{-64, 63}, {64, 65}}); // touches at no lattice point of the arc
    const Curve touching = curve({{-64, 64}, {64, 64}});
    expect_same_contacts(arc, line, "crossing near the top");
    std::vector<ExactHit> hits;
    for (const Stretch& s : stretches(arc))
        intersect_exact(s, stretches(touching)[0], hits);
    ASSERT_EQ(hits.size(), 2u) << "the tangency, seen from both stretches that end there";
    EXPECT_NEAR(hits[0].s.mid(), 0.5, 1e-15);
}

TEST(Intersect, MissedCrossingOfCgalsBezierTraitsIsFound) {
    const Curve a = curve({{147600, 160360}, {146520, 159640}, {139680, 154240}, {134280, 160000}});
    const Curve b = curve({{147600, 160360}, {146840, 159320}, {139680, 154240}, {134280, 160000}});
    int crossings = 0;
    for (const Stretch& s : stretches(a)) {
        for (const Stretch& t : stretches(b)) {
            std::vector<ExactHit> hits;
            intersect_exact(s, t, hits);
            for (const ExactHit& h : hits)
                crossings += h.s.lo > 1e-9 && h.s.hi < 1 - 1e-9;
        }
    }
    EXPECT_GE(crossings, 1) << "one lies at s = 0.98551658…";
}

TEST(Precise, FlatCrossingsAreEnclosedTightlyAndRightly) {
    // A cubic with a zero handle at its end, and lines that meet it near there.
    const Curve zero_handle =
        curve({{-327155712, 218103808}, {981467136, 872415232}, {327155712, 872415232}, {327155712, 872415232}});
    for (const std::int64_t d : {1, 10, 1000, 100000}) {
        const Curve line = curve({{327155712 + d, 872415232 + 981467136}, {327155712 + d + 7, 872415232 - 981467136}});
        for (const Stretch& s : stretches(zero_handle)) {
            const Stretch l{&line, {0, 1}, true, false};
            std::vector<Contact> found;
            if (intersect_certified(s, l, {}, found) != PairOutcome::Certified) continue;
            for (Contact c : found) {
                const PointEnclosure p = contact_point(zero_handle, line, c);
                EXPECT_LE(p.width(), budget::kPointWidth * 0x1p31) << d;
                // The exact crossing, by the resultant.
                std::vector<ExactHit> exact;
                intersect_exact(s, l, exact);
                ASSERT_EQ(exact.size(), 1u) << d;
                EXPECT_TRUE(exact[0].s.overlaps(c.s) && exact[0].t.overlaps(c.t)) << d;
                const mpq_class x = exact_value(zero_handle, Axis::X, exact[0].s.mid());
                EXPECT_LE(abs(x - mpq_class(p.x.mid())), 1e-5) << d;
            }
        }
    }
}

TEST(Precise, LevelPointsAreNarrowedWhereTheCurveIsFlat) {
    Random random(11);
    int narrowed = 0;
    for (int k = 0; k < 300; ++k) {
        const Curve c = random_curve(random, 3, 1 << 28);
        if (c.degree != 3) continue;
        for (const Stretch& s : stretches(c)) {
            // Levels ever nearer to the stretch's end, where it may be level.
            const double from = value_double(c, Axis::Y, s.range.lo), to = value_double(c, Axis::Y, s.range.hi);
            for (const double w : {0.5, 0x1p-20, 0x1p-28}) {
                const double v = std::round(to + w * (from - to));
                if (!(std::min(from, to) + 1 < v && v < std::max(from, to) - 1)) continue;
                Interval t = parameter_at(c, Axis::Y, s.range, s.y_increasing, v);
                const Interval before = t;
                const PointEnclosure p = level_point(s, Axis::Y, v, t);
                narrowed += t.width() < before.width() / 4 ? 1 : 0;
                EXPECT_TRUE(before.lo <= t.lo && t.hi <= before.hi);
                const mpq_class lo = exact_value(c, Axis::Y, t.lo) - mpq_class(v),
                                hi = exact_value(c, Axis::Y, t.hi) - mpq_class(v);
                EXPECT_LE(sgn(lo) * sgn(hi), 0);
                EXPECT_TRUE(p.x.overlaps(value_over(c, Axis::X, before)));
                EXPECT_EQ(p.y.lo, v);
            }
        }
    }
    EXPECT_GT(narrowed, 20);
}

TEST(SameSupport, PartialOverlapIsRecognisedExactly) {
    const Curve a = curve({{99000, 341601}, {94600, 336801}, {86200, 324801}, {86600, 322001}});
    const Curve b = curve({{91000, 331051}, {93600, 335001}, {96800, 339201}, {99000, 341601}});
    SupportMap map;
    ASSERT_TRUE(same_support(b, a, map));
    EXPECT_NEAR(map.start.mid(), 0.5, 1e-12);
    EXPECT_NEAR(map.end.mid(), 0.0, 1e-12);
    const Curve nudged = curve({{91000, 331051}, {93600, 335001}, {96800, 339202}, {99000, 341601}});
    EXPECT_FALSE(same_support(nudged, a, map));
}

TEST(PointOnStretch, TellsTheCurveFromItsNeighbourhood) {
    const Curve arc = curve({{0, 0}, {1 << 20, 1 << 21}, {1 << 21, 0}}); // top at t = 1/2
    const Stretch rising = stretches(arc)[0];
    EXPECT_TRUE(point_on_stretch(rising, {1 << 19, 3 << 18}).has_value()) << "t = 1/4";
    EXPECT_FALSE(point_on_stretch(rising, {1 << 19, (3 << 18) + 1}).has_value());
    EXPECT_FALSE(point_on_stretch(rising, {3 << 19, 3 << 18}).has_value()) << "on the other half";
}

/// A hairpin whose branches are 6e-8 apart: the point is half way, on the last of the three stretches.
TEST(PointOnStretch, TellsTheBranchesOfAParabola) {
    const Curve hairpin = curve({{0, 0}, {-8388032, -8388544}, {128, 128}});
    const std::vector<Stretch> all = stretches(hairpin);
    ASSERT_EQ(all.size(), 3u);
    int hits = 0;
    for (const Stretch& s : all) {
        const std::optional<Interval> t = point_on_stretch(s, {-4193984, -4194240});
        EXPECT_EQ(t.has_value(), s.range.contains(0.5));
        if (!t) continue;
        EXPECT_TRUE(t->contains(0.5));
        ++hits;
    }
    EXPECT_EQ(hits, 1);
}

TEST(CompareExact, SeparatesStretchesFarBelowDoubleResolution) {
    const std::int64_t n = std::int64_t{1} << 40;
    const Curve a = curve({{0, 0}, {n, n}}), b = curve({{0, 0}, {n - 1, n}});
    const Stretch sa = stretches(a)[0], sb = stretches(b)[0];
    EXPECT_EQ(compare_positions_exact(sa, sb, Axis::Y, mpq_class(0x1p-40)), 1) << "2^-80 apart";
    EXPECT_EQ(compare_positions_exact(sb, sa, Axis::Y, mpq_class(0x1p-40)), -1);
}

/// Outer ranges of stretches reach beyond the extremum, where the parabola has the level a second time.
TEST(CompareExact, StaysOnItsSideOfAnExtremum) {
    const Curve bowl = curve({{0, 0}, {1 << 20, 0}, {1 << 21, 1 << 20}}); // y = 2^20 t², x = 2^21 t
    const Curve wall = curve({{1, 0}, {1, 1 << 20}});
    const mpq_class level(0x1p-10); // x = ±2^6
    for (const double beyond : {0x1p-40, 0x1p-10, 0x1p-2}) {
        const Stretch right{&bowl, {-beyond, 1}, true, true}, left{&bowl, {-1, beyond}, true, false};
        const Stretch upright{&wall, {0, 1}, true, true};
        EXPECT_EQ(compare_positions_exact(right, upright, Axis::Y, level), 1) << beyond;
        EXPECT_EQ(compare_positions_exact(left, upright, Axis::Y, level), -1) << beyond;
        EXPECT_EQ(compare_position_exact(right, Axis::Y, level, 64), 0) << beyond;
    }
    // Both ends reach beyond: y = 3t² − 2t³ (times 2^20) rises from 0 to 1.
    const Curve step = curve({{0, 0}, {1 << 20, 0}, {1 << 21, 1 << 20}, {3 << 20, 1 << 20}});
    const Stretch both{&step, {-0x1p-4, 1 + 0x1p-4}, true, true};
    EXPECT_EQ(compare_position_exact(both, Axis::Y, mpq_class(1 << 19), mpq_class(3 << 19)), 0);
    EXPECT_EQ(compare_position_exact(both, Axis::Y, mpq_class(0x1p-10), 0), 1);
    EXPECT_EQ(compare_position_exact(both, Axis::Y, (1 << 20) - mpq_class(0x1p-10), 3 << 20), -1);
}

} // namespace
} // namespace fetexc::test
