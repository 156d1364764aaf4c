// SPDX-License-Identifier: GPL-3.0-or-later
/// The validator finds each kind of fault, takes what is valid, and what it takes can be sampled.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <random>

#include "formats/validate.h"
#include "tests/support/random_fbt.h"

namespace fetex {
namespace {

using fetexc::test::random_fbt;

/// One texel: band directory, two lists, pieces of each degree, every model. All faults start from here.
///   0   directory: 2 bands, ends 1/2 and 1, lists at 1 and 6
///   1   run: 2 lines, not the last of its feature (records 1, 2)
///   3   run: 1 cubic, last; inside the corners, the rest the patch (records 3, 4)
///   5   the patch
///   6   run: 1 quadratic, last; inside a colour, the rest one (records 6, 7)
///   8   a lone rest; not used
FbtTexture sample_texture() {
    FbtTexture t;
    t.width = t.height = 1;
    t.texels = {kFbtKindBanded << 30};
    t.corners = {0xff102030, 0xff000000, 0xff000000, 0xff000000};
    const auto p = fbt_pack_point;
    t.records = {
        2,
        0x8000 | 0xc000u << 16,
        1,
        6, // 0
        2 | 1 << 10,
        0,
        p(0, 0),
        p(0.25, 0.25), // 1
        p(0.5, 0.5),
        0,
        0,
        0, // 2
        1 | 3 << 10 | kFbtEntryLastRun | kFbtEntryLast | kFbtModelCorners << 16 | kFbtModelPatch << 18,
        0,
        p(0.5, 0.5),
        p(0.6, 0.6), // 3
        p(0.7, 0.7),
        p(1, 0.8),
        5,
        0, // 4
        0xff0000ff,
        0xff00ff00,
        0x80808080,
        0, // 5
        1 | 2 << 10 | 3 << 12 | kFbtEntryLastRun | kFbtEntryLast,
        0xffff0000,
        p(0, 0.5),
        p(0.5, 0.5), // 6
        p(1, 1),
        0xff00ff00,
        0,
        0, // 7
        kFbtEntryLastRun | kFbtEntryLast,
        0,
        0,
        0xff000000, // 8
    };
    t.traits = {.max_degree = 3,
                .degrees = 0b1110,
                .bands = true,
                .corners = true,
                .patches = true,
                .shared = false,
                .translucent = true,
                .directions = 0b1001,
                .max_entries = 2,
                .max_bands = 2};
    return t;
}

std::uint32_t& word(FbtTexture& t, std::size_t record, std::size_t k) { return t.records[record * 4 + k]; }

/// The list of record 6 alone.
void single(FbtTexture& t) { t.texels[0] = kFbtKindSingle << 30 | 6; }

TEST(Validator, takesAGoodTexture) {
    const auto findings = validate_fbt(sample_texture());
    EXPECT_TRUE(findings.empty()) << finding_id(findings[0].code) << " " << findings[0].message;
}

struct Fault {
    const char* what;
    FindingCode expected;
    std::function<void(FbtTexture&)> make;
};

std::vector<Fault> faults() {
    using C = FindingCode;
    return {
        {"no width", C::FbtDimensions, [](FbtTexture& t) { t.width = 0; }},
        {"too wide", C::FbtDimensions, [](FbtTexture& t) { t.width = 16385; }},
        {"no height", C::FbtDimensions, [](FbtTexture& t) { t.height = 0; }},
        {"a texel short", C::FbtDimensions, [](FbtTexture& t) { t.texels.pop_back(); }},
        {"a corner short", C::FbtDimensions, [](FbtTexture& t) { t.corners.pop_back(); }},
        {"a mip chain of two samples", C::FbtDimensions,
         [](FbtTexture& t) {
             t.mips = {0, 0};
         }},
        {"a mip sample that isn't premultiplied", C::FbtNotPremultiplied, [](FbtTexture& t) { t.mips = {0x7f800000}; }},
        {"a translucent mip sample in an opaque texture", C::FbtTraitsMismatch,
         [](FbtTexture& t) {
             single(t);
             t.corners = {0xff000000, 0xff000000, 0xff000000, 0xff000000};
             t.traits = fbt_traits(t);
             t.mips = {0xfe000000};
         }},
        {"a word too many", C::FbtDimensions, [](FbtTexture& t) { t.records.push_back(0); }},
        {"bits of a solid texel", C::FbtReservedBits, [](FbtTexture& t) { t.texels[0] = kFbtOpaque << 1; }},
        {"a colour that isn't opaque", C::FbtReservedBits, [](FbtTexture& t) { t.texels[0] = 1; }},
        {"shaded solid", C::FbtModel, [](FbtTexture& t) { t.texels[0] = 3u << 30; }},
        {"shaded by model 3", C::FbtModel, [](FbtTexture& t) { t.texels[0] = 15u << 28; }},
        {"corners with a sample", C::FbtReservedBits, [](FbtTexture& t) { t.texels[0] = 13u << 28 | 1; }},
        {"patch beyond", C::FbtAddress, [](FbtTexture& t) { t.texels[0] = 14u << 28 | 9; }},
        {"list beyond", C::FbtAddress, [](FbtTexture& t) { t.texels[0] = kFbtKindSingle << 30 | 9; }},
        {"list far beyond", C::FbtAddress, [](FbtTexture& t) { t.texels[0] = kFbtKindSingle << 30 | kFbtAddressMask; }},
        {"directory beyond", C::FbtAddress, [](FbtTexture& t) { t.texels[0] = kFbtKindBanded << 30 | 9; }},
        {"no bands", C::FbtBandCount, [](FbtTexture& t) { word(t, 0, 0) = 0; }},
        {"2^32-1 bands", C::FbtBandCount, [](FbtTexture& t) { word(t, 0, 0) = 0xffffffff; }},
        {"30 bands", C::FbtBandCount, [](FbtTexture& t) { word(t, 0, 0) = 30; }},
        {"padding of a directory", C::FbtPadding,
         [](FbtTexture& t) {
             word(t, 0, 0) = 1;
             word(t, 0, 1) = 0xc000;
         }},
        {"padding of the ends of bands", C::FbtPadding,
         [](FbtTexture& t) {
             word(t, 0, 0) = 1;
             word(t, 0, 1) = 0xc000 | 1u << 16;
             word(t, 0, 3) = 0;
         }},
        {"bands not rising", C::FbtBandOrder, [](FbtTexture& t) { word(t, 0, 1) = 0xc000 | 0xc000u << 16; }},
        {"band ends at 0", C::FbtBandOrder, [](FbtTexture& t) { word(t, 0, 1) = 0x4000 | 0xc000u << 16; }},
        {"last band not to 1", C::FbtBandOrder, [](FbtTexture& t) { word(t, 0, 1) = 0x8000 | 0xbfffu << 16; }},
        {"band's list beyond", C::FbtAddress, [](FbtTexture& t) { word(t, 0, 3) = 9; }},
        {"no last entry", C::FbtNoLastEntry,
         [](FbtTexture& t) {
             t.records.resize(32);
             single(t);
             word(t, 6, 0) &= ~kFbtEntryLast;
             word(t, 7, 1) = 0;
         }},
        {"no pieces", C::FbtDegree, [](FbtTexture& t) { word(t, 1, 0) = 1 << 10; }},
        {"degree 0", C::FbtDegree, [](FbtTexture& t) { word(t, 1, 0) = 2; }},
        {"a lone rest that isn't last", C::FbtEmptyRun,
         [](FbtTexture& t) { word(t, 1, 0) = word(t, 1, 2) = word(t, 1, 3) = 0; }},
        {"a lone rest with a ray", C::FbtEmptyRun,
         [](FbtTexture& t) {
             t.texels[0] = kFbtKindSingle << 30 | 8;
             word(t, 8, 0) |= 1 << 12;
         }},
        {"a lone rest with a sample", C::FbtEmptyRun,
         [](FbtTexture& t) {
             t.texels[0] = kFbtKindSingle << 30 | 8;
             word(t, 8, 1) = 0xff000000;
         }},
        {"reserved bits of an entry", C::FbtReservedBits, [](FbtTexture& t) { word(t, 3, 0) |= 1u << 24; }},
        {"points run off", C::FbtPieceAddress, [](FbtTexture& t) { word(t, 6, 0) |= kFbtMaxPieces; }},
        {"shared points beyond", C::FbtPieceAddress,
         [](FbtTexture& t) {
             single(t);
             t.records.resize(28);
             word(t, 6, 0) |= kFbtEntryShared;
             word(t, 6, 2) = 26; // three of them
         }},
        {"shared points at 2^32-1", C::FbtPieceAddress,
         [](FbtTexture& t) {
             single(t);
             t.records.resize(28);
             word(t, 6, 0) |= kFbtEntryShared;
             word(t, 6, 2) = 0xffffffff;
         }},
        {"unfinished feature", C::FbtUnfinishedFeature,
         [](FbtTexture& t) { word(t, 3, 0) = 1 | 3 << 10 | kFbtEntryLast | kFbtModelPatch << 18; }},
        {"sample in the middle of a feature", C::FbtStraySample, [](FbtTexture& t) { word(t, 1, 1) = 0xff000000; }},
        {"model in the middle of a feature", C::FbtStraySample, [](FbtTexture& t) { word(t, 1, 0) |= 1u << 16; }},
        {"rest in the middle of a list", C::FbtStraySample, [](FbtTexture& t) { word(t, 1, 0) |= 1u << 18; }},
        {"no corners", C::FbtCorners, [](FbtTexture& t) { t.corners.clear(); }},
        {"model 3 inside", C::FbtModel, [](FbtTexture& t) { word(t, 6, 0) |= 3u << 16; }},
        {"model 3 of the rest", C::FbtModel, [](FbtTexture& t) { word(t, 6, 0) |= 3u << 18; }},
        {"padding of an entry", C::FbtPadding, [](FbtTexture& t) { word(t, 2, 3) = 1; }},
        {"padding after a rest", C::FbtPadding, [](FbtTexture& t) { word(t, 7, 2) = 1; }},
        {"quadratic turns in x", C::FbtNotMonotone, [](FbtTexture& t) { word(t, 6, 3) = fbt_pack_point(1.3, 0.5); }},
        {"quadratic turns in y", C::FbtNotMonotone, [](FbtTexture& t) { word(t, 6, 3) = fbt_pack_point(0.5, 0.4); }},
        {"cubic turns in x", C::FbtNotMonotone, [](FbtTexture& t) { word(t, 4, 0) = fbt_pack_point(1.4, 0.7); }},
        {"cubic turns in y", C::FbtNotMonotone, [](FbtTexture& t) { word(t, 3, 3) = fbt_pack_point(0.6, 1.2); }},
        {"cubic turns twice", C::FbtNotMonotone,
         [](FbtTexture& t) {
             word(t, 3, 3) = fbt_pack_point(0.6, 1.4);
             word(t, 4, 0) = fbt_pack_point(0.7, 0);
         }},
        {"corner not premultiplied", C::FbtNotPremultiplied, [](FbtTexture& t) { t.corners[0] = 0x10203040; }},
        {"region not premultiplied", C::FbtNotPremultiplied, [](FbtTexture& t) { word(t, 6, 1) = 0x80808081; }},
        {"rest not premultiplied", C::FbtNotPremultiplied, [](FbtTexture& t) { word(t, 7, 1) = 0x80808081; }},
        {"patch not premultiplied", C::FbtNotPremultiplied, [](FbtTexture& t) { word(t, 5, 2) = 0x80808081; }},
        {"wrong degrees", C::FbtTraitsMismatch, [](FbtTexture& t) { t.traits.degrees = 0b0110; }},
        {"wrong max_degree", C::FbtTraitsMismatch, [](FbtTexture& t) { t.traits.max_degree = 2; }},
        {"wrong bands", C::FbtTraitsMismatch, [](FbtTexture& t) { t.traits.bands = false; }},
        {"wrong corners", C::FbtTraitsMismatch, [](FbtTexture& t) { t.traits.corners = false; }},
        {"wrong patches", C::FbtTraitsMismatch, [](FbtTexture& t) { t.traits.patches = false; }},
        {"wrong shared", C::FbtTraitsMismatch, [](FbtTexture& t) { t.traits.shared = true; }},
        {"wrong translucent", C::FbtTraitsMismatch, [](FbtTexture& t) { t.traits.translucent = false; }},
        {"wrong directions", C::FbtTraitsMismatch, [](FbtTexture& t) { t.traits.directions = 15; }},
        {"wrong max_entries", C::FbtTraitsMismatch, [](FbtTexture& t) { t.traits.max_entries = 3; }},
        {"wrong max_depth", C::FbtTraitsMismatch, [](FbtTexture& t) { t.traits.max_depth = 1; }},
        {"deeper than what it lies in", C::FbtNesting, [](FbtTexture& t) { word(t, 6, 0) |= 1u << kFbtDepthShift; }},
        {"two deeper than what follows", C::FbtNesting, [](FbtTexture& t) { word(t, 1, 0) |= 2u << kFbtDepthShift; }},
        {"a run deeper than its feature", C::FbtNesting,
         [](FbtTexture& t) { word(t, 1, 0) = (word(t, 1, 0) & ~kFbtEntryLastRun) | 1u << kFbtDepthShift; }},
        {"wrong max_bands", C::FbtTraitsMismatch, [](FbtTexture& t) { t.traits.max_bands = 3; }},
    };
}

TEST(Validator, findsEachFault) {
    for (const Fault& fault : faults()) {
        FbtTexture t = sample_texture();
        fault.make(t);
        const auto findings = validate_fbt(t);
        ASSERT_FALSE(findings.empty()) << fault.what;
        EXPECT_EQ(finding_id(findings[0].code), finding_id(fault.expected))
            << fault.what << ": " << findings[0].message;
    }
}

TEST(Validator, allowsWhatRoundingDoesToAMonotonePiece) {
    FbtTexture t = sample_texture();
    // y of the first handle: two steps back from a flat start
    word(t, 3, 3) = (word(t, 3, 3) & 0xffffu) | ((word(t, 3, 2) >> 16) - 2) << 16;
    EXPECT_TRUE(validate_fbt(t).empty());
}

TEST(Validator, stopsAtTheLimit) {
    FbtTexture t = random_fbt(1, {.width = 30, .height = 30});
    for (std::uint32_t& corner : t.corners)
        corner = 0x000000ff;
    EXPECT_EQ(validate_fbt(t, 10).size(), 10u);
}

TEST(Validator, takesEveryRandomTexture) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const FbtTexture t = random_fbt(seed, {.width = 5, .height = 4, .corners = seed % 2 == 0});
        const auto findings = validate_fbt(t);
        ASSERT_TRUE(findings.empty()) << seed << " " << finding_id(findings[0].code) << " " << findings[0].message;
    }
}

