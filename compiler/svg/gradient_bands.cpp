// SPDX-License-Identifier: GPL-3.0-or-later
/// Hard edges are geometry: a gradient that jumps is cut there, so that an edge in the picture is an edge of a shape.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "compiler/error_budget.h"
#include "compiler/svg/affine.h"
#include "compiler/svg/gradient.h"

namespace fetexc::svg {

Affine linear_to_unit(const Gradient& g); // gradient.cpp

namespace {

/// A point of the colour function of the unrolled parameter t: what holds just before and just after it.
struct Knot {
    double t = 0;
    Rgba before, after;
};

struct Range {
    double low = 0, high = 0;
};

/// Knots of one period [0,1], the first at 0 and the last at 1.
std::vector<Knot> period_of(const std::vector<GradientStop>& stops) {
    std::vector<Knot> knots;
    if (stops.front().offset > 0) knots.push_back({0, stops.front().color, stops.front().color});
    for (const GradientStop& stop : stops) {
        if (!knots.empty() && knots.back().t == stop.offset)
            knots.back().after = stop.color;
        else
            knots.push_back({stop.offset, stop.color, stop.color});
    }
    if (stops.back().offset < 1) knots.push_back({1, stops.back().color, stops.back().color});
    return knots;
}

void append(std::vector<Knot>& out, const Knot& knot) {
    if (!out.empty() && out.back().t == knot.t)
        out.back().after = knot.after;
    else
        out.push_back(knot);
}

/// Knots of all periods that meet the range, at most `most`; empty if there are more.
std::vector<Knot> unrolled(const Gradient& g, const Range& range, std::size_t most) {
    const std::vector<Knot> period = period_of(normalised_stops(g.stops));
    if (g.spread == Spread::Pad) return period;
    const double first = std::floor(range.low), last = std::floor(range.high);
    if (!((last - first + 1) * static_cast<double>(period.size()) <= static_cast<double>(most))) return {};
    std::vector<Knot> out;
    for (double k = first; k <= last; ++k) {
        const bool mirrored = g.spread == Spread::Reflect && std::fmod(k, 2) != 0;
        for (std::size_t i = 0; i < period.size(); ++i) {
            const Knot& knot = period[mirrored ? period.size() - 1 - i : i];
            if (mirrored)
                append(out, {k + 1 - knot.t, knot.after, knot.before});
            else
                append(out, {k + knot.t, knot.before, knot.after});
        }
    }
    return out;
}

Rgba mix(const Rgba& a, const Rgba& b, double f) {
    return {a.r + (b.r - a.r) * f, a.g + (b.g - a.g) * f, a.b + (b.b - a.b) * f, a.a + (b.a - a.a) * f};
}

/// Below `low` the circles of a radial gradient don't exist.
void cut_below(std::vector<Knot>& knots, double low) {
    std::size_t k = 0;
    while (k + 1 < knots.size() && knots[k + 1].t <= low)
        ++k;
    knots.erase(knots.begin(), knots.begin() + static_cast<std::ptrdiff_t>(k));
    if (knots.size() < 2 || knots[0].t >= low) return;
    const double f = (low - knots[0].t) / (knots[1].t - knots[0].t);
    const Rgba color = mix(knots[0].after, knots[1].before, f);
    knots[0] = {low, color, color};
}

/// Knots [first, last] of the unrolled gradient, without a jump between them.
struct Piece {
    std::size_t first = 0, last = 0;
};

std::vector<Piece> pieces_between_jumps(const std::vector<Knot>& knots) {
    std::vector<Piece> pieces;
    std::size_t first = 0;
    for (std::size_t i = 0; i < knots.size(); ++i) {
        if (knots[i].before == knots[i].after) continue;
        pieces.push_back({first, i});
        first = i;
    }
    pieces.push_back({first, knots.size() - 1});
    return pieces;
}

/// Colours on either side of a piece; at its ends only the side that belongs to it. A jump at the very first or last
/// knot leaves a piece of one knot: everything before t = 0 or after t = 1.
std::vector<GradientStop> stops_of(const std::vector<Knot>& knots, const Piece& piece, bool is_first) {
    const double a = knots[piece.first].t, length = knots[piece.last].t - a;
    std::vector<GradientStop> stops;
    for (std::size_t i = piece.first; i <= piece.last; ++i) {
        const bool starts = i == piece.first && !(is_first && i == piece.last);
        const double offset = length > 0 ? (knots[i].t - a) / length : 0;
        stops.push_back({offset, starts ? knots[i].after : knots[i].before});
    }
    return stops;
}

bool is_constant(const std::vector<GradientStop>& stops) {
    return std::all_of(stops.begin(), stops.end(), [&](const GradientStop& s) { return s.color == stops[0].color; });
}

/// The gradient between t = a and t = b as a gradient of its own, padded.
Paint paint_between(const Gradient& g, double a, double b, std::vector<GradientStop> stops) {
    if (is_constant(stops)) return SolidPaint{stops[0].color};
    if (!g.radial) {
        const Affine rescale{1 / (b - a), 0, 0, 1, -a / (b - a), 0};
        return LinearPaint{compose(rescale, linear_to_unit(g)), std::move(stops), Spread::Pad};
    }
    const double dx = g.cx - g.fx, dy = g.cy - g.fy, dr = g.r - g.fr;
    return RadialPaint{
        g.canvas_to_gradient,         g.fx + b * dx,    g.fy + b * dy, g.fr + b * dr, g.fx + a * dx, g.fy + a * dy,
        std::max(0.0, g.fr + a * dr), std::move(stops), Spread::Pad};
}

std::array<CanvasPoint, 4> corners(const Box& b) { return {{{b.x0, b.y0}, {b.x1, b.y0}, {b.x1, b.y1}, {b.x0, b.y1}}}; }

Box grown(const Box& b) {
    const double margin = budget::kBandMargin * std::max(b.x1 - b.x0, b.y1 - b.y0);
    return {b.x0 - margin, b.y0 - margin, b.x1 + margin, b.y1 + margin};
}

CanvasSegment line(CanvasPoint a, CanvasPoint b) { return {1, {a, b}}; }

CanvasContour polygon(const std::array<CanvasPoint, 4>& p) {
    return {line(p[0], p[1]), line(p[1], p[2]), line(p[2], p[3]), line(p[3], p[0])};
}

// ---- linear: strips between lines t = const ----

/// The unit space of a linear gradient around the canvas: x is t.
struct Strips {
    Affine unit_to_canvas;
    Range x, y; ///< of the canvas and a margin
};

Strips strips_of(const Gradient& g, const Box& canvas) {
    const Affine to_unit = linear_to_unit(g);
    Strips s{inverted(to_unit), {INFINITY, -INFINITY}, {INFINITY, -INFINITY}};
    for (const CanvasPoint corner : corners(grown(canvas))) {
        const CanvasPoint u = apply(to_unit, corner);
        s.x = {std::min(s.x.low, u.x), std::max(s.x.high, u.x)};
        s.y = {std::min(s.y.low, u.y), std::max(s.y.high, u.y)};
    }
    return s;
}

void set_strip(const Strips& s, std::optional<double> a, std::optional<double> b, Band& band) {
    const double from = a ? *a : std::min(s.x.low, b.value_or(s.x.low)), to = b ? *b : std::max(s.x.high, from);
    const auto at = [&](double x, double y) { return apply(s.unit_to_canvas, {x, y}); };
    band.region = {polygon({at(from, s.y.low), at(to, s.y.low), at(to, s.y.high), at(from, s.y.high)})};
}

Range linear_range(const Gradient& g, const Box& seen) {
    const Affine to_unit = linear_to_unit(g);
    Range range{INFINITY, -INFINITY};
    for (const CanvasPoint corner : corners(seen)) {
        const double t = apply(to_unit, corner).x;
        range = {std::min(range.low, t), std::max(range.high, t)};
    }
    return range;
}

// ---- radial: rings between circles t = const ----

/// Largest t over the box. The disc of t holds that of any smaller t, so t is quasi-convex: a corner has the largest.
Range radial_range(const Gradient& g, const Box& seen) {
    const double dx = g.cx - g.fx, dy = g.cy - g.fy, dr = g.r - g.fr, a = dr * dr - dx * dx - dy * dy;
    double high = 1;
    for (const CanvasPoint corner : corners(seen)) {
        const CanvasPoint q = apply(g.canvas_to_gradient, corner);
        const double px = q.x - g.fx, py = q.y - g.fy;
        const double b = px * dx + py * dy + g.fr * dr, c = px * px + py * py - g.fr * g.fr;
        high = std::max(high, (std::sqrt(std::max(0.0, b * b + a * c)) - b) / a);
    }
    return {-g.fr / dr, high};
}

/// Number of cubics for a full turn: radial error 2/27·sin⁶(θ/4)/cos²(θ/4) per unit radius and cubic of angle θ.
int cubics_per_turn(double radius, double tolerance) {
    constexpr int kMost = 4096;
    for (int n = 4; n < kMost; ++n) {
        const double quarter = std::numbers::pi / (2 * n);
        const double error = radius * 2 / 27 * std::pow(std::sin(quarter), 6) / std::pow(std::cos(quarter), 2);
        if (!(error > tolerance)) return n;
    }
    return kMost;
}

CanvasContour circle(const Gradient& g, double t, double tolerance) {
    const Affine to_canvas = inverted(g.canvas_to_gradient);
    const CanvasPoint c{g.fx + t * (g.cx - g.fx), g.fy + t * (g.cy - g.fy)};
    const double r = g.fr + t * (g.r - g.fr);
    const int n = cubics_per_turn(r * stretch(to_canvas), tolerance);
    const double step = 2 * std::numbers::pi / n, arm = 4.0 / 3 * std::tan(step / 4);
    const auto at = [&](int i, double along) {
        const double angle = (i % n) * step, s = std::sin(angle), co = std::cos(angle);
        return apply(to_canvas, {c.x + r * (co - along * s), c.y + r * (s + along * co)});
    };
    CanvasContour contour;
    for (int i = 0; i < n; ++i)
        contour.push_back({3, {at(i, 0), at(i, arm), at(i + 1, -arm), at(i + 1, 0)}});
    return contour;
}

void set_ring(const Gradient& g, const Box& canvas, std::optional<double> a, std::optional<double> b, Band& band) {
    const double side = std::max(canvas.x1 - canvas.x0, canvas.y1 - canvas.y0);
    const double tolerance = budget::kArcTolerance * side / static_cast<double>(kLatticeSteps);
    band.rule = FillRule::EvenOdd;
    band.region.push_back(b ? circle(g, *b, tolerance) : polygon(corners(grown(canvas))));
    if (a && g.fr + *a * (g.r - g.fr) > 0) band.region.push_back(circle(g, *a, tolerance));
}

bool is_nested(const Gradient& g) { return std::hypot(g.cx - g.fx, g.cy - g.fy) < g.r - g.fr; }

} // namespace

std::vector<Band> bands_of(const Gradient& g, const Box& seen, const Box& canvas, std::size_t most) {
    if (g.radial && !is_nested(g)) return {};
    const Range range = g.radial ? radial_range(g, seen) : linear_range(g, seen);
    std::vector<Knot> knots = unrolled(g, range, 4 * most);
    if (knots.empty()) return {};
    if (g.radial) cut_below(knots, range.low);
    const std::vector<Piece> pieces = pieces_between_jumps(knots);
    if (pieces.size() > most) return {};
    const Strips strips = g.radial ? Strips{} : strips_of(g, canvas);
    std::vector<Band> bands;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const double a = knots[pieces[i].first].t, b = knots[pieces[i].last].t;
        if ((i + 1 < pieces.size() && b < range.low) || (i > 0 && a > range.high)) continue; // not seen
        Band band;
        band.paint = paint_between(g, a, b, stops_of(knots, pieces[i], i == 0));
        const std::optional<double> from = i > 0 ? std::optional(a) : std::nullopt;
        const std::optional<double> to = i + 1 < pieces.size() ? std::optional(b) : std::nullopt;
        if (g.radial)
            set_ring(g, canvas, from, to, band);
        else
            set_strip(strips, from, to, band);
        bands.push_back(std::move(band));
    }
    return bands;
}

} // namespace fetexc::svg
