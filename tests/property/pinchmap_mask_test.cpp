// SPDX-License-Identifier: GPL-3.0-or-later
/// Zones of pinchmaps: what the constraints of §4.4 leave of any mask, and that maps made from it are valid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "compiler/pinchmap/pinch_frame.h"
#include "compiler/pinchmap/zone_mask.h"
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

double wrong_parts(const ZoneMask& mask, const std::vector<double>& parts) {
    double sum = 0;
    for (std::size_t k = 0; k < parts.size(); ++k)
        sum += mask.above[k] != 0 ? 1 - parts[k] : parts[k];
    return sum;
}

TEST(PinchmapMask, noForbiddenNeighbourhoodIsLeft) {
    Random random(11);
    std::uint64_t moves = 0;
    for (int n = 0; n < 400; ++n) {
        const auto width = static_cast<std::uint32_t>(random.integer(1, 24)),
                   height = static_cast<std::uint32_t>(random.integer(1, 24));
        const std::vector<double> parts = random_parts(random, width, height);
        ZoneMask mask = majority_mask(parts, width, height);
        const double before = wrong_parts(mask, parts);
        const MaskMoves cost = enforce_constraints(mask, parts);
        moves += cost.moves;
        ASSERT_TRUE(all_valid(mask)) << n;
        ASSERT_NEAR(cost.lost, wrong_parts(mask, parts) - before, 1e-9) << n;
        ASSERT_EQ(cost.moves == 0, cost.broken == 0) << n;
        for (const fetex::PinchmapFormat format : test::kPinchmapFormats) {
            const auto findings = fetex::validate_pinchmap(texture_of(mask, format), 1);
            ASSERT_TRUE(findings.empty()) << n << ": " << findings[0].message;
        }
    }
    EXPECT_GT(moves, 1000u);
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
        std::vector<double> parts(mask.above.begin(), mask.above.end());
        const ZoneMask before = mask;
        ASSERT_EQ(enforce_constraints(mask, parts).moves, 0u);
        ASSERT_EQ(mask.above, before.above);
    }
    EXPECT_GE(valid, test::all_valid_masks(4).size() * 2);
}

/// The paper's example of what a mask can't hold: one cluster is lost at the cost of itself.
TEST(PinchmapMask, aLoneClusterGoes) {
    std::vector<double> parts(64, 0.0);
    parts[8 * 3 + 4] = 0.75;
    ZoneMask mask = majority_mask(parts, 8, 8);
    const MaskMoves cost = enforce_constraints(mask, parts);
    EXPECT_EQ(cost.moves, 1u);
    EXPECT_DOUBLE_EQ(cost.lost, 0.5);
    EXPECT_TRUE(std::ranges::none_of(mask.above, [](std::uint8_t v) { return v != 0; }));
}

/// Four clusters are the least that a zone can be (§8).
TEST(PinchmapMask, fourClustersStay) {
    std::vector<double> parts(64, 0.0);
    for (const std::size_t k : {27u, 28u, 35u, 36u})
        parts[k] = 1;
    ZoneMask mask = majority_mask(parts, 8, 8);
    EXPECT_EQ(enforce_constraints(mask, parts).moves, 0u);
    EXPECT_EQ(std::ranges::count(mask.above, 1), 4);
}

} // namespace
} // namespace fetexc
