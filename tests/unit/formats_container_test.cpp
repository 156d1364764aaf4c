// SPDX-License-Identifier: GPL-3.0-or-later
/// Container and file: what is written is read back; what is damaged in any way is refused.
#include <gtest/gtest.h>

#include "formats/crc32c.h"
#include "formats/fetex_file.h"
#include "formats/validate.h"
#include "tests/support/random_fbt.h"
#include "tests/support/reseal.h"

namespace fetex {
namespace {

using fetexc::test::reseal;
using fetexc::test::store;
using Bytes = std::vector<std::uint8_t>;

FetexFile small_file() {
    FetexFile file;
    file.metadata = {{"source", "a.svg"}, {"tool", "test 1.0"}, {"ü", "\xe2\x82\xac"}};
    file.fbt = fetexc::test::random_fbt(21, {.width = 3, .height = 2});
    return file;
}

FindingCode code_of(const Bytes& bytes) {
    FetexFile file;
    const auto finding = read_file(file, bytes);
    return finding ? finding->code : FindingCode{};
}

TEST(Crc32c, hasTheStandardCheckValue) {
    const std::string digits = "123456789";
    EXPECT_EQ(crc32c({reinterpret_cast<const std::uint8_t*>(digits.data()), digits.size()}), 0xe3069283u);
    EXPECT_EQ(crc32c({}), 0u);
    const Bytes zeros(32, 0);
    EXPECT_EQ(crc32c(zeros), 0x8a9136aau); // RFC 3720, B.4
    EXPECT_EQ(crc32c_by_tables(zeros), 0x8a9136aau);
}

TEST(Crc32c, isTheSameOnEveryMachine) {
    Bytes bytes(1000);
    for (std::size_t k = 0; k < bytes.size(); ++k)
        bytes[k] = static_cast<std::uint8_t>(k * k >> 3 ^ 5 * k);
    for (std::size_t first = 0; first < 9; ++first)
        for (std::size_t size = 0; size < 200; ++size) {
            const ByteSpan part = ByteSpan(bytes).subspan(first, size);
            ASSERT_EQ(crc32c(part), crc32c_by_tables(part)) << first << ' ' << size;
        }
    EXPECT_EQ(crc32c(bytes), crc32c_by_tables(bytes));
}

TEST(File, readsWhatWasWritten) {
    const FetexFile file = small_file();
    const Bytes bytes = write_file(file);
    FetexFile back;
    const auto finding = read_file(back, bytes);
    ASSERT_FALSE(finding.has_value()) << finding->message;
    EXPECT_EQ(back.metadata, file.metadata);
    ASSERT_TRUE(back.fbt.has_value());
    EXPECT_EQ(back.fbt->texels, file.fbt->texels);
    EXPECT_EQ(back.fbt->records, file.fbt->records);
    EXPECT_EQ(back.fbt->width, 3u);
    EXPECT_EQ(back.fbt->traits.max_entries, file.fbt->traits.max_entries);
    EXPECT_EQ(write_file(back), bytes);
    EXPECT_TRUE(validate_file(bytes).empty());
}

TEST(File, writesTheSameBytesEveryTime) { EXPECT_EQ(write_file(small_file()), write_file(small_file())); }

TEST(File, alignsEveryChunkForTheGpu) {
    const Bytes bytes = write_file(small_file());
    ContainerView container;
    ASSERT_FALSE(read_container(container, bytes).has_value());
    ASSERT_EQ(container.chunks.size(), 5u);
    for (const ChunkView& chunk : container.chunks)
        EXPECT_EQ(chunk.offset % 16, 0u) << fourcc_text(chunk.type);
}

TEST(File, mayHoldMetadataAlone) {
    FetexFile file;
    const Bytes bytes = write_file(file);
    FetexFile back;
    EXPECT_FALSE(read_file(back, bytes).has_value());
    EXPECT_FALSE(back.fbt.has_value());
}

TEST(File, repairsTextThatIsNotUtf8WhenWriting) {
    FetexFile file;
    file.metadata = {{"", "dropped"}, {"bad\xff", "\xc0\x80 \xed\xa0\x80 \xf4\x90\x80\x80 ok"}};
    FetexFile back;
    ASSERT_FALSE(read_file(back, write_file(file)).has_value());
    const std::string r = "\xef\xbf\xbd";
    EXPECT_EQ(back.metadata, (Metadata{{"bad" + r, r + r + " " + r + r + r + " " + r + r + r + r + " ok"}}));
}

TEST(Reader, refusesTruncationAtEveryLength) {
    const Bytes bytes = write_file(small_file());
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        FetexFile file;
        EXPECT_TRUE(read_file(file, ByteSpan(bytes).first(length)).has_value()) << length;
        EXPECT_FALSE(file.fbt.has_value());
    }
}

TEST(Reader, refusesACorruptByteAnywhere) {
    const Bytes good = write_file(small_file());
    for (std::size_t at = 0; at < good.size(); ++at) {
        for (const std::uint8_t flip : {0x01, 0x80, 0xff}) {
            Bytes bytes = good;
            bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ flip);
            FetexFile file;
            EXPECT_TRUE(read_file(file, bytes).has_value()) << "byte " << at;
        }
    }
}

