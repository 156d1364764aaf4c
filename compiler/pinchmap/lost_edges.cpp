// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/lost_edges.h"
#include "compiler/error_budget.h"

#include <algorithm>

namespace fetexc {
LostEdges blur_lost_edges(const GammaProblem& problem, std::vector<fetex::PinchmapTexel>& map) {
    const std::vector<double> wrong = wrong_around(problem, map);
    const std::size_t columns = std::size_t{problem.width} + 1;
    LostEdges out;
    for (std::size_t k = 0; k < map.size(); ++k) {
        if (map[k].k != 0 || !(wrong[k] > budget::kPinchmapSharpTo)) continue;
        const double strength = std::max(
            (budget::kPinchmapSoftFrom - wrong[k]) / (budget::kPinchmapSoftFrom - budget::kPinchmapSharpTo), 0.0);
        map[k].du *= strength, map[k].dv *= strength, ++out.texels;
        if (!(wrong[k] > out.worst)) continue;
        out.worst = wrong[k];
        out.u = static_cast<double>(k % columns) / problem.width;
        out.v = static_cast<double>(k / columns) / problem.height;
    }
    return out;
}

} // namespace fetexc
