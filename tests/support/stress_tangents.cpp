// SPDX-License-Identifier: GPL-3.0-or-later
/// Curves that touch, or miss each other by far less than a lattice step.
///
/// Integer control points, and yet gaps of 1e-15 of the canvas: along a primitive direction d the integer points lie on
/// the lines n·p = v, for n perpendicular to d and integers v, which are 1/|n| apart. A curve whose control points have
/// the values v0, v1, …, v0 has its extremum over n at t = 1/2, a rational number of quarters, so two curves that come
/// from both sides of such a line keep a distance of a quarter of 1/|n|.
#include <numeric>

#include "tests/support/stress_parts.h"

namespace fetexc::test {
namespace {

using Int128 = __int128;

/// p with n·p = 1, for n perpendicular to d.
class Frame {
  public:
    /// With a short unit vector u, points of neighbouring values are near each other; d is then nearly parallel to u.
    static Frame random(Random& random) {
        for (;;) {
            const LatticePoint u = random_offset(random, random.chance(0.7) ? 3 : 1 << random.integer(3, 10));
            if (std::gcd(u.x, u.y) != 1) continue;
            // Every d with d.x·u.y − d.y·u.x = 1 is one of them plus a multiple of u.
            std::int64_t a = 0, b = 0;
            bezout(u.y, -u.x, a, b);
            const std::int64_t length = std::max<std::int64_t>({1, std::abs(u.x), std::abs(u.y)});
            const std::int64_t times = (std::int64_t{1} << random.integer(6, 23)) / length;
            Frame f;
            f.u_ = u;
            f.d_ = LatticePoint{a, b} + (random.chance(0.5) ? times : -times) * u;
            return f;
        }
    }

    [[nodiscard]] LatticePoint direction() const { return d_; }
    [[nodiscard]] Int128 value(LatticePoint p) const {
        return static_cast<Int128>(d_.x) * p.y - static_cast<Int128>(d_.y) * p.x;
    }
    [[nodiscard]] double length() const { return std::hypot(static_cast<double>(d_.x), static_cast<double>(d_.y)); }

    /// The integer point on the line n·p = v that is nearest to another one.
    [[nodiscard]] LatticePoint on(Int128 v, LatticePoint near) const {
        const Int128 rx = near.x - v * u_.x, ry = near.y - v * u_.y;
        const Int128 square = static_cast<Int128>(d_.x) * d_.x + static_cast<Int128>(d_.y) * d_.y;
        Int128 twice = 2 * (rx * d_.x + ry * d_.y) + square;
        Int128 k = twice / (2 * square);
        if (twice < 0 && twice % (2 * square) != 0) --k;
        return {static_cast<std::int64_t>(v * u_.x + k * d_.x), static_cast<std::int64_t>(v * u_.y + k * d_.y)};
    }