TEST(Reader, refusesExtraBytes) {
    Bytes bytes = write_file(small_file());
    bytes.push_back(0);
    EXPECT_EQ(code_of(bytes), FindingCode::ExtraBytes);
    bytes.insert(bytes.end(), 100, 0xff);
    EXPECT_EQ(code_of(bytes), FindingCode::ExtraBytes);
}

TEST(Reader, namesTextModeDamage) {
    Bytes bytes = write_file(small_file());
    bytes.erase(bytes.begin() + 4); // CR LF became LF
    EXPECT_EQ(code_of(bytes), FindingCode::BadMagic);
}

TEST(Reader, refusesOtherMajorVersionsAndTakesNewerMinorOnes) {
    Bytes bytes = write_file(small_file());
    store(bytes, 8, kVersionMajor + 1, 2);
    reseal(bytes);
    EXPECT_EQ(code_of(bytes), FindingCode::UnsupportedVersion);
    bytes = write_file(small_file());
    store(bytes, 10, 7, 2);
    reseal(bytes);
    EXPECT_EQ(code_of(bytes), FindingCode{});
}

/// Each row changes one field of a good file and mends the checksums: only the rule itself can refuse it.
struct HostileField {
    const char* what;
    std::size_t at, size;
    std::uint64_t value;
    FindingCode expected;
};
constexpr HostileField kHostileFields[] = {
    {"chunk count 2^32-1", 12, 4, 0xffffffff, FindingCode::TooManyChunks},
    {"chunk count 4097", 12, 4, 4097, FindingCode::TooManyChunks},
    {"one chunk fewer", 12, 4, 3, FindingCode::BadChunkOffset},
    {"no chunk", 12, 4, 0, FindingCode::BadLength},
    {"length too large", 16, 8, ~0ull, FindingCode::Truncated},
    {"length too small", 16, 8, 160, FindingCode::ExtraBytes},
    {"lower-case type", 32, 1, 'm', FindingCode::BadChunkType},
    {"unknown flag", 36, 2, 2, FindingCode::ReservedNotZero},
    {"reserved word", 60, 4, 1, FindingCode::ReservedNotZero},
    {"chunk over the table", 40, 8, 32, FindingCode::BadChunkOffset},
    {"chunk beyond 2^63", 40, 8, ~0ull - 15, FindingCode::BadChunkOffset},
    {"gap before a chunk", 40, 8, 176, FindingCode::BadChunkOffset},
    {"size beyond the file", 48, 8, 1u << 20, FindingCode::BadChunkSize},
    {"size 2^64-1", 48, 8, ~0ull, FindingCode::BadChunkSize},
    {"second chunk overlaps the first", 72, 8, 160, FindingCode::BadChunkOffset},
    {"type of the second chunk", 64, 4, fourcc("META"), FindingCode::UnknownCriticalChunk},
};

TEST(Reader, refusesHostileFieldsWithGoodChecksums) {
    for (const HostileField& field : kHostileFields) {
        Bytes bytes = write_file(small_file());
        store(bytes, field.at, field.value, field.size);
        reseal(bytes);
        EXPECT_EQ(finding_id(code_of(bytes)), finding_id(field.expected)) << field.what;
    }
}

TEST(Reader, refusesPaddingThatIsNotZero) {
    Bytes bytes = write_file({{{"k", "v"}}, fetexc::test::random_fbt(1)}); // META: 14 bytes, 2 of padding
    const std::size_t first_payload = 32 + std::size_t{32} * bytes[12];
    bytes[first_payload + 14] = 1;
    EXPECT_EQ(code_of(bytes), FindingCode::PaddingNotZero);
}

