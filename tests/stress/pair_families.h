// SPDX-License-Identifier: GPL-3.0-or-later
/// Pairs of curves that are hard in a way of their own, on integers below 2^43 as in planar space.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "compiler/geometry/curve.h"
#include "tests/support/random.h"

namespace fetexc::test {

enum class Family {
    Random,
    Gentle,      ///< nearly straight
    Corner,      ///< shared end point
    Smooth,      ///< shared end point, one goes on in the direction of the other
    SameTangent, ///< shared end point, both leave it in one direction
    ZeroHandle,  ///< shared end point where the first's inner control point is, too
    TJunction,   ///< an end of the second inside the first
    NearTangent, ///< at a distance, or overlapping by it: see near_tangent()
    Tangent,
    Osculating, ///< tangent, and of the same curvature
    Identical,
    Reversed,
    PartialOverlap,
};

inline constexpr std::array<std::pair<Family, const char*>, 13> kFamilies{{
    {Family::Random, "random"},
    {Family::Gentle, "gentle"},
    {Family::Corner, "shared end, corner"},
    {Family::Smooth, "shared end, smooth"},
    {Family::SameTangent, "shared end, same tangent"},
    {Family::ZeroHandle, "shared end, zero handle"},
    {Family::TJunction, "T-junction"},
    {Family::NearTangent, "near-tangent"},
    {Family::Tangent, "tangent"},
    {Family::Osculating, "tangent, same curvature"},
    {Family::Identical, "identical"},
    {Family::Reversed, "reversed"},
    {Family::PartialOverlap, "partial overlap"},
}};

struct CurvePair {
    Curve a, b;
    double s = -1, t = -1; ///< of near-tangent pairs: where they are close to each other
};

/// Lines that overlap never reach the filter (planar/arcs joins them), and only cubics have a zero handle.
inline bool applies(Family f, int degree_a, int degree_b) {
    switch (f) {
    case Family::ZeroHandle:
        return degree_a == 3;
    case Family::SameTangent:
    case Family::NearTangent:
    case Family::Tangent:
        return degree_a > 1 || degree_b > 1;
    case Family::Osculating:
        return degree_a > 1 && degree_b > 1;
    case Family::Identical:
    case Family::Reversed:
    case Family::PartialOverlap:
        return degree_a == degree_b && degree_a > 1;
    default:
        return true;
    }
}

class PairMaker {
  public:
    explicit PairMaker(std::uint64_t seed) : random_(seed) {
        constexpr std::array<double, 3> sizes{0x1p26, 0x1p34, 0x1p42}; // lattices of 1, 2^8 and 2^14 texels
        size_ = sizes[static_cast<std::size_t>(random_.integer(0, 2))];
    }

    CurvePair make(Family f, int degree_a, int degree_b) {
        switch (f) {
        case Family::Random:
            return {any(degree_a), any(degree_b)};
        case Family::Gentle:
            return {gentle(degree_a), gentle(degree_b)};
        case Family::Corner:
            return corner(degree_a, degree_b, false);
        case Family::ZeroHandle:
            return corner(degree_a, degree_b, true);
        case Family::Smooth:
            return at_one_point(degree_a, {0, 4}, degree_b, {0, 4}, -1);
        case Family::SameTangent:
            return at_one_point(degree_a, {0, 4}, degree_b, {0, 4}, 1);
        case Family::TJunction:
            return t_junction(degree_a, degree_b);
        case Family::Tangent:
            return at_one_point(degree_a, inside(), degree_b, inside(), 1);
        case Family::Osculating:
            return osculating(degree_a, degree_b);
        case Family::Identical:
        case Family::Reversed:
            return copies(degree_a, f == Family::Reversed);
        case Family::PartialOverlap:
            return partial_overlap(degree_a);
        case Family::NearTangent:
            break;
        }
        return near_tangent(degree_a, degree_b, std::pow(10.0, -random_.between(4, 15)));
    }

