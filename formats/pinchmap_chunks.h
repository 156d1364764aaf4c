// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The chunks of a pinchmap (SPEC.md §2.6). Internal to fetex_file.cpp.
#pragma once

#include <map>

#include "formats/bilevel_chunks.h"
#include "formats/container.h"
#include "formats/pinchmap.h"

namespace fetex {

struct PinchmapChunks {
    const ChunkView* header = nullptr;
    const ChunkView* map = nullptr;
    const ChunkView* signal = nullptr;
    std::map<std::uint8_t, const ChunkView*> mips; ///< by level

    /// Precondition: is_pinchmap_chunk.
    void add(const ChunkView& chunk);
};

/// Whether this reader knows the chunk as part of a pinchmap, by type, representation and level.
bool is_pinchmap_chunk(const ChunkView& chunk);

/// critical: there is nothing else in the file that a reader could show instead.
void append_pinchmap_chunks(std::vector<ChunkView>& chunks, const PinchmapTexture& texture, std::uint8_t representation,
                            bool critical, Payloads& payloads);

/// Up to `limit` findings, with offsets from the start of the file; `out` is complete if there are none. Preconditions:
/// header, map and signal are there, limit ≥ 1.
std::vector<Finding> read_pinchmap(PinchmapTexture& out, const PinchmapChunks& chunks, std::size_t limit);

} // namespace fetex
