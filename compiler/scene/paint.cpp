// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/paint.h"

#include <algorithm>
#include <cmath>

#include "compiler/scene/blend.h"

namespace fetexc {
namespace {

CanvasPoint apply(const Affine& m, CanvasPoint p) { return {m.a * p.x + m.c * p.y + m.e, m.b * p.x + m.d * p.y + m.f}; }

// ---- gradients ----

double mirrored(double t) {
    const double u = t - 2 * std::floor(t / 2); // [0,2)
    return u <= 1 ? u : 2 - u;
}

double spread_parameter(double t, Spread spread) {
    switch (spread) {
    case Spread::Reflect:
        return mirrored(t);
    case Spread::Repeat:
        return t - std::floor(t);
    case Spread::Pad:
        break;
    }
    return std::clamp(t, 0.0, 1.0);
}

double mix(double a, double b, double t) { return a + (b - a) * t; }

Rgba mix(const Rgba& a, const Rgba& b, double t) {
    return {mix(a.r, b.r, t), mix(a.g, b.g, t), mix(a.b, b.b, t), mix(a.a, b.a, t)};
}

/// Stop colours at a spread parameter, premultiplied.
Rgba stop_color(const std::vector<GradientStop>& stops, double t) {
    const auto after = std::upper_bound(stops.begin(), stops.end(), t,
                                        [](double value, const GradientStop& stop) { return value < stop.offset; });
    if (after == stops.begin()) return premultiplied(stops.front().color);
    const GradientStop& before = *(after - 1);
    if (after == stops.end()) return premultiplied(before.color);
    const double width = after->offset - before.offset; // > 0: before.offset <= t < after->offset
    return premultiplied(mix(before.color, after->color, (t - before.offset) / width));
}

/// The circles through which a radial gradient sweeps: centre f + t·d, radius fr + t·dr.
struct Sweep {
    double dx = 0, dy = 0, dr = 0;
    double a = 0; ///< quadratic coefficient d² − dr²; negative when one circle holds the other
};

Sweep sweep_of(const RadialPaint& p) {
    Sweep s{p.cx - p.fx, p.cy - p.fy, p.r - p.fr, 0};
    s.a = s.dx * s.dx + s.dy * s.dy - s.dr * s.dr;
    return s;
}

/// Every point of the plane lies on one of the circles.
bool covers_plane(const RadialPaint& p) { return sweep_of(p).a < 0 && p.r >= 0 && p.fr >= 0; }

/// Concentric circles of equal radius: the inside takes the first colour, the outside the last (Pad only, as Canvas and
/// Skia).
std::optional<double> ring_parameter(const RadialPaint& p, CanvasPoint q) {
    if (p.spread != Spread::Pad) return {};
    return std::hypot(q.x - p.cx, q.y - p.cy) < p.r ? 0.0 : 1.0;
}

/// Largest t with |q − c(t)| = r(t) ≥ 0 (the two-circle gradient of Canvas and SVG 2). Both roots without cancellation.
std::optional<double> radial_parameter(const RadialPaint& p, CanvasPoint q) {
    const Sweep s = sweep_of(p);
    if (s.dx == 0 && s.dy == 0 && s.dr == 0) return ring_parameter(p, q);
    const double px = q.x - p.fx, py = q.y - p.fy;
    const double b = px * s.dx + py * s.dy + p.fr * s.dr;
    const double c = px * px + py * py - p.fr * p.fr;
    double disc = b * b - s.a * c;     // a·t² − 2b·t + c = 0
    if (disc < 0 && s.a < 0) disc = 0; // only by rounding
    if (!(disc >= 0)) return {};
    const double w = b + std::copysign(std::sqrt(disc), b);
    std::optional<double> best;
    const auto consider = [&](double t) {
        if (std::isfinite(t) && p.fr + t * s.dr >= 0 && (!best || t > *best)) best = t;
    };
    if (s.a != 0) consider(w / s.a);
    if (w != 0)
        consider(c / w);
    else if (c == 0)
        consider(0);
    return best;
}

Rgba color_of(const SolidPaint& paint, CanvasPoint) { return premultiplied(paint.color); }

Rgba color_of(const LinearPaint& paint, CanvasPoint p) {
    return stop_color(paint.stops, spread_parameter(apply(paint.canvas_to_unit, p).x, paint.spread));
}

Rgba color_of(const RadialPaint& paint, CanvasPoint p) {
    const std::optional<double> t = radial_parameter(paint, apply(paint.canvas_to_gradient, p));
    return t ? stop_color(paint.stops, spread_parameter(*t, paint.spread)) : Rgba{};
}

// ---- bitmaps ----

Rgba pixel(const RasterPaint& paint, std::int64_t x, std::int64_t y) {
    x = std::clamp<std::int64_t>(x, 0, std::int64_t{paint.width} - 1);
    y = std::clamp<std::int64_t>(y, 0, std::int64_t{paint.height} - 1);
    const std::uint8_t* c = &paint.rgba[4 * (static_cast<std::size_t>(y) * paint.width + static_cast<std::size_t>(x))];
    return {c[0] / 255.0, c[1] / 255.0, c[2] / 255.0, c[3] / 255.0};
}

Rgba color_of(const RasterPaint& paint, CanvasPoint p) {
    const CanvasPoint q = apply(paint.canvas_to_pixel, p);
    if (!(q.x >= 0 && q.y >= 0 && q.x <= paint.width && q.y <= paint.height)) return {};
    if (!paint.smooth) return pixel(paint, static_cast<std::int64_t>(q.x), static_cast<std::int64_t>(q.y));
    const double x = q.x - 0.5, y = q.y - 0.5;
    const auto i = static_cast<std::int64_t>(std::floor(x)), j = static_cast<std::int64_t>(std::floor(y));
    const double u = x - static_cast<double>(i), v = y - static_cast<double>(j);
    return mix(mix(pixel(paint, i, j), pixel(paint, i + 1, j), u),
               mix(pixel(paint, i, j + 1), pixel(paint, i + 1, j + 1), u), v);
}

// ---- properties ----

const std::vector<GradientStop>* stops_of(const Paint& paint) {
    if (const auto* linear = std::get_if<LinearPaint>(&paint)) return &linear->stops;
    if (const auto* radial = std::get_if<RadialPaint>(&paint)) return &radial->stops;
    return nullptr;
}

/// Defined at every point.
bool is_total(const Paint& paint) {
    const auto* radial = std::get_if<RadialPaint>(&paint);
    return radial == nullptr || covers_plane(*radial);
}

template <class Predicate> bool all_stops(const Paint& paint, Predicate predicate) {
    const std::vector<GradientStop>* stops = stops_of(paint);
    return stops != nullptr && std::all_of(stops->begin(), stops->end(), predicate);
}

} // namespace

Rgba paint_color(const Paint& paint, CanvasPoint p) {
    return std::visit([p](const auto& kind) { return color_of(kind, p); }, paint);
}

std::optional<Rgba> constant_color(const Paint& paint) {
    if (const auto* solid = std::get_if<SolidPaint>(&paint)) return premultiplied(solid->color);
    if (paint_is_invisible(paint)) return Rgba{};
    if (!is_total(paint)) return {};
    if (!all_stops(paint, [&](const GradientStop& s) { return s.color == stops_of(paint)->front().color; })) return {};
    return premultiplied(stops_of(paint)->front().color);
}

bool paint_is_opaque(const Paint& paint) {
    if (const auto* solid = std::get_if<SolidPaint>(&paint)) return solid->color.a >= 1;
    return is_total(paint) && all_stops(paint, [](const GradientStop& stop) { return stop.color.a >= 1; });
}

bool paint_is_invisible(const Paint& paint) {
    if (const auto* solid = std::get_if<SolidPaint>(&paint)) return solid->color.a <= 0;
    return all_stops(paint, [](const GradientStop& stop) { return stop.color.a <= 0; });
}

} // namespace fetexc
