// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/scene/curve_distance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "compiler/error_budget.h"
#include "compiler/scene/bezier.h"

namespace fetexc {
namespace {

/// Below this part length, 2^-60 of the parameter range, the end points are all there is.
constexpr int kMaxHalvings = 60;

double dot(CanvasPoint a, CanvasPoint b) { return a.x * b.x + a.y * b.y; }

/// Lower bound: distance of the origin to the control points' box.
double box_distance(const CanvasSegment& s) {
    double x0 = s.p[0].x, x1 = x0, y0 = s.p[0].y, y1 = y0;
    for (int i = 1; i <= s.degree; ++i) {
        x0 = std::min(x0, s.p[i].x), x1 = std::max(x1, s.p[i].x);
        y0 = std::min(y0, s.p[i].y), y1 = std::max(y1, s.p[i].y);
    }
    return std::hypot(std::max({x0, -x1, 0.0}), std::max({y0, -y1, 0.0}));
}

CanvasPoint hodograph(const CanvasSegment& s, int i) {
    return {s.degree * (s.p[i + 1].x - s.p[i].x), s.degree * (s.p[i + 1].y - s.p[i].y)};
}

/// Bernstein coefficients of g = B·B', half the derivative of the squared distance to the origin.
struct Slope {
    int degree = 1;
    std::array<double, 6> c{};
};

constexpr double binomial(int n, int k) {
    double value = 1;
    for (int i = 1; i <= k; ++i)
        value = value * (n - k + i) / i;
    return value;
}

/// Weights of the product of Bernstein polynomials: w[n][i][j] = C(n,i)·C(n−1,j) / C(2n−1,i+j).
using Weights = std::array<std::array<std::array<double, 3>, 4>, 4>;
constexpr Weights product_weights() {
    Weights w{};
    for (int n = 1; n <= 3; ++n)
        for (int i = 0; i <= n; ++i)
            for (int j = 0; j < n; ++j)
                w[n][i][j] = binomial(n, i) * binomial(n - 1, j) / binomial(2 * n - 1, i + j);
    return w;
}
constexpr Weights kWeights = product_weights();

Slope slope_of(const CanvasSegment& s) {
    Slope g;
    g.degree = 2 * s.degree - 1;
    for (int j = 0; j < s.degree; ++j) {
        const CanvasPoint d = hodograph(s, j);
        for (int i = 0; i <= s.degree; ++i)
            g.c[i + j] += kWeights[s.degree][i][j] * dot(s.p[i], d);
    }
    return g;
}

int sign_changes(const Slope& g) {
    int changes = 0;
    double last = 0;
    for (int i = 0; i <= g.degree; ++i) {
        if (g.c[i] == 0) continue;
        if (last != 0 && (last < 0) != (g.c[i] < 0)) ++changes;
        last = g.c[i];
    }
    return changes;
}

double bernstein(std::array<double, 6> v, int degree, double t) {
    for (int level = 0; level < degree; ++level)
        for (int i = 0; i + level < degree; ++i)
            v[i] = (1 - t) * v[i] + t * v[i + 1];
    return v[0];
}

/// Coefficients of the derivative.
Slope derivative(const Slope& g) {
    Slope d;
    d.degree = g.degree - 1;
    for (int i = 0; i < g.degree; ++i)
        d.c[i] = g.degree * (g.c[i + 1] - g.c[i]);
    return d;
}

/// The minimum between a falling start and a rising end: Newton, with bisection where it leaves the bracket and at
/// every fourth step.
double minimum_parameter(const Slope& g) {
    const Slope d = derivative(g);
    double lo = 0, hi = 1, t = 0.5;
    for (int step = 0; step < 4 * kMaxHalvings; ++step) {
        const double value = bernstein(g.c, g.degree, t);
        if (value == 0) return t;
        (value < 0 ? lo : hi) = t;
        double next = t - value / bernstein(d.c, d.degree, t);
        if (std::abs(next - t) <= budget::kParameterStop) return t;
        if (!(next > lo && next < hi) || step % 4 == 3) next = lo + (hi - lo) / 2;
        if (next <= lo || next >= hi) return t;
        t = next;
    }
    return t;
}

double length(CanvasPoint p) { return std::hypot(p.x, p.y); }

CurveDistance nearer(CurveDistance best, const CanvasSegment& s, double local_t, double t0, double t1) {
    const double distance = length(bezier::point_at(s, local_t));
    return distance < best.distance ? CurveDistance{distance, t0 + local_t * (t1 - t0)} : best;
}

/// The segment is already translated so that the query point is the origin; it is the part over [t0,t1] of the whole.
CurveDistance search(const CanvasSegment& s, double t0, double t1, CurveDistance best, int halvings) {
    // without the slack, parts so small that their slopes are rounding noise would be halved on and on
    if (box_distance(s) + budget::kDistanceAccuracy / 2 >= best.distance) return best;
    best = nearer(nearer(best, s, 0, t0, t1), s, 1, t0, t1);
    const Slope g = slope_of(s);
    const int changes = sign_changes(g);
    if (changes == 0 || halvings == kMaxHalvings) return best;
    if (changes == 1) // a change from rising to falling is a maximum
        return g.c[0] > 0 ? best : nearer(best, s, minimum_parameter(g), t0, t1);
    const double middle = t0 + (t1 - t0) / 2;
    best = search(bezier::part(s, 0, 0.5), t0, middle, best, halvings + 1);
    return search(bezier::part(s, 0.5, 1), middle, t1, best, halvings + 1);
}

} // namespace

CurveDistance nearest_below(const CanvasSegment& s, double x, double y, CurveDistance best) {
    CanvasSegment local = s;
    for (int i = 0; i <= s.degree; ++i)
        local.p[i] = {s.p[i].x - x, s.p[i].y - y};
    return search(local, 0, 1, best, 0);
}

double distance_below(const CanvasSegment& s, double x, double y, double best) {
    return nearest_below(s, x, y, {best, 0}).distance;
}

} // namespace fetexc