  private:
    /// a·x + b·y = 1.
    static void bezout(std::int64_t a, std::int64_t b, std::int64_t& x, std::int64_t& y) {
        if (b == 0) {
            x = a, y = 0; // a is ±1
            return;
        }
        std::int64_t s = 0, t = 0;
        bezout(b, a % b, s, t);
        x = t, y = s - (a / b) * t;
    }
    LatticePoint d_, u_;
};

/// An arch over the line n·p = e/4: both ends at one value, its extremum exactly e/4, at t = 1/2, near c. rise: of its
/// ends, in steps, signed.
ControlPoints arch(Random& random, const Frame& frame, LatticePoint c, Int128 e, double rise, int degree) {
    const Int128 nearby = e / 4;
    auto v0 = nearby + static_cast<Int128>(rise * frame.length());
    const LatticePoint d = frame.direction();
    const auto half = std::max<std::int64_t>(1, std::llround(static_cast<double>(kSide / 8) / frame.length()));
    const auto at = [&](Int128 v, std::int64_t along) { return frame.on(v, c + along * d); };
    if (degree == 1) return {at(nearby, -half), at(nearby, half)};
    const std::int64_t skew = random_between(random, -half / 2, half / 2);
    if (degree == 2) { // (v0 + v1)/2 = e/4
        const Int128 v1 = e / 2 - v0;
        const LatticePoint p = at(v0, -half), q = at(v1, skew);
        return {p, q, p + 2 * half * d};
    }
    while ((e - v0) % 3 != 0) // (v0 + 3·w)/4 = e/4
        ++v0;
    const Int128 w = (e - v0) / 3;
    const LatticePoint p = at(v0, -half), q = at(w, skew - half / 3), r = at(w, skew + half / 3 + 1);
    return {p, q, r, p + 2 * half * d};
}

/// Eight times the point at t = 1/2, of degrees 2 and 3.
LatticePoint apex(const ControlPoints& c) {
    return c.size() == 3 ? 2 * (c[0] + 2 * c[1] + c[2]) : c[0] + 3 * (c[1] + c[2]) + c[3];
}

/// Moves the last point along the direction, so that the apex gets as near as possible to another one's: on it, when
/// both lie on one line and parity allows.
void move_apex(ControlPoints& c, LatticePoint to, LatticePoint d) {
    const LatticePoint off = to - apex(c);
    const double square =
        static_cast<double>(d.x) * static_cast<double>(d.x) + static_cast<double>(d.y) * static_cast<double>(d.y);
    const double times = (static_cast<double>(off.x) * static_cast<double>(d.x) +
                          static_cast<double>(off.y) * static_cast<double>(d.y)) /
                         square;
    c.back() = c.back() + std::llround(c.size() == 3 ? times / 2 : times) * d;
}

/// quarters: the distance of the second curve from the first, in 1/4 of 1/|n|; 0: they touch.
Drawing touching(Random& random, std::int64_t (*quarters)(Random&, double)) {
    const Frame frame = Frame::random(random);
    const LatticePoint c = random_centre(random);
    const Int128 e = 4 * frame.value(c);
    const double rise = random.between(0.01, 0.2) * static_cast<double>(kSide) * (random.chance(0.5) ? 1 : -1);
    Drawing out;
    const ControlPoints first = arch(random, frame, c, e, rise, random.integer(2, 3));
    out.paths.push_back({first});
    for (int n = random.integer(1, 3); n > 0; --n) {
        const std::int64_t gap = quarters(random, frame.length());
        const int degree = gap % 4 == 0 ? random.integer(1, 3) : gap % 2 == 0 ? random.integer(2, 3) : 3;
        const double other = random.chance(0.7) ? -rise * random.between(0.2, 2) : rise * random.between(0.2, 2);
        ControlPoints second = arch(random, frame, c, e + gap, other, degree);
        if (degree > 1) move_apex(second, apex(first), frame.direction());
        out.paths.push_back({random.chance(0.5) ? second : backwards(second)});
    }
    return out;
}

std::int64_t relative_gap(Random& random, double length) {
    const double gap = std::pow(10.0, -random.integer(4, 15)) * random.between(0.5, 2);
    const std::int64_t q = std::max<std::int64_t>(1, std::llround(4 * gap * static_cast<double>(kSide) * length));
    return random.chance(0.5) ? q : -q;
}

} // namespace

Drawing near_tangents(Random& random) { return touching(random, relative_gap); }

Drawing exact_tangents(Random& random) {
    return touching(random, [](Random&, double) { return std::int64_t{0}; });
}

/// From one end point with one tangent: different curvature, the same curvature, or one doubling back on the other.
Drawing shared_tangent_ends(Random& random) {
    Drawing out;
    const LatticePoint start = random_centre(random), d = random_offset(random, 1 << random.integer(4, 22));
    for (int n = random.integer(2, 5); n > 0; --n) {
        ControlPoints c = random_curve(random, random.integer(1, 3));
        c[0] = start;
        c[1] = start + (random.chance(0.8) ? 1 : -1) * random_between(random, 1, 4) * d;
        out.paths.push_back({random.chance(0.5) ? c : backwards(c)});
        if (c.size() < 4 || random.chance(0.5)) continue;
        c.back() = random_point(random); // the same tangent and curvature
        out.paths.push_back({c});
    }
    return out;
}

} // namespace fetexc::test
