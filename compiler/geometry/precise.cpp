// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/geometry/precise.h"

#include "compiler/geometry/polynomial.h"

namespace fetexc {
namespace {

constexpr int kBits = budget::kPreciseBits;

/// A parameter t = value·2^-kBits within ±radius.
struct Dyadic {
    mpz_class value;
    double radius = 0;
};

mpz_class to_dyadic(double t) {
    mpz_class v;
    mpz_set_d(v.get_mpz_t(), std::ldexp(t, kBits)); // truncated below 2^-kBits: a starting point only
    return v;
}

/// v·2^-bits, rounded towards zero.
double to_double(const mpz_class& v, int bits) {
    long exponent = 0;
    const double mantissa = mpz_get_d_2exp(&exponent, v.get_mpz_t());
    return std::ldexp(mantissa, static_cast<int>(exponent) - bits);
}

Interval enclose(const mpz_class& v, int bits) {
    const double d = to_double(v, bits);
    return {widen_down(d), widen_up(d)};
}

Interval range_of(const Dyadic& t) {
    const Interval mid = enclose(t.value, kBits);
    return {std::max(0.0, widen_down(mid.lo - t.radius)), std::min(1.0, widen_up(mid.hi + t.radius))};
}

/// p(value·2^-kBits)·2^(3·kBits), exact; degree ≤ 3.
mpz_class evaluate_dyadic(const Polynomial& p, const mpz_class& value) {
    mpz_class sum = 0, term;
    for (std::size_t i = p.size(); i-- > 0;) {
        sum *= value;
        mpz_mul_2exp(term.get_mpz_t(), p[i].get_mpz_t(), static_cast<mp_bitcnt_t>(kBits) * (p.size() - 1 - i));
        sum += term;
    }
    const std::size_t missing = p.empty() ? 0 : 4 - p.size();
    mpz_mul_2exp(sum.get_mpz_t(), sum.get_mpz_t(), static_cast<mp_bitcnt_t>(kBits) * missing);
    return sum;
}

Interval coordinate_at(const Curve& c, Axis axis, const Dyadic& t) {
    const Interval mid = enclose(evaluate_dyadic(power_basis(c, axis), t.value), 3 * kBits);
    if (t.radius == 0) return mid;
    const double reach = widen_up(derivative_over(c, axis, range_of(t)).magnitude() * t.radius);
    return {widen_down(mid.lo - reach), widen_up(mid.hi + reach)};
}

PointEnclosure point_at(const Curve& c, const Dyadic& t) {
    return {coordinate_at(c, Axis::X, t), coordinate_at(c, Axis::Y, t)};
}

PointEnclosure plain_point(const Curve& c, const Interval& t) {
    return {value_over(c, Axis::X, t), value_over(c, Axis::Y, t)};
}

double size_of(const Curve& c) { return std::max(c.x.magnitude, c.y.magnitude); }

Interval meet(const Interval& a, const Interval& b) {
    const Interval m(std::max(a.lo, b.lo), std::min(a.hi, b.hi));
    return m.lo <= m.hi ? m : hull(a, b);
}

PointEnclosure meet(const PointEnclosure& a, const PointEnclosure& b) { return {meet(a.x, b.x), meet(a.y, b.y)}; }

// --- one polynomial

/// Narrows a root whose sign change shows at the ends of t. None when it doesn't show there.
std::optional<Dyadic> narrow_root(const Polynomial& p, const Interval& t) {
    mpz_class lo = to_dyadic(t.lo), hi = to_dyadic(t.hi);
    const int at_lo = sgn(evaluate_dyadic(p, lo)), at_hi = sgn(evaluate_dyadic(p, hi));
    if (at_lo * at_hi >= 0) return {};
    while (hi - lo > 1) {
        const mpz_class mid = (lo + hi) / 2;
        const int s = sgn(evaluate_dyadic(p, mid));
        if (s == 0) return Dyadic{mid, 0};
        (s == at_lo ? lo : hi) = mid;
    }
    return Dyadic{lo, std::ldexp(1.0, -kBits)};
}

// --- two curves

/// Newton on A(s) − B(t) with exact residuals, and the Krawczyk test on what is left.
class ContactRefiner {
  public:
    ContactRefiner(const Curve& a, const Curve& b)
        : a_(a), b_(b), ax_(power_basis(a, Axis::X)), ay_(power_basis(a, Axis::Y)), bx_(power_basis(b, Axis::X)),
          by_(power_basis(b, Axis::Y)) {}

