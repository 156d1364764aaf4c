// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/bezier.h"

#include <algorithm>
#include <cmath>

#include "compiler/error_budget.h"

namespace fetexc::bezier {
namespace {

double mix(double a, double b, double t) { return (1 - t) * a + t * b; }

CanvasPoint mix(CanvasPoint a, CanvasPoint b, double t) { return {mix(a.x, b.x, t), mix(a.y, b.y, t)}; }

/// Blossom with one argument per degree; every control point of a part is a blossom of its end parameters.
CanvasPoint blossom(const CanvasSegment& s, const std::array<double, 3>& args) {
    std::array<CanvasPoint, 4> p = s.p;
    for (int level = 0; level < s.degree; ++level)
        for (int i = 0; i + level < s.degree; ++i)
            p[i] = mix(p[i], p[i + 1], args[level]);
    return p[0];
}

double derivative_at(const CanvasSegment& s, Axis axis, double t) {
    std::array<double, 4> d{};
    for (int i = 0; i < s.degree; ++i)
        d[i] = coordinate(s.p[i + 1], axis) - coordinate(s.p[i], axis);
    for (int level = 1; level < s.degree; ++level)
        for (int i = 0; i + level < s.degree; ++i)
            d[i] = mix(d[i], d[i + 1], t);
    return s.degree * d[0];
}

void add_interior(Parameters& out, double t) {
    if (t > 0 && t < 1 && (out.count == 0 || t != out.t[0])) out.t[out.count++] = t;
}

/// Roots of the quadratic with Bernstein coefficients d0, d1, d2 (citardauq form: no cancellation).
Parameters quadratic_roots(double d0, double d1, double d2) {
    Parameters out;
    const double scale = std::max({std::abs(d0), std::abs(d1), std::abs(d2)});
    if (!(scale > 0)) return out;
    d0 /= scale, d1 /= scale, d2 /= scale;
    const double a = d0 - 2 * d1 + d2, b = d1 - d0;
    const double disc = d1 * d1 - d0 * d2; // = b² − a·d0 without its cancellation
    if (disc < 0) return out;
    const double q = -(b + std::copysign(std::sqrt(disc), b));
    if (a != 0) add_interior(out, q / a);
    if (q != 0) add_interior(out, d0 / q);
    if (out.count == 2 && out.t[0] > out.t[1]) std::swap(out.t[0], out.t[1]);
    return out;
}

} // namespace

CanvasPoint point_at(const CanvasSegment& s, double t) { return blossom(s, {t, t, t}); }

double value_at(const CanvasSegment& s, Axis axis, double t) {
    std::array<double, 4> v{};
    for (int i = 0; i <= s.degree; ++i)
        v[i] = coordinate(s.p[i], axis);
    for (int level = 0; level < s.degree; ++level)
        for (int i = 0; i + level < s.degree; ++i)
            v[i] = mix(v[i], v[i + 1], t);
    return v[0];
}

CanvasSegment part(const CanvasSegment& s, double t0, double t1) {
    CanvasSegment out;
    out.degree = s.degree;
    for (int k = 0; k <= s.degree; ++k) {
        std::array<double, 3> args{};
        for (int i = 0; i < s.degree; ++i)
            args[i] = i < k ? t1 : t0;
        out.p[k] = blossom(s, args);
    }
    return out;
}

Parameters extrema(const CanvasSegment& s, Axis axis) {
    std::array<double, 3> d{};
    for (int i = 0; i < s.degree; ++i)
        d[i] = coordinate(s.p[i + 1], axis) - coordinate(s.p[i], axis);
    Parameters out;
    if (s.degree == 2 && d[0] != d[1]) add_interior(out, d[0] / (d[0] - d[1]));
    if (s.degree == 3) out = quadratic_roots(d[0], d[1], d[2]);
    return out;
}

double solve_monotone(const CanvasSegment& s, Axis axis, double target, double t0, double t1) {
    const bool rising = value_at(s, axis, t1) >= value_at(s, axis, t0);
    double lo = t0, hi = t1, t = mix(t0, t1, 0.5);
    // A Newton step that leaves the bracket, and every fourth step, is replaced by bisection: at most 4·64 steps.
    for (int step = 0; step < 256 && lo < hi; ++step) {
        const double error = value_at(s, axis, t) - target;
        if (error == 0) return t;
        ((error < 0) == rising ? lo : hi) = t;
        const double slope = derivative_at(s, axis, t);
        double next = t - error / slope;
        if (std::abs(next - t) <= budget::kParameterStop && next >= t0 && next <= t1) return next;
        if (!(next > lo && next < hi) || step % 4 == 3) next = mix(lo, hi, 0.5);
        if (next <= lo || next >= hi) return t;
        t = next;
    }
    return t;
}

CanvasSegment to_double(const Segment& s) {
    CanvasSegment out;
    out.degree = s.degree;
    for (int i = 0; i <= s.degree; ++i)
        out.p[i] = {static_cast<double>(s.p[i].x), static_cast<double>(s.p[i].y)};
    return out;
}

} // namespace fetexc::bezier
