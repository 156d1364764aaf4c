// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The .fetex container: a header, a table of chunks, the chunks. Byte layout: SPEC.md §1. Knows nothing of what the
/// chunks mean; formats/fetex_file.h does.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/bytes.h"
#include "formats/findings.h"

namespace fetex {

inline constexpr std::uint16_t kVersionMajor = 2, kVersionMinor = 0;
inline constexpr std::size_t kHeaderBytes = 32, kChunkEntryBytes = 32, kChunkAlignment = 16;
inline constexpr std::uint32_t kMaxChunks = 4096;
inline constexpr std::uint16_t kChunkCritical = 1; ///< a reader that doesn't know the chunk must refuse the file

/// Four characters of A–Z and 0–9, the first in the lowest byte.
using FourCc = std::uint32_t;
constexpr FourCc fourcc(const char (&text)[5]) {
    FourCc code = 0;
    for (int k = 0; k < 4; ++k)
        code |= static_cast<FourCc>(static_cast<unsigned char>(text[k])) << (8 * k);
    return code;
}
std::string fourcc_text(FourCc code);

/// A chunk to write. representation: 0 … 254 numbers the representations in a file, kWholeFile belongs to all.
inline constexpr std::uint8_t kWholeFile = 255;
struct Chunk {
    FourCc type = 0;
    std::uint16_t flags = 0;
    std::uint8_t representation = kWholeFile;
    std::uint8_t level = 0; ///< mip level
    std::vector<std::uint8_t> payload;
};

/// A chunk as read: payload points into the file's bytes. Or one to write whose payload is elsewhere.
struct ChunkView {
    FourCc type = 0;
    std::uint16_t flags = 0;
    std::uint8_t representation = kWholeFile;
    std::uint8_t level = 0;
    std::uint64_t offset = 0; ///< of the payload, from the start of the file; writing ignores it
    ByteSpan payload;
};

struct ContainerView {
    std::uint16_t version_major = 0, version_minor = 0;
    std::vector<ChunkView> chunks; ///< in file order
};

/// The file's bytes; the same input always gives the same bytes. Preconditions: at most kMaxChunks chunks, fourccs of
/// A–Z and 0–9, no two chunks with the same type, representation and level (the reader would refuse the result).
std::vector<std::uint8_t> write_container(const std::vector<Chunk>& chunks);
std::vector<std::uint8_t> write_container_of_views(std::span<const ChunkView> chunks);

/// Checks every byte of the container (not what chunks mean). nullopt: out is complete and points into bytes. Safe on
/// untrusted input: allocates at most one ChunkView per 32 bytes of input, never throws but for that allocation.
std::optional<Finding> read_container(ContainerView& out, ByteSpan bytes);

} // namespace fetex
