// SPDX-License-Identifier: GPL-3.0-or-later
/// Files with a texture of one representation, whole and damaged. What differs between representations is a `Traits`:
///
///     using Texture, Samples;               the texture, and what its samples may be
///     kMember                               where a FetexFile has it
///     kNumber, kPrefix                      as write_file numbers it; the first letters of its chunks
///     kLevel1, kLastLevel                   chunks of its levels in write_file's order; META is 0, its header 1
///     kBadHeader, kSizeMismatch             what is said of headers and of lengths
///     kOneFinding                           whether a fault of the texture is found at one place only
///     full(Samples = {}), other()           textures with levels, all chunks and at least 5×3 texels; unlike each
///     other several(), damaged()                  valid ones of all kinds; those whose bytes are damaged one by one
///     expect_same(a, b), validate(t)        field by field; validate_<representation>
///     sample(t)                             a colour that its levels have a part in
///     hostile_header(), spoilt(), faults()  HostileWord, SpoiltWord, Fault<Traits>: what is refused
///
/// The tests of all are in tests/support/representation_file_tests.h.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "formats/fetex_file.h"
#include "tests/support/reseal.h"

namespace fetex {
/// For messages of tests.
inline void PrintTo(FindingCode code, std::ostream* out) { *out << finding_id(code); }
} // namespace fetex

namespace fetexc::test {

using Bytes = std::vector<std::uint8_t>;
using Chunks = std::vector<fetex::Chunk>;

/// Values that a word of the header of full() may not have.
struct HostileWord {
    std::size_t word;
    std::vector<std::uint32_t> values;
    fetex::FindingCode expected;
};

/// A wrong value in the file of full(). The finding is at the multiple of 4 bytes at or before it.
struct SpoiltWord {
    std::size_t chunk, at; ///< in write_file's order; bytes from the start of its payload
    std::uint32_t value;
    std::string id, message = {}; ///< of the finding; something that the message has in it
    std::size_t bytes = 4;
};

/// A change that makes full(samples) invalid.
template <class Traits> struct Fault {
    const char* what;
    fetex::FindingCode expected;
    std::function<void(typename Traits::Texture&)> make;
    typename Traits::Samples samples = {};
};

/// All representations, each with levels.
fetex::FetexFile file_of_all_representations();
/// How many representations the file has.
std::size_t representations_in(const fetex::FetexFile& file);

/// Preconditions: read_container takes the bytes; there is such a chunk.
Chunks chunks_of(const Bytes& bytes);
std::size_t payload_offset(const Bytes& bytes, std::size_t chunk);

template <class Traits> fetex::FetexFile file_of(typename Traits::Texture texture) {
    fetex::FetexFile file;
    file.metadata = {{"k", "v"}};
    file.*Traits::kMember = std::move(texture);
    return file;
}

/// What read_file refuses the bytes for, FindingCode{} if it takes them.
template <class Traits> fetex::FindingCode code_of(const Bytes& bytes) {
    fetex::FetexFile file;
    const auto finding = fetex::read_file(file, bytes);
    EXPECT_EQ(finding.has_value(), !fetex::validate_file(bytes).empty());
    EXPECT_FALSE(finding.has_value() && (file.*Traits::kMember).has_value());
    return finding ? finding->code : fetex::FindingCode{};
}

/// code_of the texture's file with another word in its header.
template <class Traits>
fetex::FindingCode with_word(const typename Traits::Texture& texture, std::size_t word, std::uint32_t value) {
    Bytes bytes = fetex::write_file(file_of<Traits>(texture));
    store(bytes, payload_offset(bytes, 1) + 4 * word, value, 4);
    reseal(bytes);
    return code_of<Traits>(bytes);
}

/// code_of the texture's file with its chunks changed.
template <class Traits>
fetex::FindingCode with_chunks(const typename Traits::Texture& texture, const std::function<void(Chunks&)>& change) {
    Chunks chunks = chunks_of(fetex::write_file(file_of<Traits>(texture)));
    change(chunks);
    return code_of<Traits>(fetex::write_container(chunks));
}

} // namespace fetexc::test
