// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/pair_check.h"

#include <algorithm>

#include "compiler/geometry/polynomial.h"
#include "compiler/planar/box_pairs.h"

namespace fetexc::test {
namespace {

Piece::End end_of(const ArcSet& set, std::uint32_t v, const Interval& t) {
    const Vertex& vertex = set.vertices[v];
    return {t, v, vertex.integral ? std::optional(vertex.point) : std::nullopt};
}

bool same_end(const Piece::End& a, const Piece::End& b) {
    return a.vertex == b.vertex || (a.point && b.point && *a.point == *b.point);
}

enum class Place { On, Unsure, Off };

/// Where a root lies against an end of the piece; sign: +1 at its start, −1 at its end.
Place against(const RationalRange& t, const Piece::End& end, int sign) {
    const mpq_class lo(end.t.lo), hi(end.t.hi);
    if (end.t.lo == end.t.hi && t.lo <= lo && lo <= t.hi) return Place::On; // known to 2^-192: the end itself
    if (t.lo > hi) return sign > 0 ? Place::On : Place::Off;
    if (t.hi < lo) return sign > 0 ? Place::Off : Place::On;
    return Place::Unsure;
}

Place place_on(const RationalRange& t, const Piece& piece) {
    const Place first = against(t, piece.first, 1), last = against(t, piece.last, -1);
    if (first == Place::Off || last == Place::Off) return Place::Off;
    return first == Place::On && last == Place::On ? Place::On : Place::Unsure;
}

/// A contact's enclosure may reach beyond the piece; so does the kernel's search.
Stretch widened(const Piece& p) {
    Stretch s = p.stretch;
    s.range = {s.range.lo - budget::kBesideRange, s.range.hi + budget::kBesideRange};
    return s;
}

bool within(const Interval& a, const Interval& b) { return b.lo <= a.lo && a.hi <= b.hi; }
bool flat(const Interval& v) { return v.lo == v.hi; }

/// Only the shared end has its abscissa, or its ordinate, on both pieces.
bool only_shared_end(const Piece& a, const Piece& b, const Interval& x, const Interval& y) {
    const Interval common_x(std::max(a.x.lo, b.x.lo), std::min(a.x.hi, b.x.hi));
    const Interval common_y(std::max(a.y.lo, b.y.lo), std::min(a.y.hi, b.y.hi));
    return (within(common_x, x) && !(flat(a.x) && flat(b.x))) || (within(common_y, y) && !(flat(a.y) && flat(b.y)));
}

void ends_on_other(const Piece& end, const Piece& on, bool end_is_a, std::vector<Contact>& known) {
    for (const Piece::End* e : {&end.first, &end.last}) {
        if (!e->point || same_end(*e, on.first) || same_end(*e, on.last)) continue;
        const std::optional<Interval> hit = point_on_stretch(on.stretch, *e->point);
        if (hit) known.push_back(end_is_a ? Contact{e->t, *hit} : Contact{*hit, e->t});
    }
}

bool encloses(const Contact& c, const ExactHit& h) { return c.s.overlaps(h.s) && c.t.overlaps(h.t); }

/// Two lines on one line have at most an end in common.
KernelHits hits_on_one_line(const Piece& a, const Piece& b) {
    KernelHits out;
    out.common_component = true;
    for (const Piece::End* p : {&a.first, &a.last}) {
        for (const Piece::End* q : {&b.first, &b.last})
            if (same_end(*p, *q)) out.required.push_back({p->t, q->t, {}});
    }
    return out;
}

/// Parameters of one curve that another piece of it may reach; the families' pieces overlap, so they are of one size.
constexpr int kReach = 64;

KernelHits hits_on_one_curve(const Piece& a, const Piece& b) {
    if (a.stretch.curve->degree < 2) return hits_on_one_line(a, b);
    KernelHits out;
    out.common_component = true;
    SupportMap map{1, 0, {}, {}};
    if (a.curve != b.curve && !same_support(*a.stretch.curve, *b.stretch.curve, map)) return out;
    // A's ends as parameters of B; rounded, which is far below the distances of parameters that differ.
    constexpr double near = budget::kBesideRange;
    const auto mapped = [&](const Interval& s) {
        const double t = map.alpha * s.mid() + map.beta;
        return Interval(t - near, t + near);
    };
    for (const Piece::End* p : {&a.first, &a.last}) {
        for (const Piece::End* q : {&b.first, &b.last})
            if (mapped(p->t).overlaps(q->t)) out.required.push_back({p->t, q->t, {}});
    }
    const double u = mapped(a.first.t).mid(), v = mapped(a.last.t).mid();
    const double lo = std::max(std::min(u, v), b.first.t.mid()), hi = std::min(std::max(u, v), b.last.t.mid());
    out.overlap = hi - lo > near;
    // The curve's double point, of which each piece may hold one branch.
    const auto branches =
        isolate_roots(double_point_polynomial(*a.stretch.curve), -kReach, kReach, 2 * budget::kRefineBits);
    for (std::size_t i = 0; i < branches.size() && branches.size() == 2; ++i) {
        const auto rounded = [](const std::pair<mpq_class, mpq_class>& t) {
            return Interval(widen_down(t.first.get_d()), widen_up(t.second.get_d()));
        };
        const Interval s = rounded(branches[i]), t = mapped(rounded(branches[1 - i]));
        if (s.overlaps(a.stretch.range) && t.overlaps(b.stretch.range)) out.required.push_back({s, t, {}});
    }
    return out;
}

std::string text(const char* what, const Interval& s, const Interval& t) {
    char buffer[160];
    std::snprintf(buffer, sizeof buffer, "%s at s = %.17g, t = %.17g; ", what, s.mid(), t.mid());
    return buffer;
}

} // namespace

std::vector<Piece> pieces_of(const ArcSet& set) {
    std::vector<Piece> pieces;
    for (const Arc& a : set.arcs) {
        const Vertex &p = set.vertices[a.v0], &q = set.vertices[a.v1];
        pieces.push_back({set.stretch_of(a), end_of(set, a.v0, a.t0), end_of(set, a.v1, a.t1), hull(p.x, q.x),
                          hull(p.y, q.y), a.curve});
    }
    return pieces;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> box_pairs_of(const std::vector<Piece>& pieces, const Grid& grid) {
    const Interval canvas_x(0, static_cast<double>(grid.right())), canvas_y(0, static_cast<double>(grid.bottom()));
    std::vector<BoxItem> items;
    for (std::uint32_t i = 0; i < pieces.size(); ++i)
        if (pieces[i].x.overlaps(canvas_x) && pieces[i].y.overlaps(canvas_y))
            items.push_back({pieces[i].x.lo, pieces[i].y.lo, pieces[i].x.hi, pieces[i].y.hi, i, kNoFan});
    std::vector<IdPair> all;
    const BoxPairs boxes(items);
    for (std::size_t part = 0; part < boxes.parts(); ++part)
        boxes.visit(part, [&](std::span<const IdPair> pairs) { all.insert(all.end(), pairs.begin(), pairs.end()); });
    return all;
}

KernelHits kernel_hits(const Piece& a, const Piece& b) {
    if (a.curve == b.curve) return hits_on_one_curve(a, b);
    std::vector<ExactHit> all;
    const ExactOutcome outcome = intersect_by_kernel(widened(a), widened(b), all);
    if (outcome == ExactOutcome::CommonComponent) return hits_on_one_curve(a, b);
    KernelHits out;
    out.decided = outcome == ExactOutcome::Done;
    for (const ExactHit& h : all) {
        const Place on_a = place_on(h.narrow.s, a), on_b = place_on(h.narrow.t, b);
        (on_a == Place::On && on_b == Place::On ? out.required : out.allowed).push_back(h);
    }
    return out;
}

FilterAnswer filter_answer(const Piece& a, const Piece& b) {
    FilterAnswer out;
    std::vector<Contact> known;
    for (const Piece::End* p : {&a.first, &a.last}) {
        for (const Piece::End* q : {&b.first, &b.last}) {
            if (!same_end(*p, *q)) continue;
            known.push_back({p->t, q->t});
            const bool is_first = p == &a.first;
            const Interval x = value_over(*a.stretch.curve, Axis::X, is_first ? a.first.t : a.last.t);
            const Interval y = value_over(*a.stretch.curve, Axis::Y, is_first ? a.first.t : a.last.t);
            out.by_boxes =
                out.by_boxes || only_shared_end(a, b, p->point ? Interval(static_cast<double>(p->point->x)) : x,
                                                p->point ? Interval(static_cast<double>(p->point->y)) : y);
        }
    }
    ends_on_other(a, b, true, known);
    ends_on_other(b, a, false, known);
    out.contacts = known;
    out.outcome = intersect_certified(a.stretch, b.stretch, known, out.contacts);
    if (out.by_boxes) out.outcome = PairOutcome::Certified, out.contacts = known;
    return out;
}

std::string mismatch(const std::vector<Contact>& contacts, const KernelHits& hits) {
    if (!hits.decided) return "the kernel's answer is open";
    std::string wrong;
    for (const Contact& c : contacts) {
        const auto enclosed = [&](const ExactHit& h) { return encloses(c, h); };
        const auto count = std::count_if(hits.required.begin(), hits.required.end(), enclosed) +
                           std::count_if(hits.allowed.begin(), hits.allowed.end(), enclosed);
        if (count != 1) wrong += text(count == 0 ? "no common point" : "several common points", c.s, c.t);
    }
    for (const ExactHit& h : hits.required) {
        const auto count =
            std::count_if(contacts.begin(), contacts.end(), [&](const Contact& c) { return encloses(c, h); });
        if (count != 1) wrong += text(count == 0 ? "missed" : "found twice", h.s, h.t);
    }
    return wrong;
}

ArrangementContacts::ArrangementContacts(const Arrangement& arrangement) : along_(arrangement.set.arcs.size()) {
    for (const Edge& e : arrangement.edges) { // in order along each arc
        if (along_[e.arc].empty()) along_[e.arc].push_back({e.va, e.ta});
        along_[e.arc].push_back({e.vb, e.tb});
    }
}

std::vector<Contact> ArrangementContacts::operator()(std::uint32_t arc_a, std::uint32_t arc_b) const {
    std::vector<Contact> out;
    for (const OnPiece& p : along_[arc_a]) {
        for (const OnPiece& q : along_[arc_b])
            if (p.vertex == q.vertex) out.push_back({p.t, q.t});
    }
    return out;
}

} // namespace fetexc::test
