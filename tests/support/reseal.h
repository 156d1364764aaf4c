// SPDX-License-Identifier: GPL-3.0-or-later
/// Files with wrong content and right checksums: hostile bytes rather than damaged ones.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "formats/bytes.h"
#include "formats/crc32c.h"

namespace fetexc::test {

/// Little-endian, `size` bytes of it.
inline void store(std::vector<std::uint8_t>& bytes, std::size_t at, std::uint64_t value, std::size_t size) {
    for (std::size_t k = 0; k < size; ++k)
        bytes[at + k] = static_cast<std::uint8_t>(value >> (8 * k));
}

/// Makes the checksums right again after a change to header, table or chunks. At least the 32 bytes of the header.
inline void reseal(std::vector<std::uint8_t>& bytes) {
    const fetex::ByteSpan all(bytes);
    const std::uint32_t count =
        std::min(fetex::load_le<std::uint32_t>(all, 12), static_cast<std::uint32_t>(bytes.size() / 32 - 1));
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::size_t entry = 32 + 32 * std::size_t{k};
        const auto offset = fetex::load_le<std::uint64_t>(all, entry + 8),
                   size = fetex::load_le<std::uint64_t>(all, entry + 16);
        if (offset <= bytes.size() && size <= bytes.size() - offset)
            store(bytes, entry + 24, fetex::crc32c(all.subspan(offset, size)), 4);
    }
    store(bytes, 24, fetex::crc32c(all.subspan(32, 32 * std::size_t{count})), 4);
    store(bytes, 28, fetex::crc32c(all.first(28)), 4);
}

} // namespace fetexc::test
