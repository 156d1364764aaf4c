// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The samples of a bitmap beside which a map lies, in the formats of silhouette-map textures: as the file has them,
/// and whether they are colours. Internal to formats/.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "formats/bytes.h"
#include "formats/fbt_samples.h"
#include "formats/silmap.h"

namespace fetex {

/// Of a sample in the file.
inline std::size_t bitmap_sample_bytes(SilmapSampleFormat format) {
    return format == SilmapSampleFormat::Rgb8 ? 3 : 4 * fbt_sample_words(silmap_fbt_format(format));
}

/// RGB8 as the file has it, and back.
std::vector<std::uint8_t> without_alpha(std::span<const std::uint32_t> samples);
std::vector<std::uint32_t> with_alpha(ByteSpan bytes);

enum class SampleFault : std::uint8_t {
    None,
    NotPremultiplied, ///< a colour channel exceeds alpha; of halves a colour where alpha is 0
    Value,            ///< a half that is negative, infinite or no number, an alpha above 1, or less than 1 in RGB8
};
SampleFault bitmap_sample_fault(const std::uint32_t* words, SilmapSampleFormat format);
/// What is wrong, to follow the name of a part.
const char* sample_fault_text(SampleFault fault);

} // namespace fetex
