// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/global_plane.h"

#include <algorithm>
#include <array>
#include <memory>

#include "compiler/geometry/intersect.h"

namespace fetexc::test {
namespace {

const Interval& along(const Vertex& v, Axis axis) { return axis == Axis::X ? v.x : v.y; }

int sign_of(Fixed v) { return v > 0 ? 1 : v < 0 ? -1 : 0; }

/// Position where the stretch passes an abscissa.
Interval y_at(const Stretch& s, double x) {
    return value_over(*s.curve, Axis::Y, parameter_at(*s.curve, Axis::X, s.range, s.x_increasing, x));
}

std::optional<FixedPoint> certain_fixed(const ArcSet& set, const Vertex& v) {
    if (v.integral) return fixed(v.point);
    if (v.b == kNone) return fixed_extremum(set.curves[v.a], v.s);
    const std::optional<NarrowContact> narrow =
        v.narrow ? std::optional(*v.narrow) : narrow_contact(set.curves[v.a], set.curves[v.b], {v.s, v.t});
    return narrow ? std::optional(fixed_contact(set.curves[v.a], *narrow)) : std::nullopt;
}

} // namespace

GlobalPlane::GlobalPlane(const ArcSet& set) : set_(set) {
    for (const Vertex& v : set.vertices)
        add_point(v);
    for (std::uint32_t k = 0; k < set.arcs.size(); ++k) {
        note(set.arcs[k].v0, {k, set.arcs[k].t0, set.arcs[k].v0});
        note(set.arcs[k].v1, {k, set.arcs[k].t1, set.arcs[k].v1});
    }
}

PlaneArc GlobalPlane::arc(std::uint32_t piece) {
    const PlanePoint a{set_.arcs[piece].v0}, b{set_.arcs[piece].v1};
    return compare(a, b) < 0 ? PlaneArc{piece, a, b} : PlaneArc{piece, b, a};
}

void GlobalPlane::undecided(const char* question, std::uint32_t point) const {
    throw UndecidedGlobally{question, points_[point].x.mid(), points_[point].y.mid()};
}

bool GlobalPlane::vertical(std::uint32_t piece) const {
    const Curve& c = set_.curves[set_.arcs[piece].curve];
    return c.degree == 1 && c.x.magnitude == 0;
}

// --- points

std::uint32_t GlobalPlane::add_point(const Vertex& v) {
    const auto k = static_cast<std::uint32_t>(points_.size());
    points_.push_back(v);
    parent_.push_back(k);
    lies_on_.emplace_back();
    return k;
}

std::uint32_t GlobalPlane::find(std::uint32_t point) {
    while (parent_[point] != point)
        point = parent_[point] = parent_[parent_[point]];
    return point;
}

/// Two points turned out to be one. An integer point stays, for what it saves.
void GlobalPlane::unite(std::uint32_t a, std::uint32_t b) {
    if (points_[b].integral) std::swap(a, b);
    parent_[b] = a;
    for (const OnPiece& o : lies_on_[b])
        note(a, o);
}

void GlobalPlane::note(std::uint32_t representative, const OnPiece& o) {
    for (OnPiece& there : lies_on_[representative]) {
        if (there.piece != o.piece) continue;
        if (!there.t) there = o;
        return;
    }
    lies_on_[representative].push_back(o);
}

const GlobalPlane::OnPiece* GlobalPlane::on_piece(std::uint32_t point, std::uint32_t piece) const {
    for (const OnPiece& o : lies_on_[point]) {
        if (o.piece == piece) return &o;
    }
    return nullptr;
}

int GlobalPlane::compare_first(PlanePoint p, PlanePoint q) {
    return compare_coordinate(find(p.id), find(q.id), Axis::X);
}

int GlobalPlane::compare(PlanePoint p, PlanePoint q) {
    const std::uint32_t a = find(p.id), b = find(q.id);
    if (const int c = compare_coordinate(a, b, Axis::X); c != 0) return c;
    const int c = compare_coordinate(a, b, Axis::Y);
    if (c == 0 && a != b) unite(a, b);
    return c;
}

int GlobalPlane::compare_coordinate(std::uint32_t a, std::uint32_t b, Axis axis) {
    if (a == b) return 0;
    ++counts_.coordinates;
    const Interval &u = along(points_[a], axis), &v = along(points_[b], axis);
    if (const int c = fetexc::compare(u, v); c != 0) return c;
    if (u.lo == u.hi && v.lo == v.hi) return 0;
    if (a > b) return -compare_coordinate(b, a, axis);
    const auto [it, fresh] = compared_.try_emplace({a, b, axis}, 0);
    if (fresh) it->second = compare_coordinate_exactly(a, b, axis);
    return it->second;
}

/// Along one piece the order of parameters decides.
std::optional<int> GlobalPlane::compare_on_common_piece(std::uint32_t a, std::uint32_t b, Axis axis) {
    for (const OnPiece& o : lies_on_[a]) {
        const OnPiece* there = on_piece(b, o.piece);
        if (there == nullptr || !o.t || !there->t) continue;
        const Arc& arc = set_.arcs[o.piece];
        if (set_.curves[arc.curve].along(axis).magnitude == 0) return 0;
        const std::optional<int> c = compare_along(set_, arc, points_[o.point], *o.t, points_[there->point], *there->t,
                                                   counts_.coordinates_exact);
        if (c) return (axis == Axis::X ? arc.x_increasing : arc.y_increasing) ? *c : -*c;
    }
    return {};
}

int GlobalPlane::compare_coordinate_exactly(std::uint32_t a, std::uint32_t b, Axis axis) {
    if (const std::optional<int> c = compare_on_common_piece(a, b, axis)) return *c;
    const std::optional<FixedPoint> p = fixed_of(a), q = fixed_of(b);
    if (p && q) {
        const Fixed d = axis == Axis::X ? p->x - q->x : p->y - q->y;
        if (d > budget::kFixedCertain || d < -budget::kFixedCertain) return sign_of(d);
    }
    ++counts_.coordinates_exact;
    const std::optional<int> c = fetexc::compare(coordinate(a, axis), coordinate(b, axis));
    if (!c) undecided("order of two points", a);
    return *c;
}

const std::optional<FixedPoint>& GlobalPlane::fixed_of(std::uint32_t point) {
    const auto [it, fresh] = fixed_.try_emplace(point);
    if (fresh) it->second = certain_fixed(set_, points_[point]);
    return it->second;
}

const AlgebraicCoordinate& GlobalPlane::coordinate(std::uint32_t point, Axis axis) {
    const auto [it, fresh] = coordinates_.try_emplace({point, axis});
    if (fresh) {
        it->second = algebraic_coordinate(set_, points_[point], axis);
    }
    return it->second;
}

const RationalBox& GlobalPlane::box(std::uint32_t point, int bits) {
    const auto [it, fresh] = boxes_.try_emplace({point, bits});
    if (fresh) {
        const auto x = narrowed(coordinate(point, Axis::X), bits), y = narrowed(coordinate(point, Axis::Y), bits);
        if (!x || !y) undecided("place", point);
        it->second = {*x, *y};
    }
    return it->second;
}

// --- points against arcs

int GlobalPlane::compare_at(PlanePoint p, const PlaneArc& c) {
    const std::uint32_t k = find(p.id), min = find(c.min.id), max = find(c.max.id);
    if (k == min || k == max) return 0;
    if (vertical(c.piece)) {
        if (compare_coordinate(k, min, Axis::Y) < 0) return -1;
        return compare_coordinate(k, max, Axis::Y) > 0 ? 1 : 0;
    }
    if (on_piece(k, c.piece) != nullptr) return 0;
    ++counts_.sides;
    const Stretch s = set_.stretch_of(set_.arcs[c.piece]);
    const Vertex& v = points_[k];
    const double from = std::max(v.x.lo, points_[min].x.lo), to = std::min(v.x.hi, points_[max].x.hi);
    if (const int side = fetexc::compare(v.y, hull(y_at(s, from), y_at(s, to))); side != 0) return side;
    for (const std::uint32_t end : {min, max}) {
        if (compare_coordinate(k, end, Axis::X) == 0) return compare_coordinate(k, end, Axis::Y);
    }
    return compare_at_exactly(k, c.piece);
}

/// The point lies strictly between the piece's ends. On the piece's algebraic curve is not on the piece: another branch
/// may pass there.
int GlobalPlane::compare_at_exactly(std::uint32_t p, std::uint32_t piece) {
    ++counts_.sides_exact;
    const Arc& arc = set_.arcs[piece];
    const bool on_curve = on_algebraic_curve(points_[p], arc.curve);
    if (on_curve && set_.curves[arc.curve].degree == 1) {
        note(p, {piece, {}, p});
        return 0;
    }
    for (const int bits : {128, 384, 1024}) {
        if (const int side = side_by_box(p, piece, bits); side != 0) return side;
        if (!on_curve || bits < 384) continue;
        note(p, {piece, {}, p});
        return 0;
    }
    undecided("side of an arc", p);
}

bool GlobalPlane::on_algebraic_curve(const Vertex& v, std::uint32_t curve) {
    if (v.integral) return implicit_sign(set_.curves[curve], v.point) == 0;
    if (v.a == curve || v.b == curve) return true;
    const Polynomial meets = eliminate(set_.curves[v.a], set_.curves[curve]);
    const std::optional<int> sign = sign_at(meets, parameter_of(set_, v, v.a, v.s));
    if (!sign) throw UndecidedGlobally{"point on a curve", v.x.mid(), v.y.mid()};
    return *sign == 0;
}

int GlobalPlane::side_by_box(std::uint32_t p, std::uint32_t piece, int bits) {
    const Arc& arc = set_.arcs[piece];
    const Stretch s = set_.stretch_of(arc);
    const RationalBox& b = box(p, bits);
    const bool rises = arc.x_increasing == arc.y_increasing;
    const mpq_class &low_at = rises ? b.x.lo : b.x.hi, &high_at = rises ? b.x.hi : b.x.lo;
    if (compare_position_exact(s, Axis::X, low_at, b.y.hi) > 0) return -1;
    return compare_position_exact(s, Axis::X, high_at, b.y.lo) < 0 ? 1 : 0;
}

// --- arcs against each other

int GlobalPlane::compare_after(const PlaneArc& a, const PlaneArc& b, PlanePoint p) {
    if (a.piece == b.piece) return 0;
    if (vertical(a.piece) || vertical(b.piece)) return vertical(a.piece) ? (vertical(b.piece) ? 0 : 1) : -1;
    PlanePoint to = compare_first(a.max, b.max) < 0 ? a.max : b.max;
    for (const PlanePoint q : common_points(a.piece, b.piece)) {
        if (compare_first(q, p) > 0 && compare_first(q, to) < 0) to = q;
    }
    return order_between(a, b, p, to);
}

int GlobalPlane::compare_before(const PlaneArc& a, const PlaneArc& b, PlanePoint p) {
    if (a.piece == b.piece) return 0;
    if (vertical(a.piece) || vertical(b.piece)) return vertical(a.piece) ? (vertical(b.piece) ? 0 : -1) : 1;
    PlanePoint from = compare_first(a.min, b.min) > 0 ? a.min : b.min;
    for (const PlanePoint q : common_points(a.piece, b.piece)) {
        if (compare_first(q, p) < 0 && compare_first(q, from) > 0) from = q;
    }
    return order_between(a, b, from, p);
}

/// Two pieces that don't meet between the points.
int GlobalPlane::order_between(const PlaneArc& a, const PlaneArc& b, PlanePoint from, PlanePoint to) {
    ++counts_.sides;
    const Stretch sa = set_.stretch_of(set_.arcs[a.piece]), sb = set_.stretch_of(set_.arcs[b.piece]);
    const std::uint32_t p = find(from.id), q = find(to.id);
    const double lo = points_[p].x.hi, hi = points_[q].x.lo, level = 0.5 * (lo + hi);
    if (lo < level && level < hi) {
        if (const int c = fetexc::compare(y_at(sa, level), y_at(sb, level)); c != 0) return c;
    }
    ++counts_.sides_exact;
    for (const int bits : {128, 384, 1024}) {
        const mpq_class &left = box(p, bits).x.hi, &right = box(q, bits).x.lo;
        if (left >= right) continue;
        if (const int c = compare_positions_exact(sa, sb, Axis::X, (left + right) / 2); c != 0) return c;
    }
    undecided("order of two arcs", p);
}

// --- common points of two pieces

void GlobalPlane::intersect(const PlaneArc& a, const PlaneArc& b, std::vector<PlanePoint>& out) {
    if (a.piece == b.piece) undecided("overlap", a.min.id);
    for (const PlanePoint p : common_points(a.piece, b.piece)) {
        const bool inside =
            compare(p, a.min) >= 0 && compare(p, a.max) <= 0 && compare(p, b.min) >= 0 && compare(p, b.max) <= 0;
        if (inside) out.push_back(p);
    }
}

/// Ascending.
const std::vector<PlanePoint>& GlobalPlane::common_points(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto [it, fresh] = common_.try_emplace({a, b});
    if (!fresh) return it->second;
    ++counts_.pairs;
    contacts_.clear();
    intersect_pieces(a, b);
    std::vector<PlanePoint> points = contacts_;
    std::sort(points.begin(), points.end(), [&](PlanePoint p, PlanePoint q) { return compare(p, q) < 0; });
    points.erase(
        std::unique(points.begin(), points.end(), [&](PlanePoint p, PlanePoint q) { return compare(p, q) == 0; }),
        points.end());
    return it->second = std::move(points);
}

void GlobalPlane::intersect_pieces(std::uint32_t ia, std::uint32_t ib) {
    const Arc &a = set_.arcs[ia], &b = set_.arcs[ib];
    known_.clear(), found_.clear();
    if (!known_contacts(a, b)) return;
    end_on_other(ia, ib, true);
    end_on_other(ib, ia, false);
    if (intersect_certified(set_.stretch_of(a), set_.stretch_of(b), known_, found_) == PairOutcome::Certified) {
        for (const Contact& c : found_)
            add_contact(ia, ib, c, nullptr);
    } else {
        ++counts_.pairs_exact;
        intersect_exactly(ia, ib);
    }
}

/// Shared vertices. False: the arcs' boxes have no more in common.
bool GlobalPlane::known_contacts(const Arc& a, const Arc& b) {
    for (const auto& [va, ta] : {std::pair(a.v0, a.t0), std::pair(a.v1, a.t1)}) {
        for (const auto& [vb, tb] : {std::pair(b.v0, b.t0), std::pair(b.v1, b.t1)}) {
            if (va != vb) continue;
            known_.push_back({ta, tb});
            contacts_.push_back({va});
        }
    }
    for (const Axis axis : {Axis::X, Axis::Y}) {
        const auto range = [&](const Arc& arc) {
            return hull(along(set_.vertices[arc.v0], axis), along(set_.vertices[arc.v1], axis));
        };
        const Interval u = range(a), v = range(b);
        const double lo = std::max(u.lo, v.lo), hi = std::min(u.hi, v.hi);
        if (lo > hi) return false;
        if (contacts_.size() != 1 || (u.lo == u.hi && v.lo == v.hi)) continue;
        const Interval& shared = along(points_[contacts_.front().id], axis); // all that has that level on one of them
        if (shared.lo <= lo && hi <= shared.hi) return false;
    }
    return true;
}

void GlobalPlane::end_on_other(std::uint32_t end, std::uint32_t on, bool end_is_a) {
    const Arc &e = set_.arcs[end], &o = set_.arcs[on];
    for (const auto& [v, t] : {std::pair(e.v0, e.t0), std::pair(e.v1, e.t1)}) {
        const Vertex& vertex = set_.vertices[v];
        if (!vertex.integral || v == o.v0 || v == o.v1) continue;
        const std::optional<Interval> hit = point_on_stretch(set_.stretch_of(o), vertex.point);
        if (!hit || !within(o, vertex, *hit)) continue;
        known_.push_back(end_is_a ? Contact{t, *hit} : Contact{*hit, t});
        contacts_.push_back({v});
        note(find(v), {on, *hit, v});
    }
}

void GlobalPlane::intersect_exactly(std::uint32_t ia, std::uint32_t ib) {
    const Arc &a = set_.arcs[ia], &b = set_.arcs[ib];
    SupportMap map{1, 0, Interval(0), Interval(1)};
    if (a.curve == b.curve || same_support(set_.curves[a.curve], set_.curves[b.curve], map)) {
        const auto p = double_point_between(set_.stretch_of(a), set_.stretch_of(b), map.alpha < 0);
        if (p) add_contact(ia, ib, {p->s, p->t}, &p->narrow);
        return;
    }
    std::vector<ExactHit> hits;
    if (intersect_exact(set_.stretch_of(a), set_.stretch_of(b), hits) != ExactOutcome::Done)
        undecided("common points of two arcs", a.v0);
    for (const ExactHit& h : hits)
        add_contact(ia, ib, {h.s, h.t}, &h.narrow);
}

void GlobalPlane::add_contact(std::uint32_t ia, std::uint32_t ib, Contact c, const NarrowContact* narrow) {
    const Arc &a = set_.arcs[ia], &b = set_.arcs[ib];
    const PointEnclosure p = contact_point(set_.curves[a.curve], set_.curves[b.curve], c);
    Vertex v;
    v.x = p.x, v.y = p.y, v.a = a.curve, v.b = b.curve, v.s = c.s, v.t = c.t;
    if (narrow != nullptr) v.narrow = std::make_shared<const NarrowContact>(*narrow);
    if (!within(a, v, c.s) || !within(b, v, c.t)) return;
    const std::uint32_t k = add_point(v);
    note(k, {ia, c.s, k}), note(k, {ib, c.t, k});
    contacts_.push_back({k});
}

/// The stretch that a filter looks at reaches a little beyond the arc.
bool GlobalPlane::within(const Arc& arc, const Vertex& v, const Interval& t) {
    const auto order = [&](std::uint32_t end, const Interval& te) {
        const std::optional<int> c = compare_along(set_, arc, v, t, set_.vertices[end], te, counts_.ends_exact);
        if (!c) throw UndecidedGlobally{"end of an arc", v.x.mid(), v.y.mid()};
        return *c;
    };
    return (t.lo > arc.t0.hi || order(arc.v0, arc.t0) >= 0) && (t.hi < arc.t1.lo || order(arc.v1, arc.t1) <= 0);
}

} // namespace fetexc::test
