// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The chunks of a bi-level texture (SPEC.md §2.4). Internal to fetex_file.cpp.
#pragma once

#include <deque>
#include <map>

#include "formats/bilevel.h"
#include "formats/container.h"

namespace fetex {

/// Payloads that aren't anywhere else as the file has them.
using Payloads = std::deque<std::vector<std::uint8_t>>;

/// Words as the file has them, copied only where memory has another order.
inline ByteSpan as_bytes(std::span<const std::uint32_t> words, Payloads& payloads) {
    if constexpr (std::endian::native == std::endian::little)
        return {reinterpret_cast<const std::uint8_t*>(words.data()), words.size() * 4};
    return payloads.emplace_back(to_bytes(words));
}

struct BilevelChunks {
    const ChunkView* header = nullptr;
    const ChunkView* texels = nullptr;
    const ChunkView* image = nullptr;
    std::map<std::uint8_t, const ChunkView*> mips; ///< by level

    /// Precondition: is_bilevel_chunk.
    void add(const ChunkView& chunk);
};

/// Whether this reader knows the chunk as part of a bi-level texture, by type, representation and level.
bool is_bilevel_chunk(const ChunkView& chunk);

/// critical: there is nothing else in the file that a reader could show instead.
void append_bilevel_chunks(std::vector<ChunkView>& chunks, const BilevelTexture& texture, std::uint8_t representation,
                           bool critical, Payloads& payloads);

/// Up to `limit` findings, with offsets from the start of the file; `out` is complete if there are none. Preconditions:
/// header and texels are there, limit ≥ 1.
std::vector<Finding> read_bilevel(BilevelTexture& out, const BilevelChunks& chunks, std::size_t limit);

} // namespace fetex
