// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/eight_triangles.h"

#include <algorithm>
#include <cmath>

namespace fetexc::test {
namespace {

using fetex::FeatureEdge;
using fetex::FeaturePoint;
using fetex::FeatureQuadratic;
using fetex::FeatureSegment;
using enum fetex::FeatureEdge;

constexpr double kAtVertex = 1e-6;    // of parameters: sides that share a vertex meet there
constexpr double kRounding = 1e-9;    // of parameters: a root so little outside is on the end
constexpr double kClipped = 1e-15;    // of parameters: where clipping stops
constexpr int kMostClips = 100;       // halving alone needs 50
constexpr double kLeastClip = 0.2;    // Nishita et al.: what shrinks by less is halved
constexpr std::uint32_t kChords = 64; // of a curve, where two curves are looked at for crossings

FeaturePoint minus(FeaturePoint a, FeaturePoint b) { return {a.x - b.x, a.y - b.y}; }
double cross(FeaturePoint a, FeaturePoint b) { return a.x * b.y - a.y * b.x; }
double dot(FeaturePoint a, FeaturePoint b) { return a.x * b.x + a.y * b.y; }
double length(FeaturePoint a) { return std::hypot(a.x, a.y); }
FeaturePoint between(FeaturePoint a, FeaturePoint b, double t) {
    return {std::lerp(a.x, b.x, t), std::lerp(a.y, b.y, t)};
}

FeatureQuadratic straight(FeaturePoint a, FeaturePoint b) { return {a, between(a, b, 0.5), b, true}; }
FeatureQuadratic reversed(const FeatureQuadratic& q) { return {q.b2, q.b1, q.b0, q.straight}; }
FeatureQuadratic part(const FeatureQuadratic& q, double from, double to) {
    const auto blossom = [&](double s, double t) { return between(between(q.b0, q.b1, s), between(q.b1, q.b2, s), t); };
    return {blossom(from, from), blossom(from, to), blossom(to, to), q.straight};
}

/// Eq. 4: the resultant of the curve's polynomials minus the point's coordinates; of a straight one the line's
/// equation.
double implicit_form(const FeatureQuadratic& q, FeaturePoint p) {
    if (q.straight) return cross(minus(q.b2, q.b0), minus(p, q.b0));
    const double ax = q.b0.x - 2 * q.b1.x + q.b2.x, bx = 2 * (q.b1.x - q.b0.x), cx = q.b0.x - p.x;
    const double ay = q.b0.y - 2 * q.b1.y + q.b2.y, by = 2 * (q.b1.y - q.b0.y), cy = q.b0.y - p.y;
    return (ax * cy - ay * cx) * (ax * cy - ay * cx) - (ax * by - ay * bx) * (bx * cy - by * cx);
}

/// On the same side as a point that isn't on the curve.
bool on_side_of(const FeatureQuadratic& q, FeaturePoint p, FeaturePoint of) {
    return implicit_form(q, p) * (implicit_form(q, of) < 0 ? -1 : 1) >= 0;
}

/// Parameters in 0 … 1 where a curve meets a line.
std::vector<double> roots_on_line(const FeatureQuadratic& q, FeaturePoint at, FeaturePoint along) {
    const double d0 = cross(along, minus(q.b0, at)), d1 = cross(along, minus(q.b1, at)),
                 d2 = cross(along, minus(q.b2, at));
    const double a = d0 - 2 * d1 + d2, b = d1 - d0, discriminant = b * b - a * d0;
    std::vector<double> roots;
    const auto add = [&](double t) {
        if (t >= -kRounding && t <= 1 + kRounding) roots.push_back(std::clamp(t, 0.0, 1.0));
    };
    if (discriminant < 0) return roots;
    const double w = -(b + std::copysign(std::sqrt(discriminant), b)); // no subtraction of what is alike
    if (w != 0) add(d0 / w);
    if (a != 0) add(w / a);
    return roots;
}

/// Bezier clipping (Nishita et al. 1990): the root of the polynomial with these Bernstein coefficients, the first and
/// the last of which have different signs.
double clipped_root(double d0, double d1, double d2) {
    double low = 0, high = 1;
    for (int n = 0; n < kMostClips && high - low > kClipped; ++n) {
        // Where the hull of (0, d0), (1/2, d1), (1, d2) meets the axis.
        double from = 1, to = 0;
        const auto meet = [&](double t0, double v0, double t1, double v1) {
            if ((v0 < 0) == (v1 < 0) && v0 != 0 && v1 != 0) return;
            const double t = v0 == v1 ? t0 : t0 + (t1 - t0) * (v0 / (v0 - v1));
            from = std::min(from, t), to = std::max(to, t);
        };
        meet(0, d0, 0.5, d1), meet(0.5, d1, 1, d2), meet(0, d0, 1, d2);
        if (from > to) return std::abs(d0) < std::abs(d2) ? low : high; // rounding: it is at an end
        if (to - from > 1 - kLeastClip) {                               // the half with the change of sign
            const double middle = (d0 + 2 * d1 + d2) / 4;
            (middle < 0) == (d0 < 0) ? (from = 0.5, to = 1) : (from = 0, to = 0.5);
        }
        const auto value = [&](double s, double t) { return std::lerp(std::lerp(d0, d1, s), std::lerp(d1, d2, s), t); };
        const double width = high - low, first = value(from, from), second = value(from, to), third = value(to, to);
        high = low + width * to, low += width * from;
        d0 = first, d1 = second, d2 = third;
    }
    return (low + high) / 2;
}

/// Of two sides, elsewhere than in a vertex that they share.
bool cross_each_other(const FeatureQuadratic& a, const FeatureQuadratic& b) {
    const auto chord_crosses = [](const FeatureQuadratic& curve, FeaturePoint from, FeaturePoint to) {
        const FeaturePoint along = minus(to, from);
        return std::ranges::any_of(roots_on_line(curve, from, along), [&](double t) {
            const double s = dot(minus(fetex::feature_curve_at(curve, t), from), along) / dot(along, along);
            return s >= 0 && s <= 1;
        });
    };
    if (a.straight && !b.straight) return cross_each_other(b, a);
    // Without what is next to the ends: sides share those.
    const FeatureQuadratic inside = part(a, kAtVertex, 1 - kAtVertex);
    if (b.straight) {
        const FeatureQuadratic chord = part(b, kAtVertex, 1 - kAtVertex);
        return chord_crosses(inside, chord.b0, chord.b2);
    }
    for (std::uint32_t k = 0; k < kChords; ++k) {
        const auto at = [&](double n) {
            return fetex::feature_curve_at(b, std::lerp(kAtVertex, 1 - kAtVertex, n / kChords));
        };
        if (chord_crosses(inside, at(k), at(k + 1))) return true;
    }
    return false;
}

/// §5.3, one curved side from p1 to p2.
std::optional<double> with_one_curve(const FeatureQuadratic& curve, double v1, double v2, FeaturePoint q, double vq,
                                     FeaturePoint p) {
    const FeaturePoint along = minus(p, q);
    if (length(along) == 0) return vq;
    std::optional<double> u;
    for (const double root : roots_on_line(curve, q, along)) {
        if (dot(minus(fetex::feature_curve_at(curve, root), q), along) < 0) continue;
        if (u && std::abs(*u - root) > kRounding) return std::nullopt;
        u = root;
    }
    if (!u) return std::nullopt;
    const FeaturePoint on = fetex::feature_curve_at(curve, *u);
    const double s = length(minus(on, p)) / length(minus(on, q));
    return std::lerp(std::lerp(v1, v2, *u), vq, s);
}

/// Two curved sides, from p1 to p2 and from q to p2.
std::optional<double> with_two_curves(const FeatureQuadratic& first, const FeatureQuadratic& second, double v1,
                                      double v2, double vq, FeaturePoint p) {
    const FeaturePoint p1 = first.b0, q = second.b0, r{2 * q.x - p1.x, 2 * q.y - p1.y}, along = minus(p, r);
    const auto meet = [&](const FeatureQuadratic& curve) -> std::optional<double> {
        const double d0 = cross(along, minus(curve.b0, r)), d1 = cross(along, minus(curve.b1, r)),
                     d2 = cross(along, minus(curve.b2, r));
        if (std::abs(d2) <= kRounding * length(along)) return 1; // through p2
        if ((d0 < 0) == (d2 < 0)) return std::nullopt;
        return clipped_root(d0, d1, d2);
    };
    const std::optional<double> u = meet(first), v = meet(second);
    if (!u || !v) return std::nullopt;
    const FeaturePoint on_first = fetex::feature_curve_at(first, *u), on_second = fetex::feature_curve_at(second, *v);
    const double whole = length(minus(on_first, on_second));
    if (whole == 0) return v2;
    const double s = std::min(length(minus(on_first, p)) / whole, 1.0);
    return std::lerp(std::lerp(v1, v2, *u), std::lerp(vq, v2, *v), s);
}

double barycentric(const std::array<FeaturePoint, 3>& at, const std::array<double, 3>& value, FeaturePoint p) {
    const double whole = cross(minus(at[1], at[0]), minus(at[2], at[0]));
    if (whole == 0) return value[0];
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
        sum += value[k] * cross(minus(at[(k + 1) % 3], p), minus(at[(k + 2) % 3], p)) / whole;
    return sum;
}

FeaturePoint corner_point(std::uint32_t corner) { return {corner & 1u ? 1.0 : 0.0, corner & 2u ? 1.0 : 0.0}; }

} // namespace

FeatureQuadratic EightTriangles::side_between(FeatureEdge a, FeatureEdge b) const {
    for (std::uint32_t k = 0; k < texel_.segments.count; ++k)
        if (texel_.segments.segment[k] == FeatureSegment{a, b}) return texel_.curves[k];
    return straight(vertices_[fetex::feature_edge_index(a)], vertices_[fetex::feature_edge_index(b)]);
}

EightTriangles::EightTriangles(const SegmentedTexel& texel) : texel_(texel) {
    for (const FeatureEdge e : fetex::kFeatureEdges)
        vertices_[fetex::feature_edge_index(e)] = fetex::feature_point(e, fetex::FeatureCrossing{}.position);
    for (std::uint32_t k = 0; k < texel.segments.count; ++k) {
        vertices_[fetex::feature_edge_index(texel.segments.segment[k].first)] = texel.curves[k].b0;
        vertices_[fetex::feature_edge_index(texel.segments.segment[k].second)] = texel.curves[k].b2;
    }
    const auto quadrant = [&](std::uint32_t corner, FeatureEdge a, FeatureEdge b) {
        quadrants_[corner] = {corner, fetex::feature_edge_index(a), fetex::feature_edge_index(b), side_between(a, b)};
    };
    quadrant(0, North, West), quadrant(1, North, East), quadrant(2, South, West), quadrant(3, East, South);
    find_centre();
    find_values();
}

void EightTriangles::find_centre() {
    vertical_ = side_between(North, South), horizontal_ = side_between(East, West);
    // Where the vertical one comes below the horizontal one.
    const auto horizontal_at = [&](double x) {
        return clipped_root(horizontal_.b0.x - x, horizontal_.b1.x - x, horizontal_.b2.x - x);
    };
    double above = 0, below = 1;
    while (below - above > kClipped) {
        const double middle = (above + below) / 2;
        if (middle <= above || middle >= below) break;
        const FeaturePoint p = fetex::feature_curve_at(vertical_, middle);
        (p.y < fetex::feature_curve_at(horizontal_, horizontal_at(p.x)).y ? above : below) = middle;
    }
    centre_ = fetex::feature_curve_at(vertical_, above);
    const double across = horizontal_at(centre_.x);
    spokes_ = {part(vertical_, 0, above), part(horizontal_, 0, across), reversed(part(vertical_, above, 1)),
               reversed(part(horizontal_, across, 1))};
    for (FeatureQuadratic& s : spokes_)
        s.b2 = centre_;
}

/// §5.1: 0 on curves, else from the corners, which are on one side of them all.
void EightTriangles::find_values() {
    std::array<bool, 4> on_curve{};
    bool through_centre = false;
    for (const FeatureSegment s : texel_.segments) {
        on_curve[fetex::feature_edge_index(s.first)] = on_curve[fetex::feature_edge_index(s.second)] = true;
        through_centre = through_centre || s == FeatureSegment{North, South} || s == FeatureSegment{East, West};
    }
    const std::array<double, 4>& d = texel_.distances;
    values_ = {(d[0] + d[1]) / 2, (d[1] + d[3]) / 2, (d[2] + d[3]) / 2, (d[0] + d[2]) / 2};
    for (std::size_t e = 0; e < 4; ++e)
        if (on_curve[e]) values_[e] = 0;
    if (through_centre) return;
    const auto part_of = [&](std::size_t from, std::size_t to) {
        const double a = length(minus(centre_, vertices_[from])), b = length(minus(centre_, vertices_[to]));
        return std::lerp(values_[from], values_[to], a / (a + b));
    };
    centre_value_ = (part_of(0, 2) + part_of(1, 3)) / 2;
}

EightTriangles::Triangle EightTriangles::outer(const Quadrant& q) const {
    const FeaturePoint corner = corner_point(q.corner), a = vertices_[q.first], b = vertices_[q.second];
    return {{a, b, corner},
            {values_[q.first], values_[q.second], texel_.distances[q.corner]},
            {q.diagonal, straight(b, corner), straight(corner, a)}};
}

EightTriangles::Triangle EightTriangles::inner(const Quadrant& q) const {
    return {{vertices_[q.first], vertices_[q.second], centre_},
            {values_[q.first], values_[q.second], centre_value_},
            {q.diagonal, spokes_[q.second], reversed(spokes_[q.first])}};
}

bool EightTriangles::well_formed() const {
    for (const Quadrant& q : quadrants_) {
        for (std::size_t e = 0; e < 4; ++e)
            if (cross_each_other(q.diagonal, spokes_[e])) return false;
        for (const Quadrant& other : quadrants_)
            if (other.corner < q.corner && cross_each_other(q.diagonal, other.diagonal)) return false;
        // The diagonal has the corner on one side, and the centre on the other.
        if (on_side_of(q.diagonal, centre_, corner_point(q.corner))) return false;
    }
    for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < a; ++b)
            if (cross_each_other(spokes_[a], spokes_[b])) return false;
    return true;
}

bool EightTriangles::has_area_of_zero() const {
    return std::ranges::any_of(quadrants_, [&](const Quadrant& q) {
        return values_[q.first] == 0 && values_[q.second] == 0 && centre_value_ == 0;
    });
}

std::optional<double> EightTriangles::distance(FeaturePoint p) const {
    const bool west = on_side_of(vertical_, p, corner_point(0)), north = on_side_of(horizontal_, p, corner_point(0));
    const Quadrant& q = quadrants_[(west ? 0u : 1u) + (north ? 0u : 2u)];
    const Triangle t = on_side_of(q.diagonal, p, corner_point(q.corner)) ? outer(q) : inner(q);
    const auto& [at, value, side] = t;
    const auto curved = std::ranges::count(side, false, &FeatureQuadratic::straight);
    if (curved == 0) return barycentric(at, value, p);
    std::size_t k = 0; // the only curved side, or the only straight one
    while (side[k].straight != (curved == 2))
        ++k;
    const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
    if (curved == 1) return with_one_curve(side[k], value[k], value[next], at[last], value[last], p);
    return with_two_curves(side[next], reversed(side[last]), value[next], value[last], value[k], p);
}

} // namespace fetexc::test
