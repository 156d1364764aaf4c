// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The chunks of a silhouette-map texture (SPEC.md §2.5). Internal to fetex_file.cpp.
#pragma once

#include <map>

#include "formats/bilevel_chunks.h"
#include "formats/container.h"
#include "formats/silmap.h"

namespace fetex {

struct SilmapChunks {
    const ChunkView* header = nullptr;
    const ChunkView* cells = nullptr;
    const ChunkView* samples = nullptr;
    std::map<std::uint8_t, const ChunkView*> mips; ///< by level

    /// Precondition: is_silmap_chunk.
    void add(const ChunkView& chunk);
};

/// Whether this reader knows the chunk as part of a silhouette-map texture, by type, representation and level.
bool is_silmap_chunk(const ChunkView& chunk);

/// critical: there is nothing else in the file that a reader could show instead.
void append_silmap_chunks(std::vector<ChunkView>& chunks, const SilmapTexture& texture, std::uint8_t representation,
                          bool critical, Payloads& payloads);

/// Up to `limit` findings, with offsets from the start of the file; `out` is complete if there are none. Preconditions:
/// header, cells and samples are there, limit ≥ 1.
std::vector<Finding> read_silmap(SilmapTexture& out, const SilmapChunks& chunks, std::size_t limit);

} // namespace fetex