TEST(Reader, refusesTwoChunksOfOneName) {
    const Bytes bytes = write_container({{fourcc("ABCD"), 0, 1, 0, {1}}, {fourcc("ABCD"), 0, 1, 0, {2}}});
    EXPECT_EQ(code_of(bytes), FindingCode::DuplicateChunk);
    EXPECT_EQ(code_of(write_container({{fourcc("ABCD"), 0, 1, 0, {1}}, {fourcc("ABCD"), 0, 1, 1, {2}}})),
              FindingCode{});
}

TEST(Reader, skipsUnknownAncillaryChunksAndRefusesCriticalOnes) {
    EXPECT_EQ(code_of(write_container({{fourcc("NEW1"), 0, 3, 2, {1, 2, 3}}})), FindingCode{});
    EXPECT_EQ(code_of(write_container({{fourcc("NEW1"), kChunkCritical, 3, 0, {1, 2, 3}}})),
              FindingCode::UnknownCriticalChunk);
    EXPECT_EQ(code_of(write_container({{fourcc("FBTH"), kChunkCritical, 0, 1, {}}})),
              FindingCode::UnknownCriticalChunk);
    EXPECT_EQ(code_of(write_container({{fourcc("FBTH"), 0, 0, 1, {}}})), FindingCode{}); // a mip level of the future
}

TEST(Reader, wantsAllThreeChunksOfAnFbt) {
    EXPECT_EQ(code_of(write_container({{fourcc("FBTH"), kChunkCritical, 0, 0, {}}})), FindingCode::MissingChunk);
    EXPECT_EQ(code_of(write_container({{fourcc("FBTT"), kChunkCritical, 0, 0, {}}, {fourcc("FBTR"), 1, 0, 0, {}}})),
              FindingCode::MissingChunk);
}

/// A good file with a chain, and what the reader says when its chunks FBTM are something else: of a texture of 5×3
/// texels, levels of 2×1 and 1×1.
FindingCode with_mips(const std::vector<Chunk>& mips) {
    FetexFile file;
    file.fbt = fetexc::test::random_fbt(4, {.width = 5, .height = 3});
    const Bytes plain = write_file(file);
    ContainerView container;
    EXPECT_FALSE(read_container(container, plain).has_value());
    std::vector<Chunk> chunks;
    for (const ChunkView& c : container.chunks)
        chunks.push_back({c.type, c.flags, c.representation, c.level, {c.payload.begin(), c.payload.end()}});
    chunks.insert(chunks.end(), mips.begin(), mips.end());
    return code_of(write_container(chunks));
}

Chunk mip(std::uint8_t level, std::size_t bytes, std::uint8_t representation = 0) {
    return {fourcc("FBTM"), 0, representation, level, Bytes(bytes, 0)};
}

TEST(Reader, takesAMipChainWholeOrNotAtAll) {
    EXPECT_EQ(with_mips({}), FindingCode{});
    EXPECT_EQ(with_mips({mip(1, 8), mip(2, 4)}), FindingCode{});
    EXPECT_EQ(with_mips({mip(2, 4), mip(1, 8)}), FindingCode{}); // in any order
    EXPECT_EQ(with_mips({mip(1, 8)}), FindingCode::MissingChunk);
    EXPECT_EQ(with_mips({mip(2, 4)}), FindingCode::MissingChunk);
    EXPECT_EQ(with_mips({mip(0, 60), mip(1, 8), mip(2, 4)}), FindingCode::MissingChunk);
    EXPECT_EQ(with_mips({mip(1, 8), mip(2, 4), mip(3, 4)}), FindingCode::MissingChunk);
    EXPECT_EQ(with_mips({mip(1, 8), mip(3, 4)}), FindingCode::MissingChunk);
    EXPECT_EQ(with_mips({mip(1, 8), mip(255, 4)}), FindingCode::MissingChunk);
    EXPECT_EQ(with_mips({mip(1, 8, 7), mip(2, 4, 7)}), FindingCode::MissingChunk); // of no FBT
    EXPECT_EQ(with_mips({mip(1, 4), mip(2, 4)}), FindingCode::FbtSizeMismatch);
    EXPECT_EQ(with_mips({mip(1, 9), mip(2, 4)}), FindingCode::FbtSizeMismatch);
    EXPECT_EQ(with_mips({mip(1, 8), mip(2, 0)}), FindingCode::FbtSizeMismatch);
}

