// SPDX-License-Identifier: GPL-3.0-or-later
/// Distance in a texel as Parilov and Zorin (2008, §3.2, §5.1 to 5.3) interpolate it: on eight curvilinear triangles.
/// What formats/SPEC.md, 9.2, does otherwise is compared with it. Local coordinates, 0 … 1; corners: bit 0 east, bit 1
/// south.
///
/// The paper leaves open, and here is: an edge without a point of the texel's own segments has its vertex in the
/// middle, and the mean of its corners there; without a segment between opposite edges the central vertex has the mean
/// of the two interpolations between opposite edges' vertices; the auxiliary point of a triangle of two curves is on
/// the line of its straight side, a side's length beyond it.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "formats/feature_curve_geometry.h"

namespace fetexc::test {

struct SegmentedTexel {
    fetex::FeatureSegmentList segments;
    std::array<fetex::FeatureQuadratic, 2> curves; ///< of segments
    std::array<double, 4> distances{};             ///< at the corners
};

class EightTriangles {
  public:
    explicit EightTriangles(const SegmentedTexel& texel);

    /// Sides of triangles meet in nothing but vertices.
    [[nodiscard]] bool well_formed() const;
    /// A triangle has the distance 0 at all vertices, and so inside.
    [[nodiscard]] bool has_area_of_zero() const;
    /// nullopt: a ray of the interpolation doesn't meet a curve once.
    [[nodiscard]] std::optional<double> distance(fetex::FeaturePoint p) const;

  private:
    /// Side k goes from vertex k to the next.
    struct Triangle {
        std::array<fetex::FeaturePoint, 3> vertex;
        std::array<double, 3> value{};
        std::array<fetex::FeatureQuadratic, 3> side;
    };
    /// Between neighbouring edges, first and second clockwise but N–W, around a corner.
    struct Quadrant {
        std::uint32_t corner = 0;
        std::size_t first = 0, second = 0; ///< by feature_edge_index
        fetex::FeatureQuadratic diagonal;
    };

    [[nodiscard]] fetex::FeatureQuadratic side_between(fetex::FeatureEdge a, fetex::FeatureEdge b) const;
    [[nodiscard]] Triangle outer(const Quadrant& q) const;
    [[nodiscard]] Triangle inner(const Quadrant& q) const;
    void find_centre();
    void find_values();

    SegmentedTexel texel_;
    fetex::FeatureQuadratic vertical_, horizontal_; ///< from north to south, from east to west
    std::array<fetex::FeatureQuadratic, 4> spokes_; ///< from the edges' vertices to the central one
    std::array<Quadrant, 4> quadrants_;             ///< by corner
    std::array<fetex::FeaturePoint, 4> vertices_;   ///< of edges
    std::array<double, 4> values_{};                ///< there
    fetex::FeaturePoint centre_;
    double centre_value_ = 0;
};

} // namespace fetexc::test
