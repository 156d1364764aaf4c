// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/geometry/intersect.h"
#include "compiler/geometry/orientation.h"

namespace fetexc {
namespace {

struct Vector {
    double x = 0, y = 0;
};
double cross(Vector a, Vector b) { return a.x * b.y - a.y * b.x; }
double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y; }
double norm1(Vector a) { return std::fabs(a.x) + std::fabs(a.y); }

/// Control points of a stretch, relative to the origin of curve a.
struct Part {
    std::array<Vector, 4> p{};
    int degree = 1;
    Interval range; ///< lo, hi: exact doubles
    [[nodiscard]] Vector leg(int i) const { return {p[i + 1].x - p[i].x, p[i + 1].y - p[i].y}; }
};

struct Pair {
    Part a, b;
    int depth = 0;
};

struct Box {
    double x0, y0, x1, y1;
};

Box box_of(const Part& part) {
    Box b{part.p[0].x, part.p[0].y, part.p[0].x, part.p[0].y};
    for (int i = 1; i <= part.degree; ++i) {
        b.x0 = std::min(b.x0, part.p[i].x), b.x1 = std::max(b.x1, part.p[i].x);
        b.y0 = std::min(b.y0, part.p[i].y), b.y1 = std::max(b.y1, part.p[i].y);
    }
    return b;
}

void split(const Part& in, Part& left, Part& right) {
    constexpr double u = 511.0 / 1024.0; // not 1/2: art likes dyadic parameters, and a root on a box border is work
    left = right = in;
    std::array<Vector, 4> q = in.p;
    for (int k = in.degree; k > 0; --k) {
        left.p[in.degree - k] = q[0];
        right.p[k] = q[k];
        for (int i = 0; i < k; ++i) {
            q[i].x += u * (q[i + 1].x - q[i].x);
            q[i].y += u * (q[i + 1].y - q[i].y);
        }
    }
    left.p[in.degree] = right.p[0] = q[0];
    const double mid = in.range.lo + u * (in.range.hi - in.range.lo);
    left.range.hi = right.range.lo = mid;
}

/// The pair under test with its error bounds.
class Filter {
  public:
    Filter(const ControlPolygon& a, const ControlPolygon& b, std::span<const Contact> known)
        : a_(a.stretch), b_(b.stretch), known_(known) {
        offset_ = {static_cast<double>(b_.curve->x.origin - a_.curve->x.origin),
                   static_cast<double>(b_.curve->y.origin - a_.curve->y.origin)};
        scale_ = std::max(size_of(a_), size_of(b_) + std::max(std::fabs(offset_.x), std::fabs(offset_.y)));
        whole_ = {part(a, {}), part(b, offset_), 0};
    }

    PairOutcome run(std::vector<Contact>& found) {
        std::vector<Pair> stack;
        Pair pair = whole_;
        for (int boxes = 1; boxes <= budget::kFilterMaxBoxes; ++boxes) {
            if (!decided(pair)) {
                if (undecidable_ || !subdivide(pair, stack)) return PairOutcome::Undecided;
            } else if (stack.empty()) {
                found.insert(found.end(), hits_.begin(), hits_.end());
                return PairOutcome::Certified;
            }
            pair = stack.back();
            stack.pop_back();
        }
        return PairOutcome::Undecided;
    }

    /// The point lies beyond the strip that holds the polygon.
    static bool beside(const ControlPolygon& polygon, Vector point) {
        Part p;
        p.degree = 0;
        p.p[0] = point;
        return beside_chord(part(polygon, {}), p, 2 * budget::kEvaluationError * size_of(polygon.stretch));
    }

  private:
    static double size_of(const Stretch& s) { return std::max(s.curve->x.magnitude, s.curve->y.magnitude); }

    static Part part(const ControlPolygon& c, Vector offset) {
        Part out;
        out.degree = c.stretch.curve->degree;
        out.range = c.stretch.range;
        for (int i = 0; i <= out.degree; ++i)
            out.p[i] = {c.x[i] + offset.x, c.y[i] + offset.y};
        return out;
    }

    static Part part(const Stretch& s, const Interval& range, Vector offset) {
        return part(ControlPolygon({s.curve, range, s.x_increasing, s.y_increasing}), offset);
    }