/// Whatever a word is changed to: either there is a finding, or sampling stays inside the arrays and ends. Runs under
/// the address sanitiser in CI.
TEST(Validator, whatItTakesCanBeSampled) {
    std::mt19937_64 random(77);
    int taken = 0;
    for (int n = 0; n < 20000; ++n) {
        FbtTexture t =
            n % 2 ? sample_texture() : random_fbt(static_cast<std::uint64_t>(n % 64), {.width = 2, .height = 2});
        auto& words = n % 3 == 0 ? t.texels : t.records;
        if (words.empty()) continue;
        std::uint32_t& changed = words[random() % words.size()];
        changed = n % 5 < 3 ? changed ^ 1u << random() % 32 : static_cast<std::uint32_t>(random());
        t.traits = fbt_traits(t);
        if (!validate_fbt(t, 1).empty()) continue;
        ++taken;
        for (int k = 0; k < 40; ++k) {
            const FbtColor c =
                fbt_sample(t, static_cast<double>(random() % 2049) / 1024, static_cast<double>(random() % 2049) / 1024);
            ASSERT_TRUE(c.r >= 0 && c.r <= 1 + 1e-12 && c.a >= 0 && c.a <= 1 + 1e-12);
            if (k % 8 != 0) continue;
            const FbtPixel pixel{static_cast<double>(1 + random() % 512) / 1024, 0.3, k % 16 == 0};
            const FbtColor mean = fbt_sample_area(t, static_cast<double>(random() % 2049) / 1024,
                                                  static_cast<double>(random() % 2049) / 1024, pixel);
            ASSERT_TRUE(mean.r >= 0 && mean.r <= 1 + 1e-12 && mean.a >= 0 && mean.a <= 1 + 1e-12);
        }
    }
    EXPECT_GT(taken, 1000);
    EXPECT_LT(taken, 15000);
}

