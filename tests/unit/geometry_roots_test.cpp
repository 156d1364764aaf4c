// SPDX-License-Identifier: GPL-3.0-or-later
/// Roots in integer arithmetic against CGAL's algebraic kernel: planted at dyadic numbers, at the ends, close together,
/// multiple, or none.
#include <gtest/gtest.h>

#include <algorithm>

#include "compiler/geometry/algebraic_kernel.h"
#include "compiler/geometry/dyadic_roots.h"
#include "tests/support/random.h"

namespace fetexc::test {
namespace {

/// n/d, close to the one before in half of the cases.
mpq_class random_root(Random& random, const mpq_class& before) {
    mpq_class root(random.integer(-8, 24), random.chance(0.5) ? 16 : random.integer(3, 30));
    root.canonicalize();
    if (random.chance(0.3)) {
        mpq_class near(random.integer(-3, 3), 1);
        mpq_div_2exp(near.get_mpq_t(), near.get_mpq_t(), static_cast<mp_bitcnt_t>(random.integer(10, 60)));
        root = before + near;
    }
    return root;
}

/// A product of linear factors with rational roots, some of them repeated, and of quadratics.
Polynomial random_polynomial(Random& random) {
    Polynomial p{mpz_class(1)};
    mpq_class root = 0;
    const int degree = random.integer(1, 9);
    while (static_cast<int>(p.size()) <= degree) {
        if (random.chance(0.3) && static_cast<int>(p.size()) < degree) {
            const int b = random.integer(-20, 20), c = random.integer(-20, 20);
            p = p * Polynomial{mpz_class(c), mpz_class(b), mpz_class(random.integer(1, 20))};
            continue;
        }
        if (!random.chance(0.15)) root = random_root(random, root);
        p = p * Polynomial{-root.get_num(), root.get_den()};
    }
    return trimmed(p);
}

bool overlap(const std::pair<mpq_class, mpq_class>& a, const std::pair<mpq_class, mpq_class>& b) {
    return a.first <= b.second && b.first <= a.second;
}

TEST(Roots, AreTheKernels) {
    constexpr int bits = 192;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        Random random(seed);
        const Polynomial p = random_polynomial(random);
        mpq_class lo(random.integer(-4, 8), 16), hi = lo + mpq_class(random.integer(1, 32), 16);
        lo.canonicalize(), hi.canonicalize();
        const auto found = isolate_roots(p, lo, hi, bits), expected = kernel::isolate_roots(p, lo, hi, bits);
        ASSERT_EQ(found.size(), expected.size()) << "seed " << seed;
        mpq_class width = 1;
        mpq_div_2exp(width.get_mpq_t(), width.get_mpq_t(), bits);
        for (std::size_t k = 0; k < found.size(); ++k) {
            EXPECT_TRUE(overlap(found[k], expected[k])) << "seed " << seed << ", root " << k;
            EXPECT_LE(found[k].second - found[k].first, width) << "seed " << seed << ", root " << k;
            EXPECT_TRUE(k == 0 || found[k - 1].second < found[k].first) << "seed " << seed << ", root " << k;
        }
    }
}

TEST(Roots, AllRealOnesAreWithinTheBound) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Random random(seed);
        const Polynomial p = random_polynomial(random);
        const mpz_class far = root_bound(p) * 1000;
        EXPECT_EQ(isolate_roots(p, 64).size(), kernel::isolate_roots(p, -far, far, 64).size()) << "seed " << seed;
    }
}

TEST(Roots, BracketsShowChangesOfSign) {
    int brackets = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        Random random(seed);
        const Polynomial p = random_polynomial(random);
        const auto roots = bracket_roots(p, 0, 1, budget::kDescartesHalvings);
        if (!roots) continue; // multiple, or closer than that
        EXPECT_EQ(roots->size(), kernel::isolate_roots(p, 0, 1, 8).size()) << "seed " << seed;
        for (const RootBracket& root : *roots) {
            const RationalRange range = rational_range(root);
            if (range.lo == range.hi) {
                EXPECT_EQ(evaluate(p, range.lo), 0) << "seed " << seed;
                continue;
            }
            // Other roots may be at its ends only: an odd number of them inside.
            const auto inside = kernel::isolate_roots(p, range.lo, range.hi, 64);
            EXPECT_EQ(std::count_if(inside.begin(), inside.end(),
                                    [&](const auto& r) { return r.first != range.lo && r.second != range.hi; }),
                      1)
                << "seed " << seed;
            ++brackets;
        }
    }
    EXPECT_GT(brackets, 100);
}

TEST(Roots, CompareAsTheKernelSays) {
    int equal = 0, different = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Random random(seed);
        // Two polynomials with a common factor: equal numbers with different definitions.
        const Polynomial common = random_polynomial(random);
        const Polynomial p =
            random.chance(0.5) ? common * Polynomial{mpz_class(-5), mpz_class(7)} : random_polynomial(random);
        for (const auto& [a0, a1] : isolate_roots(common, 0, 1, 20)) {
            for (const auto& [b0, b1] : isolate_roots(p, 0, 1, 20)) {
                const AlgebraicNumber a{common, a0, a1}, b{p, b0, b1};
                const std::optional<int> c = compare_numbers(a, b);
                ASSERT_EQ(c, kernel::compare_numbers(a, b)) << "seed " << seed;
                EXPECT_EQ(sign_at(p, a), kernel::sign_at(p, a)) << "seed " << seed;
                ++(c == 0 ? equal : different);
            }
        }
    }
    EXPECT_GT(equal, 20);
    EXPECT_GT(different, 20);
}

TEST(SquareFree, RepeatedFactorsAreSeen) {
    int free = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const Polynomial p = random_polynomial(random);
        const bool expected = kernel::square_free_part(p).size() == p.size();
        EXPECT_EQ(certainly_square_free(p), expected) << "seed " << seed;
        free += expected;
    }
    EXPECT_GT(free, 50);
    EXPECT_LT(free, 290);
}

/// a divides b: a remainder of rationals is 0.
bool divides(const Polynomial& a, const Polynomial& b) {
    std::vector<mpq_class> rest(b.begin(), b.end());
    for (; rest.size() >= a.size(); rest.pop_back()) {
        const mpq_class factor = rest.back() / mpq_class(a.back());
        for (std::size_t i = 0; i < a.size(); ++i)
            rest[rest.size() - a.size() + i] -= factor * a[i];
    }
    return std::all_of(rest.begin(), rest.end(), [](const mpq_class& v) { return v == 0; });
}

TEST(CommonFactor, IsThePlantedOne) {
    int planted = 0;
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const Polynomial common = random.chance(0.7) ? random_polynomial(random) : Polynomial{mpz_class(1)},
                         p = common * random_polynomial(random), q = common * random_polynomial(random),
                         factor = common_factor(p, q);
        ASSERT_FALSE(factor.empty());
        EXPECT_TRUE(divides(common, factor)) << "seed " << seed;
        EXPECT_TRUE(divides(factor, p) && divides(factor, q)) << "seed " << seed;
        planted += common.size() > 1;
    }
    EXPECT_GT(planted, 100);
}

} // namespace
} // namespace fetexc::test