    [[nodiscard]] double margin(int depth) const {
        return (2 * budget::kEvaluationError + depth * budget::kSplitError) * scale_;
    }

    static bool apart(const Pair& pair, double eps) {
        const Box p = box_of(pair.a), q = box_of(pair.b);
        const double e = 2 * eps;
        return p.x1 + e < q.x0 || q.x1 + e < p.x0 || p.y1 + e < q.y0 || q.y1 + e < p.y0 ||
               beside_chord(pair.a, pair.b, eps) || beside_chord(pair.b, pair.a, eps);
    }

    /// Fat line: every control point of v beyond the strip around u's chord.
    static bool beside_chord(const Part& u, const Part& v, double eps) {
        const Vector chord{u.p[u.degree].x - u.p[0].x, u.p[u.degree].y - u.p[0].y};
        const double n = norm1(chord);
        if (!(n > 16 * eps)) return false;
        double lo = 0, hi = 0, lo2 = 0, hi2 = 0, reach = 0;
        for (int i = 1; i < u.degree; ++i) {
            const double k = cross(chord, {u.p[i].x - u.p[0].x, u.p[i].y - u.p[0].y});
            lo = std::min(lo, k), hi = std::max(hi, k);
        }
        for (int i = 0; i <= v.degree; ++i) {
            const Vector w{v.p[i].x - u.p[0].x, v.p[i].y - u.p[0].y};
            const double k = cross(chord, w);
            lo2 = i == 0 ? k : std::min(lo2, k), hi2 = i == 0 ? k : std::max(hi2, k);
            reach = std::max(reach, norm1(w));
        }
        // |error of a cross product| ≤ 2·eps·(|chord| + |w|) + 8·eps² + rounding; twice, for both strips.
        const double e = 2 * (2 * eps * (2 * n + reach) + 8 * eps * eps + 8 * budget::kUnitRoundoff * n * (n + reach));
        return lo2 > hi + e || hi2 < lo - e;
    }

    /// All tangents of a on one side of all tangents of b: at most one common point. Exactly zero legs (zero handles)
    /// are no tangents.
    static bool cones_apart(const Part& a, const Part& b, double eps) {
        int sign = 0;
        for (int i = 0; i < a.degree; ++i) {
            const Vector u = a.leg(i);
            if (u.x == 0 && u.y == 0) continue;
            for (int j = 0; j < b.degree; ++j) {
                const Vector v = b.leg(j);
                if (v.x == 0 && v.y == 0) continue;
                const double c = cross(u, v), nu = norm1(u), nv = norm1(v);
                const double e = 2 * eps * (nu + nv) + 8 * eps * eps + 4 * budget::kUnitRoundoff * nu * nv;
                const int s = c > e ? 1 : c < -e ? -1 : 0;
                if (s == 0 || (sign != 0 && s != sign)) return false;
                sign = s;
            }
        }
        return sign != 0;
    }

    /// Seen from a common end point, a lies in one open half plane and b in the other.
    static bool pointed_apart(const Part& a, bool a_ends, const Part& b, bool b_ends, double eps) {
        const auto sum = [](const Part& p, bool ends) {
            const Vector v{p.p[p.degree].x - p.p[0].x, p.p[p.degree].y - p.p[0].y};
            const double n = std::sqrt(dot(v, v)) * (ends ? -1 : 1);
            return n == 0 ? Vector{} : Vector{v.x / n, v.y / n};
        };
        const Vector u = sum(a, a_ends), w = sum(b, b_ends);
        const Vector n{u.x - w.x, u.y - w.y};
        const auto beyond = [&](const Part& p, double sign) {
            for (int i = 0; i < p.degree; ++i) {
                const Vector leg = p.leg(i);
                if (leg.x == 0 && leg.y == 0) continue;
                if (!(sign * dot(n, leg) > norm1(n) * (4 * eps + 8 * budget::kUnitRoundoff * norm1(leg)))) return false;
            }
            return true;
        };
        return norm1(n) > 0 && beyond(a, a_ends ? -1 : 1) && beyond(b, b_ends ? 1 : -1);
    }

    static bool touches(const Contact& c, const Pair& pair) {
        return c.s.overlaps(pair.a.range) && c.t.overlaps(pair.b.range);
    }

