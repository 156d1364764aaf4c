// SPDX-License-Identifier: GPL-3.0-or-later
/// Random closed paths full of the coincidences that break planar maps.
#pragma once

#include <vector>

#include "compiler/scene/scene_builder.h"
#include "tests/support/random.h"

namespace fetexc::test {

using Contours = std::vector<CanvasContour>;

/// Relative weights of the kinds of shapes; 0 leaves a kind out.
struct ShapeMix {
    double polygons = 1;    ///< 3…8 corners on the coarse grid: shared and collinear edges, self-crossings
    double curves = 1;      ///< closed paths of lines, quadratics and cubics with control points on the coarse grid
    double free_curves = 1; ///< the same anywhere
    double rectangles = 1;  ///< axis-aligned, on the coarse grid: T-junctions, overlapping collinear edges
    double circles = 1;     ///< four cubics; centres and radii on the coarse grid, so many touch
    double stars = 1;       ///< many lines through one grid point
    double loops = 1;       ///< one cubic from a point to itself
    double odd_cubics = 1;  ///< zero handles, cusps, cubics that are lines or quadratics
    double tiny = 1;        ///< features of 1/4 … 40 lattice merge distances
    double partitions = 1;  ///< a strip of cells with shared curved borders, as in maps
};

/// Canvas space [0,width]×[0,height]; the coarse grid has `cells` steps over the larger side and extends one step
/// beyond the canvas.
struct ShapeSpace {
    double width = 100, height = 100;
    int cells = 8;
};

/// One shape; a partition gives several. Each element is one shape's contours.
std::vector<Contours> random_shapes(Random& random, const ShapeMix& mix, const ShapeSpace& space);

/// The same set of points, traversed the other way round.
Contours reversed(const Contours& contours);

CanvasSegment line(CanvasPoint a, CanvasPoint b);
CanvasSegment quadratic(CanvasPoint a, CanvasPoint b, CanvasPoint c);
CanvasSegment cubic(CanvasPoint a, CanvasPoint b, CanvasPoint c, CanvasPoint d);
CanvasContour polygon(const std::vector<CanvasPoint>& corners);
CanvasContour rectangle(double x0, double y0, double x1, double y1);
/// Four cubics; radial error 2.7e-4 of the radius.
CanvasContour circle(CanvasPoint centre, double radius);

} // namespace fetexc::test
