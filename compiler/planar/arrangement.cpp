// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/arrangement.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "compiler/diagnostics.h"
#include "compiler/geometry/precise.h"
#include "compiler/parallel.h"
#include "compiler/planar/arc_order.h"
#include "compiler/planar/box_pairs.h"
#include "compiler/planar/exact_points.h"

namespace fetexc {
namespace {

/// What the pair tests ask of an arc again and again.
struct ArcShape {
    Interval x, y; ///< bounds
    ControlPolygon polygon;
};

/// A common point of two arcs. vertex: an existing one, or kNone for a new one.
struct PairContact {
    std::uint32_t a = 0, b = 0;
    Contact at;
    std::uint32_t vertex = kNone;
    Vertex crossing; ///< the new one
};

/// What one chunk of pairs found; chunks are joined in order.
struct ChunkResult {
    std::vector<PairContact> contacts;
    std::vector<SharedSupport> shared;
    std::uint64_t certified = 0, exact = 0, crossings = 0, exact_comparisons = 0;
    std::optional<Vertex> undecided; ///< a vertex that couldn't be placed
};

ArcShape shape_of(const ArcSet& set, const Arc& a) {
    const Vertex &p = set.vertices[a.v0], &q = set.vertices[a.v1];
    return {hull(p.x, q.x), hull(p.y, q.y), set.stretch_of(a)};
}

bool within(const Interval& a, const Interval& b) { return b.lo <= a.lo && a.hi <= b.hi; }
bool flat(const Interval& v) { return v.lo == v.hi; }

class PairTest {
  public:
    PairTest(const ArcSet& set, const std::vector<ArcShape>& shapes, const SkipRules& skip, ChunkResult& out)
        : set_(set), shapes_(shapes), skip_(skip), out_(out) {}

    void operator()(std::uint32_t ia, std::uint32_t ib) {
        const Arc &a = set_.arcs[ia], &b = set_.arcs[ib];
        known_.clear(), found_.clear();
        if (!collect_known(ia, ib, a, b)) {
            ++out_.certified;
            return;
        }
        const ControlPolygon &pa = shapes_[ia].polygon, &pb = shapes_[ib].polygon;
        if (skip_.certificate && intersect_certified(pa, pb, known_, found_) == PairOutcome::Certified) {
            ++out_.certified;
        } else if (a.curve == b.curve) {
            ++out_.exact;
            cross_itself(ia, ib);
        } else {
            ++out_.exact;
            decide_exactly(ia, ib, pa.stretch, pb.stretch);
        }
        for (const Contact& c : found_)
            add(ia, ib, c, nullptr);
    }

  private:
    /// Shared vertices and end points on the other arc. False: the boxes show that there is nothing else.
    bool collect_known(std::uint32_t ia, std::uint32_t ib, const Arc& a, const Arc& b) {
        const ArcShape &ba = shapes_[ia], &bb = shapes_[ib];
        const Interval ox(std::max(ba.x.lo, bb.x.lo), std::min(ba.x.hi, bb.x.hi));
        const Interval oy(std::max(ba.y.lo, bb.y.lo), std::min(ba.y.hi, bb.y.hi));
        for (const auto& [va, ta] : {std::pair(a.v0, a.t0), std::pair(a.v1, a.t1)}) {
            for (const auto& [vb, tb] : {std::pair(b.v0, b.t0), std::pair(b.v1, b.t1)}) {
                if (va != vb) continue;
                known_.push_back({ta, tb});
                const Vertex& v = set_.vertices[va];
                // Only the shared vertex has that abscissa (ordinate) on an arc that isn't vertical (horizontal).
                const bool only_x = within(ox, v.x) && !(flat(ba.x) && flat(bb.x));
                const bool only_y = within(oy, v.y) && !(flat(ba.y) && flat(bb.y));
                if (skip_.shared_ends && (only_x || only_y)) return false;
            }
        }
        end_on_other(ia, ib, a, ib, true);
        end_on_other(ia, ib, b, ia, false);
        return true;
    }