    bool decided(const Pair& pair) {
        const double eps = margin(pair.depth);
        if (apart(pair, eps)) return true;
        const bool alone = cones_apart(pair.a, pair.b, eps);
        for (const Contact& c : known_) {
            if (touches(c, pair) && (alone ? alone_with(c, pair) : corner_only(c, pair, eps))) return true;
        }
        if (!alone) return false;
        for (const Contact& c : hits_) {
            if (touches(c, pair) && alone_with(c, pair)) return true;
        }
        return find_root(pair);
    }

    /// The contact may stick out of the box; the cones must be apart on the box enlarged to hold it.
    bool alone_with(const Contact& c, const Pair& pair) const {
        const Interval s = hull(c.s, pair.a.range), t = hull(c.t, pair.b.range);
        if (s.lo == pair.a.range.lo && s.hi == pair.a.range.hi && t.lo == pair.b.range.lo && t.hi == pair.b.range.hi)
            return true;
        return cones_apart(part(a_, s, {}), part(b_, t, offset_), margin(0));
    }

    bool corner_only(const Contact& c, const Pair& pair, double eps) const {
        const auto end_of = [](const Interval& p, const Interval& range) {
            return p.lo >= range.hi ? 1 : p.hi <= range.lo ? 0 : -1;
        };
        const int ea = end_of(c.s, pair.a.range), eb = end_of(c.t, pair.b.range);
        return ea >= 0 && eb >= 0 && pointed_apart(pair.a, ea == 1, pair.b, eb == 1, eps);
    }

    /// Newton from the middle, then a certificate. False: no root in the box was found, subdivide.
    bool find_root(const Pair& pair) {
        double s = pair.a.range.mid(), t = pair.b.range.mid();
        const double ws = pair.a.range.width(), wt = pair.b.range.width();
        const double s0 = s, t0 = t;
        bool converged = false;
        for (int k = 0; k < 16 && !converged; ++k) {
            const Vector f = difference(s, t), ga = tangent(a_, s), gb = tangent(b_, t);
            const double d = -ga.x * gb.y + ga.y * gb.x;
            if (d == 0) return false;
            const double ds = (-f.x * gb.y + f.y * gb.x) / d, dt = (ga.x * f.y - ga.y * f.x) / d;
            s -= ds, t -= dt;
            if (!(std::fabs(s - s0) <= 4 * ws && std::fabs(t - t0) <= 4 * wt)) return false;
            converged = std::fabs(ds) + std::fabs(dt) <= 64 * budget::kUnitRoundoff ||
                        (k > 8 && std::fabs(ds) < budget::kNewtonSettled * ws);
        }
        return converged && certify(pair, s, t);
    }

    bool certify(const Pair& pair, double s, double t) {
        const Vector ga = tangent(a_, s), gb = tangent(b_, t);
        const double d = std::fabs(cross(ga, gb));
        if (d == 0) return false;
        const double noise = 4 * budget::kEvaluationError * scale_;
        double rs = norm1(gb) / d * noise + 4 * budget::kUnitRoundoff,
               rt = norm1(ga) / d * noise + 4 * budget::kUnitRoundoff;
        for (int k = 0; k < 5; ++k, rs *= 4, rt *= 4) {
            if (!krawczyk(s, t, rs, rt)) continue;
            const Contact c{{s - rs, s + rs}, {t - rt, t + rt}};
            if (!touches(c, pair)) return false;
            return accept(c);
        }
        return false;
    }

    bool accept(const Contact& c) {
        for (const Contact& k : known_) {
            if (!k.s.overlaps(c.s) || !k.t.overlaps(c.t)) continue;
            const Interval s = hull(k.s, c.s), t = hull(k.t, c.t);
            undecidable_ = !krawczyk(s.mid(), t.mid(), s.width(), t.width()); // else both are its only zero
            return !undecidable_;
        }
        for (Contact& h : hits_) {
            if (!h.s.overlaps(c.s) || !h.t.overlaps(c.t)) continue;
            const Interval s = hull(h.s, c.s), t = hull(h.t, c.t);
            undecidable_ = !krawczyk(s.mid(), t.mid(), 2 * s.width(), 2 * t.width());
            return !undecidable_;
        }
        hits_.push_back(c);
        return true;
    }

