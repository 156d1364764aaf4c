// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/windings.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/support/random.h"

namespace fetexc::test {
namespace {

Windings sparse(Random& random, std::size_t shapes, double share) {
    Windings out;
    for (std::uint32_t k = 0; k < shapes; ++k) {
        const auto winding = static_cast<std::int32_t>(random.integer(-2, 2));
        if (winding != 0 && random.chance(share)) out.push_back({k, winding});
    }
    return out;
}

TEST(AddWindings, AddsShapeByShapeAndDropsZeros) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        Random random(seed);
        Windings w = sparse(random, 12, random.unit());
        const Windings changes = sparse(random, 12, random.unit());
        const std::int32_t sign = random.chance(0.5) ? 1 : -1;
        std::map<std::uint32_t, std::int32_t> expected;
        for (const Contribution& c : w)
            expected[c.shape] += c.winding;
        for (const Contribution& c : changes)
            expected[c.shape] += sign * c.winding;
        std::erase_if(expected, [](const auto& e) { return e.second == 0; });
        add_windings(w, changes, sign);
        ASSERT_EQ(w.size(), expected.size()) << "seed " << seed;
        auto at = w.begin();
        for (const auto& [shape, winding] : expected) {
            EXPECT_EQ(at->shape, shape) << "seed " << seed;
            EXPECT_EQ((at++)->winding, winding) << "seed " << seed;
        }
    }
}

} // namespace
} // namespace fetexc::test
