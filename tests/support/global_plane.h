// SPDX-License-Identifier: GPL-3.0-or-later
/// All arcs of a scene as CGAL sees them (planar/filtered_arc_traits.h), x first. Unlike in planar/arrangement nothing
/// is known before CGAL asks: which arcs to intersect, and what is one point, is found by its sweep.
///
/// Filters first (the certified intersection, enclosures, coordinates of 72 places), exact arithmetic for the rest;
/// nothing is decided by closeness.
#pragma once

#include <deque>
#include <map>
#include <unordered_map>

#include "compiler/planar/exact_points.h"
#include "compiler/planar/plane_arc.h"

namespace fetexc::test {

/// A question without an answer.
struct UndecidedGlobally {
    const char* question;
    double x, y;
};

struct RationalBox {
    RationalRange x, y;
};

class GlobalPlane {
  public:
    explicit GlobalPlane(const ArcSet& set);

    struct Counts {
        std::uint64_t pairs = 0, pairs_exact = 0, ends_exact = 0, coordinates = 0, coordinates_exact = 0, sides = 0,
                      sides_exact = 0;
    };
    [[nodiscard]] const Counts& counts() const { return counts_; }
    [[nodiscard]] PlaneArc arc(std::uint32_t piece);
    [[nodiscard]] const Vertex& vertex(PlanePoint p) const { return points_[p.id]; }

    int compare_first(PlanePoint p, PlanePoint q);
    int compare(PlanePoint p, PlanePoint q);
    [[nodiscard]] bool is_vertical(const PlaneArc& c) const { return vertical(c.piece); }
    int compare_at(PlanePoint p, const PlaneArc& c);
    int compare_after(const PlaneArc& a, const PlaneArc& b, PlanePoint p);
    int compare_before(const PlaneArc& a, const PlaneArc& b, PlanePoint p);
    void intersect(const PlaneArc& a, const PlaneArc& b, std::vector<PlanePoint>& out);

  private:
    struct OnPiece {
        std::uint32_t piece = 0;
        std::optional<Interval> t; ///< its parameter, where it is known
        std::uint32_t point = 0;   ///< defined on this piece's curve
    };
    [[nodiscard]] bool vertical(std::uint32_t piece) const;
    std::uint32_t find(std::uint32_t point);
    void unite(std::uint32_t a, std::uint32_t b);
    std::uint32_t add_point(const Vertex& v);
    void note(std::uint32_t representative, const OnPiece& o);
    [[nodiscard]] const OnPiece* on_piece(std::uint32_t point, std::uint32_t piece) const;
    int compare_coordinate(std::uint32_t a, std::uint32_t b, Axis axis);
    std::optional<int> compare_on_common_piece(std::uint32_t a, std::uint32_t b, Axis axis);
    int compare_coordinate_exactly(std::uint32_t a, std::uint32_t b, Axis axis);
    const std::optional<FixedPoint>& fixed_of(std::uint32_t point);
    const AlgebraicCoordinate& coordinate(std::uint32_t point, Axis axis);
    const RationalBox& box(std::uint32_t point, int bits);

    int compare_at_exactly(std::uint32_t p, std::uint32_t piece);
    bool on_algebraic_curve(const Vertex& v, std::uint32_t curve);
    int side_by_box(std::uint32_t p, std::uint32_t piece, int bits);
    int order_between(const PlaneArc& a, const PlaneArc& b, PlanePoint from, PlanePoint to);

    const std::vector<PlanePoint>& common_points(std::uint32_t a, std::uint32_t b);
    bool known_contacts(const Arc& a, const Arc& b);
    void end_on_other(std::uint32_t end, std::uint32_t on, bool end_is_a);
    void intersect_pieces(std::uint32_t a, std::uint32_t b);
    void intersect_exactly(std::uint32_t a, std::uint32_t b);
    void add_contact(std::uint32_t a, std::uint32_t b, Contact c, const NarrowContact* narrow);
    bool within(const Arc& arc, const Vertex& v, const Interval& t);
    [[noreturn]] void undecided(const char* question, std::uint32_t point) const;

    const ArcSet& set_;
    std::deque<Vertex> points_; ///< the set's vertices, then what was found
    std::vector<std::uint32_t> parent_;
    std::deque<std::vector<OnPiece>> lies_on_; ///< per representative
    std::unordered_map<std::uint32_t, std::optional<FixedPoint>> fixed_;
    std::map<std::pair<std::uint32_t, Axis>, AlgebraicCoordinate> coordinates_;
    std::map<std::pair<std::uint32_t, int>, RationalBox> boxes_;
    std::map<std::tuple<std::uint32_t, std::uint32_t, Axis>, int> compared_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<PlanePoint>> common_;
    std::vector<Contact> known_, found_;
    std::vector<PlanePoint> contacts_; ///< of the pair at hand
    Counts counts_;
};

} // namespace fetexc::test