TEST(Reader, readsTheMipChainThatWasWritten) {
    FetexFile file, back;
    file.fbt = fetexc::test::random_fbt(4, {.width = 21, .height = 6, .mips = true});
    const Bytes bytes = write_file(file);
    ASSERT_FALSE(read_file(back, bytes).has_value());
    EXPECT_EQ(back.fbt->mips, file.fbt->mips);
    EXPECT_EQ(write_file(back), bytes);
    for (std::size_t length = 0; length < bytes.size(); length += 7)
        EXPECT_NE(code_of(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length))), FindingCode{});
}

Bytes with_metadata(const Bytes& payload) { return write_container({{fourcc("META"), 0, kWholeFile, 0, payload}}); }

TEST(Reader, refusesMalformedMetadata) {
    const Bytes hostile[] = {
        {},
        {1, 0, 0},
        {1, 0, 0, 0},                                                           // counted, not there
        {0xff, 0xff, 0xff, 0xff, 1, 0, 0, 0, 0, 0, 0, 0, 'a'},                  // far too many
        {1, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 'a'},                              // key leaves the chunk
        {1, 0, 0, 0, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 'a'},      // 2^33 bytes
        {1, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 'v'},                              // empty key
        {1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0xff},                             // not UTF-8
        {1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 'a', 'x'},                         // bytes after the end
        {2, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 'b', 1, 0, 0, 0, 0, 0, 0, 0, 'a'}, // not sorted
        {2, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 'a', 1, 0, 0, 0, 0, 0, 0, 0, 'a'}, // twice
    };
    for (const Bytes& payload : hostile)
        EXPECT_EQ(code_of(with_metadata(payload)), FindingCode::BadMetadata) << payload.size();
    EXPECT_EQ(code_of(with_metadata({0, 0, 0, 0})), FindingCode{});
}

/// Words of FBTH that lie about the size must not make the reader allocate it.
TEST(Reader, refusesHostileFbtHeaders) {
    const FetexFile file = small_file();
    ContainerView container;
    const Bytes good = write_file(file);
    ASSERT_FALSE(read_container(container, good).has_value());
    const std::size_t header = static_cast<std::size_t>(container.chunks[1].offset);
    const auto with_word = [&](std::size_t word, std::uint32_t value) {
        Bytes bytes = good;
        store(bytes, header + 4 * word, value, 4);
        reseal(bytes);
        return code_of(bytes);
    };
    for (const std::uint32_t bad : {0u, 16385u, 0xffffffffu}) {
        EXPECT_EQ(with_word(0, bad), FindingCode::BadFbtHeader);
        EXPECT_EQ(with_word(1, bad), FindingCode::BadFbtHeader);
    }
    EXPECT_EQ(with_word(2, 3), FindingCode::BadFbtHeader);
    EXPECT_EQ(with_word(5, 32), FindingCode::BadFbtHeader);
    EXPECT_EQ(with_word(15, 1), FindingCode::BadFbtHeader);
    EXPECT_EQ(with_word(0, 16384), FindingCode::FbtSizeMismatch);
    EXPECT_EQ(with_word(9, 0xffffffff), FindingCode::FbtSizeMismatch);
    EXPECT_EQ(with_word(7, 1u << 19), FindingCode::FbtTraitsMismatch);
}

TEST(Validator, countsOffsetsFromTheStartOfTheFile) {
    const Bytes good = write_file(small_file());
    ContainerView container;
    ASSERT_FALSE(read_container(container, good).has_value());
    const std::size_t texels = static_cast<std::size_t>(container.chunks[2].offset);
    Bytes bytes = good;
    store(bytes, texels + 4, 0xffffffff, 4); // texel (1,0): shaded by model 3
    reseal(bytes);
    const auto findings = validate_file(bytes);
    ASSERT_FALSE(findings.empty());
    EXPECT_EQ(findings[0].code, FindingCode::FbtModel);
    EXPECT_EQ(findings[0].offset, texels + 4);
    EXPECT_EQ(finding_id(findings[0].code), "F1020");
}

TEST(Validator, countsOffsetsInMipLevelsFromTheStartOfTheFile) {
    FetexFile file;
    file.fbt = fetexc::test::random_fbt(4, {.width = 5, .height = 3, .mips = true});
    Bytes bytes = write_file(file);
    ContainerView container;
    ASSERT_FALSE(read_container(container, bytes).has_value());
    const std::size_t last = static_cast<std::size_t>(container.chunks.back().offset); // the sample of level 2
    store(bytes, last, 0x010000ff, 4);
    reseal(bytes);
    const auto findings = validate_file(bytes);
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_EQ(findings[0].code, FindingCode::FbtNotPremultiplied);
    EXPECT_EQ(findings[0].offset, last);
}

} // namespace
} // namespace fetex
