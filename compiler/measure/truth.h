// SPDX-License-Identifier: GPL-3.0-or-later
/// The scene as the error measures see it: results and colours at points, visible edges, and the exact picture. Points
/// are asked of scene/ground_truth (winding numbers of the curves themselves, no planar map); edges and areas come
/// from the planar map of a grid of this library's own, never from an asset.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "compiler/measure/picture.h"
#include "compiler/planar/visible_edges.h"
#include "compiler/result.h"
#include "compiler/scene/compositor.h"

namespace fetexc::measure {

/// Nearest point of a visible edge.
struct EdgePoint {
    std::uint32_t edge = kNone; ///< index into edges(); kNone: nothing within the radius
    double t = 0, distance = 0; ///< width units
};

/// Const members are thread-safe.
class Truth {
  public:
    /// The scene must outlive the truth. Errors as PlanarMap::build's.
    static Result<std::unique_ptr<Truth>> of(const Scene& scene, unsigned threads);
    ~Truth();
    Truth(const Truth&) = delete;
    Truth& operator=(const Truth&) = delete;

    [[nodiscard]] const Scene& scene() const;
    /// Height of the canvas in width units.
    [[nodiscard]] double height() const;
    [[nodiscard]] WidthPoint to_width(TexturePoint p) const { return {p.u, p.v * height()}; }
    [[nodiscard]] TexturePoint to_texture(WidthPoint p) const { return {p.x, p.y / height()}; }

    /// Ids are those of this truth, and which ones depends on the order of questions (scene/compositor.h).
    [[nodiscard]] ResultId result_at(TexturePoint p) const;
    /// Colour of a result at a point, whether it is visible there or not. Premultiplied sRGB; solid ones are rounded to
    /// RGBA8.
    [[nodiscard]] Rgba color(ResultId result, TexturePoint p) const;
    [[nodiscard]] bool is_solid(ResultId result) const;

    /// In an order that depends on the scene alone.
    [[nodiscard]] std::span<const VisibleEdge> edges() const;
    /// Distance accurate to 1e-12; radius may be infinite.
    [[nodiscard]] EdgePoint nearest_edge(TexturePoint p, double radius) const;
    /// The same for one edge.
    [[nodiscard]] EdgePoint nearest_on(std::uint32_t edge, TexturePoint p, double radius) const;
    /// Whether nearest_edge() would find any.
    [[nodiscard]] bool edge_within(TexturePoint p, double radius) const;
    /// Edges whose boxes come within the radius (so all that do, and perhaps some more); ascending.
    void edges_near(TexturePoint p, double radius, std::vector<std::uint32_t>& out) const;

    /// The exactly integrated picture: width × height pixels, row-major, each the area mean of the premultiplied sRGB
    /// colours in it. Solid regions by the areas of the planar map's trapezoids (relative error below 1e-9 of a pixel),
    /// others by quadrature inside each trapezoid (error stated in measure/README.md). Errors as PlanarMap::build's,
    /// and a size outside 1 … 16384.
    [[nodiscard]] Result<std::vector<Rgba>> picture(GridSize pixels, unsigned threads) const;

  private:
    Truth();
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace fetexc::measure
