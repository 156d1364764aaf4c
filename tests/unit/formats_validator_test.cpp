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

/// One texel: band directory (records 0, 1: two bands), entries, pieces of each degree. All faults start from here.
///   0-1 directory: 2 bands, ends 1/2 and 1, lists at 2 and 5
///   2   run: 2 lines at 7, not the last of its feature      3 run: 1 cubic at 9, last       4 terminator
///   5   run: 1 quadratic at 8, last                         6 terminator
///   7   polyline (0,0) (1/4,1/4) (1/2,1/2) pad              8 quadratic                     9 cubic
FbtTexture sample_texture() {
    FbtTexture t;
    t.width = t.height = 1;
    t.apron = 1;
    t.texels = {0xff102030, kFbtKindBanded << 30, 0xff000000, 0, 0xff000000, 0, 0xff000000, 0};
    const auto p = fbt_pack_point;
    t.records = {
        2,           0,
        0x8000,      2, // 0
        0xc000,      5,
        0,           0, // 1
        7,           2 | 1 << 16,
        0,           0, // 2
        9,           1 | 3 << 16 | kFbtEntryLastRun,
        0xff0000ff,  0xe4, // 3
        0,           kFbtEntryTerminator,
        0x80808080,  0, // 4
        8,           1 | 2 << 16 | 3 << 18 | kFbtEntryLastRun,
        0xffff0000,  0, // 5
        0,           kFbtEntryTerminator,
        0xff00ff00,  0x01, // 6
        p(0, 0),     p(0.25, 0.25),
        p(0.5, 0.5), 0, // 7
        p(0, 0.5),   p(0.5, 0.5),
        p(1, 1),     0, // 8
        p(0.5, 0.5), p(0.6, 0.6),
        p(0.7, 0.7), p(1, 0.8), // 9
    };
    t.traits = {.max_degree = 3,
                .degrees = 0b1110,
                .bands = true,
                .interpolated = true,
                .translucent = true,
                .directions = 0b1001,
                .max_entries = 3,
                .max_bands = 2};
    return t;
}

