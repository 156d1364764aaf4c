// SPDX-License-Identifier: GPL-3.0-or-later
/// Random scenes full of coincidences: the FBT's region of any point is the scene's, except within the quantisation of
/// an edge.
#include <gtest/gtest.h>

#include "formats/validate.h"
#include "tests/support/random_scene.h"
#include "tests/support/region_check.h"

namespace fetexc::test {
namespace {

void expect_right_regions(const Scene& scene, GridSize size, std::uint64_t seed) {
    FbtRegions regions;
    const Result<FbtBuild> build = build_fbt(scene, {size, 1}, {}, &regions);
    ASSERT_TRUE(build.ok()) << "seed " << seed << ": " << build.error().message << " " << build.error().place;
    const auto findings = fetex::validate_fbt(build.value().texture);
    EXPECT_TRUE(findings.empty()) << "seed " << seed << ": " << (findings.empty() ? "" : findings.front().message);
    const RegionCheck check = check_regions(scene, build.value(), regions, 4000, seed);
    EXPECT_EQ(check.wrong_far, 0u) << "seed " << seed << ": " << check.worst;
    EXPECT_EQ(check.color_off, 0u) << "seed " << seed;
}

TEST(FbtRegions, OpaqueSolidsAtOddAndEvenSizes) {
    for (std::uint64_t seed = 0; seed < 120; ++seed) {
        const Scene scene = random_scene(seed, opaque_solids(4 + static_cast<int>(seed % 12)));
        expect_right_regions(scene, {static_cast<std::uint32_t>(1 + seed * 7 % 40), 0}, seed);
    }
}

TEST(FbtRegions, GroupsClipsMasksAndGradients) {
    for (std::uint64_t seed = 1000; seed < 1080; ++seed) {
        const Scene scene = random_scene(seed, everything(3 + static_cast<int>(seed % 9)));
        expect_right_regions(
            scene, {static_cast<std::uint32_t>(4 + seed * 5 % 29), static_cast<std::uint32_t>(1 + seed * 11 % 23)},
            seed);
    }
}

/// What long runs found, each with the trap it held.
TEST(FbtRegions, FoundByLongRuns) {
    const auto mixed = [](std::uint64_t seed) {
        return seed % 2 != 0 ? random_scene(seed, everything(3 + static_cast<int>(seed % 9)))
                             : random_scene(seed, opaque_solids(4 + static_cast<int>(seed % 25)));
    };
    const std::vector<std::pair<std::uint64_t, GridSize>> cases = {
        {12544, {39, 26}}, // a zero handle meets lines at a flat angle: crossings known to 1e-4 of a lattice step only
        {34343, {6, 43}},  // a curve and a line nearly tangent: a crossing enclosed by 40,000 steps
        {39210, {39, 0}},  // the same near an end
        {51598, {57, 2}},  // two contacts of one vertex in the wrong order along a curve that rests there
        {54378, {20, 0}},  // the lowest point of a curve and a crossing 10^-9 steps above it
        {58047, {42, 0}},  // the same
        {314, {55, 10}},   // a curve's continuation beyond its zero handle passes 10^-27 of a parameter away
        {706, {52, 29}},   // crossings just beyond the end of a curve
        {77327, {64, 1}},
        {79446, {23, 0}},
        {80744, {64, 11}},
        {91444, {58, 51}},
        {93384, {37, 0}},
        {99881, {23, 2}},
        {200581, {16, 2}},  // a zero handle ends on a line's end and crosses the
                            // line 10^-17 of a parameter before
        {206572, {11, 24}}, // tangent to a line in an extremum
        {207824, {65, 16}}, // crossings just before the start of a curve
        {302646, {50, 0}},  // a corner on a curve just before its extremum
        {505790, {50, 16}}, // a crossing 10^-18 of a parameter from a curve's end in a grid corner
        {710608, {43, 37}}, // two curves touch in their common end, a third crosses both 10^-25 steps apart
    };
    for (const auto& [seed, size] : cases)
        expect_right_regions(mixed(seed), size, seed);
}

} // namespace
} // namespace fetexc::test
