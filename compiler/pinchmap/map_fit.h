// SPDX-License-Identifier: GPL-3.0-or-later
/// Zones and γ together: steps 1 to 4 of Tarini and Cignoni 2005, §7.2.
#pragma once

#include <vector>

#include "compiler/pinchmap/gamma_fit.h"
#include "compiler/pinchmap/zone_mask.h"
#include "formats/pinchmap.h"

namespace fetexc {

struct MapFit {
    std::vector<fetex::PinchmapTexel> map; ///< strengths 1
    MaskMoves zones;
    GammaFit gamma;
    double unmendable = 0; ///< square clusters, about, that are wrong because of the zones
};

/// Zones by the corners' distances from the outline; if those leave much unmendable others too, searched by what each
/// corner's side costs where discontinuities would run without zones. At each place where they differ those that leave
/// less of the drawing on the wrong side; γ then searched on.
MapFit fit_map(const Solver& solver, const GammaProblem& problem);

} // namespace fetexc
