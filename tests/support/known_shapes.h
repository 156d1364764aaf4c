// SPDX-License-Identifier: GPL-3.0-or-later
/// Shapes whose areas and distances are known, as scenes on a canvas of width 1 (so user units are width units), and
/// the areas.
#pragma once

#include <vector>

#include "compiler/scene/scene_builder.h"

namespace fetexc::test {

inline constexpr double kLatticeStep = 0x1p-26; ///< width units
inline constexpr double kPi = 3.14159265358979323846;

/// A coordinate that snapping leaves where it is.
[[nodiscard]] double on_lattice(double v);

struct Layer {
    std::vector<CanvasContour> contours;
    Rgba color; ///< straight alpha
    FillRule rule = FillRule::EvenOdd;
};

/// From back to front; nothing behind.
[[nodiscard]] Scene layered(const std::vector<Layer>& layers, double height = 1);
/// White all over, then a black shape.
[[nodiscard]] Scene black_on_white(const std::vector<CanvasContour>& shape);
[[nodiscard]] CanvasContour canvas_box(double height = 1);

[[nodiscard]] CanvasContour closed_polygon(const std::vector<CanvasPoint>& points);
/// Within 1e-9 of the radius of a circle, before snapping.
[[nodiscard]] CanvasContour round_disc(CanvasPoint center, double radius);

/// {p : cos(angle)·x + sin(angle)·y < offset} within a box one unit larger than the canvas on every side.
struct HalfPlane {
    double angle = 0, offset = 0;
    [[nodiscard]] double depth(CanvasPoint p) const; ///< distance to the edge, positive inside
};
[[nodiscard]] std::vector<CanvasPoint> polygon_of(const HalfPlane& h);

struct Rectangle {
    double x0 = 0, y0 = 0, x1 = 1, y1 = 1;
    [[nodiscard]] double area() const { return (x1 - x0) * (y1 - y0); }
};

/// By the shoelace formula; the polygon doesn't cross itself.
[[nodiscard]] double polygon_area(const std::vector<CanvasPoint>& corners);
/// Area of the part of a convex polygon in a rectangle.
[[nodiscard]] double clipped_area(std::vector<CanvasPoint> polygon, const Rectangle& box);
/// Area of the part of a disc in a rectangle.
[[nodiscard]] double disc_area(CanvasPoint center, double radius, const Rectangle& box);

} // namespace fetexc::test
