// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/texel_arrangement.h"

#include <CGAL/Arr_vertical_decomposition_2.h>
#include <CGAL/Arrangement_2.h>

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "compiler/planar/filtered_arc_traits.h"
#include "compiler/planar/texel_plane.h"

namespace fetexc {
namespace {

using Traits = FilteredArcTraits<TexelPlane>;
using CgalArrangement = CGAL::Arrangement_2<Traits>;
using Vertex_handle = CgalArrangement::Vertex_const_handle;
using Halfedge_handle = CgalArrangement::Halfedge_const_handle;
using Face_handle = CgalArrangement::Face_const_handle;

/// What a wall meets that starts at a point: a piece, another point on its level, or nothing (a level edge runs there,
/// or it is outside of the texel).
struct Seen {
    std::uint32_t piece = kNone;
    PlanePoint point;
};

/// CGAL's answer, by our numbers.
struct Decomposition {
    std::vector<std::uint32_t> left_face, right_face; ///< per piece; kNone: outside
    std::vector<Seen> seen_left, seen_right;          ///< per point
};

Seen seen(const boost::optional<boost::variant<Vertex_handle, Halfedge_handle, Face_handle>>& feature) {
    if (!feature) return {};
    if (const auto* h = boost::get<Halfedge_handle>(&*feature)) return {(*h)->curve().piece, {}};
    if (const auto* v = boost::get<Vertex_handle>(&*feature)) return {kNone, (*v)->point()};
    return {};
}

Decomposition decomposed(TexelPlane& plane) {
    const Traits traits(plane);
    CgalArrangement arrangement(&traits);
    CGAL::insert_non_intersecting_curves(arrangement, plane.arcs().begin(), plane.arcs().end());

    const std::size_t pieces = plane.arcs().size(), points = plane.points().size();
    if (arrangement.number_of_edges() != pieces || arrangement.number_of_vertices() != points) throw UndecidedPlane{};
    Decomposition out{std::vector(pieces, kNone), std::vector(pieces, kNone), std::vector<Seen>(points),
                      std::vector<Seen>(points)};
    std::vector<Halfedge_handle> down(pieces);
    for (auto e = arrangement.edges_begin(); e != arrangement.edges_end(); ++e)
        down[e->curve().piece] = e->direction() == CGAL::ARR_LEFT_TO_RIGHT ? Halfedge_handle(e) : e->twin();
    std::unordered_map<const void*, std::uint32_t> faces; // numbered in the order of the pieces
    const auto number = [&](Face_handle f) {
        if (f->is_unbounded()) return kNone;
        return faces.try_emplace(&*f, static_cast<std::uint32_t>(faces.size())).first->second;
    };
    for (std::size_t p = 0; p < pieces; ++p) {
        out.left_face[p] = number(down[p]->twin()->face());
        out.right_face[p] = number(down[p]->face());
    }
    using Feature = boost::optional<boost::variant<Vertex_handle, Halfedge_handle, Face_handle>>;
    std::vector<std::pair<Vertex_handle, std::pair<Feature, Feature>>> walls;
    CGAL::decompose(arrangement, std::back_inserter(walls));
    for (const auto& [vertex, features] : walls) {
        out.seen_left[vertex->point().id] = seen(features.first);
        out.seen_right[vertex->point().id] = seen(features.second);
    }
    return out;
}

/// From walls and faces to what the compiler reads.
class Reader {
  public:
    Reader(TexelPlane& plane, Decomposition found, SweepResult& out)
        : plane_(plane), found_(std::move(found)), out_(out), in_(plane.points().size()), down_(plane.points().size()),
          left_(plane.points().size(), kNone), right_(plane.points().size(), kNone), open_(plane.arcs().size(), kNone) {
    }

    void run() {
        collect_pieces();
        resolve_walls();
        out_ = {};
        std::uint32_t faces = 0;
        for (const std::uint32_t f : found_.right_face)
            faces = std::max(faces, f == kNone ? 0 : f + 1);
        out_.faces.resize(faces);
        std::iota(out_.faces.begin(), out_.faces.end(), 0u);
        for (std::uint32_t k = 0; k < plane_.points().size(); ++k)
            at_point(k);
        read_sides();
    }

  private:
    /// Pieces that end and start at each point, from left to right.
    void collect_pieces() {
        for (const PlaneArc& c : plane_.arcs()) {
            down_[c.min.id].push_back(c.piece);
            in_[c.max.id].push_back(c.piece);
        }
        const auto arcs = plane_.arcs();
        for (std::uint32_t k = 0; k < in_.size(); ++k) {
            std::sort(in_[k].begin(), in_[k].end(), [&](std::uint32_t a, std::uint32_t b) {
                return a != b && plane_.compare_before(arcs[a], arcs[b], {k}) < 0;
            });
            std::sort(down_[k].begin(), down_[k].end(), [&](std::uint32_t a, std::uint32_t b) {
                return a != b && plane_.compare_after(arcs[a], arcs[b], {k}) < 0;
            });
        }
    }

    [[nodiscard]] bool is_level(std::uint32_t piece) const { return plane_.is_vertical(plane_.arcs()[piece]); }

