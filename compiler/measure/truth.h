// SPDX-License-Identifier: GPL-3.0-or-later
/// The scene as the error measures see it: results and colours at points, visible edges, and the exact picture. Points
/// are asked of scene/ground_truth (winding numbers of the curves themselves, no planar map); edges and areas come
/// from the planar map of a grid of this library's own, never from an asset.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "compiler/measure/picture.h"
#include "compiler/result.h"
#include "compiler/scene/compositor.h"

namespace fetexc::measure {

/// Width units: x right, y down; the canvas is [0,1] × [0, height / width]. Distances are Euclidean in them.
struct WidthPoint {
    double x = 0, y = 0;
};

/// Part of a curve with different results on its sides, monotone in x and y, following the curve with growing t.
struct VisibleEdge {
    int degree = 1;
    WidthPoint p[4];              ///< Bezier points
    ResultId left = 0, right = 0; ///< looking along growing t (y down)
};

/// Nearest point of a visible edge.
struct EdgePoint {
    std::uint32_t edge = kNone; ///< index into edges(); kNone: nothing within the radius
    double t = 0, distance = 0; ///< width units
};

class Truth {
  public:
    /// The scene must outlive the truth. Errors as PlanarMap::build's.
    static Result<std::unique_ptr<Truth>> of(const Scene& scene, unsigned threads);
    virtual ~Truth() = default;

    [[nodiscard]] virtual const Scene& scene() const = 0;
    /// Height of the canvas in width units.
    [[nodiscard]] virtual double height() const = 0;
    [[nodiscard]] virtual ResultId result_at(TexturePoint p) const = 0;
    /// Colour of a result at a point, whether it is visible there or not. Premultiplied sRGB.
    [[nodiscard]] virtual Rgba color(ResultId result, TexturePoint p) const = 0;
    [[nodiscard]] virtual std::span<const VisibleEdge> edges() const = 0;
    [[nodiscard]] virtual EdgePoint nearest_edge(TexturePoint p, double radius) const = 0;
    /// Edges that pass within the radius (or a little beyond it).
    virtual void edges_near(TexturePoint p, double radius, std::vector<std::uint32_t>& out) const = 0;
    /// The exactly integrated picture: width × height pixels, row-major, each the area mean of the premultiplied sRGB
    /// colours in it. Solid regions by the areas of the planar map's trapezoids (relative error below 1e-9 of a pixel),
    /// others by quadrature inside each trapezoid (error stated in measure/README.md).
    [[nodiscard]] virtual Result<std::vector<Rgba>> picture(GridSize pixels, unsigned threads) const = 0;
};

} // namespace fetexc::measure
