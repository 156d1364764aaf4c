// SPDX-License-Identifier: GPL-3.0-or-later
/// Samples of 16 bits a channel: the encoding, the sampler, the validator and the file.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "formats/fbt_samples.h"
#include "formats/fetex_file.h"
#include "formats/validate.h"
#include "tests/support/fbt_maker.h"
#include "tests/support/random_fbt.h"

namespace fetex {
namespace {

using fetexc::test::append_list;
using fetexc::test::append_patch;
using fetexc::test::random_fbt;
using fetexc::test::shaded_texel;

constexpr FbtSampleFormat kWide[] = {FbtSampleFormat::Rgba16, FbtSampleFormat::Rgba16F};

TEST(Halves, haveTheValuesOfIeee754) {
    EXPECT_EQ(fbt_half_value(0), 0);
    EXPECT_EQ(fbt_half_value(1), 0x1p-24);
    EXPECT_EQ(fbt_half_value(0x3ff), 1023 * 0x1p-24);
    EXPECT_EQ(fbt_half_value(0x400), 0x1p-14);
    EXPECT_EQ(fbt_half_value(0x3555), 0.333251953125);
    EXPECT_EQ(fbt_half_value(kFbtHalfOne), 1);
    EXPECT_EQ(fbt_half_value(0x7bff), kFbtMaxHalf);
}

/// Each is the nearest to itself and to what lies around it, up to halfway to its neighbours.
TEST(Halves, areTheNearest) {
    for (std::uint32_t half = 0; half < kFbtHalfInfinity; ++half) {
        const double v = fbt_half_value(half);
        ASSERT_EQ(fbt_to_half(v), half);
        if (half + 1 == kFbtHalfInfinity) break;
        const double next = fbt_half_value(half + 1), middle = 0.5 * (v + next);
        ASSERT_GT(next, v);
        ASSERT_EQ(fbt_to_half(std::nextafter(middle, 0)), half);
        ASSERT_EQ(fbt_to_half(middle), half + 1);
        ASSERT_LE(middle - v, fbt_sample_rounding(v, FbtSampleFormat::Rgba16F));
    }
}

TEST(Halves, areClamped) {
    for (const double v : {-1.0, -0.0, -std::numeric_limits<double>::infinity(), std::nan("")})
        EXPECT_EQ(fbt_to_half(v), 0u) << v;
    for (const double v : {65505.0, 65520.0, 1e9, std::numeric_limits<double>::infinity()})
        EXPECT_EQ(fbt_to_half(v), 0x7bffu) << v;
}

TEST(WideSamples, areWithinTheirRounding) {
    const FbtColor color{0.123456, 0.3, 0.499, 0.5};
    for (const FbtSampleFormat format : {FbtSampleFormat::Rgba8, FbtSampleFormat::Rgba16, FbtSampleFormat::Rgba16F}) {
        const auto words = fbt_pack_sample(color, format);
        const auto channels = fbt_sample_channels(words.data(), format);
        const double wanted[] = {color.r, color.g, color.b, color.a};
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_LE(std::abs(channels[k] / fbt_sample_unit(format) - wanted[k]),
                      fbt_sample_rounding(wanted[k], format));
        }
        EXPECT_FALSE(fbt_sample_opaque(words.data(), format));
    }
    EXPECT_EQ(fbt_pack_sample({1, 0.5, 0, 1}, FbtSampleFormat::Rgba16), (std::array{0x8000ffffu, 0xffff0000u}));
    EXPECT_EQ(fbt_pack_sample({1, 0.5, 0, 1}, FbtSampleFormat::Rgba16F), (std::array{0x38003c00u, 0x3c000000u}));
    EXPECT_EQ(fbt_pack_sample({1, 0.5, 0, 1}, FbtSampleFormat::Rgba8), (std::array{0xff0080ffu, 0u}));
}

TEST(WideSamples, areClampedToWhatTheFormatHolds) {
    EXPECT_EQ(fbt_pack_sample({2, -1, 0.7, 0.5}, FbtSampleFormat::Rgba16), (std::array{0x00008000u, 0x80008000u}));
    const auto bright = fbt_pack_sample({2, -1, 0.75, 3}, FbtSampleFormat::Rgba16F);
    EXPECT_EQ(fbt_sample_channels(bright.data(), FbtSampleFormat::Rgba16F), (std::array{2.0, 0.0, 0.75, 1.0}));
    EXPECT_EQ(fbt_pack_sample({2, 1, 1, 0}, FbtSampleFormat::Rgba16F), (std::array{0u, 0u}));
}

/// Two by one texels: the left one shows the corners, the right one a patch left of a line and a solid colour right of
/// it. Corners rise by 0.25 a column in red, patches by 0.5 a row in green.
FbtTexture two_texels(FbtSampleFormat format) {
    FbtTexture t;
    t.sample_format = format;
    t.width = 2, t.height = 1;
    const auto append = [&](std::vector<std::uint32_t>& words, const FbtColor& c) {
        const auto sample = fbt_pack_sample(c, format);
        words.insert(words.end(), sample.begin(), sample.end());
    };
    for (int k = 0; k < 6; ++k)
        append(t.corners, {0.25 * (k % 3), 0, 0, 1});
    std::vector<std::uint32_t> patch;
    for (int k = 0; k < 4; ++k)
        append(patch, {0, 0.5 * (k / 2), 0, 0.5});
    const std::uint32_t at = append_patch(t.records, patch);
    const fetexc::test::MadeRun line{1,    kFbtRayPosX,         1, {fbt_pack_point(0.5, 0), fbt_pack_point(0.5, 1)}, 0,
                                     true, {kFbtModelPatch, at}};
    t.texels = {shaded_texel({kFbtModelCorners, 0}),
                kFbtKindSingle << 30 | append_list(t.records, {line}, {kFbtModelSolid, 0xff0000ff})};
    t.traits = fbt_traits(t);
    return t;
}

TEST(WideSamples, areInterpolated) {
    for (const FbtSampleFormat format : kWide) {
        const FbtTexture t = two_texels(format);
        ASSERT_TRUE(validate_fbt(t).empty()) << validate_fbt(t)[0].message;
        EXPECT_TRUE(t.traits.translucent);
        for (const double x : {0.0, 0.3, 0.9}) {
            EXPECT_NEAR(fbt_sample(t, x, 0.4).r, 0.25 * x, 0.5 / 65535);
            EXPECT_DOUBLE_EQ(fbt_sample(t, x, 0.4).a, 1);
        }
        for (const double y : {0.0, 0.3, 0.99}) {
            EXPECT_NEAR(fbt_sample(t, 1.25, y).g, 0.5 * y, 0.5 / 65535);
            EXPECT_NEAR(fbt_sample(t, 1.25, y).a, 0.5, 0.5 / 65535);
            EXPECT_DOUBLE_EQ(fbt_sample(t, 1.75, y).r, 1); // RGBA8
        }
        const FbtColor mean = fbt_sample_area(t, 1.5, 0.5, {0.5, 0.5, true});
        EXPECT_NEAR(mean.g, 0.125, 1e-5);
        EXPECT_NEAR(mean.r, 0.5, 1e-5);
    }
}

TEST(WideSamples, mayBeBrighterThanWhiteAsHalves) {
    FbtTexture t = two_texels(FbtSampleFormat::Rgba16F);
    const std::uint32_t bright = fbt_to_half(1000);
    for (std::size_t k = 0; k < t.corners.size(); k += 2)
        t.corners[k] = bright;
    ASSERT_TRUE(validate_fbt(t).empty());
    EXPECT_EQ(fbt_sample(t, 0.5, 0.5).r, 1000);
    t.records[0] = bright; // the patch's first corner has alpha 1/2
    ASSERT_TRUE(validate_fbt(t).empty());
    EXPECT_EQ(fbt_sample(t, 1, 0).r, 1000);
}

TEST(WideSamples, areReadAsTheyWereWritten) {
    for (const FbtSampleFormat format : kWide) {
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            FetexFile file;
            file.fbt = random_fbt(seed, {.width = 5, .height = 3, .mips = seed % 2 == 0, .sample_format = format});
            const auto findings = validate_fbt(*file.fbt);
            ASSERT_TRUE(findings.empty()) << seed << " " << finding_id(findings[0].code) << " " << findings[0].message;
            FetexFile back;
            const auto bad = read_file(back, write_file(file));
            ASSERT_FALSE(bad.has_value()) << bad->message;
            EXPECT_EQ(back.fbt->sample_format, format);
            EXPECT_EQ(back.fbt->corners, file.fbt->corners);
            EXPECT_EQ(back.fbt->records, file.fbt->records);
            EXPECT_EQ(fbt_gpu_bytes(*back.fbt), fbt_gpu_bytes(*file.fbt));
        }
    }
}

