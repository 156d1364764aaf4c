// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/known_shapes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fetexc::test {

double on_lattice(double v) { return std::round(v / kLatticeStep) * kLatticeStep; }

Scene layered(const std::vector<Layer>& layers, double height) {
    SceneBuilder builder(1, height);
    for (const Layer& layer : layers) {
        Node node;
        node.shape = builder.add_shape(layer.contours, layer.rule, kNone);
        node.paint = static_cast<std::uint32_t>(builder.scene().paints.size());
        node.end = static_cast<std::uint32_t>(builder.scene().nodes.size()) + 1;
        builder.scene().paints.emplace_back(SolidPaint{layer.color});
        builder.scene().nodes.push_back(node);
    }
    Result<Scene> scene = builder.finish();
    if (!scene) throw std::runtime_error(scene.error().message);
    return std::move(scene).value();
}

CanvasContour canvas_box(double height) { return closed_polygon({{0, 0}, {1, 0}, {1, height}, {0, height}}); }

Scene black_on_white(const std::vector<CanvasContour>& shape) {
    return layered({{{canvas_box()}, {1, 1, 1, 1}}, {shape, {0, 0, 0, 1}}});
}

CanvasContour closed_polygon(const std::vector<CanvasPoint>& points) {
    CanvasContour out;
    for (std::size_t i = 0; i < points.size(); ++i)
        out.push_back({1, {points[i], points[(i + 1) % points.size()]}});
    return out;
}

CanvasContour round_disc(CanvasPoint center, double radius) {
    constexpr int arcs = 32;
    const double step = 2 * kPi / arcs, handle = radius * 4 / 3 * std::tan(step / 4);
    CanvasContour out;
    for (int k = 0; k < arcs; ++k) {
        const double a = k * step, b = (k + 1) % arcs * step;
        const CanvasPoint p{center.x + radius * std::cos(a), center.y + radius * std::sin(a)},
            q{center.x + radius * std::cos(b), center.y + radius * std::sin(b)};
        out.push_back({3,
                       {p,
                        {p.x - handle * std::sin(a), p.y + handle * std::cos(a)},
                        {q.x + handle * std::sin(b), q.y - handle * std::cos(b)},
                        q}});
    }
    return out;
}

double HalfPlane::depth(CanvasPoint p) const { return offset - std::cos(angle) * p.x - std::sin(angle) * p.y; }

namespace {

/// Sutherland–Hodgman by one line: what has depth ≥ 0.
template <class Depth> std::vector<CanvasPoint> clipped(const std::vector<CanvasPoint>& polygon, const Depth& depth) {
    std::vector<CanvasPoint> out;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const CanvasPoint a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const double da = depth(a), db = depth(b);
        if (da >= 0) out.push_back(a);
        if ((da < 0) != (db < 0)) {
            const double t = da / (da - db);
            out.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
        }
    }
    return out;
}

} // namespace

double polygon_area(const std::vector<CanvasPoint>& corners) {
    double twice = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const CanvasPoint a = corners[i], b = corners[(i + 1) % corners.size()];
        twice += a.x * b.y - b.x * a.y;
    }
    return std::fabs(twice) / 2;
}

std::vector<CanvasPoint> polygon_of(const HalfPlane& h) {
    std::vector<CanvasPoint> out = clipped({{-0.875, -0.875}, {1.875, -0.875}, {1.875, 1.875}, {-0.875, 1.875}},
                                           [&](CanvasPoint p) { return h.depth(p); });
    for (CanvasPoint& p : out)
        p = {on_lattice(p.x), on_lattice(p.y)};
    return out;
}

/// Coordinates from the box's corner first: the areas of small boxes lose nothing to cancellation.
double clipped_area(std::vector<CanvasPoint> polygon, const Rectangle& box) {
    for (CanvasPoint& p : polygon)
        p = {p.x - box.x0, p.y - box.y0};
    polygon = clipped(polygon, [](CanvasPoint p) { return p.x; });
    polygon = clipped(polygon, [](CanvasPoint p) { return p.y; });
    polygon = clipped(polygon, [&](CanvasPoint p) { return box.x1 - box.x0 - p.x; });
    polygon = clipped(polygon, [&](CanvasPoint p) { return box.y1 - box.y0 - p.y; });
    return polygon_area(polygon);
}

/// ∫ of the chord's part between the box's levels. Between two neighbours of the positions listed, each end of the
/// chord is either a level or the circle all along.
double disc_area(CanvasPoint center, double radius, const Rectangle& box) {
    const double x0 = std::clamp(box.x0 - center.x, -radius, radius),
                 x1 = std::clamp(box.x1 - center.x, -radius, radius);
    const double y0 = box.y0 - center.y, y1 = box.y1 - center.y;
    std::vector<double> cuts{x0, x1};
    for (const double y : {y0, y1}) {
        if (std::fabs(y) >= radius) continue;
        const double x = std::sqrt(radius * radius - y * y);
        for (const double cut : {-x, x}) {
            if (cut > x0 && cut < x1) cuts.push_back(cut);
        }
    }
    std::sort(cuts.begin(), cuts.end());
    const auto half_chord = [&](double x) { return std::sqrt(std::max(radius * radius - x * x, 0.0)); };
    const auto primitive = [&](double x) { return (x * half_chord(x) + radius * radius * std::asin(x / radius)) / 2; };
    double area = 0;
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
        const double a = cuts[k], b = cuts[k + 1], h = half_chord((a + b) / 2);
        if (std::min(y1, h) <= std::max(y0, -h)) continue;
        const double round = primitive(b) - primitive(a);
        area += (h < y1 ? round : y1 * (b - a)) - (-h > y0 ? -round : y0 * (b - a));
    }
    return area;
}

} // namespace fetexc::test
