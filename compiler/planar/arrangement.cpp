// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/arrangement.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <tuple>

#include "compiler/diagnostics.h"
#include "compiler/geometry/precise.h"
#include "compiler/parallel.h"
#include "compiler/planar/box_pairs.h"
#include "compiler/planar/edges.h"
#include "compiler/planar/exact_points.h"

namespace fetexc {
namespace {

/// What the pair tests ask of an arc again and again.
struct ArcShape {
    Interval x, y; ///< bounds
    ControlPolygon polygon;
};

/// A vertex that couldn't be placed, and the pair it belongs to.
struct Undecided {
    IdPair pair;
    Vertex vertex;
};

/// What pairs have found. Fresh contacts count crossings; once those are vertices of the set, they name them (settle).
struct Found {
    std::vector<PairContact> contacts;
    std::vector<Vertex> crossing_points;
    std::vector<SharedSupport> shared;
    std::uint64_t box_pairs = 0, certified = 0, exact = 0, crossings = 0, exact_comparisons = 0;
    std::optional<Undecided> undecided; ///< the first one in the order of pairs
};

ArcShape shape_of(const ArcSet& set, const Arc& a) {
    const Vertex &p = set.vertices[a.v0], &q = set.vertices[a.v1];
    return {hull(p.x, q.x), hull(p.y, q.y), set.stretch_of(a)};
}

UnwrittenVector<ArcShape> shapes_of(const ArcSet& set, unsigned threads) {
    UnwrittenVector<ArcShape> shapes(set.arcs.size());
    parallel_for_chunks(shapes.size(), 512, threads, [&](std::size_t first, std::size_t end) {
        for (std::size_t k = first; k < end; ++k)
            shapes[k] = shape_of(set, set.arcs[k]);
    });
    return shapes;
}

bool within(const Interval& a, const Interval& b) { return b.lo <= a.lo && a.hi <= b.hi; }
bool flat(const Interval& v) { return v.lo == v.hi; }
bool is_line(const ArcSet& set, const Arc& a) { return set.curves[a.curve].degree == 1; }

class PairTest {
  public:
    PairTest(const ArcSet& set, std::span<const ArcShape> shapes, const SkipRules& skip, Found& out)
        : set_(set), shapes_(shapes), skip_(skip), out_(out) {}