    /// The pieces beside each point when levels fall slightly to the right: a wall that meets a point on its level goes
    /// on to what starts (to the left) or ends (to the right) there, or beyond it.
    void resolve_walls() {
        const auto n = static_cast<std::uint32_t>(in_.size());
        for (std::uint32_t k = 0; k < n; ++k) {
            const Seen& s = found_.seen_left[k];
            left_[k] = s.piece;
            if (s.point.id != kNone) {
                left_[k] = down_[s.point.id].empty() ? left_[s.point.id] : down_[s.point.id].back();
            } else if (!in_[k].empty() && is_level(in_[k].front())) {
                const std::uint32_t from = plane_.arcs()[in_[k].front()].min.id;
                const std::vector<std::uint32_t>& there = down_[from];
                left_[k] = there.size() < 2 ? left_[from] : there[there.size() - 2];
            }
        }
        for (std::uint32_t k = n; k-- > 0;) {
            const Seen& s = found_.seen_right[k];
            right_[k] = s.piece;
            if (s.point.id != kNone) {
                right_[k] = in_[s.point.id].empty() ? right_[s.point.id] : in_[s.point.id].front();
            } else if (!down_[k].empty() && is_level(down_[k].back())) {
                const std::uint32_t to = plane_.arcs()[down_[k].back()].max.id;
                right_[k] = in_[to].size() < 2 ? right_[to] : in_[to][1];
            }
        }
    }

    [[nodiscard]] std::uint32_t edge(std::uint32_t piece) const { return plane_.is_edge(piece) ? piece : kNone; }

    void at_point(std::uint32_t k) {
        const std::uint32_t node = plane_.points()[k].node;
        std::uint32_t going_on = kNone; // a trapezoid that a corner without a node doesn't end
        for_each_gap(k, in_[k], [&](std::uint32_t left, std::uint32_t right) {
            const std::uint32_t t = open_[left];
            if (t == kNone || out_.trapezoids[t].right != edge(right)) throw UndecidedPlane{};
            out_.trapezoids[t].bottom_node = node;
            open_[left] = kNone;
            if (node == kNone) going_on = t;
        });
        for_each_gap(k, down_[k], [&](std::uint32_t left, std::uint32_t right) {
            if (going_on == kNone) {
                open_[left] = static_cast<std::uint32_t>(out_.trapezoids.size());
                out_.trapezoids.push_back({edge(left), edge(right), node, kNone, found_.right_face[left]});
            } else {
                open_[left] = going_on;
            }
        });
        for (const std::uint32_t piece : down_[k]) {
            if (plane_.is_edge(piece)) add_portion(piece, plane_.points()[k].y == 0);
        }
    }

    /// visit(left piece, right piece) for the gaps inside the texel beside and between some pieces at a point.
    template <class Visit>
    void for_each_gap(std::uint32_t k, const std::vector<std::uint32_t>& pieces, const Visit& visit) const {
        for (std::size_t i = 0; i <= pieces.size(); ++i) {
            const std::uint32_t left = i == 0 ? left_[k] : pieces[i - 1];
            const std::uint32_t right = i == pieces.size() ? right_[k] : pieces[i];
            const std::uint32_t face = left == kNone ? kNone : found_.right_face[left];
            if (face != (right == kNone ? kNone : found_.left_face[right])) throw UndecidedPlane{};
            if (face != kNone) visit(left, right);
        }
    }

    void add_portion(std::uint32_t piece, bool from_top) {
        Portion p;
        p.edge = piece, p.left = found_.left_face[piece], p.right = found_.right_face[piece];
        if (from_top) p.rank = top_edges_++;
        out_.portions.push_back(p);
    }

    void read_sides() {
        for (const TexelSide s : {TexelSide::Top, TexelSide::Bottom, TexelSide::Left, TexelSide::Right}) {
            const auto [first, end] = plane_.side(s);
            const bool inside_is_right = s == TexelSide::Left || s == TexelSide::Bottom;
            for (std::uint32_t piece = first; piece < end; ++piece) {
                const std::uint32_t node = plane_.points()[plane_.arcs()[piece].min.id].node;
                out_.sides[static_cast<std::size_t>(s)].push_back(
                    {piece == first ? kNone : node,
                     inside_is_right ? found_.right_face[piece] : found_.left_face[piece]});
            }
        }
        out_.first_face = out_.sides[static_cast<std::size_t>(TexelSide::Left)].front().face;
    }

    TexelPlane& plane_;
    Decomposition found_;
    SweepResult& out_;
    std::vector<std::vector<std::uint32_t>> in_, down_; ///< per point: pieces that end, that start there
    std::vector<std::uint32_t> left_, right_;           ///< per point: pieces beside it
    std::vector<std::uint32_t> open_;                   ///< per piece: the open trapezoid to its right
    std::uint32_t top_edges_ = 0;
};

} // namespace

bool TexelArrangement::run(std::span<const SubEdge> sub_edges, const SweepGraph& graph, TexelFrame frame,
                           SweepResult& out) {
    try {
        TexelPlane plane(map_, order_, stats_, sub_edges, graph, frame);
        Reader(plane, decomposed(plane), out).run();
        return true;
    } catch (const UndecidedPlane&) {
        return false;
    }
}

} // namespace fetexc
