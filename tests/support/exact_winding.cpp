// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/exact_winding.h"

#include <algorithm>
#include <cmath>

namespace fetexc::test {
namespace {

mpz_class to_mpz(std::int64_t v) { return mpz_class(static_cast<long>(v)); }

mpz_class shifted(const mpz_class& v, int bits) {
    mpz_class out;
    if (bits >= 0)
        mpz_mul_2exp(out.get_mpz_t(), v.get_mpz_t(), static_cast<mp_bitcnt_t>(bits));
    else
        mpz_fdiv_q_2exp(out.get_mpz_t(), v.get_mpz_t(), static_cast<mp_bitcnt_t>(-bits));
    return out;
}

using Values = std::array<mpz_class, 4>;

/// Control values of both halves, all times 2^degree.
void halve(const Values& v, int degree, Values& first, Values& second) {
    Values row = v; // row r of the triangle is times 2^r
    for (int r = 0; r <= degree; ++r) {
        first[static_cast<std::size_t>(r)] = shifted(row[0], degree - r);
        second[static_cast<std::size_t>(degree - r)] = shifted(row[static_cast<std::size_t>(degree - r)], degree - r);
        for (int i = 0; i + 1 <= degree - r; ++i)
            row[static_cast<std::size_t>(i)] += row[static_cast<std::size_t>(i) + 1];
    }
}

/// −1: all control values are below v, +1: all above, 0: neither.
int side(const Values& c, int degree, const mpz_class& v) {
    const auto below = std::count_if(c.begin(), c.begin() + degree + 1, [&](const mpz_class& u) { return u < v; });
    const auto above = std::count_if(c.begin(), c.begin() + degree + 1, [&](const mpz_class& u) { return u > v; });
    return below == degree + 1 ? -1 : above == degree + 1 ? 1 : 0;
}

/// Counts on pieces; x, y: the point, times the pieces' scale.
std::optional<int> count(const Values& cx, const Values& cy, int degree, const ExactPoint& p, int depth) {
    if (side(cy, degree, p.y) != 0 || side(cx, degree, p.x) > 0) return 0;
    const auto last = static_cast<std::size_t>(degree);
    if (side(cx, degree, p.x) < 0) return (cy[last] > p.y ? 1 : 0) - (cy[0] > p.y ? 1 : 0);
    if (depth == kPointBits / 3) return {};
    Values ax, ay, bx, by;
    halve(cx, degree, ax, bx), halve(cy, degree, ay, by);
    const ExactPoint q{shifted(p.x, degree), shifted(p.y, degree)};
    const std::optional<int> a = count(ax, ay, degree, q, depth + 1);
    const std::optional<int> b = a ? count(bx, by, degree, q, depth + 1) : a;
    return b ? *a + *b : b;
}

/// Coordinates of a curve at parameters m/2^bits, times 2^kPointBits: exact for 3·bits ≤ kPointBits.
class Dyadic {
  public:
    static constexpr int kBits = kPointBits / 3;
    Dyadic(const std::array<std::int64_t, 4>& p, int degree) : degree_(degree) {
        const mpz_class a = to_mpz(p[0]), b = to_mpz(p[1]), c = to_mpz(p[2]), d = to_mpz(p[3]);
        if (degree == 1) a_ = {a, b - a, 0, 0};
        if (degree == 2) a_ = {a, 2 * (b - a), a - 2 * b + c, 0};
        if (degree == 3) a_ = {a, 3 * (b - a), 3 * (a - 2 * b + c), d - 3 * c + 3 * b - a};
    }
    [[nodiscard]] mpz_class at(const mpz_class& m) const {
        mpz_class v = a_[static_cast<std::size_t>(degree_)];
        for (int i = degree_; i > 0; --i)
            v = v * m + shifted(a_[static_cast<std::size_t>(i) - 1], kBits * (degree_ - i + 1));
        return shifted(v, kPointBits - kBits * degree_);
    }
    /// For a first guess only.
    [[nodiscard]] long double about(long double t) const {
        long double v = 0;
        for (int i = degree_; i >= 0; --i)
            v = v * t + static_cast<long double>(a_[static_cast<std::size_t>(i)].get_si());
        return v;
    }

