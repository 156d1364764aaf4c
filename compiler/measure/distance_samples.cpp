// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/distance_samples.h"

#include <algorithm>

namespace fetexc::measure {

Distances summary(std::vector<DistanceSample> all) {
    Distances out;
    out.points = all.size();
    double sum = 0, weight = 0;
    for (const DistanceSample& s : all) {
        sum += s.weight * s.distance, weight += s.weight;
        out.beyond_reach += s.beyond ? 1 : 0;
        if (s.distance > out.hausdorff) out.hausdorff = s.distance, out.farthest = s.place;
    }
    if (all.empty()) return out;
    out.mean = sum / weight;
    std::ranges::stable_sort(all, {}, &DistanceSample::distance);
    double below = 0;
    for (const DistanceSample& s : all) {
        below += s.weight, out.p95 = s.distance;
        if (below >= 0.95 * weight) break;
    }
    return out;
}

} // namespace fetexc::measure
