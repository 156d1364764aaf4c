// SPDX-License-Identifier: GPL-3.0-or-later
/// Textures with feature curves in files: what is written is read back; what is damaged or hostile is refused by its
/// number.
#include <cmath>

#include "formats/feature_sampler.h"
#include "formats/validate.h"
#include "tests/support/random_features.h"
#include "tests/support/random_silmap.h"
#include "tests/support/representation_file_tests.h"

namespace fetexc::test {
namespace {

using namespace fetex;

FeatureCurvesTexture three_profiles() {
    return random_features(6, {.width = 5, .height = 3, .profiles = 3, .mips = true});
}

struct FeatureTraits {
    using Texture = FeatureCurvesTexture;
    using Samples = FeatureSampleFormat;
    static constexpr auto kMember = &FetexFile::feature_curves;
    static constexpr std::uint8_t kNumber = 4;
    static constexpr const char* kPrefix = "FCV";
    static constexpr std::size_t kProfile = 7, kLevel1 = 8, kLastLevel = 9;
    static constexpr FindingCode kBadHeader = FindingCode::BadFeatureHeader,
                                 kSizeMismatch = FindingCode::FeatureSizeMismatch;
    static constexpr bool kOneFinding = true;

    /// 5×3 texels and levels of 2×1 and 1×1.
    static Texture full(Samples samples = {}) {
        return random_features(5, {.width = 5, .height = 3, .base_format = samples, .mips = true});
    }
    static Texture other() {
        Texture t = full();
        t.base[0] = 0;
        return t;
    }
    static std::vector<Texture> several() {
        constexpr std::uint32_t kProfileCounts[] = {16, 1, 2, 3};
        std::vector<Texture> all;
        std::uint64_t seed = 0;
        for (const FeatureNumberFormat format : kFeatureNumberFormats)
            for (const FeatureKind kind : kFeatureKinds)
                for (const Samples samples : kSilmapSampleFormats) {
                    ++seed;
                    all.push_back(random_features(seed, {.width = 4,
                                                         .height = 5,
                                                         .format = format,
                                                         .linear = seed % 2 == 0,
                                                         .kind = kind,
                                                         .base_format = samples,
                                                         .base_map = seed % 3 != 0,
                                                         .gradients = seed % 5 != 0,
                                                         .profiles = kProfileCounts[seed % 4],
                                                         .mips = seed % 7 != 0}));
                }
        return all;
    }
    static std::vector<Texture> damaged() {
        std::vector<Texture> all = {three_profiles()};
        for (const Samples samples : kSilmapSampleFormats)
            all.push_back(full(samples));
        return all;
    }

