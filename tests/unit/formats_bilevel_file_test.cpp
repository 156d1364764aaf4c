// SPDX-License-Identifier: GPL-3.0-or-later
/// Bi-level textures in files: what is written is read back; what is damaged or hostile is refused by its number.
#include <gtest/gtest.h>

#include <functional>

#include "formats/fetex_file.h"
#include "formats/validate.h"
#include "tests/support/random_bilevel.h"
#include "tests/support/random_fbt.h"
#include "tests/support/reseal.h"

namespace fetex {
namespace {

using fetexc::test::kBilevelRules;
using fetexc::test::random_bilevel;
using fetexc::test::reseal;
using fetexc::test::store;
using Bytes = std::vector<std::uint8_t>;

/// 5×3 texels of three channels, levels of 2×1 and 1×1, an image of 2×3.
BilevelTexture full_texture() {
    return random_bilevel(
        3, {.width = 5, .height = 3, .rule = BilevelRule::Median, .mips = true, .image_width = 2, .image_height = 3});
}

FetexFile file_of(BilevelTexture texture) {
    FetexFile file;
    file.metadata = {{"k", "v"}};
    file.bilevel = std::move(texture);
    return file;
}

FindingCode code_of(const Bytes& bytes) {
    FetexFile file;
    const auto finding = read_file(file, bytes);
    EXPECT_EQ(finding.has_value(), !validate_file(bytes).empty());
    EXPECT_FALSE(finding.has_value() && file.bilevel.has_value());
    return finding ? finding->code : FindingCode{};
}

void expect_same(const BilevelTexture& a, const BilevelTexture& b) {
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

TEST(BilevelFile, readsWhatWasWritten) {
    std::uint64_t seed = 0;
    for (const BilevelRule rule : kBilevelRules) {
        for (const bool mips : {false, true}) {
            for (const std::uint32_t image : {0u, 3u}) {
                const FetexFile file = file_of(random_bilevel(++seed, {.width = 7,
                                                                       .height = 2,
                                                                       .rule = rule,
                                                                       .mips = mips,
                                                                       .image_width = image,
                                                                       .image_height = image}));
                const Bytes bytes = write_file(file);
                FetexFile back;
                const auto finding = read_file(back, bytes);
                ASSERT_FALSE(finding.has_value()) << finding->message;
                ASSERT_TRUE(back.bilevel.has_value() && !back.fbt.has_value());
                expect_same(*back.bilevel, *file.bilevel);
                EXPECT_EQ(write_file(back), bytes);
            }
        }
    }
}

TEST(BilevelFile, standsBesideAnFbt) {
    FetexFile file = file_of(full_texture()), back;
    file.fbt = fetexc::test::random_fbt(21, {.width = 3, .height = 2, .mips = true});
    const Bytes bytes = write_file(file);
    ASSERT_FALSE(read_file(back, bytes).has_value());
    ASSERT_TRUE(back.fbt.has_value() && back.bilevel.has_value());
    EXPECT_EQ(back.fbt->records, file.fbt->records);
    EXPECT_EQ(back.fbt->mips, file.fbt->mips);
    expect_same(*back.bilevel, *file.bilevel);
}

/// Alone its chunks are critical; beside an FBT a reader without them has that to show.
TEST(BilevelFile, marksChunksCriticalWhereNothingElseCanBeShown) {
    for (const bool beside : {false, true}) {
        FetexFile file = file_of(full_texture());
        if (beside) file.fbt = fetexc::test::random_fbt(21);
        const Bytes bytes = write_file(file);
        ContainerView container;
        ASSERT_FALSE(read_container(container, bytes).has_value());
        std::size_t seen = 0;
        for (const ChunkView& chunk : container.chunks) {
            const std::string type = fourcc_text(chunk.type);
            if (type.substr(0, 3) != "BLV") continue;
            ++seen;
            EXPECT_EQ(chunk.representation, 1);
            EXPECT_EQ(chunk.offset % kChunkAlignment, 0u);
            EXPECT_EQ(chunk.flags, !beside && type != "BLVM" ? kChunkCritical : 0) << type;
        }
        EXPECT_EQ(seen, 5u);
    }
}

/// SPEC.md §2.4, word by word.
TEST(BilevelFile, hasTheBytesOfTheSpecification) {
    BilevelTexture t;
    t.width = 2, t.height = 1, t.channels = 2, t.rule = BilevelRule::Max;
    t.texels = {1, 2, 3, 4};
    t.mips = {9};
    t.below = 0xff030201, t.above = 0x80000000;
    const Bytes bytes = write_file(file_of(t));
    ContainerView container;
    ASSERT_FALSE(read_container(container, bytes).has_value());
    ASSERT_EQ(container.chunks.size(), 4u);
    const auto payload = [&](std::size_t k) {
        return Bytes(container.chunks[k].payload.begin(), container.chunks[k].payload.end());
    };
    EXPECT_EQ(payload(1), (Bytes{2, 0, 0, 0,    1, 0, 0, 0, 2, 0, 0, 0, 1, 2, 3, 0xff,
                                 0, 0, 0, 0x80, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(payload(2), t.texels);
    EXPECT_EQ(payload(3), t.mips);
    EXPECT_EQ(container.chunks[3].level, 1);
}

TEST(BilevelReader, refusesTruncationAtEveryLengthAndACorruptByteAnywhere) {
    const Bytes good = write_file(file_of(full_texture()));
    for (std::size_t k = 0; k < good.size(); ++k) {
        EXPECT_NE(code_of(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(k))), FindingCode{}) << k;
        Bytes bytes = good;
        bytes[k] ^= 0x11;
        EXPECT_NE(code_of(bytes), FindingCode{}) << k;
    }
}

/// What is hostile is found or harmless: with good checksums every byte of BLVH, one at a time.
TEST(BilevelReader, takesOnlyWhatCanBeSampled) {
    const Bytes good = write_file(file_of(full_texture()));
    ContainerView container;
    ASSERT_FALSE(read_container(container, good).has_value());
    const std::size_t header = static_cast<std::size_t>(container.chunks[1].offset);
    std::size_t taken = 0;
    for (std::size_t at = header; at < header + 32; ++at) {
        for (const int value : {0, 1, 2, 3, 4, 0x40, 0x7f, 0xff}) {
            Bytes bytes = good;
            bytes[at] = static_cast<std::uint8_t>(value);
            reseal(bytes);
            FetexFile file;
            if (read_file(file, bytes)) continue;
            ++taken;
            EXPECT_TRUE(validate_bilevel(*file.bilevel).empty());
            EXPECT_LE(bilevel_sample_mip(*file.bilevel, 2.2, 1.1, {1.5, 0.2}).a, 1 + 1e-12);
        }
    }
    EXPECT_GT(taken, 30u); // a byte as it was, or another colour
}

FindingCode with_word(std::size_t word, std::uint32_t value) {
    Bytes bytes = write_file(file_of(full_texture()));
    ContainerView container;
    EXPECT_FALSE(read_container(container, bytes).has_value());
    store(bytes, static_cast<std::size_t>(container.chunks[1].offset) + 4 * word, value, 4);
    reseal(bytes);
    return code_of(bytes);
}

TEST(BilevelReader, refusesHostileHeaders) {
    for (const std::uint32_t bad : {0u, 16385u, 0xffffffffu}) {
        EXPECT_EQ(with_word(0, bad), FindingCode::BadBilevelHeader);
        EXPECT_EQ(with_word(1, bad), FindingCode::BadBilevelHeader);
        EXPECT_EQ(with_word(5, bad), FindingCode::BadBilevelHeader);
        EXPECT_EQ(with_word(6, bad), FindingCode::BadBilevelHeader);
    }
    EXPECT_EQ(with_word(2, 4), FindingCode::BadBilevelHeader);
    EXPECT_EQ(with_word(7, 1), FindingCode::BadBilevelHeader);
    EXPECT_EQ(with_word(0, 16384), FindingCode::BilevelSizeMismatch); // and doesn't allocate it
    EXPECT_EQ(with_word(2, 0), FindingCode::BilevelSizeMismatch);
    EXPECT_EQ(with_word(6, 16384), FindingCode::BilevelSizeMismatch);
    EXPECT_EQ(with_word(3, 0x7f800000), FindingCode::BilevelNotPremultiplied);
    EXPECT_EQ(with_word(4, 0x00000001), FindingCode::BilevelNotPremultiplied);
}

/// The chunks of the full texture, changed.
FindingCode with_chunks(const std::function<void(std::vector<Chunk>&)>& change) {
    const Bytes good = write_file(file_of(full_texture()));
    ContainerView container;
    EXPECT_FALSE(read_container(container, good).has_value());
    std::vector<Chunk> chunks;
    for (const ChunkView& c : container.chunks)
        chunks.push_back({c.type, c.flags, c.representation, c.level, {c.payload.begin(), c.payload.end()}});
    change(chunks);
    return code_of(write_container(chunks));
}

constexpr std::size_t kHeader = 1, kTexels = 2, kImage = 3, kLevel1 = 4, kLevel2 = 5; ///< as write_file orders them

FindingCode without(std::size_t k) {
    return with_chunks([&](std::vector<Chunk>& c) { c.erase(c.begin() + static_cast<std::ptrdiff_t>(k)); });
}

FindingCode with_length(std::size_t k, int by) {
    return with_chunks([&](std::vector<Chunk>& c) { c[k].payload.resize(c[k].payload.size() + by); });
}

TEST(BilevelReader, wantsAllChunksAndNoOthers) {
    using Chunks = std::vector<Chunk>;
    EXPECT_EQ(with_chunks([](Chunks&) {}), FindingCode{});
    EXPECT_EQ(with_chunks([](Chunks& c) { std::swap(c[kLevel1], c[kHeader]); }), FindingCode{}); // in any order
    for (const std::size_t k : {kHeader, kTexels, kImage, kLevel1, kLevel2})
        EXPECT_EQ(without(k), FindingCode::MissingChunk) << k;
    EXPECT_EQ(with_chunks([](Chunks& c) { c[kLevel2].level = 3; }), FindingCode::MissingChunk);
    EXPECT_EQ(with_chunks([](Chunks& c) { c[kLevel1].level = 0; }), FindingCode::MissingChunk);
    EXPECT_EQ(with_chunks([](Chunks& c) { c[kImage].level = 1; }), FindingCode::UnknownCriticalChunk);
    EXPECT_EQ(with_chunks([](Chunks& c) { c[kTexels].representation = 9; }), FindingCode::MissingChunk);
    EXPECT_EQ(with_chunks([](Chunks& c) { c[kHeader].representation = kWholeFile; }),
              FindingCode::UnknownCriticalChunk);
    EXPECT_EQ(with_chunks([](Chunks& c) { // an image that the header doesn't speak of
                  std::fill(c[kHeader].payload.begin() + 20, c[kHeader].payload.end(), std::uint8_t{0});
              }),
              FindingCode::MissingChunk);
}

TEST(BilevelReader, wantsEveryLengthToBeRight) {
    for (const int by : {-1, 1}) {
        EXPECT_EQ(with_length(kHeader, by), FindingCode::BadBilevelHeader);
        for (const std::size_t k : {kTexels, kImage, kLevel1, kLevel2})
            EXPECT_EQ(with_length(k, by), FindingCode::BilevelSizeMismatch) << k;
    }
    EXPECT_EQ(with_length(kHeader, 4), FindingCode::BadBilevelHeader);
}

TEST(BilevelReader, refusesOneNumberForTwoKinds) {
    EXPECT_EQ(with_chunks([](std::vector<Chunk>& c) {
                  c.push_back({fourcc("FBTH"), 0, 1, 0, {}});
              }),
              FindingCode::RepresentationKinds);
}

TEST(BilevelReader, showsTheLowestNumber) {
    BilevelTexture second = full_texture();
    second.below = 0;
    const Bytes other = write_file(file_of(second));
    EXPECT_EQ(with_chunks([&](std::vector<Chunk>& chunks) {
                  ContainerView container;
                  EXPECT_FALSE(read_container(container, other).has_value());
                  for (const ChunkView& c : container.chunks)
                      if (c.representation == 1)
                          chunks.push_back({c.type, c.flags, 0, c.level, {c.payload.begin(), c.payload.end()}});
                  FetexFile file;
                  EXPECT_FALSE(read_file(file, write_container(chunks)).has_value());
                  EXPECT_EQ(file.bilevel->below, 0u);
              }),
              FindingCode{});
}

TEST(BilevelValidator, countsOffsetsFromTheStartOfTheFile) {
    Bytes bytes = write_file(file_of(full_texture()));
    ContainerView container;
    ASSERT_FALSE(read_container(container, bytes).has_value());
    const std::size_t header = static_cast<std::size_t>(container.chunks[kHeader].offset),
                      image = static_cast<std::size_t>(container.chunks[kImage].offset);
    store(bytes, header + 16, 0x01000002, 4);
    store(bytes, image + 8, 0x01000200, 4);
    reseal(bytes);
    const auto findings = validate_file(bytes);
    ASSERT_EQ(findings.size(), 2u);
    EXPECT_EQ(findings[0].offset, header + 16);
    EXPECT_EQ(findings[1].offset, image + 8);
    EXPECT_EQ(finding_id(findings[1].code), "F2003");
    EXPECT_EQ(validate_file(bytes, 1).size(), 1u);
}

struct Fault {
    const char* what;
    FindingCode expected;
    std::function<void(BilevelTexture&)> make;
};

TEST(BilevelValidator, findsEachKindOfFault) {
    using C = FindingCode;
    using T = BilevelTexture;
    const Fault faults[] = {
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
    EXPECT_TRUE(validate_bilevel(full_texture()).empty());
    for (const Fault& fault : faults) {
        BilevelTexture texture = full_texture();
        fault.make(texture);
        const auto findings = validate_bilevel(texture);
        ASSERT_EQ(findings.size(), 1u) << fault.what;
        EXPECT_EQ(finding_id(findings[0].code), finding_id(fault.expected)) << fault.what;
    }
}

} // namespace
} // namespace fetex