    /// T-junctions: an integral end point of `end` in the interior of `on`.
    void end_on_other(std::uint32_t ia, std::uint32_t ib, const Arc& end, std::uint32_t other, bool end_is_a) {
        const Arc& on = set_.arcs[other];
        const ArcShape& shape = shapes_[other];
        const std::array<std::pair<std::uint32_t, Interval>, 2> ends{{{end.v0, end.t0}, {end.v1, end.t1}}};
        for (const auto& [v, t] : ends) {
            const Vertex& vertex = set_.vertices[v];
            if (!vertex.integral || v == on.v0 || v == on.v1) continue;
            if (!within(vertex.x, shape.x) || !within(vertex.y, shape.y)) continue;
            const std::optional<Interval> hit = point_on_stretch(shape.polygon, vertex.point);
            if (!hit || beyond_an_end(on, vertex, *hit)) continue;
            const Contact c = end_is_a ? Contact{t, *hit} : Contact{*hit, t};
            known_.push_back(c);
            out_.contacts.push_back({ia, ib, c, v, {}});
        }
    }

    void decide_exactly(std::uint32_t ia, std::uint32_t ib, const Stretch& sa, const Stretch& sb) {
        const Arc &a = set_.arcs[ia], &b = set_.arcs[ib];
        SupportMap map;
        if (same_support(set_.curves[a.curve], set_.curves[b.curve], map)) {
            out_.shared.push_back({std::min(a.curve, b.curve), std::max(a.curve, b.curve)});
            return;
        }
        std::vector<ExactHit> hits;
        if (intersect_exact(sa, sb, hits, known_) == ExactOutcome::Undecided && !out_.undecided)
            out_.undecided = set_.vertices[a.v0];
        for (const ExactHit& h : hits)
            add(ia, ib, {h.s, h.t}, &h.narrow); // a known one that is left turns out to be one vertex with it
    }

    /// Two stretches of one cubic: its double point is the only one they can share, beside an end.
    void cross_itself(std::uint32_t ia, std::uint32_t ib) {
        const Arc &a = set_.arcs[ia], &b = set_.arcs[ib];
        std::optional<ExactHit> p = double_point(set_.curves[a.curve]);
        if (!p) return;
        if (a.t0.mid() > b.t0.mid()) std::swap(p->s, p->t), std::swap(p->narrow.s, p->narrow.t);
        const bool inside = p->s.overlaps({a.t0.lo, a.t1.hi}) && p->t.overlaps({b.t0.lo, b.t1.hi});
        if (inside) add(ia, ib, {p->s, p->t}, &p->narrow);
    }

    void add(std::uint32_t ia, std::uint32_t ib, Contact c, const NarrowContact* narrow) {
        const Arc &a = set_.arcs[ia], &b = set_.arcs[ib];
        const PointEnclosure p = contact_point(set_.curves[a.curve], set_.curves[b.curve], c);
        Vertex crossing;
        crossing.x = p.x, crossing.y = p.y;
        crossing.a = a.curve, crossing.b = b.curve, crossing.s = c.s, crossing.t = c.t;
        if (narrow != nullptr) crossing.narrow = std::make_shared<const NarrowContact>(*narrow);
        if (beyond_an_end(a, crossing, c.s) || beyond_an_end(b, crossing, c.t)) return;
        ++out_.crossings;
        out_.contacts.push_back({ia, ib, c, kNone, std::move(crossing)});
    }

    /// A contact is enclosed in parameters of the whole curves; the arc may end before it.
    bool beyond_an_end(const Arc& arc, const Vertex& crossing, const Interval& t) {
        return (t.lo <= arc.t0.hi && compare_on_arc(set_, arc, crossing, t, set_.vertices[arc.v0], arc.t0, out_) < 0) ||
               (t.hi >= arc.t1.lo && compare_on_arc(set_, arc, crossing, t, set_.vertices[arc.v1], arc.t1, out_) > 0);
    }

