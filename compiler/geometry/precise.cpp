// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/geometry/orientation.h"
#include "compiler/geometry/precise.h"

#include <array>
#include <cstdlib>

#include "compiler/geometry/dyadic_roots.h"

namespace fetexc {
namespace {

/// A parameter t = value·2^-bits within ±radius.
struct Dyadic {
    mpz_class value;
    double radius = 0;
    int bits = budget::kPreciseBits;
};

Interval enclose(const mpz_class& v, int bits) {
    const double d = to_double(v, bits);
    return {widen_down(d), widen_up(d)};
}

Interval range_of(const Dyadic& t) {
    const Interval mid = enclose(t.value, t.bits);
    return {widen_down(mid.lo - t.radius), widen_up(mid.hi + t.radius)};
}

mpz_class evaluate_at(const Polynomial& p, const Dyadic& t) { return evaluate_dyadic(p, t.value, t.bits, 3); }

Interval coordinate_at(const Curve& c, Axis axis, const Dyadic& t) {
    const Interval mid = enclose(evaluate_at(power_basis(c, axis), t), 3 * t.bits);
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

/// For a curve of that size; and no enclosure in doubles is narrower than a few roundings of the position itself.
bool precise_enough(const Interval& v, double size) {
    return v.width() <= std::max(budget::kPointWidth * size, budget::kRoundingWidth * v.magnitude());
}
bool precise_enough(const PointEnclosure& p, double size) {
    return precise_enough(p.x, size) && precise_enough(p.y, size);
}

/// Of two enclosures of one value; the hull if one of them isn't.
Interval meet_or_hull(const Interval& a, const Interval& b) {
    const Interval m = meet(a, b);
    return empty(m) ? hull(a, b) : m;
}

PointEnclosure meet_or_hull(const PointEnclosure& a, const PointEnclosure& b) {
    return {meet_or_hull(a.x, b.x), meet_or_hull(a.y, b.y)};
}

// --- one polynomial

/// Narrows a root whose sign change shows at the ends of t, to one step of 2^-bits. None when it doesn't show there.
std::optional<Dyadic> narrow_root(const Polynomial& p, const Interval& t, int bits) {
    RootBracket root{to_dyadic(t.lo, bits), to_dyadic(t.hi, bits), bits, 0};
    const std::size_t scale = p.empty() ? 0 : p.size() - 1;
    const int at_lo = sgn(evaluate_dyadic(p, root.lo, bits, scale)),
              at_hi = sgn(evaluate_dyadic(p, root.hi, bits, scale));
    if (at_lo == 0 && root.lo <= root.hi) return Dyadic{root.lo, 0, bits};
    if (at_hi == 0) return Dyadic{root.hi, 0, bits};
    if (at_lo * at_hi > 0) return {};
    root.sign_before = at_lo;
    narrow(root, p, bits);
    return Dyadic{root.lo, root.lo == root.hi ? 0 : std::ldexp(1.0, -bits), bits};
}

RationalRange rational_range(const Dyadic& t) {
    const int bits = t.bits + budget::kPreciseBits;
    mpz_class mid = t.value;
    mpz_mul_2exp(mid.get_mpz_t(), mid.get_mpz_t(), static_cast<mp_bitcnt_t>(budget::kPreciseBits));
    const mpz_class radius = t.radius == 0 ? mpz_class(0) : mpz_class(to_dyadic(t.radius, bits) + 1);
    return fetexc::rational_range({mid - radius, mid + radius, bits, 0});
}

bool inside(const Dyadic& t, const Interval& range) {
    if (const Interval outer = range_of(t); range.lo <= outer.lo && outer.hi <= range.hi) return true;
    const RationalRange r = rational_range(t);
    return mpq_class(range.lo) <= r.lo && r.hi <= mpq_class(range.hi);
}

// --- two curves

/// Newton on A(s) − B(t) with exact residuals, and the Krawczyk test on what is left.
class ContactRefiner {
  public:
    ContactRefiner(const Curve& a, const Curve& b, int bits)
        : bits_(bits), stop_(std::ldexp(1.0, budget::kPreciseSlack - bits)), a_(a), b_(b), ax_(power_basis(a, Axis::X)),
          ay_(power_basis(a, Axis::Y)), bx_(power_basis(b, Axis::X)), by_(power_basis(b, Axis::Y)) {}

    bool run(const Contact& c) {
        s_ = {to_dyadic(c.s.mid(), bits_), 0, bits_}, t_ = {to_dyadic(c.t.mid(), bits_), 0, bits_};
        double ds = 0, dt = 0;
        for (int k = 0; k < budget::kPreciseSteps; ++k) {
            if (!step(ds, dt)) return false;
            converged_ = ds <= stop_ && dt <= stop_;
            if (converged_) break;
        }
        s_.radius = 4 * ds + stop_, t_.radius = 4 * dt + stop_;
        // Another root can't be meant: the contact is alone in its enclosures, which hold this box.
        return inside(s_, c.s) && inside(t_, c.t) && certified();
    }

    [[nodiscard]] const Dyadic& s() const { return s_; }
    [[nodiscard]] const Dyadic& t() const { return t_; }
    /// The last step was as short as it has to be; without that the box holds the contact, but may be wide.
    [[nodiscard]] bool converged() const { return converged_; }

  private:
    struct Residual {
        Interval x, y;
    };
    [[nodiscard]] Residual residual() const {
        return {enclose(evaluate_at(ax_, s_) - evaluate_at(bx_, t_), 3 * bits_),
                enclose(evaluate_at(ay_, s_) - evaluate_at(by_, t_), 3 * bits_)};
    }

    bool step(double& ds, double& dt) {
        const double s = to_double(s_.value, bits_), t = to_double(t_.value, bits_);
        const double gax = derivative_double(a_, Axis::X, s), gay = derivative_double(a_, Axis::Y, s),
                     gbx = derivative_double(b_, Axis::X, t), gby = derivative_double(b_, Axis::Y, t);
        const double d = gay * gbx - gax * gby;
        if (d == 0) return false;
        const Residual f = residual();
        const double es = (-f.x.mid() * gby + f.y.mid() * gbx) / d, et = (gax * f.y.mid() - gay * f.x.mid()) / d;
        if (!(std::fabs(es) <= 1 && std::fabs(et) <= 1)) return false; // diverges
        s_.value -= to_dyadic(es, bits_), t_.value -= to_dyadic(et, bits_);
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

    int bits_;
    double stop_;
    bool converged_ = false;
    const Curve &a_, &b_;
    Polynomial ax_, ay_, bx_, by_;
    Dyadic s_, t_;
};

/// Where line b crosses line a.
mpq_class line_parameter(const Curve& a, const Curve& b) {
    const Fixed from = cross(b.p[0], b.p[1], a.p[0]), to = cross(b.p[0], b.p[1], a.p[1]);
    mpq_class s(to_integer(from), to_integer(from - to));
    s.canonicalize();
    return s;
}

/// floor(2^64·part·length/whole); |part| ≤ |whole|.
Fixed scaled_share(Fixed part, Fixed whole, std::int64_t length) {
    static_assert(GMP_NUMB_BITS == 64);
    const auto limbs = [](Unsigned128 v) {
        return std::array{static_cast<mp_limb_t>(v), static_cast<mp_limb_t>(v >> 64)};
    };
    const auto factor = limbs(magnitude(part)), divisor = limbs(magnitude(whole));
    std::array<mp_limb_t, 4> product{}, quotient{};
    std::array<mp_limb_t, 2> rest{};
    product[3] = mpn_mul_1(&product[1], factor.data(), 2, static_cast<mp_limb_t>(std::abs(length)));
    mpn_tdiv_qr(quotient.data(), rest.data(), 0, product.data(), 4, divisor.data(), divisor[1] != 0 ? 2 : 1);
    const Fixed share = static_cast<Fixed>(static_cast<Unsigned128>(quotient[1]) << 64 | quotient[0]);
    const bool negative = (part < 0) != (whole < 0) ? length > 0 : length < 0;
    const bool exact = rest[0] == 0 && rest[1] == 0;
    return negative ? -share - (exact ? 0 : 1) : share;
}

/// Exact quotients, rounded outwards.
PointEnclosure line_crossing(const Curve& a, const Curve& b) {
    const Fixed from = cross(b.p[0], b.p[1], a.p[0]), whole = from - cross(b.p[0], b.p[1], a.p[1]);
    const auto at = [&](std::int64_t v0, std::int64_t v1) {
        if (v0 == v1) return Interval(static_cast<double>(v0));
        const Fixed v = (static_cast<Fixed>(v0) << 64) + scaled_share(from, whole, v1 - v0);
        return enclose_fixed(v, v + 1, 64);
    };
    const PointEnclosure on_a{at(a.p[0].x, a.p[1].x), at(a.p[0].y, a.p[1].y)};
    // A level or upright partner gives its coordinate exactly.
    return {b.x.magnitude == 0 ? Interval(static_cast<double>(b.p[0].x)) : on_a.x,
            b.y.magnitude == 0 ? Interval(static_cast<double>(b.p[0].y)) : on_a.y};
}

/// None also for extrema along both axes, too near to each other to be told apart.
std::optional<Dyadic> narrow_extremum(const Curve& c, const Interval& t, int bits) {
    std::optional<Dyadic> root;
    for (const Axis axis : {Axis::X, Axis::Y}) {
        const std::optional<Dyadic> found = narrow_root(derivative(power_basis(c, axis)), t, bits);
        if (found && root) return {};
        if (found) root = found;
    }
    return root;
}

Fixed to_fixed(std::int64_t v) { return static_cast<Fixed>(v) << budget::kFixedBits; }

/// Nearest multiple of 2^-kFixedBits.
Fixed to_fixed(const mpz_class& v, int bits) {
    mpz_class scaled = v;
    const auto shift = static_cast<mp_bitcnt_t>(bits - budget::kFixedBits);
    mpz_class half = 1;
    mpz_mul_2exp(half.get_mpz_t(), half.get_mpz_t(), shift - 1);
    scaled += half;
    mpz_fdiv_q_2exp(scaled.get_mpz_t(), scaled.get_mpz_t(), shift);
    mpz_class low, high;
    mpz_fdiv_r_2exp(low.get_mpz_t(), scaled.get_mpz_t(), 64);
    mpz_fdiv_q_2exp(high.get_mpz_t(), scaled.get_mpz_t(), 64);
    return (static_cast<Fixed>(high.get_si()) << 64) | static_cast<Fixed>(low.get_ui());
}

FixedPoint fixed_at(const Curve& c, const Dyadic& t) {
    return {to_fixed(evaluate_at(power_basis(c, Axis::X), t), 3 * t.bits),
            to_fixed(evaluate_at(power_basis(c, Axis::Y), t), 3 * t.bits)};
}

/// As tight as doubles are, where a few steps get there. None when they leave it too wide.
std::optional<PointEnclosure> short_point(const Curve& a, const Curve& b, double size, Contact& c) {
    ShortContact near(a, b, c);
    PointEnclosure p;
    for (int k = 0; k < budget::kShortSteps; ++k) {
        if (!near.narrow()) return {};
        p = {near.along(Axis::X), near.along(Axis::Y)};
        if (precise_enough(p, 0)) break;
    }
    if (!precise_enough(p, size)) return {};
    c = near.contact();
    return p;
}

} // namespace

PointEnclosure contact_point(const Curve& a, const Curve& b, Contact& c) {
    if (a.degree == 1 && b.degree == 1) return line_crossing(a, b);
    const PointEnclosure plain = meet_or_hull(plain_point(a, c.s), plain_point(b, c.t));
    const double size = std::max(size_of(a), size_of(b));
    if (precise_enough(plain, size)) return plain;
    if (const auto p = short_point(a, b, size, c)) return *p;
    ContactRefiner refiner(a, b, budget::kPreciseBits);
    if (!refiner.run(c)) return plain;
    c = {range_of(refiner.s()), range_of(refiner.t())};
    return meet_or_hull(point_at(a, refiner.s()), point_at(b, refiner.t()));
}

PointEnclosure level_point(const Stretch& s, Axis axis, double v, Interval& t) {
    const Curve& c = *s.curve;
    Interval across = value_over(c, other(axis), t);
    if (!precise_enough(across, size_of(c))) {
        const Polynomial q = minus(power_basis(c, axis), mpz_class(v));
        if (const std::optional<Dyadic> root = narrow_root(q, t, budget::kPreciseBits)) {
            t = range_of(*root);
            across = coordinate_at(c, other(axis), *root);
        }
    }
    return axis == Axis::X ? PointEnclosure{v, across} : PointEnclosure{across, v};
}

PointEnclosure extremum_point(const Curve& c, Interval& t) {
    const PointEnclosure plain = plain_point(c, t);
    if (precise_enough(plain, size_of(c))) return plain;
    const std::optional<Dyadic> root = narrow_extremum(c, t, budget::kPreciseBits);
    if (!root) return plain;
    t = range_of(*root);
    return point_at(c, *root);
}

// --- fixed point

std::optional<NarrowContact> narrow_contact(const Curve& a, const Curve& b, const Contact& c) {
    if (a.degree == 1 && b.degree == 1) {
        const mpq_class s = line_parameter(a, b), t = line_parameter(b, a);
        return NarrowContact{{s, s}, {t, t}};
    }
    ContactRefiner refiner(a, b, budget::kFixedParameterBits);
    if (!refiner.run(c) || !refiner.converged()) return {};
    return NarrowContact{rational_range(refiner.s()), rational_range(refiner.t())};
}

mpz_class to_integer(Fixed v) {
    mpz_class high = static_cast<long>(v >> 64), low = static_cast<unsigned long>(v);
    mpz_mul_2exp(high.get_mpz_t(), high.get_mpz_t(), 64);
    return high + low;
}

FixedPoint fixed(IntPoint p) { return {to_fixed(p.x), to_fixed(p.y)}; }

FixedPoint fixed_contact(const Curve& a, const NarrowContact& c) {
    mpq_class scaled = (c.s.lo + c.s.hi) / 2;
    mpq_mul_2exp(scaled.get_mpq_t(), scaled.get_mpq_t(), budget::kFixedParameterBits);
    return fixed_at(a, {mpz_class(scaled.get_num() / scaled.get_den()), 0, budget::kFixedParameterBits});
}

std::optional<FixedPoint> fixed_level(const Curve& c, Axis axis, std::int64_t v, const Interval& t) {
    const Polynomial p = minus(power_basis(c, axis), to_mpz(v));
    const std::optional<Dyadic> root = narrow_root(p, t, budget::kFixedParameterBits);
    if (!root) return {};
    FixedPoint point = fixed_at(c, *root);
    (axis == Axis::X ? point.x : point.y) = to_fixed(v);
    return point;
}

std::optional<FixedPoint> whole_level(const Curve& c, Axis axis, std::int64_t v, const Interval& t) {
    const double nearest = std::ldexp(std::round(std::ldexp(t.mid(), budget::kWholeBits)), -budget::kWholeBits);
    if (!t.contains(nearest)) return {};
    if (derivative_over(c, axis, t).sign() == 0) return {}; // t might hold the other side of an extremum, too
    const std::int64_t s = ShortParameter(nearest).mid;
    const FixedPoint p{FixedCoordinate(c, Axis::X).at(s), FixedCoordinate(c, Axis::Y).at(s)};
    return (axis == Axis::X ? p.x : p.y) == to_fixed(v) ? std::optional(p) : std::nullopt;
}

std::optional<FixedPoint> fixed_extremum(const Curve& c, const Interval& t) {
    const std::optional<Dyadic> root = narrow_extremum(c, t, budget::kFixedParameterBits);
    return root ? std::optional(fixed_at(c, *root)) : std::nullopt;
}

} // namespace fetexc