    bool run(const Contact& c) {
        s_.value = to_dyadic(c.s.mid()), t_.value = to_dyadic(c.t.mid());
        double ds = 0, dt = 0;
        for (int k = 0; k < budget::kPreciseSteps; ++k) {
            if (!step(ds, dt)) return false;
            const double ms = to_double(s_.value, kBits), mt = to_double(t_.value, kBits);
            if (!c.s.contains(ms) || !c.t.contains(mt)) return false;
            if (ds <= budget::kPreciseStop && dt <= budget::kPreciseStop) break;
        }
        s_.radius = 4 * ds + budget::kPreciseStop, t_.radius = 4 * dt + budget::kPreciseStop;
        // Another root can't be meant: the contact is alone in its enclosures, which hold this box.
        const Interval rs = range_of(s_), rt = range_of(t_);
        return rs.lo >= c.s.lo && rs.hi <= c.s.hi && rt.lo >= c.t.lo && rt.hi <= c.t.hi && certified();
    }

    [[nodiscard]] const Dyadic& s() const { return s_; }
    [[nodiscard]] const Dyadic& t() const { return t_; }

  private:
    struct Residual {
        Interval x, y;
    };
    [[nodiscard]] Residual residual() const {
        return {enclose(evaluate_dyadic(ax_, s_.value) - evaluate_dyadic(bx_, t_.value), 3 * kBits),
                enclose(evaluate_dyadic(ay_, s_.value) - evaluate_dyadic(by_, t_.value), 3 * kBits)};
    }

    bool step(double& ds, double& dt) {
        const double s = to_double(s_.value, kBits), t = to_double(t_.value, kBits);
        const double gax = derivative_double(a_, Axis::X, s), gay = derivative_double(a_, Axis::Y, s),
                     gbx = derivative_double(b_, Axis::X, t), gby = derivative_double(b_, Axis::Y, t);
        const double d = gay * gbx - gax * gby;
        if (d == 0) return false;
        const Residual f = residual();
        const double es = (-f.x.mid() * gby + f.y.mid() * gbx) / d, et = (gax * f.y.mid() - gay * f.x.mid()) / d;
        s_.value -= to_dyadic(es), t_.value -= to_dyadic(et);
        ds = std::fabs(es), dt = std::fabs(et);
        return true;
    }

    [[nodiscard]] bool certified() const {
        const Residual f = residual();
        const Interval rs = range_of(s_), rt = range_of(t_);
        const Interval a11 = derivative_over(a_, Axis::X, rs), a21 = derivative_over(a_, Axis::Y, rs);
        const Interval a12 = -derivative_over(b_, Axis::X, rt), a22 = -derivative_over(b_, Axis::Y, rt);
        return krawczyk_maps_inside(f.x, f.y, a11, a12, a21, a22, s_.radius, t_.radius);
    }

    const Curve &a_, &b_;
    Polynomial ax_, ay_, bx_, by_;
    Dyadic s_, t_;
};

} // namespace

PointEnclosure contact_point(const Curve& a, const Curve& b, Contact& c) {
    const PointEnclosure plain = meet(plain_point(a, c.s), plain_point(b, c.t));
    if (plain.width() <= budget::kPointWidth * std::max(size_of(a), size_of(b))) return plain;
    ContactRefiner refiner(a, b);
    if (!refiner.run(c)) return plain;
    c = {range_of(refiner.s()), range_of(refiner.t())};
    return meet(point_at(a, refiner.s()), point_at(b, refiner.t()));
}

PointEnclosure level_point(const Stretch& s, Axis axis, double v, Interval& t) {
    const Curve& c = *s.curve;
    PointEnclosure p = plain_point(c, t);
    if (p.width() > budget::kPointWidth * size_of(c)) {
        Polynomial q = power_basis(c, axis);
        if (q.empty()) q.emplace_back(0);
        q[0] -= mpz_class(v);
        if (const std::optional<Dyadic> root = narrow_root(trimmed(q), t)) {
            t = range_of(*root);
            p = point_at(c, *root);
        }
    }
    (axis == Axis::X ? p.x : p.y) = v;
    return p;
}

PointEnclosure extremum_point(const Curve& c, Interval& t) {
    const PointEnclosure plain = plain_point(c, t);
    if (plain.width() <= budget::kPointWidth * size_of(c)) return plain;
    std::optional<Dyadic> root;
    for (const Axis axis : {Axis::X, Axis::Y}) {
        const Polynomial p = power_basis(c, axis);
        Polynomial derivative;
        for (std::size_t i = 1; i < p.size(); ++i)
            derivative.push_back(p[i] * static_cast<unsigned long>(i));
        const std::optional<Dyadic> found = narrow_root(derivative, t);
        if (found && root) return plain; // extrema along both axes, too near to each other to be told apart
        if (found) root = found;
    }
    if (!root) return plain;
    t = range_of(*root);
    return point_at(c, *root);
}

} // namespace fetexc
