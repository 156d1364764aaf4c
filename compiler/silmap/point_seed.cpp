// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/silmap/point_seed.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace fetexc {
namespace {

using fetex::SilmapPoint;

SilmapPoint middle_of(const std::vector<CellChord>& chords) {
    double x = 0, y = 0, sum = 0;
    for (const CellChord& c : chords) {
        const double length = std::hypot(c.x1 - c.x0, c.y1 - c.y0);
        x += length * (c.x0 + c.x1) / 2, y += length * (c.y0 + c.y1) / 2, sum += length;
    }
    return sum > 0 ? SilmapPoint{x / sum, y / sum} : SilmapPoint{chords.front().x0, chords.front().y0};
}

SilmapPoint nearest_on(const CellChord& c, const SilmapPoint& p) {
    const double dx = c.x1 - c.x0, dy = c.y1 - c.y0, square = dx * dx + dy * dy;
    const double t = square > 0 ? std::clamp(((p.x - c.x0) * dx + (p.y - c.y0) * dy) / square, 0.0, 1.0) : 0;
    return {c.x0 + t * dx, c.y0 + t * dy};
}

} // namespace

SilmapPoint seed_of(const CellDrawing& drawing) {
    if (!drawing.corners.empty()) {
        return std::ranges::max_element(drawing.corners,
                                        [](const CellCorner& a, const CellCorner& b) {
                                            return std::tuple(a.edges, a.turn) < std::tuple(b.edges, b.turn);
                                        })
            ->at;
    }
    const SilmapPoint middle = middle_of(drawing.chords);
    SilmapPoint best = middle;
    double least = INFINITY;
    for (const CellChord& c : drawing.chords) {
        const SilmapPoint p = nearest_on(c, middle);
        const double square = (p.x - middle.x) * (p.x - middle.x) + (p.y - middle.y) * (p.y - middle.y);
        if (square < least) least = square, best = p;
    }
    return best;
}

} // namespace fetexc
