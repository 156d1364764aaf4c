// SPDX-License-Identifier: GPL-3.0-or-later
/// Textures with feature curves in files: what is written is read back; what is damaged or hostile is refused by its
/// number.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "formats/fetex_file.h"
#include "formats/validate.h"
#include "tests/support/random_bilevel.h"
#include "tests/support/random_fbt.h"
#include "tests/support/random_features.h"
#include "tests/support/random_silmap.h"
#include "tests/support/reseal.h"

namespace fetex {
namespace {

using fetexc::test::kFeatureKinds;
using fetexc::test::kFeatureNumberFormats;
using fetexc::test::kSilmapSampleFormats;
using fetexc::test::random_features;
using fetexc::test::reseal;
using fetexc::test::store;
using Bytes = std::vector<std::uint8_t>;

/// 5×3 texels and levels of 2×1 and 1×1.
FeatureCurvesTexture full_texture(FeatureSampleFormat samples = FeatureSampleFormat::Rgba8) {
    return random_features(5, {.width = 5, .height = 3, .base_format = samples, .mips = true});
}

FeatureCurvesTexture three_profiles() {
    return random_features(6, {.width = 5, .height = 3, .profiles = 3, .mips = true});
}

FetexFile file_of(FeatureCurvesTexture texture) {
    FetexFile file;
    file.metadata = {{"k", "v"}};
    file.feature_curves = std::move(texture);
    return file;
}

FindingCode code_of(const Bytes& bytes) {
    FetexFile file;
    const auto finding = read_file(file, bytes);
    EXPECT_EQ(finding.has_value(), !validate_file(bytes).empty());
    EXPECT_FALSE(finding.has_value() && file.feature_curves.has_value());
    return finding ? finding->code : FindingCode{};
}

void expect_same(const FeatureCurvesTexture& a, const FeatureCurvesTexture& b) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_EQ(a.format, b.format);
    EXPECT_EQ(a.linear, b.linear);
    EXPECT_EQ(a.distance_limit, b.distance_limit);
    EXPECT_EQ(a.configurations, b.configurations);
    EXPECT_EQ(a.signatures, b.signatures);
    EXPECT_EQ(a.distances, b.distances);
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.base_format, b.base_format);
    EXPECT_EQ(a.height_scale, b.height_scale);
    EXPECT_EQ(a.gradients, b.gradients);
    EXPECT_EQ(a.base, b.base);
    EXPECT_EQ(a.profile, b.profile);
    EXPECT_EQ(a.profiles, b.profiles);
    EXPECT_EQ(a.profile_map, b.profile_map);
    EXPECT_EQ(a.mips, b.mips);
}

TEST(FeatureFile, readsWhatWasWritten) {
    constexpr std::uint32_t kProfileCounts[] = {16, 1, 2, 3};
    std::uint64_t seed = 0;
    for (const FeatureNumberFormat format : kFeatureNumberFormats) {
        for (const FeatureKind kind : kFeatureKinds) {
            for (const FeatureSampleFormat samples : kSilmapSampleFormats) {
                ++seed;
                const FetexFile file = file_of(random_features(seed, {.width = 4,
                                                                      .height = 5,
                                                                      .format = format,
                                                                      .linear = seed % 2 == 0,
                                                                      .kind = kind,
                                                                      .base_format = samples,
                                                                      .base_map = seed % 3 != 0,
                                                                      .gradients = seed % 5 != 0,
                                                                      .profiles = kProfileCounts[seed % 4],
                                                                      .mips = seed % 7 != 0}));
                ASSERT_TRUE(validate_feature_curves(*file.feature_curves).empty())
                    << validate_feature_curves(*file.feature_curves)[0].message;
                const Bytes bytes = write_file(file);
                FetexFile back;
                const auto finding = read_file(back, bytes);
                ASSERT_FALSE(finding.has_value()) << finding->message;
                ASSERT_TRUE(back.feature_curves.has_value() && !back.fbt.has_value() && !back.pinchmap.has_value());
                expect_same(*back.feature_curves, *file.feature_curves);
                EXPECT_EQ(write_file(back), bytes);
            }
        }
    }
}

