// SPDX-License-Identifier: GPL-3.0-or-later
/// Zones of pinchmaps: what the constraints of §4.4 leave of any mask, and that maps made from it are valid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "compiler/pinchmap/pinch_frame.h"
#include "compiler/pinchmap/zone_mask.h"
#include "compiler/pinchmap/zone_patches.h"
#include "compiler/pinchmap/zone_search.h"
#include "formats/validate.h"
#include "tests/support/known_pinchmap.h"
#include "tests/support/random.h"

namespace fetexc {
namespace {

using test::Random;

/// Signal of one colour.
fetex::PinchmapTexture texture_of(const ZoneMask& mask, fetex::PinchmapFormat format) {
    fetex::PinchmapTexture t;
    t.width = mask.width, t.height = mask.height, t.map_format = format;
    for (const fetex::PinchmapTexel& texel : pinch_frame(mask)) {
        const auto words = fetex::pinchmap_pack(format, texel);
        t.map.insert(t.map.end(), words.begin(), words.begin() + fetex::pinchmap_words(format));
    }
    t.signal.assign(mask.above.size(), 0xff000000);
    return t;
}

bool all_valid(const ZoneMask& mask) {
    for (std::uint32_t j = 0; j < mask.height; ++j) {
        for (std::uint32_t i = 0; i < mask.width; ++i) {
            if (!is_valid_cluster(mask, i, j)) return false;
        }
    }
    return true;
}

/// Parts of clusters: of noise, or of discs, with thin bands between them.
std::vector<double> random_parts(Random& random, std::uint32_t width, std::uint32_t height) {
    std::vector<double> parts(std::size_t{width} * height);
    const bool noise = random.chance(0.3);
    const double bend = random.between(0.5, 4);
    for (std::uint32_t j = 0; j < height; ++j) {
        for (std::uint32_t i = 0; i < width; ++i) {
            const double wave = std::sin(i / bend) + std::cos(j / bend + 0.3 * i);
            parts[std::size_t{j} * width + i] = noise ? random.unit() : std::clamp(0.5 + wave, 0.0, 1.0);
        }
    }
    return parts;
}

/// As far from the outline as the clusters around a corner say.
ZoneTruth truth_of(std::vector<double> parts, std::uint32_t width, std::uint32_t height) {
    ZoneTruth out;
    const auto part = [&](std::uint32_t i, std::uint32_t j) {
        return parts[std::size_t{std::min(j, height - 1)} * width + std::min(i, width - 1)];
    };
    for (std::uint32_t j = 0; j <= height; ++j) {
        for (std::uint32_t i = 0; i <= width; ++i)
            out.distances.push_back((part(i, j) + part(i > 0 ? i - 1 : 0, j > 0 ? j - 1 : 0) +
                                     part(i > 0 ? i - 1 : 0, j) + part(i, j > 0 ? j - 1 : 0)) /
                                        2 -
                                    1);
    }
    out.parts = std::move(parts);
    return out;
}

TEST(PinchmapMask, noForbiddenNeighbourhoodIsLeft) {
    Random random(11);
    std::uint64_t moves = 0;
    for (int n = 0; n < 150; ++n) {
        const auto width = static_cast<std::uint32_t>(random.integer(1, 24)),
                   height = static_cast<std::uint32_t>(random.integer(1, 24));
        const ZoneTruth truth = truth_of(random_parts(random, width, height), width, height);
        ZoneMask mask = majority_mask(truth.parts, width, height);
        const double before = unmendable(mask, truth);
        const MaskMoves cost = enforce_constraints(mask, truth);
        moves += cost.moves;
        ASSERT_TRUE(all_valid(mask)) << n;
        ASSERT_NEAR(cost.lost, unmendable(mask, truth) - before, 1e-9) << n;
        ASSERT_TRUE(cost.moves > 0 || cost.broken == 0) << n;
        for (const fetex::PinchmapFormat format : test::kPinchmapFormats) {
            const auto findings = fetex::validate_pinchmap(texture_of(mask, format), 1);
            ASSERT_TRUE(findings.empty()) << n << ": " << findings[0].message;
        }
    }
    EXPECT_GT(moves, 500u);
}

/// Costs of random sides: what a search leaves is valid and no dearer.
TEST(PinchmapMask, searchedZonesAreValidAndCheaper) {
    Random random(12);
    double won = 0;
    for (int n = 0; n < 40; ++n) {
        const auto width = static_cast<std::uint32_t>(random.integer(1, 20)),
                   height = static_cast<std::uint32_t>(random.integer(1, 20));
        ZoneTruth truth = truth_of(random_parts(random, width, height), width, height);
        for (const double above : truth.distances)
            truth.costs.push_back({std::max(above, 0.0) * random.unit(), std::max(-above, 0.0) * random.unit()});
        ZoneMask mask = majority_mask(truth.parts, width, height);
        enforce_constraints(mask, truth);
        ZoneMask again = mask;
        const double before = unmendable(mask, truth);
        search_zones(mask, truth, 5), search_zones(again, truth, 5);
        ASSERT_EQ(mask.above, again.above) << n;
        ASSERT_TRUE(all_valid(mask)) << n;
        ASSERT_LE(unmendable(mask, truth), before) << n;
        won += before - unmendable(mask, truth);
    }
    EXPECT_GT(won, 1);
}

/// Of two valid masks, some of the places where they differ from one and the others from the other.
TEST(PinchmapMask, patchesOfValidMasksMix) {
    Random random(13);
    std::uint32_t patches = 0;
    for (int n = 0; n < 100; ++n) {
        const auto width = static_cast<std::uint32_t>(random.integer(1, 40)),
                   height = static_cast<std::uint32_t>(random.integer(1, 40));
        const auto valid_mask = [&](const std::vector<double>& parts) {
            const ZoneTruth truth = truth_of(parts, width, height);
            ZoneMask mask = majority_mask(truth.parts, width, height);
            enforce_constraints(mask, truth);
            return mask;
        };
        std::vector<double> parts = random_parts(random, width, height);
        const ZoneMask one = valid_mask(parts);
        for (double& part : parts) {
            if (random.chance(0.03)) part = 1 - part;
        }
        const ZoneMask other = valid_mask(parts);
        const ZonePatches found = patches_between(one, other);
        patches += found.count;
        std::vector<std::uint8_t> takes(found.count);
        for (std::uint8_t& take : takes)
            take = random.chance(0.5) ? 1 : 0;
        ZoneMask mixed = one;
        for (std::size_t k = 0; k < mixed.above.size(); ++k) {
            ASSERT_EQ(found.of[k] != ZonePatches::kNone, one.above[k] != other.above[k]) << n;
            if (found.of[k] != ZonePatches::kNone && takes[found.of[k]] != 0) mixed.above[k] = other.above[k];
        }
        ASSERT_TRUE(all_valid(mixed)) << n;
    }
    EXPECT_GT(patches, 300u);
}

/// Nothing that is valid is changed, and what is_valid_cluster says is what the validator does.
TEST(PinchmapMask, agreesWithTheValidatorOnAllSmallMasks) {
    std::size_t valid = 0;
    for (unsigned bits = 0; bits < 1U << 16; ++bits) {
        ZoneMask mask{4, 4, std::vector<std::uint8_t>(16)};
        for (unsigned k = 0; k < 16; ++k)
            mask.above[k] = bits >> k & 1U;
        const bool says = all_valid(mask);
        if (bits % 7 == 0 || says) {
            ASSERT_EQ(says, fetex::validate_pinchmap(texture_of(mask, fetex::PinchmapFormat::Bits8), 1).empty())
                << bits;
        }
        valid += says;
        if (!says) continue;
        const ZoneTruth truth = truth_of({mask.above.begin(), mask.above.end()}, 4, 4);
        const ZoneMask before = mask;
        if (unmendable(mask, truth) > 0) continue; // crosses
        ASSERT_EQ(enforce_constraints(mask, truth).moves, 0u);
        ASSERT_EQ(mask.above, before.above);
    }
    EXPECT_GE(valid, test::all_valid_masks(4).size() * 2);
}

/// In the drawing it is an isle that a zone of four clusters holds: with the right γ, at no cost.
TEST(PinchmapMask, aLoneClusterGetsThreeMore) {
    std::vector<double> parts(64, 0.0);
    parts[8 * 3 + 4] = 0.75;
    const ZoneTruth truth = truth_of(parts, 8, 8);
    ZoneMask mask = majority_mask(truth.parts, 8, 8);
    const MaskMoves cost = enforce_constraints(mask, truth);
    EXPECT_EQ(cost.broken, 1u);
    EXPECT_EQ(cost.moves, 1u);
    EXPECT_EQ(std::ranges::count(mask.above, 1), 4);
}

/// A line from border to border, x = 4.7 to 5.4, stays whole.
TEST(PinchmapMask, aThinLineStays) {
    ZoneTruth truth;
    for (int j = 0; j <= 16; ++j) {
        for (int i = 0; i <= 16; ++i) {
            truth.distances.push_back(std::max(0.35 - std::abs(i - 5.05), -2.0));
            if (i < 16 && j < 16) truth.parts.push_back(i == 4 ? 0.3 : i == 5 ? 0.4 : 0);
        }
    }
    ZoneMask mask = majority_mask(truth.parts, 16, 16);
    EXPECT_GT(enforce_constraints(mask, truth).moves, 0u);
    for (std::uint32_t j = 0; j < 16; ++j) {
        int above = 0;
        for (std::uint32_t i = 0; i < 16; ++i)
            above += mask.at(i, j);
        EXPECT_EQ(above, 2) << j;
    }
}

/// Four clusters are the least that a zone can be (§8).
TEST(PinchmapMask, fourClustersStay) {
    std::vector<double> parts(64, 0.0);
    for (const std::size_t k : {27u, 28u, 35u, 36u})
        parts[k] = 1;
    const ZoneTruth truth = truth_of(parts, 8, 8);
    ZoneMask mask = majority_mask(truth.parts, 8, 8);
    EXPECT_EQ(enforce_constraints(mask, truth).moves, 0u);
    EXPECT_EQ(std::ranges::count(mask.above, 1), 4);
}

} // namespace
} // namespace fetexc