    static int compare_on_arc(const ArcSet& set, const Arc& arc, const Vertex& p, const Interval& tp, const Vertex& q,
                              const Interval& tq, ChunkResult& out) {
        const std::optional<int> c = compare_along(set, arc, p, tp, q, tq, out.exact_comparisons);
        if (!c && !out.undecided) out.undecided = p;
        return c.value_or(0);
    }

    const ArcSet& set_;
    const std::vector<ArcShape>& shapes_;
    const SkipRules& skip_;
    ChunkResult& out_;
    std::vector<Contact> known_, found_;
};

/// Boxes of the arcs that reach the canvas.
std::vector<BoxItem> canvas_boxes(const Grid& grid, const std::vector<ArcShape>& shapes) {
    std::vector<BoxItem> items;
    const double right = static_cast<double>(grid.right()), bottom = static_cast<double>(grid.bottom());
    for (std::uint32_t i = 0; i < shapes.size(); ++i) {
        const ArcShape& b = shapes[i];
        if (b.x.hi < 0 || b.x.lo > right || b.y.hi < 0 || b.y.lo > bottom) continue;
        items.push_back({b.x.lo, b.y.lo, b.x.hi, b.y.hi, i});
    }
    return items;
}

ChunkResult test_pairs(const ArcSet& set, const std::vector<ArcShape>& shapes,
                       const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs, unsigned threads,
                       const SkipRules& skip) {
    constexpr std::size_t chunk = 1024;
    std::vector<ChunkResult> results((pairs.size() + chunk - 1) / chunk);
    parallel_for(results.size(), threads, [&](std::size_t k) {
        PairTest test(set, shapes, skip, results[k]);
        for (std::size_t i = k * chunk; i < std::min(pairs.size(), (k + 1) * chunk); ++i)
            test(pairs[i].first, pairs[i].second);
    });
    ChunkResult all;
    for (ChunkResult& r : results) {
        all.contacts.insert(all.contacts.end(), r.contacts.begin(), r.contacts.end());
        all.shared.insert(all.shared.end(), r.shared.begin(), r.shared.end());
        all.certified += r.certified, all.exact += r.exact, all.crossings += r.crossings;
        all.exact_comparisons += r.exact_comparisons, all.undecided = all.undecided ? all.undecided : r.undecided;
    }
    return all;
}

/// One vertex for every crossing.
void add_vertices(ArcSet& set, std::vector<PairContact>& contacts) {
    for (PairContact& c : contacts) {
        if (c.vertex != kNone) continue;
        c.vertex = static_cast<std::uint32_t>(set.vertices.size());
        set.vertices.push_back(c.crossing);
    }
}

// --- edges
// ------------------------------------------------------------------------------------------------------------------------

/// Vertices on each arc: its ends, and its contacts.
class ArcVertices {
  public:
    ArcVertices(const ArcSet& set, const std::vector<PairContact>& contacts)
        : set_(set), start_(set.arcs.size() + 1, 0) {
        for (const PairContact& c : contacts)
            ++start_[c.a + 1], ++start_[c.b + 1];
        std::partial_sum(start_.begin(), start_.end(), start_.begin());
        on_arc_.resize(start_.back());
        std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
        for (const PairContact& c : contacts) {
            on_arc_[next[c.a]++] = {c.vertex, c.at.s};
            on_arc_[next[c.b]++] = {c.vertex, c.at.t};
        }
    }

    void of(std::uint32_t arc, std::vector<OnArc>& out) const {
        const Arc& a = set_.arcs[arc];
        out.assign(on_arc_.begin() + start_[arc], on_arc_.begin() + start_[arc + 1]);
        out.push_back({a.v0, a.t0});
        out.push_back({a.v1, a.t1});
    }