TEST(FeatureFile, gradientsKeepTheirSignInEveryFormat) {
    for (const FeatureNumberFormat format : kFeatureNumberFormats) {
        FeatureCurvesTexture t = feature_empty_texture(1, 1, format, true, 1);
        feature_set_gradient(t, 1, 0, {-0.6, 0.8});
        feature_set_gradient(t, 0, 1, {-1, 1});
        EXPECT_NEAR(feature_gradient(t, 1, 0).x, -0.6, 0x1p-12);
        EXPECT_NEAR(feature_gradient(t, 1, 0).y, 0.8, 0x1p-12);
        EXPECT_EQ(feature_gradient(t, 0, 1).x, -1);
        EXPECT_EQ(feature_gradient(t, 0, 1).y, 1);
        EXPECT_EQ(feature_gradient(t, 1, 1).x, 0);
        EXPECT_TRUE(validate_feature_curves(t).empty());
    }
}

/// Alone its chunks are critical; beside others a reader without them has those to show.
TEST(FeatureFile, marksChunksCriticalWhereNothingElseCanBeShown) {
    for (const int beside : {0, 1, 2, 3}) {
        FetexFile file = file_of(full_texture()), back;
        if (beside == 1) file.fbt = fetexc::test::random_fbt(21);
        if (beside == 2) file.bilevel = fetexc::test::random_bilevel(1);
        if (beside == 3) file.silmap = fetexc::test::random_silmap(1);
        const Bytes bytes = write_file(file);
        ASSERT_FALSE(read_file(back, bytes).has_value());
        expect_same(*back.feature_curves, *file.feature_curves);
        ContainerView container;
        ASSERT_FALSE(read_container(container, bytes).has_value());
        std::size_t seen = 0;
        for (const ChunkView& chunk : container.chunks) {
            const std::string type = fourcc_text(chunk.type);
            if (type.substr(0, 3) != "FCV") continue;
            ++seen;
            EXPECT_EQ(chunk.representation, 4);
            EXPECT_EQ(chunk.offset % kChunkAlignment, 0u);
            EXPECT_EQ(chunk.flags, beside == 0 && type != "FCVM" ? kChunkCritical : 0) << type;
        }
        EXPECT_EQ(seen, 9u);
    }
}