    /// Tangent curves moved apart, or into each other, by `gap` times the larger side of the pair's box.
    CurvePair near_tangent(int degree_a, int degree_b, double gap) {
        size_ = 0x1p42; // gaps of 1e-15 are fractions of a step: displaced() finds them
        const std::int64_t n = gap > 1e-11 ? 4 : std::int64_t{1} << std::array{14, 7, 5}[degree_b - 1];
        const Range r = inside();
        CurvePair pair = at_one_point(degree_a, r, degree_b, {-1, n - 1}, 1);
        pair.s = static_cast<double>(-r.from) / static_cast<double>(r.to - r.from),
        pair.t = 1.0 / static_cast<double>(n);
        const double larger = size_of_box(pair), length = std::hypot(direction_.x, direction_.y);
        const double distance = (random_.chance(0.5) ? gap : -gap) * larger;
        pair.b = displaced(pair.b, n, {-direction_.y / length * distance, direction_.x / length * distance});
        return pair;
    }

  private:
    struct Range {
        std::int64_t from = 0, to = 1;
    };
    struct Vector {
        double x = 0, y = 0;
    };

    static Curve curve(int degree, const std::array<IntPoint, 4>& p) { return make_curve(degree, p); }

    IntPoint point(double low, double high) {
        return {std::llround(random_.between(low, high) * size_), std::llround(random_.between(low, high) * size_)};
    }
    /// No longer than `length`, and no shorter than a quarter of it.
    IntPoint vector(double length) {
        const double angle = random_.between(0, 6.283185307179586), r = length * random_.between(0.25, 1);
        return {std::llround(r * std::cos(angle)), std::llround(r * std::sin(angle))};
    }

    Curve any(int degree) {
        std::array<IntPoint, 4> p{};
        for (int i = 0; i <= degree; ++i)
            p[i] = point(0, 1);
        return curve(degree, p);
    }

    Curve gentle(int degree) {
        std::array<IntPoint, 4> p{};
        p[0] = point(0, 1), p[degree] = point(0, 1);
        for (int i = 1; i < degree; ++i) {
            const double t = static_cast<double>(i) / degree, off = 0.05 * size_;
            const auto mix = [&](std::int64_t v, std::int64_t w) {
                return std::llround((1 - t) * static_cast<double>(v) + t * static_cast<double>(w) +
                                    random_.between(0, off));
            };
            p[i] = {mix(p[0].x, p[degree].x), mix(p[0].y, p[degree].y)};
        }
        return curve(degree, p);
    }

    CurvePair corner(int degree_a, int degree_b, bool zero_handle) {
        std::array<IntPoint, 4> a{}, b{};
        for (IntPoint& p : a)
            p = point(0, 1);
        for (IntPoint& p : b)
            p = point(0, 1);
        const bool at_end_of_a = random_.chance(0.5), at_end_of_b = random_.chance(0.5);
        const int end = at_end_of_a ? degree_a : 0;
        b[at_end_of_b ? degree_b : 0] = a[end];
        if (zero_handle) a[at_end_of_a ? degree_a - 1 : 1] = a[end];
        return {curve(degree_a, a), curve(degree_b, b), -1, -1};
    }

    Range inside() { return {-random_.integer(1, 3), random_.integer(1, 3)}; }

    /// C(t) = p + D·d·t + E·e·t² + f·t³ (D, E: binomials) for t in the range, with integer control points: the blossom
    /// at integers.
    static Curve through(int degree, IntPoint p, IntPoint d, IntPoint e, IntPoint f, Range range) {
        std::array<IntPoint, 4> control{};
        for (int i = 0; i <= degree; ++i) {
            std::array<std::int64_t, 3> u{};
            for (int k = 0; k < degree; ++k)
                u[k] = k < degree - i ? range.from : range.to;
            const std::int64_t s1 = u[0] + u[1] + u[2], s2 = u[0] * u[1] + u[0] * u[2] + u[1] * u[2],
                               s3 = u[0] * u[1] * u[2];
            control[i] = {p.x + s1 * d.x + s2 * e.x + s3 * f.x, p.y + s1 * d.y + s2 * e.y + s3 * f.y};
        }
        return curve(degree, control);
    }

    Curve through(int degree, IntPoint p, IntPoint d, IntPoint e, Range range) {
        const double reach = static_cast<double>(std::max(-range.from, range.to));
        const IntPoint f = vector(size_ / (16 * reach * reach * reach));
        return through(degree, p, d, degree > 1 ? e : IntPoint{}, degree > 2 ? f : IntPoint{}, range);
    }