    [[nodiscard]] Vector tangent(const Stretch& s, double t) const {
        return {derivative_double(*s.curve, Axis::X, t), derivative_double(*s.curve, Axis::Y, t)};
    }
    [[nodiscard]] Vector difference(double s, double t) const {
        const auto along = [&](Axis axis, double offset) {
            return local_double(*a_.curve, axis, s) - local_double(*b_.curve, axis, t) - offset;
        };
        return {along(Axis::X, offset_.x), along(Axis::Y, offset_.y)};
    }

    /// Krawczyk operator on the box of radius (rs,rt): maps into itself only if it holds exactly one zero of A(s) −
    /// B(t).
    bool krawczyk(double s, double t, double rs, double rt) const {
        const Vector f = difference(s, t);
        const double fe = 2 * budget::kEvaluationError * scale_;
        const Interval fx(f.x - fe, f.x + fe), fy(f.y - fe, f.y + fe);
        const Interval bs(s - rs, s + rs), bt(t - rt, t + rt);
        const Interval a11 = derivative_over(*a_.curve, Axis::X, bs), a21 = derivative_over(*a_.curve, Axis::Y, bs);
        const Interval a12 = -derivative_over(*b_.curve, Axis::X, bt), a22 = -derivative_over(*b_.curve, Axis::Y, bt);
        return krawczyk_maps_inside(fx, fy, a11, a12, a21, a22, rs, rt);
    }

    static bool subdivide(const Pair& pair, std::vector<Pair>& stack) {
        if (pair.depth >= budget::kFilterMaxDepth) return false;
        const Box p = box_of(pair.a), q = box_of(pair.b);
        const double la = std::max(p.x1 - p.x0, p.y1 - p.y0), lb = std::max(q.x1 - q.x0, q.y1 - q.y0);
        Part al, ar, bl, br;
        if (lb <= 2 * la) split(pair.a, al, ar);
        if (la <= 2 * lb) split(pair.b, bl, br);
        const int depth = pair.depth + 1;
        if (la > 2 * lb) {
            stack.push_back({al, pair.b, depth});
            stack.push_back({ar, pair.b, depth});
        } else if (lb > 2 * la) {
            stack.push_back({pair.a, bl, depth});
            stack.push_back({pair.a, br, depth});
        } else {
            stack.push_back({al, bl, depth});
            stack.push_back({al, br, depth});
            stack.push_back({ar, bl, depth});
            stack.push_back({ar, br, depth});
        }
        return true;
    }

    const Stretch &a_, &b_;
    std::span<const Contact> known_;
    Pair whole_;
    Vector offset_;
    double scale_ = 0;
    std::vector<Contact> hits_;
    bool undecidable_ = false;
};

Interval rounded(Int128 v) {
    const double d = static_cast<double>(v);
    return {widen_down(d), widen_up(d)};
}

/// Two segments: proper crossings by exact orientation tests; end point contacts are known already.
void intersect_lines(const Curve& a, const Curve& b, std::vector<Contact>& found) {
    const Int128 b0 = cross(a.p[0], a.p[1], b.p[0]), b1 = cross(a.p[0], a.p[1], b.p[1]);
    const Int128 a0 = cross(b.p[0], b.p[1], a.p[0]), a1 = cross(b.p[0], b.p[1], a.p[1]);
    if (sign_of(a0) * sign_of(a1) >= 0 || sign_of(b0) * sign_of(b1) >= 0) return;
    const auto ratio = [](Int128 v0, Int128 v1) {
        const Interval r = rounded(v0) / rounded(v0 - v1);
        return Interval(std::max(0.0, r.lo), std::min(1.0, r.hi));
    };
    found.push_back({ratio(a0, a1), ratio(b0, b1)});
}

} // namespace

std::optional<Krawczyk> krawczyk(const Interval& fx, const Interval& fy, const Interval& a11, const Interval& a12,
                                 const Interval& a21, const Interval& a22) {
    const double det = a11.mid() * a22.mid() - a12.mid() * a21.mid();
    if (det == 0 || !(det == det)) return {};
    const Interval y11 = a22.mid() / det, y12 = -a12.mid() / det, y21 = -a21.mid() / det, y22 = a11.mid() / det;
    return Krawczyk{y11 * fx + y12 * fy,      y21 * fx + y22 * fy,      Interval(1) - (y11 * a11 + y12 * a21),
                    -(y11 * a12 + y12 * a22), -(y21 * a11 + y22 * a21), Interval(1) - (y21 * a12 + y22 * a22)};
}