/// SPEC.md §2.7, byte by byte: one texel, a straight segment from north to south.
TEST(FeatureFile, hasTheBytesOfTheSpecification) {
    FeatureCurvesTexture t = feature_empty_texture(1, 1, FeatureNumberFormat::Bits16, false, 2);
    t.configurations[0] =
        feature_pack({FeatureEdge::North, FeatureEdge::South}, {FeatureEdge::North, FeatureEdge::South}, true, true);
    feature_set_crossing(t, 0, 0, FeatureEdge::North, {0.25, 0});
    feature_set_crossing(t, 0, 1, FeatureEdge::North, {0.75, 0});
    for (const std::uint32_t j : {0u, 1u})
        for (const std::uint32_t i : {0u, 1u})
            feature_set_distance(t, i, j, 2 * (i + 2 * j) / 65535.0),
                feature_set_gradient(t, i, j, {-1.0 * i, 1.0 * j});
    t.kind = FeatureKind::Height, t.height_scale = 4, t.base_format = FeatureSampleFormat::Rgb8, t.base = {0xff030201};
    t.profile = {{1, -2, 0, 0x04030201}, {0, 0, 1, 0xffffffff}};
    t.mips = {0xff090807};
    ASSERT_TRUE(validate_feature_curves(t).empty());
    const Bytes bytes = write_file(file_of(t));
    ContainerView container;
    ASSERT_FALSE(read_container(container, bytes).has_value());
    ASSERT_EQ(container.chunks.size(), 9u);
    const auto payload = [&](std::size_t k) {
        return Bytes(container.chunks[k].payload.begin(), container.chunks[k].payload.end());
    };
    EXPECT_EQ(payload(1), (Bytes{1, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 6,    0,    0, 0, 0, 0, 0, 0x40, 2, 0,
                                 0, 0, 3, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0x80, 0x40, 0, 0, 0, 0, 0, 0,    0, 0,
                                 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,    0,    0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(payload(2), (Bytes{0x39, 0x39}));
    EXPECT_EQ(payload(3), (Bytes{0, 0x20, 0, 0, 0, 0x40, 0, 0, 0, 0x40, 0, 0, 0, 0x40, 0, 0,
                                 0, 0x60, 0, 0, 0, 0x40, 0, 0, 0, 0x40, 0, 0, 0, 0x40, 0, 0}));
    EXPECT_EQ(payload(4), (Bytes{0, 0, 1, 0, 2, 0, 3, 0}));
    EXPECT_EQ(payload(5), (Bytes{0, 0, 0, 0, 1, 0x80, 0, 0, 0, 0, 0xff, 0x7f, 1, 0x80, 0xff, 0x7f}));
    EXPECT_EQ(payload(6), (Bytes{1, 2, 3}));
    EXPECT_EQ(payload(7), (Bytes{0, 0, 0x80, 0x3f, 0, 0, 0, 0xc0, 0, 0, 0,    0,    1,    2,    3,    4,
                                 0, 0, 0,    0,    0, 0, 0, 0,    0, 0, 0x80, 0x3f, 0xff, 0xff, 0xff, 0xff}));
    EXPECT_EQ(payload(8), (Bytes{7, 8, 9, 255}));
}

/// SPEC.md §2.7: what several profiles add.
TEST(FeatureFile, hasTheBytesOfTheSpecificationForSeveralProfiles) {
    FeatureCurvesTexture t = feature_empty_texture(1, 1, FeatureNumberFormat::Bits16, true, 1);
    t.configurations[0] =
        feature_pack({FeatureEdge::North, FeatureEdge::South}, {FeatureEdge::North, FeatureEdge::South});
    t.profiles = 2, t.profile = {{0, 0, 1, 0}, {0, 0, 1, 1u << 24}, {0, 0, 1, 2u << 24}, {0, 0, 1, 3u << 24}};
    t.profile_map = {feature_profile_word(0, 1, 0), feature_profile_word(1, 0, 0), feature_profile_word(1, 1, 0),
                     feature_profile_word(0, 0, 0)};
    ASSERT_TRUE(validate_feature_curves(t).empty()) << validate_feature_curves(t)[0].message;
    const Bytes bytes = write_file(file_of(t));
    ContainerView container;
    ASSERT_FALSE(read_container(container, bytes).has_value());
    ASSERT_EQ(container.chunks.size(), 8u);
    const auto payload = [&](std::size_t k) {
        return Bytes(container.chunks[k].payload.begin(), container.chunks[k].payload.end());
    };
    EXPECT_EQ(payload(1)[28], 2); // entries a profile
    EXPECT_EQ(payload(1)[36], 2); // profiles
    EXPECT_EQ(payload(6).size(), 64u);
    for (std::size_t k = 0; k < 4; ++k)
        EXPECT_EQ(payload(6)[16 * k + 15], k);
    EXPECT_EQ(fourcc_text(container.chunks[7].type), "FCVI");
    EXPECT_EQ(container.chunks[7].flags, kChunkCritical);
    EXPECT_EQ(payload(7), (Bytes{0x10, 0, 1, 0, 0x11, 0, 0, 0}));
}

TEST(FeatureReader, refusesTruncationAtEveryLengthAndACorruptByteAnywhere) {
    const Bytes good = write_file(file_of(three_profiles()));
    for (std::size_t k = 0; k < good.size(); ++k) {
        EXPECT_NE(code_of(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(k))), FindingCode{}) << k;
        Bytes bytes = good;
        bytes[k] ^= 0x11;
        EXPECT_NE(code_of(bytes), FindingCode{}) << k;
    }
}

FindingCode with_word(std::size_t word, std::uint32_t value, const FeatureCurvesTexture& texture = full_texture()) {
    Bytes bytes = write_file(file_of(texture));
    ContainerView container;
    EXPECT_FALSE(read_container(container, bytes).has_value());
    store(bytes, static_cast<std::size_t>(container.chunks[1].offset) + 4 * word, value, 4);
    reseal(bytes);
    return code_of(bytes);
}

TEST(FeatureReader, refusesHostileHeaders) {
    for (const std::uint32_t bad : {0u, 16385u, 0xffffffffu}) {
        EXPECT_EQ(with_word(0, bad), FindingCode::BadFeatureHeader);
        EXPECT_EQ(with_word(1, bad), FindingCode::BadFeatureHeader);
    }
    EXPECT_EQ(with_word(2, 3), FindingCode::BadFeatureHeader);
    EXPECT_EQ(with_word(3, 8 + 2), FindingCode::BadFeatureHeader);
    EXPECT_EQ(with_word(3, 0), FindingCode::MissingChunk); // there are gradients
    EXPECT_EQ(with_word(5, 3), FindingCode::BadFeatureHeader);
    EXPECT_EQ(with_word(6, 4), FindingCode::BadFeatureHeader);
    for (const std::uint32_t bad : {0u, 1u, 4097u})
        EXPECT_EQ(with_word(7, bad), FindingCode::BadFeatureHeader);
    for (std::size_t word = 9; word < 16; ++word)
        EXPECT_EQ(with_word(word, 1), FindingCode::BadFeatureHeader);
    for (const std::uint32_t bad : {0u, 0x80000000u, 0xbf800000u, 0x7f800000u, 0x7fc00000u, 0x47800000u}) {
        EXPECT_EQ(with_word(4, bad), FindingCode::FeatureFormat); // 0, −0, −1, ∞, NaN, 65536
        EXPECT_EQ(with_word(8, bad), FindingCode::FeatureFormat);
    }
    EXPECT_EQ(with_word(8, 0x40000000), FindingCode::FeatureFormat); // a scale of normals
    EXPECT_EQ(with_word(0, 8192), FindingCode::FeatureSizeMismatch); // and doesn't allocate it
    EXPECT_EQ(with_word(2, 1), FindingCode::FeatureSizeMismatch);
    EXPECT_EQ(with_word(3, 3), FindingCode::FeatureSizeMismatch);
    EXPECT_EQ(with_word(3, 6), FindingCode::FeatureSizeMismatch);
    EXPECT_EQ(with_word(6, 1), FindingCode::FeatureSizeMismatch);
    EXPECT_EQ(with_word(6, 3), FindingCode::FeatureSizeMismatch);
    EXPECT_EQ(with_word(7, 18), FindingCode::FeatureSizeMismatch);
    for (const std::uint32_t bad : {1u, 17u, 0xffffffffu})
        EXPECT_EQ(with_word(9, bad), FindingCode::BadFeatureHeader);
    EXPECT_EQ(with_word(9, 2), FindingCode::MissingChunk); // there is no map of profiles
    EXPECT_EQ(with_word(9, 0, three_profiles()), FindingCode::MissingChunk);
    EXPECT_EQ(with_word(9, 2, three_profiles()), FindingCode::FeatureSizeMismatch);
    EXPECT_EQ(with_word(9, 16, three_profiles()), FindingCode::FeatureSizeMismatch);
    EXPECT_EQ(with_word(7, 4096, three_profiles()), FindingCode::FeatureSizeMismatch);
}

/// The chunks of the full texture, changed.
FindingCode with_chunks(const std::function<void(std::vector<Chunk>&)>& change,
                        const FeatureCurvesTexture& texture = full_texture()) {
    const Bytes good = write_file(file_of(texture));
    ContainerView container;
    EXPECT_FALSE(read_container(container, good).has_value());
    std::vector<Chunk> chunks;
    for (const ChunkView& c : container.chunks)
        chunks.push_back({c.type, c.flags, c.representation, c.level, {c.payload.begin(), c.payload.end()}});
    change(chunks);
    return code_of(write_container(chunks));
}

constexpr std::size_t kHeader = 1, kProfile = 7, kLevel1 = 8, kLevel2 = 9; ///< as write_file orders them

TEST(FeatureReader, wantsAllChunksAndNoOthersOfTheRightLength) {
    using Chunks = std::vector<Chunk>;
    EXPECT_EQ(with_chunks([](Chunks& c) { std::swap(c[kLevel1], c[kHeader]); }), FindingCode{}); // in any order
    EXPECT_EQ(with_chunks([](Chunks& c) { c.resize(kLevel1); }), FindingCode{});                 // no levels at all
    EXPECT_EQ(with_chunks([](Chunks& c) { c[kLevel2].level = 3; }), FindingCode::MissingChunk);
    for (std::size_t k = kHeader; k <= kLevel2; ++k) {
        EXPECT_EQ(with_chunks([&](Chunks& c) { c.erase(c.begin() + static_cast<std::ptrdiff_t>(k)); }),
                  FindingCode::MissingChunk)
            << k;
        for (const int by : {-1, 1})
            EXPECT_EQ(with_chunks([&](Chunks& c) { c[k].payload.resize(c[k].payload.size() + by); }),
                      k == kHeader ? FindingCode::BadFeatureHeader : FindingCode::FeatureSizeMismatch)
                << k;
        if (k >= kLevel1) continue;
        EXPECT_EQ(with_chunks([&](Chunks& c) { c[k].level = 1; }), FindingCode::UnknownCriticalChunk);
        EXPECT_EQ(with_chunks([&](Chunks& c) { c[k].representation = kWholeFile; }), FindingCode::UnknownCriticalChunk);
    }
    for (const FourCc other : {fourcc("FBTH"), fourcc("BLVH"), fourcc("SLMH"), fourcc("PNCH")})
        EXPECT_EQ(with_chunks([&](Chunks& c) { c.push_back({other, 0, 4, 0, {}}); }), FindingCode::RepresentationKinds);
}

TEST(FeatureReader, wantsAMapOfSeveralProfilesOfTheRightLength) {
    using Chunks = std::vector<Chunk>;
    constexpr std::size_t kMap = 8; // before the levels
    const auto with_map = [](const std::function<void(Chunks&)>& change) {
        return with_chunks(change, three_profiles());
    };
    ASSERT_EQ(with_map([](Chunks& c) { EXPECT_EQ(fourcc_text(c[kMap].type), "FCVI"); }), FindingCode{});
    EXPECT_EQ(with_map([](Chunks& c) { c.erase(c.begin() + kMap); }), FindingCode::MissingChunk);
    EXPECT_EQ(with_map([](Chunks& c) { c[kMap].level = 1; }), FindingCode::UnknownCriticalChunk);
    for (const int by : {-2, -1, 1, 2})
        EXPECT_EQ(with_map([&](Chunks& c) { c[kMap].payload.resize(c[kMap].payload.size() + by); }),
                  FindingCode::FeatureSizeMismatch);
    for (const std::uint16_t bad : {0x0003, 0x0030, 0x0300, 0x000f, 0x1000, 0x8000, 0xffff})
        EXPECT_EQ(with_map([&](Chunks& c) {
                      c[kMap].payload[4] = static_cast<std::uint8_t>(bad);
                      c[kMap].payload[5] = static_cast<std::uint8_t>(bad >> 8);
                  }),
                  FindingCode::FeatureProfileNumber);
}

TEST(FeatureValidator, placesFaultsOfTheProfileMap) {
    Bytes bytes = write_file(file_of(three_profiles()));
    ContainerView container;
    ASSERT_FALSE(read_container(container, bytes).has_value());
    const std::uint64_t place = container.chunks[8].offset + 2 * 7;
    store(bytes, static_cast<std::size_t>(place), 0x0003, 2);
    reseal(bytes);
    const auto findings = validate_file(bytes);
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_EQ(findings[0].code, FindingCode::FeatureProfileNumber);
    EXPECT_EQ(findings[0].offset, place);
}

TEST(FeatureValidator, countsOffsetsFromTheStartOfTheFile) {
    Bytes bytes = write_file(file_of(full_texture()));
    ContainerView container;
    ASSERT_FALSE(read_container(container, bytes).has_value());
    std::vector<std::uint64_t> wanted;
    const auto spoil = [&](std::size_t chunk, std::size_t at, std::uint32_t value) {
        wanted.push_back(container.chunks[chunk].offset + at);
        store(bytes, static_cast<std::size_t>(wanted.back()), value, 4);
    };
    spoil(3, 8, 0x40000000);            // a position of 2
    spoil(4, 4, 0x41000000);            // a distance of 8
    spoil(5, 12, 0x3f800001);           // a gradient above 1
    spoil(6, 20, 0x01000002);           // brighter than alpha
    spoil(kLevel2, 0, 0x01000002);      // likewise
    spoil(kProfile, 16 + 12, 0x000001); // likewise
    reseal(bytes);
    const auto findings = validate_file(bytes);
    ASSERT_EQ(findings.size(), wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k)
        EXPECT_EQ(findings[k].offset, wanted[k]) << findings[k].message;
    EXPECT_EQ(validate_file(bytes, 2).size(), 2u);
}

struct Fault {
    const char* what;
    FindingCode expected;
    FeatureSampleFormat format;
    std::function<void(FeatureCurvesTexture&)> make;
};

TEST(FeatureValidator, findsEachKindOfFaultInTheMaps) {
    using C = FindingCode;
    using T = FeatureCurvesTexture;
    using F = FeatureSampleFormat;
    const Fault faults[] = {
        {"a gradient short", C::FeatureDimensions, F::Rgba8, [](T& t) { t.gradients.pop_back(); }},
        {"normals without gradients", C::FeatureDimensions, F::Rgba8, [](T& t) { t.gradients.clear(); }},
        {"a sample short", C::FeatureDimensions, F::Rgba8, [](T& t) { t.base.pop_back(); }},
        {"no sample", C::FeatureDimensions, F::Rgba8, [](T& t) { t.base.clear(); }},
        {"one entry", C::FeatureDimensions, F::Rgba8, [](T& t) { t.profile.resize(1); }},
        {"many entries", C::FeatureDimensions, F::Rgba8, [](T& t) { t.profile.resize(4097); }},
        {"no profile", C::FeatureDimensions, F::Rgba8, [](T& t) { t.profiles = 0; }},
        {"a map of one profile", C::FeatureDimensions, F::Rgba8, [](T& t) { t.profile_map.resize(24); }},
        {"no map of two", C::FeatureDimensions, F::Rgba8, [](T& t) { t.profiles = 2, t.profile.resize(18); }},
        {"odd entries of two", C::FeatureDimensions, F::Rgba8, [](T& t) { t.profiles = 2, t.profile_map.resize(24); }},
        {"an entry each", C::FeatureDimensions, F::Rgba8,
         [](T& t) { t.profiles = 2, t.profile.resize(2), t.profile_map.resize(24); }},
        {"many profiles", C::FeatureDimensions, F::Rgba8,
         [](T& t) { t.profiles = 17, t.profile.resize(34), t.profile_map.resize(24); }},
        {"a level short", C::FeatureDimensions, F::Rgba8, [](T& t) { t.mips.pop_back(); }},
        {"no kind", C::FeatureFormat, F::Rgba8, [](T& t) { t.kind = FeatureKind(3); }},
        {"no sample format", C::FeatureFormat, F::Rgba8, [](T& t) { t.base_format = F(4); }},
        {"no scale", C::FeatureFormat, F::Rgba8, [](T& t) { t.kind = FeatureKind::Height, t.height_scale = NAN; }},
        {"brighter than alpha", C::FeatureNotPremultiplied, F::Rgba16, [](T& t) { t.base.back() = 0x7fff8000; }},
        {"a negative half", C::FeatureSampleValue, F::Rgba16F, [](T& t) { t.base.back() = 0x3c008001; }},
        {"not opaque", C::FeatureSampleValue, F::Rgb8, [](T& t) { t.base.back() = 0xfe000000; }},
        {"in a level", C::FeatureNotPremultiplied, F::Rgba16F, [](T& t) { t.mips.back() = 0x7f000080; }},
        {"an infinite height", C::FeatureProfileValue, F::Rgba8, [](T& t) { t.profile[3].height = INFINITY; }},
        {"no slope", C::FeatureProfileValue, F::Rgba8, [](T& t) { t.profile[3].slope = NAN; }},
        {"a blend above 1", C::FeatureProfileValue, F::Rgba8, [](T& t) { t.profile[3].blend = 1.5f; }},
        {"a blend below 0", C::FeatureProfileValue, F::Rgba8, [](T& t) { t.profile[3].blend = -0.5f; }},
        {"a bright profile", C::FeatureNotPremultiplied, F::Rgba8, [](T& t) { t.profile[3].color = 0x7f000080; }},
    };
    for (const FeatureSampleFormat format : kSilmapSampleFormats)
        EXPECT_TRUE(validate_feature_curves(full_texture(format)).empty());
    FeatureCurvesTexture unused = feature_empty_texture(2, 2, FeatureNumberFormat::Half, true, 1);
    unused.profiles = 2, unused.profile.resize(4), unused.profile_map.resize(9);
    EXPECT_TRUE(validate_feature_curves(unused).empty());
    unused.profile_map[4] = feature_profile_word(1, 0, 1); // an edge without a curve
    ASSERT_EQ(validate_feature_curves(unused).size(), 1u);
    EXPECT_EQ(validate_feature_curves(unused)[0].code, C::FeatureUnusedEdge);
    EXPECT_EQ(validate_feature_curves(unused)[0].offset, 8u);
    for (const Fault& fault : faults) {
        FeatureCurvesTexture texture = full_texture(fault.format);
        fault.make(texture);
        const auto findings = validate_feature_curves(texture);
        ASSERT_GE(findings.size(), 1u) << fault.what;
        EXPECT_EQ(finding_id(findings[0].code), finding_id(fault.expected))
            << fault.what << ": " << findings[0].message;
    }
}

} // namespace
} // namespace fetex
