// SPDX-License-Identifier: GPL-3.0-or-later
/// From distances at single points to the figures of Distances.
#pragma once

#include <vector>

#include "compiler/measure/errors.h"

namespace fetexc::measure {

/// Width units.
struct DistanceSample {
    double distance = 0, weight = 1;
    bool beyond = false; ///< the distance is the reach
    WidthPoint place;
};

Distances summary(std::vector<DistanceSample> all);

} // namespace fetexc::measure