  private:
    const ArcSet& set_;
    std::vector<std::uint32_t> start_;
    std::vector<OnArc> on_arc_;
};

/// Each representative takes the best that is known of its point.
void join_vertices(ArcSet& set, ArcOrder& order) {
    const auto meet = [](const Interval& a, const Interval& b) {
        const Interval m(std::max(a.lo, b.lo), std::min(a.hi, b.hi));
        return m.lo <= m.hi ? m : a;
    };
    for (std::uint32_t k = 0; k < set.vertices.size(); ++k) {
        const Vertex& v = set.vertices[k];
        Vertex& r = set.vertices[order.representative(k)];
        if (&v == &r || r.integral) continue;
        if (v.integral)
            r = v;
        else
            r.x = meet(r.x, v.x), r.y = meet(r.y, v.y);
    }
}

/// Cuts the arcs into edges. Returns a vertex whose place on some arc couldn't be decided.
std::optional<Vertex> cut_arcs(Arrangement& out, const std::vector<PairContact>& contacts, PlanarStats& stats) {
    const ArcVertices vertices(out.set, contacts);
    ArcOrder order(out.set, stats);
    std::vector<OnArc> on_arc;
    for (std::uint32_t arc = 0; arc < out.set.arcs.size(); ++arc) {
        vertices.of(arc, on_arc);
        order.sort(out.set.arcs[arc], on_arc);
        for (std::size_t k = 0; k + 1 < on_arc.size(); ++k)
            out.edges.push_back({arc, on_arc[k].t, on_arc[k + 1].t, on_arc[k].vertex, on_arc[k + 1].vertex});
    }
    for (Edge& e : out.edges)
        e.va = order.representative(e.va), e.vb = order.representative(e.vb);
    join_vertices(out.set, order);
    if (order.conflict()) return out.set.vertices[*order.conflict()];
    for (const Edge& e : out.edges) {
        if (e.va == e.vb) return out.set.vertices[e.va];
    }
    return {};
}

} // namespace

Result<Arrangement> arrange(const Scene& scene, const Grid& grid, unsigned threads, PlanarStats& stats,
                            const SkipRules& skip) {
    std::vector<SharedSupport> shared;
    // A pass that finds partial overlaps starts again with them joined; each pass adds at least one pair, real art
    // needs none or one.
    for (;;) {
        PlanarStats pass = {};
        Arrangement out;
        out.set = prepare_arcs(scene, grid, shared, pass, threads, skip);
        std::vector<ArcShape> shapes;
        shapes.reserve(out.set.arcs.size());
        for (const Arc& a : out.set.arcs)
            shapes.push_back(shape_of(out.set, a));
        const auto pairs = overlapping_pairs(canvas_boxes(grid, shapes));
        ChunkResult found = test_pairs(out.set, shapes, pairs, threads, skip);
        std::sort(found.shared.begin(), found.shared.end());
        found.shared.erase(std::unique(found.shared.begin(), found.shared.end()), found.shared.end());
        const std::size_t known = shared.size();
        for (const SharedSupport& s : found.shared) {
            if (std::find(shared.begin(), shared.end(), s) == shared.end()) shared.push_back(s);
        }
        if (shared.size() > known) continue;

        add_vertices(out.set, found.contacts);
        pass.exact_comparisons = found.exact_comparisons;
        std::optional<Vertex> undecided = found.undecided;
        if (out.set.undecided != kNone) undecided = out.set.vertices[out.set.undecided];
        if (!undecided) undecided = cut_arcs(out, found.contacts, pass);
        pass.box_pairs = pairs.size(), pass.pairs_certified = found.certified, pass.pairs_exact = found.exact;
        pass.overlaps = shared.size(), pass.crossings = found.crossings;
        pass.vertices = out.set.vertices.size(), pass.edges = out.edges.size();
        stats = pass;
        if (undecided) {
            return Error{ErrorClass::Runtime, diag::kPlanarInconsistent,
                         "the order of crossings along a curve can't be decided; please report this file",
                         grid.texel_name(undecided->x.mid(), undecided->y.mid())};
        }
        return out;
    }
}

} // namespace fetexc
