// SPDX-License-Identifier: GPL-3.0-or-later
/// Silhouette-map textures in files: what is written is read back; what is damaged or hostile is refused by its number.
#include <gtest/gtest.h>

#include <functional>

#include "formats/fetex_file.h"
#include "formats/validate.h"
#include "tests/support/random_bilevel.h"
#include "tests/support/random_fbt.h"
#include "tests/support/random_silmap.h"
#include "tests/support/reseal.h"

namespace fetex {
namespace {

using fetexc::test::kSilmapCellFormats;
using fetexc::test::kSilmapSampleFormats;
using fetexc::test::random_silmap;
using fetexc::test::reseal;
using fetexc::test::store;
using Bytes = std::vector<std::uint8_t>;

/// 5×3 texels, 6×4 cells, levels of 2×1 and 1×1.
SilmapTexture full_texture(SilmapSampleFormat samples = SilmapSampleFormat::Rgba8) {
    return random_silmap(3, {.width = 5, .height = 3, .sample_format = samples, .mips = true});
}

FetexFile file_of(SilmapTexture texture) {
    FetexFile file;
    file.metadata = {{"k", "v"}};
    file.silmap = std::move(texture);
    return file;
}

FindingCode code_of(const Bytes& bytes) {
    FetexFile file;
    const auto finding = read_file(file, bytes);
    EXPECT_EQ(finding.has_value(), !validate_file(bytes).empty());
    EXPECT_FALSE(finding.has_value() && file.silmap.has_value());
    return finding ? finding->code : FindingCode{};
}

void expect_same(const SilmapTexture& a, const SilmapTexture& b) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_EQ(a.cell_format, b.cell_format);
    EXPECT_EQ(a.sample_format, b.sample_format);
    EXPECT_EQ(a.cells, b.cells);
    EXPECT_EQ(a.colors, b.colors);
    EXPECT_EQ(a.mips, b.mips);
}

TEST(SilmapFile, readsWhatWasWritten) {
    std::uint64_t seed = 0;
    for (const SilmapCellFormat cells : kSilmapCellFormats) {
        for (const SilmapSampleFormat samples : kSilmapSampleFormats) {
            for (const bool mips : {false, true}) {
                const FetexFile file = file_of(random_silmap(
                    ++seed, {.width = 7, .height = 2, .cell_format = cells, .sample_format = samples, .mips = mips}));
                const Bytes bytes = write_file(file);
                FetexFile back;
                const auto finding = read_file(back, bytes);
                ASSERT_FALSE(finding.has_value()) << finding->message;
                ASSERT_TRUE(back.silmap.has_value() && !back.fbt.has_value() && !back.bilevel.has_value());
                expect_same(*back.silmap, *file.silmap);
                EXPECT_EQ(write_file(back), bytes);
            }
        }
    }
}

TEST(SilmapFile, standsBesideOtherRepresentations) {
    FetexFile file = file_of(full_texture()), back;
    file.fbt = fetexc::test::random_fbt(21, {.width = 3, .height = 2, .mips = true});
    file.bilevel = fetexc::test::random_bilevel(1, {.mips = true});
    const Bytes bytes = write_file(file);
    ASSERT_FALSE(read_file(back, bytes).has_value());
    ASSERT_TRUE(back.fbt.has_value() && back.bilevel.has_value() && back.silmap.has_value());
    EXPECT_EQ(back.fbt->records, file.fbt->records);
    EXPECT_EQ(back.bilevel->texels, file.bilevel->texels);
    expect_same(*back.silmap, *file.silmap);
}

/// Alone its chunks are critical; beside others a reader without them has those to show.
TEST(SilmapFile, marksChunksCriticalWhereNothingElseCanBeShown) {
    for (const int beside : {0, 1, 2}) {
        FetexFile file = file_of(full_texture());
        if (beside == 1) file.fbt = fetexc::test::random_fbt(21);
        if (beside == 2) file.bilevel = fetexc::test::random_bilevel(1);
        const Bytes bytes = write_file(file);
        ContainerView container;
        ASSERT_FALSE(read_container(container, bytes).has_value());
        std::size_t seen = 0;
        for (const ChunkView& chunk : container.chunks) {
            const std::string type = fourcc_text(chunk.type);
            if (type.substr(0, 3) != "SLM") continue;
            ++seen;
            EXPECT_EQ(chunk.representation, 2);
            EXPECT_EQ(chunk.offset % kChunkAlignment, 0u);
            EXPECT_EQ(chunk.flags, beside == 0 && type != "SLMM" ? kChunkCritical : 0) << type;
        }
        EXPECT_EQ(seen, 5u);
    }
}

/// SPEC.md §2.5, byte by byte.
TEST(SilmapFile, hasTheBytesOfTheSpecification) {
    SilmapTexture t;
    t.width = 2, t.height = 1;
    t.cell_format = SilmapCellFormat::Bits16, t.sample_format = SilmapSampleFormat::Rgb8;
    t.cells = {0x0102, 0x0304, 0x0506, 0x0708, 0x090a, 0x0b0c};
    t.colors = {0xff030201, 0xff060504};
    t.mips = {0xff090807};
    const Bytes bytes = write_file(file_of(t));
    ContainerView container;
    ASSERT_FALSE(read_container(container, bytes).has_value());
    ASSERT_EQ(container.chunks.size(), 5u);
    const auto payload = [&](std::size_t k) {
        return Bytes(container.chunks[k].payload.begin(), container.chunks[k].payload.end());
    };
    EXPECT_EQ(payload(1),
              (Bytes{2, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(payload(2), (Bytes{2, 1, 4, 3, 6, 5, 8, 7, 10, 9, 12, 11}));
    EXPECT_EQ(payload(3), (Bytes{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(payload(4), (Bytes{7, 8, 9, 255}));
    EXPECT_EQ(container.chunks[4].level, 1);
}

TEST(SilmapReader, refusesTruncationAtEveryLengthAndACorruptByteAnywhere) {
    const Bytes good = write_file(file_of(full_texture()));
    for (std::size_t k = 0; k < good.size(); ++k) {
        EXPECT_NE(code_of(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(k))), FindingCode{}) << k;
        Bytes bytes = good;
        bytes[k] ^= 0x11;
        EXPECT_NE(code_of(bytes), FindingCode{}) << k;
    }
}

/// What is hostile is found or harmless: with good checksums every byte of the file's chunks, one at a time.
TEST(SilmapReader, takesOnlyWhatCanBeSampled) {
    for (const SilmapSampleFormat samples : kSilmapSampleFormats) {
        const Bytes good = write_file(file_of(full_texture(samples)));
        ContainerView container;
        ASSERT_FALSE(read_container(container, good).has_value());
        std::size_t taken = 0, refused = 0;
        for (std::size_t at = static_cast<std::size_t>(container.chunks[1].offset); at < good.size(); ++at) {
            for (const int value : {0, 1, 2, 3, 0x40, 0x7f, 0xff}) {
                Bytes bytes = good;
                bytes[at] = static_cast<std::uint8_t>(value);
                reseal(bytes);
                FetexFile file;
                if (read_file(file, bytes)) {
                    ++refused;
                    continue;
                }
                ++taken;
                EXPECT_TRUE(validate_silmap(*file.silmap).empty());
                EXPECT_LE(silmap_sample_mip(*file.silmap, 2.2, 1.1, {1.5, 0.2}).a, 1 + 1e-12);
            }
        }
        EXPECT_GT(taken, 300u); // a byte as it was, another cell or colour
        EXPECT_GT(refused, 200u);
    }
}

FindingCode with_word(std::size_t word, std::uint32_t value) {
    Bytes bytes = write_file(file_of(full_texture()));
    ContainerView container;
    EXPECT_FALSE(read_container(container, bytes).has_value());
    store(bytes, static_cast<std::size_t>(container.chunks[1].offset) + 4 * word, value, 4);
    reseal(bytes);
    return code_of(bytes);
}

TEST(SilmapReader, refusesHostileHeaders) {
    for (const std::uint32_t bad : {0u, 16385u, 0xffffffffu}) {
        EXPECT_EQ(with_word(0, bad), FindingCode::BadSilmapHeader);
        EXPECT_EQ(with_word(1, bad), FindingCode::BadSilmapHeader);
    }
    EXPECT_EQ(with_word(2, 2), FindingCode::BadSilmapHeader);
    EXPECT_EQ(with_word(3, 4), FindingCode::BadSilmapHeader);
    for (std::size_t word = 4; word < 8; ++word)
        EXPECT_EQ(with_word(word, 1), FindingCode::BadSilmapHeader);
    EXPECT_EQ(with_word(0, 16384), FindingCode::SilmapSizeMismatch); // and doesn't allocate it
    EXPECT_EQ(with_word(2, 1), FindingCode::SilmapSizeMismatch);
    EXPECT_EQ(with_word(3, 1), FindingCode::SilmapSizeMismatch);
    EXPECT_EQ(with_word(3, 3), FindingCode::SilmapSizeMismatch);
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

constexpr std::size_t kHeader = 1, kCells = 2, kSamples = 3, kLevel1 = 4, kLevel2 = 5; ///< as write_file orders them

FindingCode without(std::size_t k) {
    return with_chunks([&](std::vector<Chunk>& c) { c.erase(c.begin() + static_cast<std::ptrdiff_t>(k)); });
}

FindingCode with_length(std::size_t k, int by) {
    return with_chunks([&](std::vector<Chunk>& c) { c[k].payload.resize(c[k].payload.size() + by); });
}

TEST(SilmapReader, wantsAllChunksAndNoOthers) {
    using Chunks = std::vector<Chunk>;
    EXPECT_EQ(with_chunks([](Chunks&) {}), FindingCode{});
    EXPECT_EQ(with_chunks([](Chunks& c) { std::swap(c[kLevel1], c[kHeader]); }), FindingCode{}); // in any order
    for (const std::size_t k : {kHeader, kCells, kSamples, kLevel1, kLevel2})
        EXPECT_EQ(without(k), FindingCode::MissingChunk) << k;
    EXPECT_EQ(with_chunks([](Chunks& c) { c.resize(kLevel1); }), FindingCode{}); // no levels at all
    EXPECT_EQ(with_chunks([](Chunks& c) { c[kLevel2].level = 3; }), FindingCode::MissingChunk);
    EXPECT_EQ(with_chunks([](Chunks& c) { c[kLevel1].level = 0; }), FindingCode::MissingChunk);
    EXPECT_EQ(with_chunks([](Chunks& c) { c[kCells].level = 1; }), FindingCode::UnknownCriticalChunk);
    EXPECT_EQ(with_chunks([](Chunks& c) { c[kSamples].representation = 9; }), FindingCode::MissingChunk);
    EXPECT_EQ(with_chunks([](Chunks& c) { c[kHeader].representation = kWholeFile; }),
              FindingCode::UnknownCriticalChunk);
}

TEST(SilmapReader, wantsEveryLengthToBeRight) {
    for (const int by : {-1, 1}) {
        EXPECT_EQ(with_length(kHeader, by), FindingCode::BadSilmapHeader);
        for (const std::size_t k : {kCells, kSamples, kLevel1, kLevel2})
            EXPECT_EQ(with_length(k, by), FindingCode::SilmapSizeMismatch) << k;
    }
    EXPECT_EQ(with_length(kHeader, 4), FindingCode::BadSilmapHeader);
}

TEST(SilmapReader, refusesOneNumberForTwoKinds) {
    for (const FourCc other : {fourcc("FBTH"), fourcc("BLVH")})
        EXPECT_EQ(with_chunks([&](std::vector<Chunk>& c) {
                      c.push_back({other, 0, 2, 0, {}});
                  }),
                  FindingCode::RepresentationKinds);
}

TEST(SilmapReader, showsTheLowestNumber) {
    SilmapTexture second = full_texture();
    second.colors[0] = 0;
    const Bytes other = write_file(file_of(second));
    EXPECT_EQ(with_chunks([&](std::vector<Chunk>& chunks) {
                  ContainerView container;
                  EXPECT_FALSE(read_container(container, other).has_value());
                  for (const ChunkView& c : container.chunks)
                      if (c.representation == 2)
                          chunks.push_back({c.type, c.flags, 0, c.level, {c.payload.begin(), c.payload.end()}});
                  FetexFile file;
                  EXPECT_FALSE(read_file(file, write_container(chunks)).has_value());
                  EXPECT_EQ(file.silmap->colors[0], 0u);
              }),
              FindingCode{});
}

TEST(SilmapValidator, countsOffsetsFromTheStartOfTheFile) {
    Bytes bytes = write_file(file_of(full_texture()));
    ContainerView container;
    ASSERT_FALSE(read_container(container, bytes).has_value());
    const auto offset = [&](std::size_t k) { return static_cast<std::size_t>(container.chunks[k].offset); };
    store(bytes, offset(kSamples) + 16, 0x01000002, 4);
    store(bytes, offset(kLevel1) + 4, 0x01000200, 4);
    store(bytes, offset(kLevel2), 0x01030000, 4);
    reseal(bytes);
    const auto findings = validate_file(bytes);
    ASSERT_EQ(findings.size(), 3u);
    EXPECT_EQ(findings[0].offset, offset(kSamples) + 16);
    EXPECT_EQ(findings[1].offset, offset(kLevel1) + 4);
    EXPECT_EQ(findings[2].offset, offset(kLevel2));
    EXPECT_EQ(finding_id(findings[0].code), "F3003");
    EXPECT_EQ(validate_file(bytes, 2).size(), 2u);
}

struct Fault {
    const char* what;
    FindingCode expected;
    SilmapSampleFormat format;
    std::function<void(SilmapTexture&)> make;
};

TEST(SilmapValidator, findsEachKindOfFault) {
    using C = FindingCode;
    using T = SilmapTexture;
    using F = SilmapSampleFormat;
    const Fault faults[] = {
        {"no width", C::SilmapDimensions, F::Rgba8, [](T& t) { t.width = 0; }},
        {"too high", C::SilmapDimensions, F::Rgba8, [](T& t) { t.height = 16385; }},
        {"a cell short", C::SilmapDimensions, F::Rgba8, [](T& t) { t.cells.pop_back(); }},
        {"a texel short", C::SilmapDimensions, F::Rgba8, [](T& t) { t.colors.pop_back(); }},
        {"half a texel short", C::SilmapDimensions, F::Rgba16, [](T& t) { t.colors.pop_back(); }},
        {"a level short", C::SilmapDimensions, F::Rgba8, [](T& t) { t.mips.pop_back(); }},
        {"no cell format", C::SilmapFormat, F::Rgba8, [](T& t) { t.cell_format = SilmapCellFormat(2); }},
        {"no sample format", C::SilmapFormat, F::Rgba8, [](T& t) { t.sample_format = F(4); }},
        {"a cell of 9 bits", C::SilmapFormat, F::Rgba8, [](T& t) { t.cells.back() = 256; }},
        {"brighter than alpha", C::SilmapNotPremultiplied, F::Rgba8, [](T& t) { t.colors.back() = 0x7f000080; }},
        {"of 16 bits", C::SilmapNotPremultiplied, F::Rgba16, [](T& t) { t.colors.back() = 0x7fff8000; }},
        {"light without alpha", C::SilmapNotPremultiplied, F::Rgba16F, [](T& t) { t.colors.back() = 0x00000001; }},
        {"a negative half", C::SilmapSampleValue, F::Rgba16F, [](T& t) { t.colors.back() = 0x3c008001; }},
        {"an infinite half", C::SilmapSampleValue, F::Rgba16F, [](T& t) { t.colors.back() = 0x3c007c00; }},
        {"alpha above 1", C::SilmapSampleValue, F::Rgba16F, [](T& t) { t.colors.back() = 0x3c010000; }},
        {"not opaque", C::SilmapSampleValue, F::Rgb8, [](T& t) { t.colors.back() = 0xfe000000; }},
        {"in a level", C::SilmapNotPremultiplied, F::Rgba16F, [](T& t) { t.mips.back() = 0x7f000080; }},
    };
    for (const SilmapSampleFormat format : kSilmapSampleFormats)
        EXPECT_TRUE(validate_silmap(full_texture(format)).empty());
    for (const Fault& fault : faults) {
        SilmapTexture texture = full_texture(fault.format);
        fault.make(texture);
        const auto findings = validate_silmap(texture);
        ASSERT_EQ(findings.size(), 1u) << fault.what;
        EXPECT_EQ(finding_id(findings[0].code), finding_id(fault.expected)) << fault.what;
    }
}

} // namespace
} // namespace fetex