    static void expect_same(const Texture& a, const Texture& b) {
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
    static std::vector<Finding> validate(const Texture& t) { return validate_feature_curves(t); }
    static FbtColor sample(const Texture& t) { return feature_sample_mip(t, 2.2, 1.1, {1.5, 0.2}); }

    static std::vector<HostileWord> hostile_header() {
        const std::vector<std::uint32_t> no_scale = {0,          0x80000000, 0xbf800000,
                                                     0x7f800000, 0x7fc00000, 0x47800000}; // 0, −0, −1, ∞, NaN, 65536
        std::vector<HostileWord> all = {
            {0, {0, 16385, 0xffffffff}, kBadHeader},
            {1, {0, 16385, 0xffffffff}, kBadHeader},
            {2, {3}, kBadHeader},
            {3, {8 + 2}, kBadHeader},
            {3, {0}, FindingCode::MissingChunk}, // there are gradients
            {5, {3}, kBadHeader},
            {6, {4}, kBadHeader},
            {7, {0, 1, 4097}, kBadHeader},
            {4, no_scale, FindingCode::FeatureFormat},
            {8, no_scale, FindingCode::FeatureFormat},
            {8, {0x40000000}, FindingCode::FeatureFormat}, // a scale of normals
            {0, {8192}, kSizeMismatch},                    // and doesn't allocate it
            {2, {1}, kSizeMismatch},
            {3, {3, 6}, kSizeMismatch},
            {6, {1, 3}, kSizeMismatch},
            {7, {18}, kSizeMismatch},
            {9, {1, 17, 0xffffffff}, kBadHeader},
            {9, {2}, FindingCode::MissingChunk}, // there is no map of profiles
        };
        for (std::size_t word = 10; word < 16; ++word)
            all.push_back({word, {1}, kBadHeader});
        return all;
    }
    static std::vector<SpoiltWord> spoilt() {
        return {{3, 8, 0x40000000, "F5004"},             // a position of 2
                {4, 4, 0x41000000, "F5004"},             // a distance of 8
                {5, 12, 0x3f800001, "F5004"},            // a gradient above 1
                {6, 20, 0x01000002, "F5007"},            // brighter than alpha
                {kLastLevel, 0, 0x01000002, "F5007"},    // likewise
                {kProfile, 16 + 12, 0x000001, "F5007"}}; // likewise
    }
    static std::vector<Fault<FeatureTraits>> faults() {
        using C = FindingCode;
        using T = Texture;
        using F = Samples;
        return {
            {"a gradient short", C::FeatureDimensions, [](T& t) { t.gradients.pop_back(); }},
            {"normals without gradients", C::FeatureDimensions, [](T& t) { t.gradients.clear(); }},
            {"a sample short", C::FeatureDimensions, [](T& t) { t.base.pop_back(); }},
            {"no sample", C::FeatureDimensions, [](T& t) { t.base.clear(); }},
            {"one entry", C::FeatureDimensions, [](T& t) { t.profile.resize(1); }},
            {"many entries", C::FeatureDimensions, [](T& t) { t.profile.resize(4097); }},
            {"no profile", C::FeatureDimensions, [](T& t) { t.profiles = 0; }},
            {"a map of one profile", C::FeatureDimensions, [](T& t) { t.profile_map.resize(24); }},
            {"no map of two", C::FeatureDimensions, [](T& t) { t.profiles = 2, t.profile.resize(18); }},
            {"odd entries of two", C::FeatureDimensions, [](T& t) { t.profiles = 2, t.profile_map.resize(24); }},
            {"an entry each", C::FeatureDimensions,
             [](T& t) { t.profiles = 2, t.profile.resize(2), t.profile_map.resize(24); }},
            {"many profiles", C::FeatureDimensions,
             [](T& t) { t.profiles = 17, t.profile.resize(34), t.profile_map.resize(24); }},
            {"a level short", C::FeatureDimensions, [](T& t) { t.mips.pop_back(); }},
            {"no kind", C::FeatureFormat, [](T& t) { t.kind = FeatureKind(3); }},
            {"no sample format", C::FeatureFormat, [](T& t) { t.base_format = F(4); }},
            {"no scale", C::FeatureFormat, [](T& t) { t.kind = FeatureKind::Height, t.height_scale = NAN; }},
            {"brighter than alpha", C::FeatureNotPremultiplied, [](T& t) { t.base.back() = 0x7fff8000; }, F::Rgba16},
            {"a negative half", C::FeatureSampleValue, [](T& t) { t.base.back() = 0x3c008001; }, F::Rgba16F},
            {"not opaque", C::FeatureSampleValue, [](T& t) { t.base.back() = 0xfe000000; }, F::Rgb8},
            {"in a level", C::FeatureNotPremultiplied, [](T& t) { t.mips.back() = 0x7f000080; }, F::Rgba16F},
            {"an infinite height", C::FeatureProfileValue, [](T& t) { t.profile[3].height = INFINITY; }},
            {"no slope", C::FeatureProfileValue, [](T& t) { t.profile[3].slope = NAN; }},
            {"a blend above 1", C::FeatureProfileValue, [](T& t) { t.profile[3].blend = 1.5f; }},
            {"a blend below 0", C::FeatureProfileValue, [](T& t) { t.profile[3].blend = -0.5f; }},
            {"a bright profile", C::FeatureNotPremultiplied, [](T& t) { t.profile[3].color = 0x7f000080; }},
        };
    }
};

INSTANTIATE_TYPED_TEST_SUITE_P(Feature, RepresentationFile, FeatureTraits);

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
    const Chunks chunks = chunks_of(write_file(file_of<FeatureTraits>(t)));
    ASSERT_EQ(chunks.size(), 9u);
    EXPECT_EQ(chunks[1].payload, (Bytes{1, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 6,    0,    0, 0, 0, 0, 0, 0x40, 2, 0,
                                        0, 0, 3, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0x80, 0x40, 0, 0, 0, 0, 0, 0,    0, 0,
                                        0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,    0,    0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(chunks[2].payload, (Bytes{0x39, 0x39}));
    EXPECT_EQ(chunks[3].payload, (Bytes{0, 0x20, 0, 0, 0, 0x40, 0, 0, 0, 0x40, 0, 0, 0, 0x40, 0, 0,
                                        0, 0x60, 0, 0, 0, 0x40, 0, 0, 0, 0x40, 0, 0, 0, 0x40, 0, 0}));
    EXPECT_EQ(chunks[4].payload, (Bytes{0, 0, 1, 0, 2, 0, 3, 0}));
    EXPECT_EQ(chunks[5].payload, (Bytes{0, 0, 0, 0, 1, 0x80, 0, 0, 0, 0, 0xff, 0x7f, 1, 0x80, 0xff, 0x7f}));
    EXPECT_EQ(chunks[6].payload, (Bytes{1, 2, 3}));
    EXPECT_EQ(chunks[7].payload, (Bytes{0, 0, 0x80, 0x3f, 0, 0, 0, 0xc0, 0, 0, 0,    0,    1,    2,    3,    4,
                                        0, 0, 0,    0,    0, 0, 0, 0,    0, 0, 0x80, 0x3f, 0xff, 0xff, 0xff, 0xff}));
    EXPECT_EQ(chunks[8].payload, (Bytes{7, 8, 9, 255}));
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
    const Chunks chunks = chunks_of(write_file(file_of<FeatureTraits>(t)));
    ASSERT_EQ(chunks.size(), 8u);
    EXPECT_EQ(chunks[1].payload[28], 2); // entries a profile
    EXPECT_EQ(chunks[1].payload[36], 2); // profiles
    EXPECT_EQ(chunks[6].payload.size(), 64u);
    for (std::size_t k = 0; k < 4; ++k)
        EXPECT_EQ(chunks[6].payload[16 * k + 15], k);
    EXPECT_EQ(fourcc_text(chunks[7].type), "FCVI");
    EXPECT_EQ(chunks[7].flags, kChunkCritical);
    EXPECT_EQ(chunks[7].payload, (Bytes{0x10, 0, 1, 0, 0x11, 0, 0, 0}));
}

TEST(FeatureReader, refusesHostileHeadersOfSeveralProfiles) {
    const HostileWord all[] = {{9, {0}, FindingCode::MissingChunk},
                               {9, {2, 16}, FindingCode::FeatureSizeMismatch},
                               {7, {4096}, FindingCode::FeatureSizeMismatch}};
    for (const HostileWord& hostile : all)
        for (const std::uint32_t value : hostile.values)
            EXPECT_EQ(with_word<FeatureTraits>(three_profiles(), hostile.word, value), hostile.expected)
                << "word " << hostile.word << " is " << value;
}

TEST(FeatureReader, wantsAMapOfSeveralProfilesOfTheRightLength) {
    constexpr std::size_t kMap = 8; // before the levels
    const auto with_map = [](const std::function<void(Chunks&)>& change) {
        return with_chunks<FeatureTraits>(three_profiles(), change);
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
    Bytes bytes = write_file(file_of<FeatureTraits>(three_profiles()));
    const std::size_t place = payload_offset(bytes, 8) + 2 * 7;
    store(bytes, place, 0x0003, 2);
    reseal(bytes);
    const auto findings = validate_file(bytes);
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_EQ(findings[0].code, FindingCode::FeatureProfileNumber);
    EXPECT_EQ(findings[0].offset, place);
}

TEST(FeatureValidator, findsProfilesOfUnusedEdges) {
    FeatureCurvesTexture unused = feature_empty_texture(2, 2, FeatureNumberFormat::Half, true, 1);
    unused.profiles = 2, unused.profile.resize(4), unused.profile_map.resize(9);
    EXPECT_TRUE(validate_feature_curves(unused).empty());
    unused.profile_map[4] = feature_profile_word(1, 0, 1); // an edge without a curve
    ASSERT_EQ(validate_feature_curves(unused).size(), 1u);
    EXPECT_EQ(validate_feature_curves(unused)[0].code, FindingCode::FeatureUnusedEdge);
    EXPECT_EQ(validate_feature_curves(unused)[0].offset, 8u);
}

} // namespace
} // namespace fetexc::test
