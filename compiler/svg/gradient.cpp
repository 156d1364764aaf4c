// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/svg/gradient.h"

#include <algorithm>
#include <cmath>

#include "compiler/error_budget.h"
#include "compiler/svg/affine.h"

namespace fetexc::svg {
namespace {

bool is_degenerate(const Gradient& g) {
    if (g.radial) return !(g.r > 0);
    return g.x1 == g.x2 && g.y1 == g.y2;
}

bool is_constant(const std::vector<GradientStop>& stops) {
    return std::all_of(stops.begin(), stops.end(), [&](const GradientStop& s) { return s.color == stops[0].color; });
}

/// Circles of which the later holds the earlier: the gradient is defined everywhere.
bool covers_plane(const Gradient& g) { return !g.radial || std::hypot(g.cx - g.fx, g.cy - g.fy) < g.r - g.fr; }

/// A third stop at one offset is never seen.
void drop_hidden_stops(std::vector<GradientStop>& stops) {
    for (std::size_t i = 1; i + 1 < stops.size();) {
        const bool hidden = stops[i - 1].offset == stops[i].offset && stops[i].offset == stops[i + 1].offset;
        if (hidden)
            stops.erase(stops.begin() + static_cast<std::ptrdiff_t>(i));
        else
            ++i;
    }
}

} // namespace

std::vector<GradientStop> normalised_stops(std::vector<GradientStop> stops) {
    double last = 0;
    for (GradientStop& stop : stops) {
        const double offset = std::isfinite(stop.offset) ? std::clamp(stop.offset, 0.0, 1.0) : last;
        stop.offset = last = std::max(offset, last);
    }
    // The parser moves the earlier of two equal offsets back, except at 0, where it moves the later one on.
    for (std::size_t i = stops.size() - 1; i-- > 0;)
        if (stops[i + 1].offset - stops[i].offset <= budget::kHardEdgeGap)
            stops[i].offset = stops[i + 1].offset <= budget::kHardEdgeGap ? stops[i].offset : stops[i + 1].offset;
    for (std::size_t i = 1; i < stops.size(); ++i)
        if (stops[i].offset - stops[i - 1].offset <= budget::kHardEdgeGap) stops[i].offset = stops[i - 1].offset;
    drop_hidden_stops(stops);
    return stops;
}

Affine linear_to_unit(const Gradient& g) {
    const double dx = g.x2 - g.x1, dy = g.y2 - g.y1, l2 = dx * dx + dy * dy;
    const double a = dx / l2, b = dy / l2;
    // x: along the vector, 0 at its start and 1 at its end; y: across, in the same unit.
    const Affine unit{a, -b, b, a, -(a * g.x1 + b * g.y1), b * g.x1 - a * g.y1};
    return compose(unit, g.canvas_to_gradient);
}

Paint as_paint(const Gradient& g) {
    std::vector<GradientStop> stops = normalised_stops(g.stops);
    if (is_degenerate(g)) return SolidPaint{stops.back().color};
    if (is_constant(stops) && covers_plane(g)) return SolidPaint{stops[0].color};
    if (g.radial)
        return RadialPaint{g.canvas_to_gradient, g.cx, g.cy, g.r, g.fx, g.fy, g.fr, std::move(stops), g.spread};
    return LinearPaint{linear_to_unit(g), std::move(stops), g.spread};
}

bool has_hard_edges(const Gradient& g) {
    if (is_degenerate(g)) return false;
    const std::vector<GradientStop> stops = normalised_stops(g.stops);
    if (g.spread == Spread::Repeat && !(stops.front().color == stops.back().color)) return true;
    for (std::size_t i = 1; i < stops.size(); ++i)
        if (stops[i].offset == stops[i - 1].offset && !(stops[i].color == stops[i - 1].color)) return true;
    return false;
}

} // namespace fetexc::svg