    /// Both pass one point at their parameter 0, in the same direction or (sense −1) in opposite ones.
    CurvePair at_one_point(int degree_a, Range range_a, int degree_b, Range range_b, int sense) {
        const auto reach = [](Range r) { return static_cast<double>(std::max(-r.from, r.to)); };
        const double ra = reach(range_a), rb = reach(range_b), most = std::max(ra, rb);
        const IntPoint p = point(0.45, 0.55);
        direction_ = vector(size_ / (32 * most));
        const std::int64_t ma = random_.integer(1, std::max(1, static_cast<int>(most / ra))),
                           mb = random_.integer(1, std::max(1, static_cast<int>(most / rb)));
        const IntPoint ea = vector(size_ / (16 * ra * ra)), eb = vector(size_ / (16 * rb * rb));
        return {through(degree_a, p, times(direction_, ma), ea, range_a),
                through(degree_b, p, times(direction_, sense * mb), eb, range_b)};
    }

    static IntPoint times(IntPoint v, std::int64_t k) { return {k * v.x, k * v.y}; }

    /// One point, one first derivative and one second derivative. Of degree n: C' = n·d, C'' = n·(n − 1)·e.
    CurvePair osculating(int degree_a, int degree_b) {
        const IntPoint p = point(0.45, 0.55), d = vector(size_ / 192), e = vector(size_ / 512);
        const auto one = [&](int degree, int other) {
            return through(degree, p, times(d, other), times(e, other == 3 ? 3 : 1), inside());
        };
        const Curve a = one(degree_a, degree_b);
        return {a, one(degree_b, degree_a)};
    }

    CurvePair t_junction(int degree_a, int degree_b) {
        const IntPoint p = point(0.45, 0.55);
        const Range ra = inside();
        const Range rb = random_.chance(0.5) ? Range{0, random_.integer(1, 3)} : Range{-random_.integer(1, 3), 0};
        const auto one = [&](int degree, Range r) {
            const double reach = static_cast<double>(std::max(-r.from, r.to));
            return through(degree, p, vector(size_ / (16 * reach)), vector(size_ / (16 * reach * reach)), r);
        };
        return {one(degree_a, ra), one(degree_b, rb)};
    }

    static double size_of_box(const CurvePair& pair) {
        double x0 = 0x1p60, y0 = 0x1p60, x1 = -0x1p60, y1 = -0x1p60;
        for (const Curve* c : {&pair.a, &pair.b}) {
            for (int i = 0; i <= c->degree; ++i) {
                const double x = static_cast<double>(c->p[i].x), y = static_cast<double>(c->p[i].y);
                x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
            }
        }
        return std::max(x1 - x0, y1 - y0);
    }

    /// Moves the curve's point at parameter 1/n by v, to within n^−degree steps: whole steps by moving all control
    /// points, the rest by the last one, whose weight there is n^−degree.
    static Curve displaced(const Curve& c, std::int64_t n, Vector v) {
        std::int64_t parts = 1;
        for (int i = 0; i < c.degree; ++i)
            parts *= n;
        const auto split = [&](double d) {
            const double whole = std::floor(d);
            return std::pair(static_cast<std::int64_t>(whole), std::llround((d - whole) * static_cast<double>(parts)));
        };
        const auto [x, part_x] = split(v.x);
        const auto [y, part_y] = split(v.y);
        std::array<IntPoint, 4> p = c.p;
        for (int i = 0; i <= c.degree; ++i)
            p[i] = {p[i].x + x, p[i].y + y};
        p[c.degree].x += part_x, p[c.degree].y += part_y;
        return curve(c.degree, p);
    }

    static Curve reversed(const Curve& c) {
        std::array<IntPoint, 4> p{};
        for (int i = 0; i <= c.degree; ++i)
            p[i] = c.p[c.degree - i];
        return curve(c.degree, p);
    }

    CurvePair copies(int degree, bool reverse) {
        const Curve c = any(degree);
        return {c, reverse ? reversed(c) : c};
    }

    /// Two parts of one curve that share a third.
    CurvePair partial_overlap(int degree) {
        const IntPoint p = point(0.45, 0.55), d = vector(size_ / 96), e = vector(size_ / 256),
                       f = vector(degree > 2 ? size_ / 512 : 0);
        const std::int64_t from = random_.integer(0, 1), to = random_.integer(2, 3);
        const Curve a = through(degree, p, d, e, f, {-1, to - 1}), b = through(degree, p, d, e, f, {from, 4});
        return {a, random_.chance(0.5) ? reversed(b) : b};
    }

    Random random_;
    double size_ = 0;
    IntPoint direction_;
};

} // namespace fetexc::test
