// SPDX-License-Identifier: GPL-3.0-or-later
/// Bi-level textures in files: what is written is read back; what is damaged or hostile is refused by its number.
#include "formats/validate.h"
#include "tests/support/random_bilevel.h"
#include "tests/support/representation_file_tests.h"

namespace fetexc::test {
namespace {

using namespace fetex;

struct BilevelTraits {
    using Texture = BilevelTexture;
    struct Samples {}; ///< of one format
    static constexpr auto kMember = &FetexFile::bilevel;
    static constexpr std::uint8_t kNumber = 1;
    static constexpr const char* kPrefix = "BLV";
    static constexpr std::size_t kHeader = 1, kImage = 3, kLevel1 = 4, kLastLevel = 5;
    static constexpr FindingCode kBadHeader = FindingCode::BadBilevelHeader,
                                 kSizeMismatch = FindingCode::BilevelSizeMismatch;
    static constexpr bool kOneFinding = true;

    /// 5×3 texels of three channels, levels of 2×1 and 1×1, an image of 2×3.
    static Texture full(Samples = {}) {
        return random_bilevel(
            3,
            {.width = 5, .height = 3, .rule = BilevelRule::Median, .mips = true, .image_width = 2, .image_height = 3});
    }
    static Texture other() {
        Texture t = full();
        t.below = 0;
        return t;
    }
    static std::vector<Texture> several() {
        std::vector<Texture> all;
        for (const BilevelRule rule : kBilevelRules)
            for (const bool mips : {false, true})
                for (const std::uint32_t image : {0u, 3u})
                    all.push_back(random_bilevel(all.size() + 1, {.width = 7,
                                                                  .height = 2,
                                                                  .rule = rule,
                                                                  .mips = mips,
                                                                  .image_width = image,
                                                                  .image_height = image}));
        return all;
    }
    static std::vector<Texture> damaged() { return {full()}; }

    static void expect_same(const Texture& a, const Texture& b) {
        EXPECT_EQ(a.width, b.width);
        EXPECT_EQ(a.height, b.height);
        EXPECT_EQ(a.channels, b.channels);
        EXPECT_EQ(a.rule, b.rule);
        EXPECT_EQ(a.texels, b.texels);
        EXPECT_EQ(a.mips, b.mips);
        EXPECT_EQ(a.below, b.below);
        EXPECT_EQ(a.above, b.above);
        EXPECT_EQ(a.image_width, b.image_width);
        EXPECT_EQ(a.image_height, b.image_height);
        EXPECT_EQ(a.image, b.image);
    }
    static std::vector<Finding> validate(const Texture& t) { return validate_bilevel(t); }
    static FbtColor sample(const Texture& t) { return bilevel_sample_mip(t, 2.2, 1.1, {1.5, 0.2}); }

    static std::vector<HostileWord> hostile_header() {
        return {
            {0, {0, 16385, 0xffffffff}, kBadHeader},
            {1, {0, 16385, 0xffffffff}, kBadHeader},
            {5, {0, 16385, 0xffffffff}, kBadHeader},
            {6, {0, 16385, 0xffffffff}, kBadHeader},
            {2, {4}, kBadHeader},
            {7, {1}, kBadHeader},
            {0, {16384}, kSizeMismatch}, // and doesn't allocate it
            {2, {0}, kSizeMismatch},
            {6, {16384}, kSizeMismatch},
            {3, {0x7f800000}, FindingCode::BilevelNotPremultiplied},
            {4, {0x00000001}, FindingCode::BilevelNotPremultiplied},
        };
    }
    static std::vector<SpoiltWord> spoilt() {
        return {{kHeader, 16, 0x01000002, "F2003"}, {kImage, 8, 0x01000200, "F2003"}};
    }
    static std::vector<Fault<BilevelTraits>> faults() {
        using C = FindingCode;
        using T = Texture;
        return {
            {"no width", C::BilevelDimensions, [](T& t) { t.width = 0; }},
            {"too high", C::BilevelDimensions, [](T& t) { t.height = 16385; }},
            {"a byte short", C::BilevelDimensions, [](T& t) { t.texels.pop_back(); }},
            {"a level short", C::BilevelDimensions, [](T& t) { t.mips.pop_back(); }},
            {"an image without sides", C::BilevelDimensions, [](T& t) { t.image_width = t.image_height = 0; }},
            {"sides without an image", C::BilevelDimensions, [](T& t) { t.image.clear(); }},
            {"an image that is too wide", C::BilevelDimensions,
             [](T& t) {
                 t.image_width = 16385, t.image_height = 1;
                 t.image.assign(16385, 0);
             }},
            {"other channels", C::BilevelRuleChannels, [](T& t) { t.channels = 2; }},
            {"no rule", C::BilevelRuleChannels, [](T& t) { t.rule = static_cast<BilevelRule>(4); }},
            {"below", C::BilevelNotPremultiplied, [](T& t) { t.below = 0x00000100; }},
            {"above", C::BilevelNotPremultiplied, [](T& t) { t.above = 0x7fff0000; }},
            {"the image", C::BilevelNotPremultiplied, [](T& t) { t.image.back() = 0x7f000080; }},
        };
    }
};

INSTANTIATE_TYPED_TEST_SUITE_P(Bilevel, RepresentationFile, BilevelTraits);

/// SPEC.md §2.4, word by word.
TEST(BilevelFile, hasTheBytesOfTheSpecification) {
    BilevelTexture t;
    t.width = 2, t.height = 1, t.channels = 2, t.rule = BilevelRule::Max;
    t.texels = {1, 2, 3, 4};
    t.mips = {9};
    t.below = 0xff030201, t.above = 0x80000000;
    const Chunks chunks = chunks_of(write_file(file_of<BilevelTraits>(t)));
    ASSERT_EQ(chunks.size(), 4u);
    EXPECT_EQ(chunks[1].payload, (Bytes{2, 0, 0, 0,    1, 0, 0, 0, 2, 0, 0, 0, 1, 2, 3, 0xff,
                                        0, 0, 0, 0x80, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(chunks[2].payload, t.texels);
    EXPECT_EQ(chunks[3].payload, t.mips);
    EXPECT_EQ(chunks[3].level, 1);
}

TEST(BilevelFile, hasNoImageThatTheHeaderDoesNotSpeakOf) {
    EXPECT_EQ(with_chunks<BilevelTraits>(BilevelTraits::full(),
                                         [](Chunks& c) {
                                             auto& header = c[BilevelTraits::kHeader].payload;
                                             std::fill(header.begin() + 20, header.end(), std::uint8_t{0});
                                         }),
              FindingCode::MissingChunk);
}

} // namespace
} // namespace fetexc::test
