// SPDX-License-Identifier: GPL-3.0-or-later
/// FBTs put together by hand: entry lists and band directories of given content (formats/fbt.h).
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "formats/fbt.h"

namespace fetexc::test {

struct MadeRegion {
    std::uint32_t model = fetex::kFbtModelSolid, sample = 0;
};

/// One run of a feature; degree·pieces+1 packed points, or the word where those of another run begin.
struct MadeRun {
    std::uint32_t degree = 1, direction = 0, pieces = 0;
    std::vector<std::uint32_t> points;
    std::uint32_t shared_from = 0; ///< if there are no points
    bool last = true;              ///< run of its feature
    MadeRegion inside;             ///< of the last run
    std::uint32_t depth = 0;
};

/// Appends an entry list to the records; where it begins. first_words: of each run's points.
std::uint32_t append_list(std::vector<std::uint32_t>& records, const std::vector<MadeRun>& runs, MadeRegion rest,
                          std::vector<std::uint32_t>* first_words = nullptr);

/// Appends a directory of (quantised y_end, entry list).
std::uint32_t append_directory(std::vector<std::uint32_t>& records,
                               const std::vector<std::pair<std::uint32_t, std::uint32_t>>& bands);

/// Appends four samples, in words of any sample format.
std::uint32_t append_patch(std::vector<std::uint32_t>& records, const std::vector<std::uint32_t>& samples);
std::uint32_t append_patch(std::vector<std::uint32_t>& records, std::uint32_t c00, std::uint32_t c10, std::uint32_t c01,
                           std::uint32_t c11);

/// A solid texel of an opaque colour.
inline std::uint32_t solid_texel(std::uint32_t rgba8) { return (rgba8 & 0xffffffu) | fetex::kFbtOpaque; }
inline std::uint32_t shaded_texel(MadeRegion r) { return (fetex::kFbtKindShaded << 30) | (r.model << 28) | r.sample; }

} // namespace fetexc::test
