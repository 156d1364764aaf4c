// SPDX-License-Identifier: GPL-3.0-or-later
/// The local optimisation problem of a texel (Parilov and Zorin 2008, §4, Eq. 2-3): least thin-plate energy of its
/// curved segments and those that go on in the four texels beside it.
///
/// Variables: positions of the texel's points along their edges; the middle control points of its segments; how far the
/// middle control points of the neighbours' segments are from their other ends, along the tangents there, which stay.
/// Constraints: one tangent at each of the points. Bounds: all middle points inside their texels, by kFeatureMargin. A
/// straight segment that ends at a point holds it, and is its tangent. Points where nothing goes on stay where they
/// are.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "compiler/feature_curves/signatures.h"
#include "compiler/feature_curves/sqp.h"

namespace fetexc {

/// What straight segments do at an edge's point, those of both texels.
struct StraightEnds {
    bool any = false;
    std::optional<double> angle; ///< their direction, if they have one
};
StraightEnds straight_ends(const SnappedCurves& curves, std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e);

/// The texel across an edge, and which edge it is there. None: the border.
struct Beside {
    std::uint32_t i = 0, j = 0;
    fetex::FeatureEdge edge{};
};
std::optional<Beside> across(const SnappedCurves& curves, std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e);

/// A point that depends linearly on two variables at most; local coordinates of the texel, also of those beside it.
struct MovablePoint {
    fetex::FeaturePoint base;
    std::array<int, 2> variable = {-1, -1};
    std::array<fetex::FeaturePoint, 2> by{};

    template <class T> [[nodiscard]] std::array<T, 2> at(const T* x) const {
        std::array<T, 2> p = {T(base.x), T(base.y)};
        for (std::size_t k = 0; k < variable.size() && variable[k] >= 0; ++k)
            p[0] += by[k].x * x[variable[k]], p[1] += by[k].y * x[variable[k]];
        return p;
    }
};

/// A segment of the texel across the edge ends there too.
bool goes_on(const SnappedCurves& curves, std::uint32_t i, std::uint32_t j, fetex::FeatureEdge e);

class LocalProblem : public sqp::Problem {
  public:
    /// Of a texel with curved segments; their middle points stay `margin` inside.
    LocalProblem(const SnappedCurves& curves, std::uint32_t i, std::uint32_t j, double margin);

    /// Something of it can move, and no neighbour's tangent keeps its middle point out of its texel.
    [[nodiscard]] bool open() const { return open_; }
    /// As solve() has it.
    [[nodiscard]] sqp::Task task() const;
    /// From the signature as it is, moved within the bounds; if that leads nowhere, from the middle of the bounds.
    [[nodiscard]] std::optional<sqp::Vector> solve() const;
    /// Eq. 3 of all segments.
    [[nodiscard]] double energy(const sqp::Vector& x) const;
    void constraints(const sqp::Vector& x, sqp::Values& values, sqp::Jacobian& jacobian) const override;
    void add_curvature(const sqp::Values& weights, sqp::Matrix& to) const override;
    /// Positions and angles of the texel's points.
    void apply(const sqp::Vector& x, SnappedCurves& curves) const;

  private:
    struct Point {
        fetex::FeatureEdge edge{};
        MovablePoint at;
        std::optional<double> angle; ///< held
    };
    struct Segment {
        std::array<MovablePoint, 3> points;
    };
    /// Control points of the curved segments that end at the point.
    struct Handle {
        std::size_t point = 0, segment = 0;
    };
    /// A direction, or a handle, along which another handle has to be.
    struct Tangency {
        std::size_t point = 0, segment = 0;
        std::optional<std::size_t> like;
    };

    /// A tangency as value + slopes·x + x·bends·x/2.
    struct Expansion {
        struct Slope {
            Eigen::Index variable = 0;
            double value = 0;
        };
        struct Bend {
            Eigen::Index row = 0, column = 0;
            double value = 0;
        };
        double value = 0;
        std::vector<Slope> slopes;
        std::vector<Bend> bends;
    };

    std::size_t add_point(const SnappedCurves& curves, fetex::FeatureEdge e);
    void add_inner(const SnappedCurves& curves, std::uint32_t k);
    void add_outer(const SnappedCurves& curves, std::size_t point);
    void add_tangencies();
    void expand_tangencies();
    [[nodiscard]] double angle_at(std::size_t point, const sqp::Vector& x) const;
    void straighten_flat(std::size_t segment, const sqp::Vector& x, SnappedCurves& curves) const;
    int add_variable(double low, double high, double start);
    [[nodiscard]] const MovablePoint& middle(std::size_t segment) const { return segments_[segment].points[1]; }
    template <class T> [[nodiscard]] T tangency(const Tangency& t, const T* x) const;
    template <class T> [[nodiscard]] std::array<T, 2> bend(const Segment& s, const T* x) const;

    std::uint32_t i_, j_;
    double margin_;
    bool open_ = false;
    std::vector<Point> points_;
    std::vector<Segment> segments_; ///< the texel's, then those beside it
    std::size_t inner_ = 0;         ///< how many are the texel's
    std::vector<Handle> handles_;
    std::vector<Tangency> tangencies_;
    std::vector<Expansion> expansions_;
    std::vector<double> low_, high_, start_;
};

} // namespace fetexc
