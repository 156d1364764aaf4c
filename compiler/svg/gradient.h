// SPDX-License-Identifier: GPL-3.0-or-later
/// Gradients as SVG gives them, and as the scene wants them: without hard edges inside a paint.
#pragma once

#include <vector>

#include "compiler/scene/scene.h"
#include "compiler/scene/scene_builder.h"

namespace fetexc::svg {

/// A gradient as it comes from the parser.
struct Gradient {
    bool radial = false;
    Affine canvas_to_gradient;
    double x1 = 0, y1 = 0, x2 = 0, y2 = 0;                ///< linear
    double cx = 0, cy = 0, r = 0, fx = 0, fy = 0, fr = 0; ///< radial
    std::vector<GradientStop> stops;                      ///< at least one
    Spread spread = Spread::Pad;
};

/// Axis-parallel box in canvas space.
struct Box {
    double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// A part of the plane with a paint that has no hard edge. No contours: the whole plane.
struct Band {
    std::vector<CanvasContour> region;
    FillRule rule = FillRule::NonZero;
    Paint paint;
};

/// Stops in ascending order in [0,1]; offsets closer than budget::kHardEdgeGap made equal; of more than two equal
/// offsets only the first and the last (SVG 2 §14.2.4.1).
std::vector<GradientStop> normalised_stops(std::vector<GradientStop> stops);

/// The gradient as one paint, degenerate cases resolved: one colour, zero-length vector (last colour, SVG 2 §14.2.2).
Paint as_paint(const Gradient& gradient);

/// True when the colour jumps somewhere: at equal offsets of different colours, or from the end to the start of a
/// repeat.
bool has_hard_edges(const Gradient& gradient);

/// The gradient cut at its hard edges into regions that tile the plane around `canvas`; every point of `seen` (the
/// visible box of the shape) lies in exactly one. Neighbouring regions share their border curve exactly. Empty when it
/// can't be cut: the circles of a radial gradient are not nested, or more than `most` bands would be needed.
std::vector<Band> bands_of(const Gradient& gradient, const Box& seen, const Box& canvas, std::size_t most);

} // namespace fetexc::svg
