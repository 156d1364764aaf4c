// SPDX-License-Identifier: GPL-3.0-or-later
/// The search by which the paper finds a pinchmap's gamma (Tarini and Cignoni 2005, §7.2 step 4): what ours must beat.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/pinchmap.h"

namespace fetexc::test {

/// A drawing in pixels, `pixels` along a cluster's sides.
struct PixelZones {
    std::uint32_t width = 0, height = 0; ///< clusters
    std::uint32_t pixels = 0;
    std::vector<std::uint8_t> above; ///< width·pixels × height·pixels
};

struct AnnealingResult {
    std::uint64_t wrong = 0;    ///< pixels on the wrong side
    std::uint64_t at_first = 0; ///< after every texel alone
    std::uint64_t rounds = 0;   ///< places tried
    double seconds = 0;         ///< of the processor
};

/// That this process has used: a busy machine doesn't change what a search gets.
double processor_seconds();

/// Each γ of a texel near a discontinuity goes up and down by ever smaller steps while that makes more pixels match;
/// then, for so many seconds of the processor, 2 × 2 of them at a random place are perturbed and 4 × 4 searched again,
/// and all is undone unless more match. γ is in whole steps of the format.
AnnealingResult anneal_gamma(const PixelZones& zones, fetex::PinchmapFormat format, double seconds, std::uint64_t seed,
                             std::vector<fetex::PinchmapTexel>& map);

/// Pixels on the wrong side.
std::uint64_t wrong_pixels(const PixelZones& zones, const std::vector<fetex::PinchmapTexel>& map);

} // namespace fetexc::test
