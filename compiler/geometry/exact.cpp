// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/geometry/exact.h"

#include <optional>

#include "compiler/geometry/polynomial.h"

namespace fetexc {
namespace {

/// Parameter of the stretch where the coordinate passes v, to within 2^-bits of the range; clamped to the stretch. The
/// outer range of a stretch that ends in an extremum reaches a little beyond it, where the coordinate turns back.
RationalRange bisect(const Stretch& s, const Polynomial& p, bool increasing, const mpq_class& v, int bits) {
    const Polynomial slope = derivative(p), bend = derivative(slope);
    const int up = increasing ? 1 : -1;
    const auto turned_back = [&](const mpq_class& t) { return up * sgn(evaluate(slope, t)) < 0; };
    mpq_class lo(s.range.lo), hi(s.range.hi);
    const bool before = turned_back(lo), after = turned_back(hi);
    for (int k = 0; k < bits; ++k) {
        const mpq_class mid = (lo + hi) / 2;
        bool below = increasing ? evaluate(p, mid) < v : evaluate(p, mid) > v;
        // Between two extrema the slope has one vertex, and bends towards the direction of the stretch before it.
        if (turned_back(mid)) below = before && (!after || up * sgn(evaluate(bend, mid)) > 0);
        (below ? lo : hi) = mid;
    }
    return {lo, hi};
}

int compare_at(const Stretch& a, const Stretch& b, Axis level_axis, const mpq_class& level) {
    const Polynomial al = power_basis(*a.curve, level_axis), bl = power_basis(*b.curve, level_axis);
    const Polynomial av = power_basis(*a.curve, other(level_axis)), bv = power_basis(*b.curve, other(level_axis));
    const bool a_up = level_axis == Axis::Y ? a.y_increasing : a.x_increasing;
    const bool b_up = level_axis == Axis::Y ? b.y_increasing : b.x_increasing;
    for (int bits = budget::kRefineBits; bits <= budget::kRefineBitsLimit; bits *= 2) {
        const RationalRange va = evaluate_over(av, bisect(a, al, a_up, level, bits));
        const RationalRange vb = evaluate_over(bv, bisect(b, bl, b_up, level, bits));
        if (va.hi < vb.lo) return -1;
        if (va.lo > vb.hi) return 1;
    }
    return 0;
}

mpz_class leading(const Curve& c, std::size_t i, bool use_x) {
    const Polynomial p = power_basis(c, use_x ? Axis::X : Axis::Y);
    return i < p.size() ? p[i] : mpz_class(0);
}

/// Power coefficients (x_i, y_i), i = 0…3, zero beyond the degree.
struct Vectors {
    std::array<mpz_class, 4> x, y;
    int degree = 0;
    explicit Vectors(const Curve& c) {
        for (std::size_t i = 0; i < 4; ++i) {
            x[i] = leading(c, i, true);
            y[i] = leading(c, i, false);
            if (x[i] != 0 || y[i] != 0) degree = static_cast<int>(i);
        }
    }
    [[nodiscard]] mpz_class cross(int i, int j) const { return x[i] * y[j] - y[i] * x[j]; }
};

mpz_class cross(const Vectors& a, int i, const Vectors& b, int j) { return a.x[i] * b.y[j] - a.y[i] * b.x[j]; }

/// alpha from cross products with the common leading direction; none when no alpha can exist.
std::optional<mpq_class> support_scale(const Vectors& a, const Vectors& b, const mpq_class& ratio) {
    const int d = b.degree;
    if (d == 2) {
        const mpz_class cb = b.cross(2, 1), ca = cross(b, 2, a, 1);
        if (cb == 0 || ca == 0) return {};
        mpq_class alpha(ca, cb);
        alpha.canonicalize();
        return alpha * alpha == ratio ? std::optional(alpha) : std::nullopt;
    }
    mpq_class alpha;
    if (const mpz_class cb = b.cross(3, 2); cb != 0) {
        const mpz_class ca = cross(b, 3, a, 2);
        if (ca == 0) return {};
        mpq_class squared(ca, cb); // = alpha²
        squared.canonicalize();
        alpha = ratio / squared;
    } else {
        const mpz_class c1 = b.cross(3, 1), a1 = cross(b, 3, a, 1);
        if (c1 == 0 || a1 == 0 || cross(b, 3, a, 2) != 0) return {};
        alpha = mpq_class(a1, c1);
        alpha.canonicalize();
    }
    return alpha * alpha * alpha == ratio ? std::optional(alpha) : std::nullopt;
}

/// B(alpha·s + beta) has exactly A's coefficients.
bool maps_onto(const std::array<mpz_class, 4>& a, const std::array<mpz_class, 4>& b, const mpq_class& alpha,
               const mpq_class& beta) {
    const mpq_class c0 = b[0], c1 = b[1], c2 = b[2], c3 = b[3];
    const mpq_class e0 = c0 + beta * (c1 + beta * (c2 + beta * c3));
    const mpq_class e1 = alpha * (c1 + beta * (2 * c2 + 3 * beta * c3));
    const mpq_class e2 = alpha * alpha * (c2 + 3 * beta * c3);
    const mpq_class e3 = alpha * alpha * alpha * c3;
    return e0 == a[0] && e1 == a[1] && e2 == a[2] && e3 == a[3];
}

Interval enclose(const mpq_class& v) { return to_interval({v, v}); }

} // namespace

int implicit_sign(const Curve& c, IntPoint p) {
    Curve point;
    point.degree = 1;
    point.p = {p, p, IntPoint{}, IntPoint{}};
    const Polynomial r = eliminate(point, c);
    return r.empty() ? 0 : sgn(r[0]);
}

bool same_support(const Curve& a, const Curve& b, SupportMap& map) {
    const Vectors va(a), vb(b);
    const int d = va.degree;
    if (d != vb.degree || d < 2 || cross(va, d, vb, d) != 0) return false;
    const bool use_x = vb.x[d] != 0;
    mpq_class ratio(use_x ? va.x[d] : va.y[d], use_x ? vb.x[d] : vb.y[d]);
    ratio.canonicalize();
    const std::optional<mpq_class> alpha = support_scale(va, vb, ratio);
    if (!alpha) return false;
    const mpq_class power = d == 2 ? *alpha : *alpha * *alpha;
    const mpq_class a1(use_x ? va.x[d - 1] : va.y[d - 1]), b1(use_x ? vb.x[d - 1] : vb.y[d - 1]),
        bd(use_x ? vb.x[d] : vb.y[d]);
    const mpq_class beta = (a1 / power - b1) / (d * bd);
    if (!maps_onto(va.x, vb.x, *alpha, beta) || !maps_onto(va.y, vb.y, *alpha, beta)) return false;
    map = {alpha->get_d(), beta.get_d(), enclose(beta), enclose(*alpha + beta)};
    return true;
}

std::optional<Interval> parameter_of_point(const Curve& c, IntPoint p, const Interval& range) {
    const bool x_first = c.x.magnitude >= c.y.magnitude;
    const Polynomial px = minus(power_basis(c, Axis::X), to_mpz(p.x)), py = minus(power_basis(c, Axis::Y), to_mpz(p.y));
    const Polynomial &along = x_first ? px : py, &across = x_first ? py : px;
    const mpq_class lo = mpq_class(range.lo) - budget::kBesideRange, hi = mpq_class(range.hi) + budget::kBesideRange;
    for (const auto& [t0, t1] : isolate_roots(along, lo, hi, 2 * budget::kRefineBits)) {
        if (sign_at(across, {along, t0, t1}) == 0) return to_interval({t0, t1});
    }
    return {};
}

std::optional<DoublePoint> singular_point(const Curve& c) {
    // (C(s) − C(t))/(s − t) = 0: C3(σ² − π) + C2·σ + C1 = 0 with σ = s + t, π = s·t; crossed with C3 it is linear in σ.
    const Vectors v(c);
    const mpz_class c23 = v.cross(2, 3), c13 = v.cross(1, 3);
    if (v.degree < 3 || c23 == 0) return {};
    DoublePoint out;
    out.sum = mpq_class(-c13, c23);
    out.sum.canonicalize();
    const bool use_x = v.x[3] != 0;
    const mpq_class c1(use_x ? v.x[1] : v.y[1]), c2(use_x ? v.x[2] : v.y[2]), c3(use_x ? v.x[3] : v.y[3]);
    out.product = out.sum * out.sum + (c2 * out.sum + c1) / c3;
    // C(t) modulo t² − σt + π: the linear term vanishes, the rest is the point.
    const auto rest = [&](const std::array<mpz_class, 4>& k) {
        return mpq_class(k[0] - out.product * (k[2] + out.sum * k[3]));
    };
    out.x = rest(v.x), out.y = rest(v.y);
    return out;
}

std::vector<mpz_class> double_point_polynomial(const Curve& c) {
    const std::optional<DoublePoint> p = singular_point(c);
    if (!p || p->discriminant_sign() <= 0) return {};
    const mpz_class scale = p->sum.get_den() * p->product.get_den();
    const mpq_class linear = -p->sum * scale, constant = p->product * scale;
    return {constant.get_num(), linear.get_num(), scale};
}

std::optional<ExactHit> double_point(const Curve& c) {
    const auto roots = isolate_roots(double_point_polynomial(c), 0, 1, 2 * budget::kRefineBits);
    if (roots.size() != 2) return {};
    const RationalRange s{roots[0].first, roots[0].second}, t{roots[1].first, roots[1].second};
    return ExactHit{to_interval(s), to_interval(t), {s, t}};
}

std::optional<ExactHit> double_point_between(const Stretch& a, const Stretch& b, bool reversed) {
    const auto roots = [&](const Stretch& s) {
        return isolate_roots(double_point_polynomial(*s.curve), 2 * budget::kRefineBits);
    };
    const auto ra = roots(a), rb = roots(b);
    if (ra.size() != 2 || rb.size() != 2) return {};
    for (std::size_t i = 0; i < 2; ++i) {
        const std::size_t k = reversed ? i : 1 - i;
        const RationalRange s{ra[i].first, ra[i].second}, t{rb[k].first, rb[k].second};
        const ExactHit hit{to_interval(s), to_interval(t), {s, t}};
        if (hit.s.overlaps(a.range) && hit.t.overlaps(b.range)) return hit;
    }
    return {};
}

int compare_positions_exact(const Stretch& a, const Stretch& b, Axis level_axis, const mpq_class& level) {
    return compare_at(a, b, level_axis, level);
}

int compare_position_exact(const Stretch& a, Axis level_axis, const mpq_class& level, const mpq_class& value) {
    const Polynomial al = power_basis(*a.curve, level_axis), av = power_basis(*a.curve, other(level_axis));
    const bool up = level_axis == Axis::Y ? a.y_increasing : a.x_increasing;
    for (int bits = budget::kRefineBits; bits <= budget::kRefineBitsLimit; bits *= 2) {
        const RationalRange v = evaluate_over(av, bisect(a, al, up, level, bits));
        if (v.hi < value) return -1;
        if (v.lo > value) return 1;
    }
    return 0;
}

} // namespace fetexc