/// The same words under another format have other sizes, or another meaning; a format that there isn't is refused.
TEST(WideSamples, ofTheWrongFormatAreRefused) {
    FetexFile file;
    file.fbt = two_texels(FbtSampleFormat::Rgba16);
    file.fbt->sample_format = FbtSampleFormat::Rgba8;
    FetexFile back;
    auto finding = read_file(back, write_file(file));
    ASSERT_TRUE(finding.has_value());
    EXPECT_EQ(finding->code, FindingCode::FbtSizeMismatch);
    file.fbt->sample_format = static_cast<FbtSampleFormat>(3);
    finding = read_file(back, write_file(file));
    ASSERT_TRUE(finding.has_value());
    EXPECT_EQ(finding->code, FindingCode::BadFbtHeader);
    ASSERT_FALSE(validate_fbt(*file.fbt).empty());
    EXPECT_EQ(validate_fbt(*file.fbt)[0].code, FindingCode::FbtDimensions);
}

struct Fault {
    const char* what;
    FbtSampleFormat format;
    FindingCode expected;
    std::function<void(FbtTexture&)> make;
};

TEST(WideSamples, haveTheirFaultsFound) {
    using C = FindingCode;
    constexpr auto unorm = FbtSampleFormat::Rgba16, half = FbtSampleFormat::Rgba16F;
    const Fault faults[] = {
        {"half the corners", unorm, C::FbtDimensions, [](FbtTexture& t) { t.corners.resize(6); }},
        {"a word short", half, C::FbtDimensions, [](FbtTexture& t) { t.corners.pop_back(); }},
        {"patch ends beyond the records", unorm, C::FbtAddress,
         [](FbtTexture& t) {
             t.texels[0] = shaded_texel({kFbtModelPatch, static_cast<std::uint32_t>(t.records.size() / 4 - 1)});
         }},
        {"red above alpha", unorm, C::FbtNotPremultiplied, [](FbtTexture& t) { t.records[0] = 0x8001; }},
        {"green above alpha", unorm, C::FbtNotPremultiplied, [](FbtTexture& t) { t.records[2] = 0x80010000; }},
        {"blue above alpha", unorm, C::FbtNotPremultiplied, [](FbtTexture& t) { t.records[7] |= 0x8001; }},
        {"corner above alpha", unorm, C::FbtNotPremultiplied, [](FbtTexture& t) { t.corners[3] = 0x3fff0000; }},
        {"alpha above 1", half, C::FbtSampleValue, [](FbtTexture& t) { t.corners[1] = 0x3c010000; }},
        {"negative red", half, C::FbtSampleValue, [](FbtTexture& t) { t.corners[0] = 0x8001; }},
        {"negative zero", half, C::FbtSampleValue, [](FbtTexture& t) { t.corners[0] = 0x8000; }},
        {"negative alpha", half, C::FbtSampleValue, [](FbtTexture& t) { t.records[1] = 0xb8000000; }},
        {"infinite green", half, C::FbtSampleValue, [](FbtTexture& t) { t.corners[0] = 0x7c000000; }},
        {"blue that is no number", half, C::FbtSampleValue, [](FbtTexture& t) { t.records[5] |= 0x7e00; }},
        {"alpha that is no number", half, C::FbtSampleValue, [](FbtTexture& t) { t.records[7] = 0x7e000000; }},
        {"colour where alpha is 0", half, C::FbtNotPremultiplied,
         [](FbtTexture& t) { t.records[0] = 0x3c00, t.records[1] = 0; }},
        {"wrong translucent", half, C::FbtTraitsMismatch, [](FbtTexture& t) { t.traits.translucent = false; }},
        {"solid region not premultiplied", half, C::FbtNotPremultiplied,
         [](FbtTexture& t) { t.records[t.records.size() - 4] = 0x010000ff; }},
    };
    for (const Fault& fault : faults) {
        FbtTexture t = two_texels(fault.format);
        fault.make(t);
        const auto findings = validate_fbt(t);
        ASSERT_FALSE(findings.empty()) << fault.what;
        EXPECT_EQ(finding_id(findings[0].code), finding_id(fault.expected))
            << fault.what << ": " << findings[0].message;
    }
}

} // namespace
} // namespace fetex