std::uint32_t& word(FbtTexture& t, std::size_t record, std::size_t k) { return t.records[record * 4 + k]; }

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
        {"apron 2", C::FbtDimensions, [](FbtTexture& t) { t.apron = 2; }},
        {"width + apron wraps", C::FbtDimensions, [](FbtTexture& t) { t.apron = 0xffffffff; }},
        {"a texel short", C::FbtDimensions, [](FbtTexture& t) { t.texels.pop_back(); }},
        {"a word too many", C::FbtDimensions, [](FbtTexture& t) { t.records.push_back(0); }},
        {"kind 3", C::FbtTexelKind, [](FbtTexture& t) { t.texels[1] = 3u << 30; }},
        {"bits beside the mask", C::FbtReservedBits, [](FbtTexture& t) { t.texels[1] = 0x100; }},
        {"word 1 of the apron", C::FbtReservedBits, [](FbtTexture& t) { t.texels[3] = 1; }},
        {"list beyond", C::FbtAddress, [](FbtTexture& t) { t.texels[1] = kFbtKindSingle << 30 | 10; }},
        {"list far beyond", C::FbtAddress, [](FbtTexture& t) { t.texels[1] = kFbtKindSingle << 30 | kFbtAddressMask; }},
        {"directory beyond", C::FbtAddress, [](FbtTexture& t) { t.texels[1] = kFbtKindBanded << 30 | 10; }},
        {"no bands", C::FbtBandCount, [](FbtTexture& t) { word(t, 0, 0) = 0; }},
        {"2^32-1 bands", C::FbtBandCount, [](FbtTexture& t) { word(t, 0, 0) = 0xffffffff; }},
        {"20 bands", C::FbtBandCount, [](FbtTexture& t) { word(t, 0, 0) = 20; }},
        {"word 1 of a directory", C::FbtReservedBits, [](FbtTexture& t) { word(t, 0, 1) = 1; }},
        {"padding of a directory", C::FbtPadding, [](FbtTexture& t) { word(t, 1, 3) = 1; }},
        {"bands not rising", C::FbtBandOrder, [](FbtTexture& t) { word(t, 0, 2) = 0xc000; }},
        {"band ends at 0", C::FbtBandOrder, [](FbtTexture& t) { word(t, 0, 2) = 0x4000; }},
        {"y_end beyond u16", C::FbtBandOrder, [](FbtTexture& t) { word(t, 0, 2) = 0x18000; }},
        {"last band not to 1", C::FbtBandOrder, [](FbtTexture& t) { word(t, 1, 0) = 0xbfff; }},
        {"band's list beyond", C::FbtAddress, [](FbtTexture& t) { word(t, 1, 1) = 10; }},
        {"no terminator", C::FbtNoTerminator,
         [](FbtTexture& t) {
             t.records.resize(4 * 10);
             t.texels[1] = kFbtKindSingle << 30 | 9;
             word(t, 9, 0) = 7;
             word(t, 9, 1) = 2 | 1 << 16 | kFbtEntryLastRun;
             word(t, 9, 2) = 0xff000000;
             word(t, 9, 3) = 0;
         }},
        {"empty run", C::FbtEmptyRun, [](FbtTexture& t) { word(t, 2, 1) = 1 << 16; }},
        {"degree 0", C::FbtDegree, [](FbtTexture& t) { word(t, 2, 1) = 2; }},
        {"reserved bits of a run", C::FbtReservedBits, [](FbtTexture& t) { word(t, 3, 1) |= 1u << 22; }},
        {"reserved bits of a mask", C::FbtReservedBits, [](FbtTexture& t) { word(t, 3, 3) |= 0x100; }},
        {"pieces beyond", C::FbtPieceAddress, [](FbtTexture& t) { word(t, 2, 0) = 10; }},
        {"pieces run off", C::FbtPieceAddress, [](FbtTexture& t) { word(t, 3, 1) += 1; }},
        {"polyline runs off", C::FbtPieceAddress, [](FbtTexture& t) { word(t, 2, 1) = 0xffff | 1 << 16; }},
        {"address 2^32-1", C::FbtPieceAddress, [](FbtTexture& t) { word(t, 2, 0) = 0xffffffff; }},
        {"unfinished feature", C::FbtUnfinishedFeature,
         [](FbtTexture& t) {
             word(t, 3, 1) &= ~kFbtEntryLastRun;
             word(t, 3, 2) = word(t, 3, 3) = 0;
         }},
        {"terminator with pieces", C::FbtTerminator, [](FbtTexture& t) { word(t, 4, 1) |= 1; }},
        {"terminator with an address", C::FbtTerminator, [](FbtTexture& t) { word(t, 4, 0) = 1; }},
        {"sample in the middle of a feature", C::FbtStraySample, [](FbtTexture& t) { word(t, 2, 2) = 0xff000000; }},
        {"mask in the middle of a feature", C::FbtStraySample, [](FbtTexture& t) { word(t, 2, 3) = 1; }},
        {"mask without an apron", C::FbtMask,
         [](FbtTexture& t) {
             t.apron = 0;
             t.texels.resize(2);
         }},
        {"padding of a polyline", C::FbtPadding, [](FbtTexture& t) { word(t, 7, 3) = 1; }},
        {"padding of a quadratic", C::FbtPadding, [](FbtTexture& t) { word(t, 8, 3) = 1; }},
        {"quadratic turns in x", C::FbtNotMonotone, [](FbtTexture& t) { word(t, 8, 1) = fbt_pack_point(1.3, 0.5); }},
        {"quadratic turns in y", C::FbtNotMonotone, [](FbtTexture& t) { word(t, 8, 1) = fbt_pack_point(0.5, 0.4); }},
        {"cubic turns in x", C::FbtNotMonotone, [](FbtTexture& t) { word(t, 9, 2) = fbt_pack_point(1.4, 0.7); }},
        {"cubic turns in y", C::FbtNotMonotone, [](FbtTexture& t) { word(t, 9, 1) = fbt_pack_point(0.6, 1.2); }},
        {"cubic turns twice", C::FbtNotMonotone,
         [](FbtTexture& t) {
             word(t, 9, 1) = fbt_pack_point(0.6, 1.4);
             word(t, 9, 2) = fbt_pack_point(0.7, 0);
         }},
        {"texel not premultiplied", C::FbtNotPremultiplied, [](FbtTexture& t) { t.texels[0] = 0x10203040; }},
        {"region not premultiplied", C::FbtNotPremultiplied, [](FbtTexture& t) { word(t, 4, 2) = 0x80808081; }},
        {"wrong degrees", C::FbtTraitsMismatch, [](FbtTexture& t) { t.traits.degrees = 0b0110; }},
        {"wrong max_degree", C::FbtTraitsMismatch, [](FbtTexture& t) { t.traits.max_degree = 2; }},
        {"wrong bands", C::FbtTraitsMismatch, [](FbtTexture& t) { t.traits.bands = false; }},
        {"wrong interpolated", C::FbtTraitsMismatch, [](FbtTexture& t) { t.traits.interpolated = false; }},
        {"wrong translucent", C::FbtTraitsMismatch, [](FbtTexture& t) { t.traits.translucent = false; }},
        {"wrong directions", C::FbtTraitsMismatch, [](FbtTexture& t) { t.traits.directions = 15; }},
        {"wrong max_entries", C::FbtTraitsMismatch, [](FbtTexture& t) { t.traits.max_entries = 2; }},
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
    word(t, 9, 1) -= 2u << 16; // y of the first handle: two steps back from a flat start
    word(t, 9, 1) = (word(t, 9, 1) & 0xffffu) | ((word(t, 9, 0) >> 16) - 2) << 16;
    EXPECT_TRUE(validate_fbt(t).empty());
}

