// SPDX-License-Identifier: GPL-3.0-or-later
/// Drawings with control points on a small grid of integers, where every coincidence happens.
#pragma once

#include <algorithm>

#include "tests/support/drawn_scene.h"
#include "tests/support/random.h"

namespace fetexc::test {

struct Drawing {
    std::vector<Path> paths;
    int cells = 1; ///< the grid is cells × cells
};

inline Drawing random_drawing(std::uint64_t seed) {
    Random random(seed);
    Drawing d;
    d.cells = 1 << random.integer(2, 4);
    const std::int64_t unit = 512 / d.cells;
    const int span = random.chance(0.3) ? d.cells : std::min(d.cells, 5); // few places: more coincidences
    const auto point = [&] { return LatticePoint{unit * random.integer(0, span), unit * random.integer(0, span)}; };
    const int shapes = random.integer(1, 7);
    for (int k = 0; k < shapes; ++k) {
        Path path;
        LatticePoint at = point();
        const int segments = random.integer(2, 6);
        for (int i = 0; i < segments; ++i) {
            std::vector<LatticePoint> control{at};
            const int degree = random.integer(1, 3);
            for (int j = 0; j < degree; ++j)
                control.push_back(point());
            at = control.back();
            path.push_back(control);
        }
        d.paths.push_back(closed(path));
    }
    return d;
}

/// Some of its segments again in part, as shapes of their own: partial overlaps, on loops, too.
inline Drawing with_parts(Drawing d, std::uint64_t seed) {
    Random random(seed);
    for (std::size_t k = 0, paths = d.paths.size(); k < paths; ++k) {
        for (std::size_t i = 0; i < d.paths[k].size(); ++i) {
            if (random.chance(0.5)) continue;
            std::vector<LatticePoint> part = half_of(d.paths[k][i], random.chance(0.5));
            if (random.chance(0.3)) std::reverse(part.begin(), part.end());
            d.paths.push_back(closed({part}));
        }
    }
    return d;
}

} // namespace fetexc::test
