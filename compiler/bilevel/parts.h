// SPDX-License-Identifier: GPL-3.0-or-later
/// Connected parts of above and of below, along scan lines: those that a texture lost or invented.
#pragma once

#include <cstdint>

#include "compiler/bilevel/silhouette.h"
#include "formats/bilevel.h"

namespace fetexc {

struct PartCounts {
    std::uint64_t parts = 0;               ///< of the silhouette
    std::uint64_t lost = 0;                ///< nothing of them is right in the texture
    std::uint64_t invented = 0;            ///< parts of the texture of which nothing is right
    double lost_u = 0, lost_v = 0;         ///< 0…1 of the canvas: a point of the first that is lost
    double invented_u = 0, invented_v = 0; ///< of the first that is invented
};

/// Parts are exact along `per_texel` rows a texel. The silhouette's are followed along its outline from row to row, and
/// each closed piece of it that no row meets is a part that is lost. The texture's are followed where they overlap in
/// neighbouring rows; what shows in one row alone is looked at closer, along 257 rows a texel. With an odd number of
/// rows one goes through each texel's centre, so no invented part of one channel is missed: its values are largest, or
/// least, at a centre.
PartCounts count_parts(const Silhouette& silhouette, const fetex::BilevelTexture& texture, std::uint32_t per_texel,
                       unsigned threads);

} // namespace fetexc