TEST(Validator, stopsAtTheLimit) {
    FbtTexture t = random_fbt(1, {.width = 30, .height = 30});
    for (std::size_t k = 0; k < t.texels.size(); k += 2)
        t.texels[k] = 0x000000ff;
    EXPECT_EQ(validate_fbt(t, 10).size(), 10u);
}

TEST(Validator, takesEveryRandomTexture) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const FbtTexture t = random_fbt(seed, {.width = 5, .height = 4, .apron = static_cast<std::uint32_t>(seed % 2)});
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
        }
    }
    EXPECT_GT(taken, 1000);
    EXPECT_LT(taken, 15000);
}

/// Every texel at another offset of one long list, and every run with as many pieces as fit: the walk must not start
/// over for each (it would take some 10^10 steps).
TEST(Validator, takesTimeInProportionToTheBytes) {
    FbtTexture t;
    t.width = 512;
    t.height = 256;
    const std::uint32_t entries = 512 * 256, pieces = 65535;
    for (std::uint32_t k = 0; k < entries; ++k) {
        t.texels.push_back(0xff000000);
        t.texels.push_back(kFbtKindSingle << 30 | k);
        t.records.push_back(entries + 1 + k % 1000);
        t.records.push_back(pieces | 3 << 16 | kFbtEntryLastRun);
        t.records.push_back(0xff000000);
        t.records.push_back(0);
    }
    for (const std::uint32_t v : {0u, kFbtEntryTerminator, 0xff000000u, 0u})
        t.records.push_back(v);
    for (std::uint32_t k = 0; k < pieces + 1000; ++k)
        for (const double v : {0.1, 0.2, 0.3, 0.4})
            t.records.push_back(fbt_pack_point(v, v));
    const auto start = std::chrono::steady_clock::now();
    t.traits = fbt_traits(t);
    EXPECT_TRUE(validate_fbt(t).empty());
    EXPECT_EQ(t.traits.max_entries, entries + 1);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
}

TEST(Validator, refusesListsThatNoShaderLoopReaches) {
    FbtTexture t;
    t.width = t.height = 1;
    t.texels = {0xff000000, kFbtKindSingle << 30};
    for (std::uint32_t k = 0; k < kFbtMaxEntries; ++k) {
        for (const std::uint32_t v : {kFbtMaxEntries + 1, 1u | 1u << 16 | kFbtEntryLastRun, 0xff000000u, 0u})
            t.records.push_back(v);
    }
    for (const std::uint32_t v : {0u, kFbtEntryTerminator, 0xff000000u, 0u, 0u, 0u, 0u, 0u})
        t.records.push_back(v);
    t.traits = fbt_traits(t);
    const auto findings = validate_fbt(t);
    ASSERT_FALSE(findings.empty());
    EXPECT_EQ(findings[0].code, FindingCode::FbtTooManyEntries);
    t.texels[1] += 1; // one entry fewer
    t.traits = fbt_traits(t);
    EXPECT_TRUE(validate_fbt(t).empty());
}

} // namespace
} // namespace fetex
