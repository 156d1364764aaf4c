// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The chunks of a texture with feature curves (SPEC.md §2.7). Internal to fetex_file.cpp.
#pragma once

#include <map>

#include "formats/bilevel_chunks.h"
#include "formats/container.h"
#include "formats/feature_curves.h"

namespace fetex {

struct FeatureCurvesChunks {
    std::map<FourCc, const ChunkView*> parts;      ///< of level 0, by type
    std::map<std::uint8_t, const ChunkView*> mips; ///< by level

    /// Precondition: is_feature_curves_chunk.
    void add(const ChunkView& chunk);
    /// All that there must be, but for gradients.
    [[nodiscard]] bool complete() const;
};

/// Whether this reader knows the chunk as part of a texture with feature curves, by type, representation and level.
bool is_feature_curves_chunk(const ChunkView& chunk);

/// critical: there is nothing else in the file that a reader could show instead.
void append_feature_curves_chunks(std::vector<ChunkView>& chunks, const FeatureCurvesTexture& texture,
                                  std::uint8_t representation, bool critical, Payloads& payloads);

/// Up to `limit` findings, with offsets from the start of the file; `out` is complete if there are none. Preconditions:
/// complete, limit ≥ 1.
std::vector<Finding> read_feature_curves(FeatureCurvesTexture& out, const FeatureCurvesChunks& chunks,
                                         std::size_t limit);

} // namespace fetex
