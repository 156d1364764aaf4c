// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/zone_truth.h"

#include <algorithm>
#include <iterator>

#include "compiler/bilevel/coverage.h"
#include "compiler/bilevel/seed.h"

namespace fetexc {

/// The distances are those that fits begin with, finely stored.
ZoneTruth zone_truth(const Silhouette& silhouette, std::uint32_t width, std::uint32_t height) {
    constexpr std::uint16_t kSteps = 65534; // even: a corner on the outline has distance 0
    constexpr std::uint32_t kLines = 4;     // a cluster, to find those that the outline passes
    const std::vector<OutlineSegment> outline = outline_in_texels(silhouette, width, height);
    const ScannedOutline scanned(silhouette, outline, width, height, kLines);
    const ThresholdCells cells(scanned, width + 1, height + 1, fetex::BilevelRule::Single, TexelPlaces::Corners, {});
    const std::vector<std::uint16_t> stored =
        seed_stored(cells, scanned, outline, kFarFromOutline, 0, {kSteps, 0, kSteps, 1, {}});
    ZoneTruth out;
    out.parts = coverage(silhouette, width, height);
    std::ranges::transform(stored, std::back_inserter(out.distances),
                           [](std::uint16_t v) { return (2.0 * v / kSteps - 1) * kFarFromOutline; });
    return out;
}

} // namespace fetexc
