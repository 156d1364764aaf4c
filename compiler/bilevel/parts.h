// SPDX-License-Identifier: GPL-3.0-or-later
/// Islands that a texture lost or invented.
#pragma once

#include <cstdint>

#include "compiler/bilevel/silhouette.h"
#include "formats/bilevel.h"

namespace fetexc {

/// Connected parts of above and of below (4 neighbours), seen at four points a texel along each side (fewer in textures
/// of more than 2^22 texels).
struct PartCounts {
    std::uint64_t parts = 0;    ///< of the silhouette
    std::uint64_t lost = 0;     ///< no point of them is right in the texture
    std::uint64_t invented = 0; ///< parts of the texture of which no point is right
};

PartCounts count_parts(const Silhouette& silhouette, const fetex::BilevelTexture& texture, unsigned threads);

} // namespace fetexc
