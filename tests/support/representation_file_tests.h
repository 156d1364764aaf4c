// SPDX-License-Identifier: GPL-3.0-or-later
/// What holds of every representation in files: what is written is read back; what is damaged or hostile is refused by
/// its number. A test program gives the Traits of tests/support/representation_file.h and has them instantiated:
/// INSTANTIATE_TYPED_TEST_SUITE_P(Silmap, RepresentationFile, SilmapTraits).
#pragma once

#include "tests/support/representation_file.h"

namespace fetexc::test {

template <class Traits> class RepresentationFile : public testing::Test {};
TYPED_TEST_SUITE_P(RepresentationFile);

inline constexpr std::size_t kHeaderChunk = 1; ///< META is 0

TYPED_TEST_P(RepresentationFile, readsWhatWasWritten) {
    for (const auto& texture : TypeParam::several()) {
        ASSERT_TRUE(TypeParam::validate(texture).empty()) << TypeParam::validate(texture)[0].message;
        const Bytes bytes = fetex::write_file(file_of<TypeParam>(texture));
        fetex::FetexFile back;
        const auto finding = fetex::read_file(back, bytes);
        ASSERT_FALSE(finding.has_value()) << finding->message;
        ASSERT_TRUE((back.*TypeParam::kMember).has_value());
        EXPECT_EQ(representations_in(back), 1u);
        TypeParam::expect_same(*(back.*TypeParam::kMember), texture);
        EXPECT_EQ(fetex::write_file(back), bytes);
    }
}

TYPED_TEST_P(RepresentationFile, standsBesideAllOthers) {
    fetex::FetexFile file = file_of_all_representations(), back;
    file.*TypeParam::kMember = TypeParam::full();
    const Bytes bytes = fetex::write_file(file);
    ASSERT_FALSE(fetex::read_file(back, bytes).has_value());
    ASSERT_EQ(representations_in(back), 5u);
    TypeParam::expect_same(*(back.*TypeParam::kMember), *(file.*TypeParam::kMember));
    EXPECT_EQ(back.fbt->records, file.fbt->records);
    EXPECT_EQ(back.bilevel->texels, file.bilevel->texels);
    EXPECT_EQ(back.silmap->cells, file.silmap->cells);
    EXPECT_EQ(back.pinchmap->map, file.pinchmap->map);
    EXPECT_EQ(back.feature_curves->configurations, file.feature_curves->configurations);
    EXPECT_EQ(fetex::write_file(back), bytes);
}

/// Critical are the chunks of the first alone; beside it a reader without the others has that to show.
TYPED_TEST_P(RepresentationFile, marksChunksCriticalWhereNothingElseCanBeShown) {
    const fetex::FetexFile all = file_of_all_representations();
    for (int beside = -1; beside < 5; ++beside) { // by number
        fetex::FetexFile file, back;
        if (beside == 0) file.fbt = all.fbt;
        if (beside == 1) file.bilevel = all.bilevel;
        if (beside == 2) file.silmap = all.silmap;
        if (beside == 3) file.pinchmap = all.pinchmap;
        if (beside == 4) file.feature_curves = all.feature_curves;
        file.*TypeParam::kMember = TypeParam::full();
        const bool first = beside == -1 || beside >= TypeParam::kNumber;
        const Bytes bytes = fetex::write_file(file);
        ASSERT_FALSE(fetex::read_file(back, bytes).has_value());
        TypeParam::expect_same(*(back.*TypeParam::kMember), TypeParam::full());
        fetex::ContainerView container;
        ASSERT_FALSE(fetex::read_container(container, bytes).has_value());
        std::size_t seen = 0;
        for (const fetex::ChunkView& chunk : container.chunks) {
            const std::string type = fetex::fourcc_text(chunk.type);
            if (!type.starts_with(TypeParam::kPrefix)) continue;
            ++seen;
            EXPECT_EQ(chunk.representation, TypeParam::kNumber);
            EXPECT_EQ(chunk.offset % fetex::kChunkAlignment, 0u);
            EXPECT_EQ(chunk.flags, first && type.back() != 'M' ? fetex::kChunkCritical : 0)
                << type << " beside " << beside;
        }
        EXPECT_EQ(seen, TypeParam::kLastLevel);
    }
}

TYPED_TEST_P(RepresentationFile, refusesTruncationAtEveryLengthAndACorruptByteAnywhere) {
    for (const auto& texture : TypeParam::damaged()) {
        const Bytes good = fetex::write_file(file_of<TypeParam>(texture));
        for (std::size_t k = 0; k < good.size(); ++k) {
            const Bytes start(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(k));
            EXPECT_NE(code_of<TypeParam>(start), fetex::FindingCode{}) << "byte " << k;
            Bytes bytes = good;
            bytes[k] ^= 0x11;
            EXPECT_NE(code_of<TypeParam>(bytes), fetex::FindingCode{}) << "byte " << k;
        }
    }
}

/// What is hostile is found or harmless: with good checksums every byte of the file's chunks, one at a time.
TYPED_TEST_P(RepresentationFile, takesOnlyWhatCanBeSampled) {
    for (const auto& texture : TypeParam::damaged()) {
        const Bytes good = fetex::write_file(file_of<TypeParam>(texture));
        std::size_t taken = 0, refused = 0;
        for (std::size_t at = payload_offset(good, kHeaderChunk); at < good.size(); ++at) {
            for (const int value : {0, 1, 2, 3, 4, 0x40, 0x7f, 0xff}) {
                Bytes bytes = good;
                bytes[at] = static_cast<std::uint8_t>(value);
                reseal(bytes);
                fetex::FetexFile file;
                if (fetex::read_file(file, bytes)) {
                    ++refused;
                    continue;
                }
                ++taken;
                EXPECT_TRUE(TypeParam::validate(*(file.*TypeParam::kMember)).empty());
                EXPECT_LE(TypeParam::sample(*(file.*TypeParam::kMember)).a, 1 + 1e-12) << at << ": " << value;
            }
        }
        EXPECT_GT(taken, 300u); // a byte as it was, another colour
        EXPECT_GT(refused, 200u);
    }
}

TYPED_TEST_P(RepresentationFile, refusesHostileHeaders) {
    for (const HostileWord& hostile : TypeParam::hostile_header())
        for (const std::uint32_t value : hostile.values)
            EXPECT_EQ(with_word<TypeParam>(TypeParam::full(), hostile.word, value), hostile.expected)
                << "word " << hostile.word << " is " << value;
}

TYPED_TEST_P(RepresentationFile, wantsAllChunksAndNoOthers) {
    using C = fetex::FindingCode;
    constexpr std::size_t kLevel1 = TypeParam::kLevel1, kLastLevel = TypeParam::kLastLevel;
    const auto code = [](const auto& change) { return with_chunks<TypeParam>(TypeParam::full(), change); };
    EXPECT_EQ(code([](Chunks& c) { EXPECT_EQ(c.size(), kLastLevel + 1); }), C{});
    EXPECT_EQ(code([](Chunks& c) { std::swap(c[kLevel1], c[kHeaderChunk]); }), C{}); // in any order
    EXPECT_EQ(code([](Chunks& c) { c.resize(kLevel1); }), C{});                      // no levels at all
    EXPECT_EQ(code([](Chunks& c) { ++c[kLastLevel].level; }), C::MissingChunk);
    EXPECT_EQ(code([](Chunks& c) { c[kLevel1].level = 0; }), C::MissingChunk);
    for (std::size_t k = kHeaderChunk; k <= kLastLevel; ++k)
        EXPECT_EQ(code([&](Chunks& c) { c.erase(c.begin() + static_cast<std::ptrdiff_t>(k)); }), C::MissingChunk)
            << "chunk " << k;
    for (std::size_t k = kHeaderChunk; k < kLevel1; ++k) {
        EXPECT_EQ(code([&](Chunks& c) { c[k].level = 1; }), C::UnknownCriticalChunk) << "chunk " << k;
        EXPECT_EQ(code([&](Chunks& c) { c[k].representation = 9; }), C::MissingChunk) << "chunk " << k;
        EXPECT_EQ(code([&](Chunks& c) { c[k].representation = fetex::kWholeFile; }), C::UnknownCriticalChunk)
            << "chunk " << k;
    }
}

TYPED_TEST_P(RepresentationFile, wantsEveryLengthToBeRight) {
    const auto with_length = [](std::size_t k, int by) {
        return with_chunks<TypeParam>(TypeParam::full(),
                                      [&](Chunks& c) { c[k].payload.resize(c[k].payload.size() + by); });
    };
    for (const int by : {-1, 1})
        for (std::size_t k = kHeaderChunk; k <= TypeParam::kLastLevel; ++k)
            EXPECT_EQ(with_length(k, by), k == kHeaderChunk ? TypeParam::kBadHeader : TypeParam::kSizeMismatch)
                << "chunk " << k;
    EXPECT_EQ(with_length(kHeaderChunk, 4), TypeParam::kBadHeader);
}

TYPED_TEST_P(RepresentationFile, refusesOneNumberForTwoKinds) {
    using fetex::fourcc;
    for (const fetex::FourCc other : {fourcc("FBTH"), fourcc("BLVH"), fourcc("SLMH"), fourcc("PNCH"), fourcc("FCVH")}) {
        const std::string name = fetex::fourcc_text(other);
        if (name.starts_with(TypeParam::kPrefix)) continue;
        const auto add = [&](Chunks& c) { c.push_back({other, 0, TypeParam::kNumber, 0, {}}); };
        EXPECT_EQ(with_chunks<TypeParam>(TypeParam::full(), add), fetex::FindingCode::RepresentationKinds) << name;
    }
}

TYPED_TEST_P(RepresentationFile, showsTheLowestNumber) {
    Chunks chunks = chunks_of(fetex::write_file(file_of<TypeParam>(TypeParam::full())));
    for (fetex::Chunk chunk : chunks_of(fetex::write_file(file_of<TypeParam>(TypeParam::other())))) {
        if (chunk.representation != TypeParam::kNumber) continue;
        chunk.representation = 0;
        chunks.push_back(std::move(chunk));
    }
    const Bytes bytes = fetex::write_container(chunks);
    EXPECT_EQ(code_of<TypeParam>(bytes), fetex::FindingCode{});
    fetex::FetexFile file;
    ASSERT_FALSE(fetex::read_file(file, bytes).has_value());
    TypeParam::expect_same(*(file.*TypeParam::kMember), TypeParam::other());
}

TYPED_TEST_P(RepresentationFile, countsOffsetsFromTheStartOfTheFile) {
    const Bytes good = fetex::write_file(file_of<TypeParam>(TypeParam::full()));
    const std::vector<SpoiltWord> spoilt = TypeParam::spoilt();
    Bytes bytes = good;
    for (const SpoiltWord& word : spoilt)
        store(bytes, payload_offset(good, word.chunk) + word.at, word.value, word.bytes);
    reseal(bytes);
    const auto findings = fetex::validate_file(bytes);
    ASSERT_EQ(findings.size(), spoilt.size());
    for (std::size_t k = 0; k < spoilt.size(); ++k) {
        EXPECT_EQ(findings[k].offset, payload_offset(good, spoilt[k].chunk) + spoilt[k].at / 4 * 4)
            << findings[k].message;
        EXPECT_EQ(fetex::finding_id(findings[k].code), spoilt[k].id) << findings[k].message;
        EXPECT_NE(findings[k].message.find(spoilt[k].message), std::string::npos) << findings[k].message;
    }
    EXPECT_EQ(fetex::validate_file(bytes, spoilt.size() - 1).size(), spoilt.size() - 1);
}

TYPED_TEST_P(RepresentationFile, findsEachKindOfFault) {
    for (const auto& texture : TypeParam::damaged())
        EXPECT_TRUE(TypeParam::validate(texture).empty());
    for (const Fault<TypeParam>& fault : TypeParam::faults()) {
        auto texture = TypeParam::full(fault.samples);
        fault.make(texture);
        const auto findings = TypeParam::validate(texture);
        ASSERT_GE(findings.size(), 1u) << fault.what;
        if (TypeParam::kOneFinding) {
            EXPECT_EQ(findings.size(), 1u) << fault.what;
        }
        for (const fetex::Finding& finding : findings)
            EXPECT_EQ(finding.code, fault.expected) << fault.what << ": " << finding.message;
    }
}

REGISTER_TYPED_TEST_SUITE_P(RepresentationFile, readsWhatWasWritten, standsBesideAllOthers,
                            marksChunksCriticalWhereNothingElseCanBeShown,
                            refusesTruncationAtEveryLengthAndACorruptByteAnywhere, takesOnlyWhatCanBeSampled,
                            refusesHostileHeaders, wantsAllChunksAndNoOthers, wantsEveryLengthToBeRight,
                            refusesOneNumberForTwoKinds, showsTheLowestNumber, countsOffsetsFromTheStartOfTheFile,
                            findsEachKindOfFault);

} // namespace fetexc::test