    void operator()(const IdPair& pair) {
        const auto [ia, ib] = pair;
        const Arc &a = set_.arcs[ia], &b = set_.arcs[ib];
        pair_ = pair, place_ = 0;
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
    /// Shared vertices and end points on the other arc. False: it is clear that there is nothing else.
    bool collect_known(std::uint32_t ia, std::uint32_t ib, const Arc& a, const Arc& b) {
        const ArcShape &ba = shapes_[ia], &bb = shapes_[ib];
        const Interval ox(std::max(ba.x.lo, bb.x.lo), std::min(ba.x.hi, bb.x.hi));
        const Interval oy(std::max(ba.y.lo, bb.y.lo), std::min(ba.y.hi, bb.y.hi));
        for (const auto& [va, ta] : {std::pair(a.v0, a.t0), std::pair(a.v1, a.t1)}) {
            for (const auto& [vb, tb] : {std::pair(b.v0, b.t0), std::pair(b.v1, b.t1)}) {
                if (va != vb) continue;
                if (is_line(set_, a) && is_line(set_, b)) return false; // collinear ones don't overlap (arcs.h)
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
            out_.contacts.push_back({ia, ib, v, place_++, false, c});
        }
    }

    void decide_exactly(std::uint32_t ia, std::uint32_t ib, const Stretch& sa, const Stretch& sb) {
        const Arc &a = set_.arcs[ia], &b = set_.arcs[ib];
        SupportMap map;
        if (same_support(set_.curves[a.curve], set_.curves[b.curve], map)) {
            out_.shared.push_back({std::min(a.curve, b.curve), std::max(a.curve, b.curve)});
            // Once joined they overlap no more, but where the support crosses itself they still meet.
            if (const auto p = double_point_between(sa, sb, map.alpha < 0)) add(ia, ib, {p->s, p->t}, &p->narrow);
            return;
        }
        std::vector<ExactHit> hits;
        if (intersect_exact(sa, sb, hits, known_) != ExactOutcome::Done) report(set_.vertices[a.v0]);
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
        const auto index = static_cast<std::uint32_t>(out_.crossing_points.size());
        ++out_.crossings;
        out_.contacts.push_back({ia, ib, index, place_++, true, c});
        out_.crossing_points.push_back(std::move(crossing));
    }

    /// A contact is enclosed in parameters of the whole curves; the arc may end before it.
    bool beyond_an_end(const Arc& arc, const Vertex& crossing, const Interval& t) {
        return (t.lo <= arc.t0.hi && compare_on_arc(arc, crossing, t, set_.vertices[arc.v0], arc.t0) < 0) ||
               (t.hi >= arc.t1.lo && compare_on_arc(arc, crossing, t, set_.vertices[arc.v1], arc.t1) > 0);
    }

    int compare_on_arc(const Arc& arc, const Vertex& p, const Interval& tp, const Vertex& q, const Interval& tq) {
        const std::optional<int> c = compare_along(set_, arc, p, tp, q, tq, out_.exact_comparisons);
        if (!c) report(p);
        return c.value_or(0);
    }

    void report(const Vertex& vertex) {
        if (!out_.undecided || pair_ < out_.undecided->pair) out_.undecided = {pair_, vertex};
    }

    const ArcSet& set_;
    std::span<const ArcShape> shapes_;
    const SkipRules& skip_;
    Found& out_;
    IdPair pair_;
    std::uint32_t place_ = 0;
    std::vector<Contact> known_, found_;
};

/// Boxes of the arcs that reach the canvas.
std::vector<BoxItem> canvas_boxes(const Grid& grid, std::span<const ArcShape> shapes) {
    std::vector<BoxItem> items;
    const double right = static_cast<double>(grid.right()), bottom = static_cast<double>(grid.bottom());
    for (std::uint32_t i = 0; i < shapes.size(); ++i) {
        const ArcShape& b = shapes[i];
        if (b.x.hi < 0 || b.x.lo > right || b.y.hi < 0 || b.y.lo > bottom) continue;
        items.push_back({b.x.lo, b.y.lo, b.x.hi, b.y.hi, i, kNoFan});
    }
    return items;
}

std::uint64_t pairs_among(std::uint64_t n) { return n * (n - 1) / 2; }

/// Lines that end in one point meet nowhere else: collinear ones are cut at each other's ends (arcs.h). Where so many
/// do that going through all boxes is less work than going through their pairs, they become a fan. Returns the number
/// of pairs inside fans.
std::uint64_t group_fans(const ArcSet& set, std::vector<BoxItem>& items) {
    constexpr std::uint64_t gain = 32; // pairs in the time that a box takes
    const auto worth = [&](std::uint64_t lines) { return pairs_among(lines) > gain * items.size(); };
    std::vector<std::uint32_t> lines_at(set.vertices.size(), 0), in_fan(set.vertices.size(), 0);
    for (const BoxItem& item : items) {
        const Arc& a = set.arcs[item.id];
        if (is_line(set, a)) ++lines_at[a.v0], ++lines_at[a.v1];
    }
    if (std::none_of(lines_at.begin(), lines_at.end(), worth)) return 0;
    for (BoxItem& item : items) {
        const Arc& a = set.arcs[item.id];
        const std::uint32_t hub = lines_at[a.v0] >= lines_at[a.v1] ? a.v0 : a.v1;
        if (is_line(set, a) && worth(lines_at[hub])) item.fan = hub, ++in_fan[hub];
    }
    for (BoxItem& item : items) {
        if (item.fan != kNoFan && !worth(in_fan[item.fan])) item.fan = kNoFan;
    }
    std::uint64_t pairs = 0;
    for (std::uint64_t lines : in_fan)
        pairs += worth(lines) ? pairs_among(lines) : 0;
    return pairs;
}

/// Joins what parts found; afterwards fresh contacts count the crossings of all.
void append(Found& all, Found& part) {
    const auto first = static_cast<std::uint32_t>(all.crossing_points.size());
    for (PairContact& c : part.contacts) {
        if (c.fresh) c.vertex += first;
    }
    std::move(part.crossing_points.begin(), part.crossing_points.end(), std::back_inserter(all.crossing_points));
    all.contacts.insert(all.contacts.end(), part.contacts.begin(), part.contacts.end());
    all.shared.insert(all.shared.end(), part.shared.begin(), part.shared.end());
    all.certified += part.certified, all.exact += part.exact, all.crossings += part.crossings;
    all.exact_comparisons += part.exact_comparisons, all.box_pairs += part.box_pairs;
    if (part.undecided && (!all.undecided || part.undecided->pair < all.undecided->pair))
        all.undecided = part.undecided;
}

Found test_pairs(const ArcSet& set, std::span<const ArcShape> shapes, const BoxPairs& boxes, unsigned threads,
                 const SkipRules& skip) {
    std::vector<Found> parts(boxes.parts());
    parallel_for(parts.size(), threads, [&](std::size_t k) {
        PairTest test(set, shapes, skip, parts[k]);
        boxes.visit(k, [&](std::span<const IdPair> pairs) {
            for (const IdPair& p : pairs)
                test(p);
            parts[k].box_pairs += pairs.size();
        });
    });
    Found all;
    for (Found& part : parts)
        append(all, part);
    return all;
}

/// Sorts the contacts by pairs, whatever order these came in; crossings become vertices of the set in that order.
void settle(ArcSet& set, Found& found, unsigned threads) {
    std::vector<PairContact>& contacts = found.contacts;
    parallel_sort(contacts, threads, [](const PairContact& a, const PairContact& b) { return a.key() < b.key(); });
    set.vertices.reserve(set.vertices.size() + found.crossing_points.size());
    for (PairContact& c : contacts) {
        if (!c.fresh) continue;
        set.vertices.push_back(std::move(found.crossing_points[c.vertex]));
        c.vertex = static_cast<std::uint32_t>(set.vertices.size() - 1);
    }
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
        if (out.set.too_many_contributions) {
            return Error{ErrorClass::InvalidInput, diag::kSceneTooLarge,
                         "too many shapes have borders on one line or curve", ""};
        }
        const UnwrittenVector<ArcShape> shapes = shapes_of(out.set, threads);
        std::vector<BoxItem> boxes = canvas_boxes(grid, shapes);
        const std::uint64_t in_fans = skip.fans ? group_fans(out.set, boxes) : 0;
        Found found = test_pairs(out.set, shapes, BoxPairs(std::move(boxes)), threads, skip);
        std::sort(found.shared.begin(), found.shared.end());
        found.shared.erase(std::unique(found.shared.begin(), found.shared.end()), found.shared.end());
        const std::size_t known = shared.size();
        std::vector<SharedSupport> all;
        std::set_union(shared.begin(), shared.end(), found.shared.begin(), found.shared.end(), std::back_inserter(all));
        shared = std::move(all);
        if (shared.size() > known) continue;

        settle(out.set, found, threads);
        pass.exact_comparisons = found.exact_comparisons;
        std::optional<Vertex> undecided;
        if (out.set.undecided != kNone)
            undecided = out.set.vertices[out.set.undecided];
        else if (found.undecided)
            undecided = found.undecided->vertex;
        else
            undecided = cut_arcs(out, found.contacts, threads, pass);
        pass.box_pairs = found.box_pairs + in_fans;
        pass.pairs_certified = found.certified + in_fans, pass.pairs_exact = found.exact;
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