  private:
    int degree_;
    std::array<mpz_class, 4> a_;
};

mpz_class dyadic(double t) {
    mpz_class m;
    mpz_set_d(m.get_mpz_t(), std::floor(std::ldexp(t, Dyadic::kBits)));
    return m;
}

/// The first parameter in (lo, hi] from which on the values are on hi's side of v, by bisection; lo is the last before.
void bisect(const Dyadic& c, const mpz_class& v, bool rises, mpz_class& lo, mpz_class& hi) {
    while (hi - lo > 1) {
        const mpz_class mid = (lo + hi) >> 1;
        ((c.at(mid) < v) == rises ? lo : hi) = mid;
    }
}

/// Narrows [lo, hi] around a guess in long double, then bisects.
void narrow(const Dyadic& c, const mpz_class& v, bool rises, mpz_class& lo, mpz_class& hi) {
    const auto target = static_cast<long double>(shifted(v, 64 - kPointBits).get_d()) * 0x1p-64L;
    long double a = std::ldexp(static_cast<long double>(lo.get_d()), -Dyadic::kBits),
                b = std::ldexp(static_cast<long double>(hi.get_d()), -Dyadic::kBits);
    for (int k = 0; k < 52; ++k) {
        const long double mid = (a + b) / 2;
        ((c.about(mid) < target) == rises ? a : b) = mid;
    }
    mpz_class step = (hi - lo) >> 40;
    const mpz_class guess = dyadic(static_cast<double>(a));
    for (const mpz_class& m : {mpz_class(guess - step), mpz_class(guess + step)}) {
        if (m <= lo || m >= hi) continue;
        ((c.at(m) < v) == rises ? lo : hi) = m;
    }
    bisect(c, v, rises, lo, hi);
}

/// By whole numbers alone, for most curves: the point's coordinates are no integers, so v ≤ ⌊p⌋ is v < p.
std::optional<int> crossings_of_far_curve(const PlanarCurve& c, std::int64_t fx, std::int64_t fy) {
    const auto n = static_cast<std::size_t>(c.degree) + 1;
    const auto [x0, x1] = std::minmax_element(c.x.begin(), c.x.begin() + static_cast<std::ptrdiff_t>(n));
    const auto [y0, y1] = std::minmax_element(c.y.begin(), c.y.begin() + static_cast<std::ptrdiff_t>(n));
    if (*y1 <= fy || *y0 > fy || *x0 > fx) return 0;
    if (*x1 <= fx) return (c.y[n - 1] > fy ? 1 : 0) - (c.y[0] > fy ? 1 : 0);
    return {};
}

} // namespace

PlanarCurve planar_curve(const Segment& segment, const Grid& grid) {
    PlanarCurve out;
    out.degree = segment.degree;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(segment.degree); ++i)
        out.x[i] = segment.p[i].x * grid.kx, out.y[i] = segment.p[i].y * grid.ky;
    return out;
}

std::optional<int> crossings_left_of(const PlanarCurve& curve, const ExactPoint& point) {
    const std::int64_t fx = shifted(point.x, -kPointBits).get_si(), fy = shifted(point.y, -kPointBits).get_si();
    if (const std::optional<int> n = crossings_of_far_curve(curve, fx, fy)) return n;
    Values x, y;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(curve.degree); ++i)
        x[i] = shifted(to_mpz(curve.x[i]), kPointBits), y[i] = shifted(to_mpz(curve.y[i]), kPointBits);
    return count(x, y, curve.degree, point, 0);
}

std::optional<int> winding_at(std::span<const PlanarCurve> contour, const ExactPoint& point) {
    int sum = 0;
    for (const PlanarCurve& c : contour) {
        const std::optional<int> n = crossings_left_of(c, point);
        if (!n) return {};
        sum += *n;
    }
    return sum;
}

std::optional<ExactRange> position_at(const PlanarCurve& curve, double t0, double t1, const mpz_class& y) {
    const Dyadic cx(curve.x, curve.degree), cy(curve.y, curve.degree);
    mpz_class lo = dyadic(t0), hi = dyadic(t1) + 1;
    const bool rises = cy.at(lo) < y;
    if ((cy.at(hi) < y) == rises) return {};
    narrow(cy, y, rises, lo, hi);
    ExactRange out{cx.at(lo), cx.at(hi)};
    if (out.lo > out.hi) std::swap(out.lo, out.hi);
    return out;
}

mpq_class winding_area(std::span<const PlanarCurve> contour) {
    mpq_class sum = 0;
    for (const PlanarCurve& c : contour) {
        // Σ over Bernstein products: ∫ x dy = Σ_ij x_i (y_{j+1} − y_j) · C(n,i) C(n−1,j) / (2 C(2n−1,i+j)).
        static constexpr int choose[6][6] = {{1, 0, 0, 0, 0, 0}, {1, 1, 0, 0, 0, 0}, {1, 2, 1, 0, 0, 0},
                                             {1, 3, 3, 1, 0, 0}, {1, 4, 6, 4, 1, 0}, {1, 5, 10, 10, 5, 1}};
        const int n = c.degree;
        for (int i = 0; i <= n; ++i) {
            for (int j = 0; j < n; ++j) {
                const mpz_class product =
                    to_mpz(c.x[static_cast<std::size_t>(i)]) *
                    (to_mpz(c.y[static_cast<std::size_t>(j) + 1]) - to_mpz(c.y[static_cast<std::size_t>(j)])) *
                    (choose[n][i] * choose[n - 1][j]);
                mpq_class term(product, 2 * choose[2 * n - 1][i + j]);
                term.canonicalize();
                sum -= term;
            }
        }
    }
    return sum;
}

} // namespace fetexc::test