bool krawczyk_maps_inside(const Interval& fx, const Interval& fy, const Interval& a11, const Interval& a12,
                          const Interval& a21, const Interval& a22, double rs, double rt) {
    const std::optional<Krawczyk> k = krawczyk(fx, fy, a11, a12, a21, a22);
    if (!k) return false;
    const double ks = k->gs.magnitude() + k->e11.magnitude() * rs + k->e12.magnitude() * rt;
    const double kt = k->gt.magnitude() + k->e21.magnitude() * rs + k->e22.magnitude() * rt;
    constexpr double slack = 1 + 16 * budget::kUnitRoundoff; // roundings of the two sums above
    return ks * slack < rs && kt * slack < rt;
}

ControlPolygon::ControlPolygon(const Stretch& s)
    : stretch(s), x(fetexc::stretch(*s.curve, Axis::X, s.range.lo, s.range.hi)),
      y(fetexc::stretch(*s.curve, Axis::Y, s.range.lo, s.range.hi)) {}

PairOutcome intersect_certified(const ControlPolygon& a, const ControlPolygon& b, std::span<const Contact> known,
                                std::vector<Contact>& found) {
    const Curve &ca = *a.stretch.curve, &cb = *b.stretch.curve;
    if (ca.degree == 1 && cb.degree == 1) {
        intersect_lines(ca, cb, found);
        return PairOutcome::Certified;
    }
    return Filter(a, b, known).run(found);
}

namespace {

/// Of a point that lies on the quadratic's parabola: crossed with the second difference, only the linear term is left.
/// Products stay below 2^91; the divisor isn't 0, because curves aren't collinear.
Interval parameter_on_parabola(const Curve& c, IntPoint p) {
    const IntPoint o = c.p[0], bend{c.p[2].x - 2 * c.p[1].x + o.x, c.p[2].y - 2 * c.p[1].y + o.y};
    const auto with_bend = [&](IntPoint q) {
        return static_cast<Int128>(q.x - o.x) * bend.y - static_cast<Int128>(q.y - o.y) * bend.x;
    };
    return rounded(with_bend(p)) / rounded(2 * with_bend(c.p[1]));
}

} // namespace

std::optional<Interval> point_on_stretch(const ControlPolygon& polygon, IntPoint p) {
    const Stretch& s = polygon.stretch;
    const Curve& c = *s.curve;
    if (c.degree == 1
            ? cross(c.p[0], c.p[1], p) != 0
            : Filter::beside(polygon, {static_cast<double>(p.x - c.x.origin), static_cast<double>(p.y - c.y.origin)}))
        return {};
    const double x = static_cast<double>(p.x), y = static_cast<double>(p.y);
    const Interval x0 = value_over(c, Axis::X, {s.range.lo, s.range.lo}),
                   x1 = value_over(c, Axis::X, {s.range.hi, s.range.hi});
    const Interval y0 = value_over(c, Axis::Y, {s.range.lo, s.range.lo}),
                   y1 = value_over(c, Axis::Y, {s.range.hi, s.range.hi});
    if (!hull(x0, x1).contains(x) || !hull(y0, y1).contains(y)) return {};
    const bool over_y = std::fabs(y1.mid() - y0.mid()) >= std::fabs(x1.mid() - x0.mid());
    const Interval t = over_y ? parameter_at(c, Axis::Y, s.range, s.y_increasing, y)
                              : parameter_at(c, Axis::X, s.range, s.x_increasing, x);
    if (!value_over(c, over_y ? Axis::X : Axis::Y, t).contains(over_y ? x : y)) return {};
    if (c.degree == 1) return t;
    if (implicit_sign(c, p) != 0) return {};
    if (c.degree == 2) {
        const Interval exact = parameter_on_parabola(c, p);
        return exact.overlaps(s.range) ? std::optional(exact) : std::nullopt;
    }
    return parameter_of_point(c, p, s.range);
}

} // namespace fetexc
