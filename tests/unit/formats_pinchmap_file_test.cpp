// SPDX-License-Identifier: GPL-3.0-or-later
/// Pinchmaps in files: what is written is read back; what is damaged or hostile is refused by its number.
#include <gtest/gtest.h>

#include <functional>

#include "formats/fetex_file.h"
#include "formats/validate.h"
#include "tests/support/known_pinchmap.h"
#include "tests/support/random_bilevel.h"
#include "tests/support/random_fbt.h"
#include "tests/support/random_silmap.h"
#include "tests/support/reseal.h"

namespace fetex {
namespace {

using fetexc::test::KnownSignal;
using fetexc::test::kPinchmapFormats;
using fetexc::test::kPinchmapSampleFormats;
using fetexc::test::mask_of;
using fetexc::test::pinchmap_of;
using fetexc::test::reseal;
using fetexc::test::store;
using Bytes = std::vector<std::uint8_t>;

/// 5×3 clusters, 6×4 map texels, a signal of 10×6 and its levels of 5×3, 2×1 and 1×1.
PinchmapTexture full_texture(PinchmapSampleFormat samples = PinchmapSampleFormat::Rgba8) {
    PinchmapTexture t = pinchmap_of(mask_of({"..###", "..###", "....."}), {.scale = 1,
                                                                           .map_format = PinchmapFormat::Bits8,
                                                                           .sample_format = samples,
                                                                           .signal = KnownSignal::Random,
                                                                           .gamma_from = -0.5,
                                                                           .gamma_to = 0.5,
                                                                           .mips = true,
                                                                           .seed = 3});
    t.line_color = 0xff102030, t.line_width = 4096;
    return t;
}

FetexFile file_of(PinchmapTexture texture) {
    FetexFile file;
    file.metadata = {{"k", "v"}};
    file.pinchmap = std::move(texture);
    return file;
}

FindingCode code_of(const Bytes& bytes) {
    FetexFile file;
    const auto finding = read_file(file, bytes);
    EXPECT_EQ(finding.has_value(), !validate_file(bytes).empty());
    EXPECT_FALSE(finding.has_value() && file.pinchmap.has_value());
    return finding ? finding->code : FindingCode{};
}

void expect_same(const PinchmapTexture& a, const PinchmapTexture& b) {
    EXPECT_EQ(a.width, b.width);
    EXPECT_EQ(a.height, b.height);
    EXPECT_EQ(a.scale, b.scale);
    EXPECT_EQ(a.map_format, b.map_format);
    EXPECT_EQ(a.sample_format, b.sample_format);
    EXPECT_EQ(a.line_color, b.line_color);
    EXPECT_EQ(a.line_width, b.line_width);
    EXPECT_EQ(a.map, b.map);
    EXPECT_EQ(a.signal, b.signal);
    EXPECT_EQ(a.mips, b.mips);
}

TEST(PinchmapFile, readsWhatWasWritten) {
    std::uint64_t seed = 0;
    for (const PinchmapFormat format : kPinchmapFormats) {
        for (const PinchmapSampleFormat samples : kPinchmapSampleFormats) {
            for (const bool mips : {false, true}) {
                const FetexFile file = file_of(pinchmap_of(mask_of({".......", "##.....", "##.....", "##....."}),
                                                           {.scale = static_cast<std::uint32_t>(seed % 3),
                                                            .map_format = format,
                                                            .sample_format = samples,
                                                            .signal = KnownSignal::Random,
                                                            .gamma_from = -0.9,
                                                            .gamma_to = 0.9,
                                                            .least_strength = seed % 2 == 0 ? 0.5 : 1.0,
                                                            .mips = mips,
                                                            .seed = ++seed}));
                const Bytes bytes = write_file(file);
                FetexFile back;
                const auto finding = read_file(back, bytes);
                ASSERT_FALSE(finding.has_value()) << finding->message;
                ASSERT_TRUE(back.pinchmap.has_value() && !back.fbt.has_value() && !back.silmap.has_value());
                expect_same(*back.pinchmap, *file.pinchmap);
                EXPECT_EQ(write_file(back), bytes);
            }
        }
    }
}

TEST(PinchmapFile, standsBesideOtherRepresentations) {
    FetexFile file = file_of(full_texture()), back;
    file.fbt = fetexc::test::random_fbt(21, {.width = 3, .height = 2, .mips = true});
    file.bilevel = fetexc::test::random_bilevel(1, {.mips = true});
    file.silmap = fetexc::test::random_silmap(1, {.mips = true});
    const Bytes bytes = write_file(file);
    ASSERT_FALSE(read_file(back, bytes).has_value());
    ASSERT_TRUE(back.fbt.has_value() && back.bilevel.has_value() && back.silmap.has_value() &&
                back.pinchmap.has_value());
    EXPECT_EQ(back.silmap->cells, file.silmap->cells);
    expect_same(*back.pinchmap, *file.pinchmap);
}

/// Alone its chunks are critical; beside others a reader without them has those to show.
TEST(PinchmapFile, marksChunksCriticalWhereNothingElseCanBeShown) {
    for (const int beside : {0, 1, 2, 3}) {
        FetexFile file = file_of(full_texture());
        if (beside == 1) file.fbt = fetexc::test::random_fbt(21);
        if (beside == 2) file.bilevel = fetexc::test::random_bilevel(1);
        if (beside == 3) file.silmap = fetexc::test::random_silmap(1);
        const Bytes bytes = write_file(file);
        ContainerView container;
        ASSERT_FALSE(read_container(container, bytes).has_value());
        std::size_t seen = 0;
        for (const ChunkView& chunk : container.chunks) {
            const std::string type = fourcc_text(chunk.type);
            if (type.substr(0, 3) != "PNC") continue;
            ++seen;
            EXPECT_EQ(chunk.representation, 3);
            EXPECT_EQ(chunk.offset % kChunkAlignment, 0u);
            EXPECT_EQ(chunk.flags, beside == 0 && type != "PNCM" ? kChunkCritical : 0) << type;
        }
        EXPECT_EQ(seen, 6u);
    }
}

/// SPEC.md §2.6, byte by byte: two clusters of one sample each, a line between them of strength 64/127.
TEST(PinchmapFile, hasTheBytesOfTheSpecification) {
    PinchmapTexture t;
    t.width = 2, t.height = 1, t.sample_format = PinchmapSampleFormat::Rgb8;
    t.line_color = 0x80402010, t.line_width = 0x1234;
    t.map = {0x7f007f7f, 0x807f7fbf, 0x7ffe7f7f, 0x7f007f7f, 0x807f7fbf, 0x7ffe7f7f};
    t.signal = {0xff030201, 0xff060504};
    t.mips = {0xff090807};
    ASSERT_TRUE(validate_pinchmap(t).empty());
    const Bytes bytes = write_file(file_of(t));
    ContainerView container;
    ASSERT_FALSE(read_container(container, bytes).has_value());
    ASSERT_EQ(container.chunks.size(), 5u);
    const auto payload = [&](std::size_t k) {
        return Bytes(container.chunks[k].payload.begin(), container.chunks[k].payload.end());
    };
    EXPECT_EQ(payload(1),
              (Bytes{2,    0,    0,    0,    1,    0,    0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 3, 0, 0, 0,
                     0x10, 0x20, 0x40, 0x80, 0x34, 0x12, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(payload(2), (Bytes{127, 127, 0, 127, 191, 127, 127, 128, 127, 127, 254, 127,
                                 127, 127, 0, 127, 191, 127, 127, 128, 127, 127, 254, 127}));
    EXPECT_EQ(payload(3), (Bytes{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(payload(4), (Bytes{7, 8, 9, 255}));
    EXPECT_EQ(container.chunks[4].level, 1);
}

TEST(PinchmapReader, refusesTruncationAtEveryLengthAndACorruptByteAnywhere) {
    const Bytes good = write_file(file_of(full_texture()));
    for (std::size_t k = 0; k < good.size(); ++k) {
        EXPECT_NE(code_of(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(k))), FindingCode{}) << k;
        Bytes bytes = good;
        bytes[k] ^= 0x11;
        EXPECT_NE(code_of(bytes), FindingCode{}) << k;
    }
}

/// What is hostile is found or harmless: with good checksums every byte of the file's chunks, one at a time.
TEST(PinchmapReader, takesOnlyWhatCanBeSampled) {
    for (const PinchmapSampleFormat samples : kPinchmapSampleFormats) {
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
                EXPECT_TRUE(validate_pinchmap(*file.pinchmap).empty());
                const FbtColor color = pinchmap_sample_mip(*file.pinchmap, 2.2, 1.1, {1.5, 0.2});
                EXPECT_LE(color.a, 1 + 1e-12);
            }
        }
        EXPECT_GT(taken, 300u); // a byte as it was, another gamma or colour
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

TEST(PinchmapReader, refusesHostileHeaders) {
    for (const std::uint32_t bad : {0u, 16385u, 0xffffffffu}) {
        EXPECT_EQ(with_word(0, bad), FindingCode::BadPinchmapHeader);
        EXPECT_EQ(with_word(1, bad), FindingCode::BadPinchmapHeader);
    }
    for (const std::uint32_t bad : {15u, 32u, 0xffffffffu})
        EXPECT_EQ(with_word(2, bad), FindingCode::BadPinchmapHeader);
    EXPECT_EQ(with_word(2, 12), FindingCode::BadPinchmapHeader); // 5·2^12 samples
    EXPECT_EQ(with_word(3, 2), FindingCode::BadPinchmapHeader);
    EXPECT_EQ(with_word(4, 4), FindingCode::BadPinchmapHeader);
    EXPECT_EQ(with_word(5, 4), FindingCode::BadPinchmapHeader);
    EXPECT_EQ(with_word(5, 0), FindingCode::BadPinchmapHeader); // there is a line
    EXPECT_EQ(with_word(5, 3), FindingCode::BadPinchmapHeader); // every strength is 1
    EXPECT_EQ(with_word(6, 0x01000002), FindingCode::PinchmapNotPremultiplied);
    EXPECT_EQ(with_word(7, 65537), FindingCode::BadPinchmapHeader);
    EXPECT_EQ(with_word(7, 0), FindingCode::BadPinchmapHeader);
    for (std::size_t word = 8; word < 12; ++word)
        EXPECT_EQ(with_word(word, 1), FindingCode::BadPinchmapHeader);
    EXPECT_EQ(with_word(0, 8192), FindingCode::PinchmapSizeMismatch); // and doesn't allocate it
    EXPECT_EQ(with_word(2, 0), FindingCode::PinchmapSizeMismatch);
    EXPECT_EQ(with_word(3, 1), FindingCode::PinchmapSizeMismatch);
    EXPECT_EQ(with_word(4, 1), FindingCode::PinchmapSizeMismatch);
    EXPECT_EQ(with_word(4, 3), FindingCode::PinchmapSizeMismatch);
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

constexpr std::size_t kHeader = 1, kMap = 2, kSignal = 3, kLevel1 = 4, kLevel2 = 5,
                      kLevel3 = 6; ///< as write_file orders them

FindingCode without(std::size_t k) {
    return with_chunks([&](std::vector<Chunk>& c) { c.erase(c.begin() + static_cast<std::ptrdiff_t>(k)); });
}

FindingCode with_length(std::size_t k, int by) {
    return with_chunks([&](std::vector<Chunk>& c) { c[k].payload.resize(c[k].payload.size() + by); });
}

TEST(PinchmapReader, wantsAllChunksAndNoOthers) {
    using Chunks = std::vector<Chunk>;
    EXPECT_EQ(with_chunks([](Chunks&) {}), FindingCode{});
    EXPECT_EQ(with_chunks([](Chunks& c) { std::swap(c[kLevel1], c[kHeader]); }), FindingCode{}); // in any order
    for (const std::size_t k : {kHeader, kMap, kSignal, kLevel1, kLevel2, kLevel3})
        EXPECT_EQ(without(k), FindingCode::MissingChunk) << k;
    EXPECT_EQ(with_chunks([](Chunks& c) { c.resize(kLevel1); }), FindingCode{}); // no levels at all
    EXPECT_EQ(with_chunks([](Chunks& c) { c[kLevel3].level = 4; }), FindingCode::MissingChunk);
    EXPECT_EQ(with_chunks([](Chunks& c) { c[kLevel1].level = 0; }), FindingCode::MissingChunk);
    EXPECT_EQ(with_chunks([](Chunks& c) { c[kMap].level = 1; }), FindingCode::UnknownCriticalChunk);
    EXPECT_EQ(with_chunks([](Chunks& c) { c[kSignal].representation = 9; }), FindingCode::MissingChunk);
    EXPECT_EQ(with_chunks([](Chunks& c) { c[kHeader].representation = kWholeFile; }),
              FindingCode::UnknownCriticalChunk);
}

TEST(PinchmapReader, wantsEveryLengthToBeRight) {
    for (const int by : {-1, 1}) {
        EXPECT_EQ(with_length(kHeader, by), FindingCode::BadPinchmapHeader);
        for (const std::size_t k : {kMap, kSignal, kLevel1, kLevel2, kLevel3})
            EXPECT_EQ(with_length(k, by), FindingCode::PinchmapSizeMismatch) << k;
    }
    EXPECT_EQ(with_length(kHeader, 4), FindingCode::BadPinchmapHeader);
}

TEST(PinchmapReader, refusesOneNumberForTwoKinds) {
    for (const FourCc other : {fourcc("FBTH"), fourcc("BLVH"), fourcc("SLMH")})
        EXPECT_EQ(with_chunks([&](std::vector<Chunk>& c) {
                      c.push_back({other, 0, 3, 0, {}});
                  }),
                  FindingCode::RepresentationKinds);
}

TEST(PinchmapReader, showsTheLowestNumber) {
    PinchmapTexture second = full_texture();
    second.signal[0] = 0;
    const Bytes other = write_file(file_of(second));
    EXPECT_EQ(with_chunks([&](std::vector<Chunk>& chunks) {
                  ContainerView container;
                  EXPECT_FALSE(read_container(container, other).has_value());
                  for (const ChunkView& c : container.chunks)
                      if (c.representation == 3)
                          chunks.push_back({c.type, c.flags, 0, c.level, {c.payload.begin(), c.payload.end()}});
                  FetexFile file;
                  EXPECT_FALSE(read_file(file, write_container(chunks)).has_value());
                  EXPECT_EQ(file.pinchmap->signal[0], 0u);
              }),
              FindingCode{});
}

TEST(PinchmapValidator, countsOffsetsFromTheStartOfTheFile) {
    Bytes bytes = write_file(file_of(full_texture()));
    ContainerView container;
    ASSERT_FALSE(read_container(container, bytes).has_value());
    const auto offset = [&](std::size_t k) { return static_cast<std::size_t>(container.chunks[k].offset); };
    store(bytes, offset(kMap) + 4 * 7 + 3, 0, 1); // gamma of -1
    store(bytes, offset(kSignal) + 16, 0x01000002, 4);
    store(bytes, offset(kLevel1) + 4, 0x01000200, 4);
    store(bytes, offset(kLevel2), 0x01030000, 4);
    reseal(bytes);
    const auto findings = validate_file(bytes);
    ASSERT_EQ(findings.size(), 4u);
    EXPECT_EQ(findings[0].offset, offset(kMap) + 4 * 7);
    EXPECT_EQ(finding_id(findings[0].code), "F4005");
    EXPECT_NE(findings[0].message.find("(1,1)"), std::string::npos);
    EXPECT_EQ(findings[1].offset, offset(kSignal) + 16);
    EXPECT_EQ(findings[2].offset, offset(kLevel1) + 4);
    EXPECT_EQ(findings[3].offset, offset(kLevel2));
    EXPECT_EQ(finding_id(findings[1].code), "F4003");
    EXPECT_EQ(validate_file(bytes, 2).size(), 2u);
}

struct Fault {
    const char* what;
    FindingCode expected;
    PinchmapSampleFormat format;
    std::function<void(PinchmapTexture&)> make;
};

TEST(PinchmapValidator, findsEachKindOfFault) {
    using C = FindingCode;
    using T = PinchmapTexture;
    using F = PinchmapSampleFormat;
    const Fault faults[] = {
        {"no width", C::PinchmapDimensions, F::Rgba8, [](T& t) { t.width = 0; }},
        {"too high", C::PinchmapDimensions, F::Rgba8, [](T& t) { t.height = 8193; }},
        {"too fine", C::PinchmapDimensions, F::Rgba8, [](T& t) { t.scale = 40; }},
        {"a map texel short", C::PinchmapDimensions, F::Rgba8, [](T& t) { t.map.pop_back(); }},
        {"a sample short", C::PinchmapDimensions, F::Rgba8, [](T& t) { t.signal.pop_back(); }},
        {"half a sample short", C::PinchmapDimensions, F::Rgba16, [](T& t) { t.signal.pop_back(); }},
        {"a level short", C::PinchmapDimensions, F::Rgba8, [](T& t) { t.mips.pop_back(); }},
        {"no map format", C::PinchmapFormat, F::Rgba8, [](T& t) { t.map_format = PinchmapFormat(2); }},
        {"no sample format", C::PinchmapFormat, F::Rgba8, [](T& t) { t.sample_format = F(4); }},
        {"a wide line", C::PinchmapFormat, F::Rgba8, [](T& t) { t.line_width = 65537; }},
        {"a bright line", C::PinchmapNotPremultiplied, F::Rgba8, [](T& t) { t.line_color = 0x7f000080; }},
        {"brighter than alpha", C::PinchmapNotPremultiplied, F::Rgba8, [](T& t) { t.signal.back() = 0x7f000080; }},
        {"of 16 bits", C::PinchmapNotPremultiplied, F::Rgba16, [](T& t) { t.signal.back() = 0x7fff8000; }},
        {"light without alpha", C::PinchmapNotPremultiplied, F::Rgba16F, [](T& t) { t.signal.back() = 1; }},
        {"a negative half", C::PinchmapSampleValue, F::Rgba16F, [](T& t) { t.signal.back() = 0x3c008001; }},
        {"alpha above 1", C::PinchmapSampleValue, F::Rgba16F, [](T& t) { t.signal.back() = 0x3c010000; }},
        {"not opaque", C::PinchmapSampleValue, F::Rgb8, [](T& t) { t.signal.back() = 0xfe000000; }},
        {"in a level", C::PinchmapNotPremultiplied, F::Rgba16F, [](T& t) { t.mips.back() = 0x7f000080; }},
        // The line goes down at corner 2 of rows 0 and 1, turns at (2,2) and leaves at row 2.
        {"a step beyond 1", C::PinchmapValue, F::Rgba8, [](T& t) { t.map[2] = 0x7f7f7fff; }},
        {"gamma of 1", C::PinchmapValue, F::Rgba8, [](T& t) { t.map[2] = 0xfe7f7ffe; }},
        {"a k between", C::PinchmapValue, F::Rgba8, [](T& t) { t.map[0] = 0x7f307f7f; }},
        {"a direction at rest", C::PinchmapValue, F::Rgba8, [](T& t) { t.map[0] = 0x7f00807f; }},
        {"an open cluster", C::PinchmapCluster, F::Rgba8, [](T& t) { t.map[8] = 0x7f007f7f; }},
        {"an island", C::PinchmapDirection, F::Rgba8, [](T& t) { t.map[23] = 0x7f7f7f7f; }},
        {"backwards", C::PinchmapDirection, F::Rgba8, [](T& t) { t.map[2] = 0x7f7f7f00; }},
        {"along the line", C::PinchmapDirection, F::Rgba8, [](T& t) { t.map[2] = 0x7f7ffe7f; }},
        {"a skew turn", C::PinchmapDirection, F::Rgba8, [](T& t) { t.map[14] = 0x7f7f40fe; }},
    };
    for (const PinchmapSampleFormat format : kPinchmapSampleFormats)
        EXPECT_TRUE(validate_pinchmap(full_texture(format)).empty());
    for (const Fault& fault : faults) {
        PinchmapTexture texture = full_texture(fault.format);
        fault.make(texture);
        const auto findings = validate_pinchmap(texture);
        ASSERT_GE(findings.size(), 1u) << fault.what;
        for (const Finding& finding : findings)
            EXPECT_EQ(finding_id(finding.code), finding_id(fault.expected)) << fault.what << ": " << finding.message;
    }
}

} // namespace
} // namespace fetex