/// Every texel at another offset of one long list, and every run with as many pieces as fit, at all offsets modulo the
/// degree: the walk must not start over for each (it would take 10^8 steps a megabyte).
TEST(Validator, takesTimeInProportionToTheBytes) {
    FbtTexture t;
    t.width = 512;
    t.height = 256;
    const std::uint32_t entries = 512 * 256;
    for (std::uint32_t k = 0; k < entries; ++k) {
        t.texels.push_back(kFbtKindSingle << 30 | k);
        const std::uint32_t last = k + 1 == entries ? kFbtEntryLast : 0;
        for (const std::uint32_t v : {kFbtMaxPieces | 3u << 10 | kFbtEntryLastRun | kFbtEntryShared | last, 0xff000000u,
                                      4 * entries + k % 4000, last != 0 ? 0xff000000u : 0u})
            t.records.push_back(v);
    }
    for (std::uint32_t k = 0; k < 3 * kFbtMaxPieces + 4004; ++k)
        t.records.push_back(fbt_pack_point(0.25, 0.25));
    t.records.resize((t.records.size() + 3) / 4 * 4, 0);
    const auto start = std::chrono::steady_clock::now();
    t.traits = fbt_traits(t);
    const auto findings = validate_fbt(t);
    EXPECT_TRUE(findings.empty()) << findings[0].message;
    EXPECT_EQ(t.traits.max_entries, entries);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(Validator, refusesListsThatNoShaderLoopReaches) {
    FbtTexture t;
    t.width = t.height = 1;
    t.texels = {kFbtKindSingle << 30};
    const std::uint32_t line = 1u | 1u << 10 | kFbtEntryLastRun;
    for (std::uint32_t k = 0; k < kFbtMaxEntries; ++k) {
        for (const std::uint32_t v : {line, 0xff000000u, 0u, 0u})
            t.records.push_back(v);
    }
    for (const std::uint32_t v : {line | kFbtEntryLast, 0xff000000u, 0u, 0u, 0xff000000u, 0u, 0u, 0u})
        t.records.push_back(v);
    t.traits = fbt_traits(t);
    const auto findings = validate_fbt(t);
    ASSERT_FALSE(findings.empty());
    EXPECT_EQ(findings[0].code, FindingCode::FbtTooManyEntries);
    t.texels[0] += 1; // one entry fewer
    t.traits = fbt_traits(t);
    EXPECT_TRUE(validate_fbt(t).empty());
}

} // namespace
} // namespace fetex
