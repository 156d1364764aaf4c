// SPDX-License-Identifier: GPL-3.0-or-later
/// Where a pinchmap can't follow the edges it blurs them (Tarini and Cignoni 2005, §8).
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/pinchmap/gamma_fit.h"
#include "formats/pinchmap.h"

namespace fetexc {

struct LostEdges {
    std::uint64_t texels = 0; ///< with a strength below 1
    double worst = 0;         ///< square clusters on the wrong side in the four around a texel, at most
    double u = 0, v = 0;      ///< 0 … 1: where
};

/// Scales the directions of active texels by strengths: 1 where no more than 0.3 square clusters around them are on the
/// wrong side, 0 from 0.5 on, evenly between. (Hard edges in wrong places look and measure worse than soft ones: on
/// drawings full of thin lines blurring wins 1 to 1.5 dB; shapes that the map can follow have no such place.)
LostEdges blur_lost_edges(const GammaProblem& problem, std::vector<fetex::PinchmapTexel>& map);

} // namespace fetexc
