// SPDX-License-Identifier: GPL-3.0-or-later
/// A model of CGAL's ArrangementTraits_2 for our monotone arcs (DESIGN §5.5). It only translates: every question goes
/// to a plane, whose predicates are filtered and never guess.
///
/// CGAL's x is the plane's first coordinate and its y the second one. A plane that gives y first and x second makes
/// CGAL's vertical decomposition the horizontal one that texels need.
#pragma once

#include <CGAL/Arr_tags.h>
#include <CGAL/enum.h>
#include <CGAL/tags.h>

#include <boost/variant.hpp>
#include <utility>
#include <vector>

#include "compiler/planar/plane_arc.h"

namespace fetexc {

/// Plane: what is not needed (intersect(), where nothing crosses) needn't be there as long as CGAL doesn't ask.
///
///     int compare_first(PlanePoint, PlanePoint);        sign of the difference of first coordinates
///     int compare(PlanePoint, PlanePoint);              … and of second ones where those are equal
///     bool is_vertical(const PlaneArc&);                all first coordinates are equal
///     int compare_at(PlanePoint, const PlaneArc&);      side of an arc whose first coordinates comprise the point's
///     int compare_after(const PlaneArc&, const PlaneArc&, PlanePoint);    side of the second arc on which the first
///     one int compare_before(const PlaneArc&, const PlaneArc&, PlanePoint);   leaves / reaches a common point void
///     intersect(const PlaneArc&, const PlaneArc&, std::vector<PlanePoint>&);   ascending; arcs never overlap
template <class Plane> class FilteredArcTraits {
  public:
    using Point_2 = PlanePoint;
    using X_monotone_curve_2 = PlaneArc;
    using Curve_2 = PlaneArc;
    using Multiplicity = unsigned;
    using Has_left_category = CGAL::Tag_true;
    using Has_merge_category = CGAL::Tag_true;
    using Has_do_intersect_category = CGAL::Tag_false;
    using Left_side_category = CGAL::Arr_oblivious_side_tag;
    using Right_side_category = CGAL::Arr_oblivious_side_tag;
    using Bottom_side_category = CGAL::Arr_oblivious_side_tag;
    using Top_side_category = CGAL::Arr_oblivious_side_tag;

    FilteredArcTraits() = default; // CGAL copies its traits
    explicit FilteredArcTraits(Plane& plane) : plane_(&plane) {}

    static CGAL::Comparison_result result(int sign) {
        return sign < 0 ? CGAL::SMALLER : sign > 0 ? CGAL::LARGER : CGAL::EQUAL;
    }

    struct Compare_x_2 {
        Plane* plane;
        CGAL::Comparison_result operator()(PlanePoint p, PlanePoint q) const {
            return result(plane->compare_first(p, q));
        }
    };
    struct Compare_xy_2 {
        Plane* plane;
        CGAL::Comparison_result operator()(PlanePoint p, PlanePoint q) const { return result(plane->compare(p, q)); }
    };
    struct Construct_min_vertex_2 {
        PlanePoint operator()(const PlaneArc& c) const { return c.min; }
    };
    struct Construct_max_vertex_2 {
        PlanePoint operator()(const PlaneArc& c) const { return c.max; }
    };
    struct Is_vertical_2 {
        Plane* plane;
        bool operator()(const PlaneArc& c) const { return plane->is_vertical(c); }
    };
    struct Compare_y_at_x_2 {
        Plane* plane;
        CGAL::Comparison_result operator()(PlanePoint p, const PlaneArc& c) const {
            return result(plane->compare_at(p, c));
        }
    };
    struct Compare_y_at_x_right_2 {
        Plane* plane;
        CGAL::Comparison_result operator()(const PlaneArc& a, const PlaneArc& b, PlanePoint p) const {
            return result(plane->compare_after(a, b, p));
        }
    };
    struct Compare_y_at_x_left_2 {
        Plane* plane;
        CGAL::Comparison_result operator()(const PlaneArc& a, const PlaneArc& b, PlanePoint p) const {
            return result(plane->compare_before(a, b, p));
        }
    };
    struct Equal_2 {
        Plane* plane;
        bool operator()(PlanePoint p, PlanePoint q) const { return plane->compare(p, q) == 0; }
        bool operator()(const PlaneArc& a, const PlaneArc& b) const {
            return a.piece == b.piece && (*this)(a.min, b.min) && (*this)(a.max, b.max);
        }
    };
    struct Make_x_monotone_2 {
        template <class Output> Output operator()(const PlaneArc& c, Output out) const {
            *out++ = boost::variant<PlanePoint, PlaneArc>(c);
            return out;
        }
    };
    struct Split_2 {
        void operator()(const PlaneArc& c, PlanePoint p, PlaneArc& before, PlaneArc& after) const {
            before = {c.piece, c.min, p}, after = {c.piece, p, c.max};
        }
    };
    struct Intersect_2 {
        Plane* plane;
        template <class Output> Output operator()(const PlaneArc& a, const PlaneArc& b, Output out) const {
            std::vector<PlanePoint> points;
            plane->intersect(a, b, points);
            for (const PlanePoint p : points) // multiplicity 0: not known, CGAL compares behind the point
                *out++ = boost::variant<std::pair<PlanePoint, Multiplicity>, PlaneArc>(std::pair(p, Multiplicity(0)));
            return out;
        }
    };
    struct Are_mergeable_2 {
        Plane* plane;
        bool operator()(const PlaneArc& a, const PlaneArc& b) const {
            const Equal_2 equal{plane};
            return a.piece == b.piece && (equal(a.max, b.min) || equal(b.max, a.min));
        }
    };
    struct Merge_2 {
        Plane* plane;
        void operator()(const PlaneArc& a, const PlaneArc& b, PlaneArc& c) const {
            c = plane->compare(a.max, b.min) == 0 ? PlaneArc{a.piece, a.min, b.max} : PlaneArc{a.piece, b.min, a.max};
        }
    };

    Compare_x_2 compare_x_2_object() const { return {plane_}; }
    Compare_xy_2 compare_xy_2_object() const { return {plane_}; }
    Construct_min_vertex_2 construct_min_vertex_2_object() const { return {}; }
    Construct_max_vertex_2 construct_max_vertex_2_object() const { return {}; }
    Is_vertical_2 is_vertical_2_object() const { return {plane_}; }
    Compare_y_at_x_2 compare_y_at_x_2_object() const { return {plane_}; }
    Compare_y_at_x_right_2 compare_y_at_x_right_2_object() const { return {plane_}; }
    Compare_y_at_x_left_2 compare_y_at_x_left_2_object() const { return {plane_}; }
    Equal_2 equal_2_object() const { return {plane_}; }
    Make_x_monotone_2 make_x_monotone_2_object() const { return {}; }
    Split_2 split_2_object() const { return {}; }
    Intersect_2 intersect_2_object() const { return {plane_}; }
    Are_mergeable_2 are_mergeable_2_object() const { return {plane_}; }
    Merge_2 merge_2_object() const { return {plane_}; }

  private:
    Plane* plane_ = nullptr;
};

} // namespace fetexc
