// SPDX-License-Identifier: GPL-3.0-or-later
/// Connected parts of above and of below, along scan lines: those that a texture lost or invented, and ways to have
/// fewer of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/bilevel/discrete_fit.h"
#include "compiler/bilevel/scan_lines.h"
#include "formats/bilevel.h"

namespace fetexc {

struct PartCounts {
    std::uint64_t parts = 0;       ///< of the silhouette
    std::uint64_t lost = 0;        ///< nothing of them is right in the texture
    std::uint64_t invented = 0;    ///< parts of the texture of which nothing is right
    double lost_x = 0, lost_y = 0; ///< texels: a point of the first that is lost
};

/// Parts are exact along `per_texel` rows a texel. The silhouette's are followed along its outline from row to row, and
/// each closed piece of it that no row meets is a part that is lost. The texture's are followed where they overlap in
/// neighbouring rows; what shows in one row alone is looked at closer, along 257 rows a texel. With an odd number of
/// rows one goes through each texel's centre, so no invented part of one channel is missed: its values are largest, or
/// least, at a centre.
PartCounts count_parts(const Silhouette& silhouette, const fetex::BilevelTexture& texture, std::uint32_t per_texel,
                       unsigned threads);

/// Changes single bytes so that fewer parts are invented, or more of those that are lost show, each by whichever change
/// gets the least area wrong if that is no more than budget::kWorthAPart. fine: for the areas. Returns the changes.
std::uint64_t mend_parts(const ThresholdCells& fine, const ScannedOutline& rows,
                         std::span<const OutlineSegment> outline, MidGreys greys, std::vector<std::uint8_t>& values);

} // namespace fetexc
