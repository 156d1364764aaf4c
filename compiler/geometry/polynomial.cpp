// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/geometry/polynomial.h"

#include <algorithm>
#include <array>

namespace fetexc {

Polynomial trimmed(Polynomial p) {
    while (!p.empty() && p.back() == 0)
        p.pop_back();
    return p;
}

Polynomial operator+(const Polynomial& a, const Polynomial& b) {
    Polynomial out = a.size() < b.size() ? b : a;
    const Polynomial& other = a.size() < b.size() ? a : b;
    for (std::size_t i = 0; i < other.size(); ++i)
        out[i] += other[i];
    return trimmed(std::move(out));
}

Polynomial operator-(const Polynomial& a, const Polynomial& b) {
    Polynomial out = a;
    out.resize(std::max(a.size(), b.size()));
    for (std::size_t i = 0; i < b.size(); ++i)
        out[i] -= b[i];
    return trimmed(std::move(out));
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
    if (a.empty() || b.empty()) return {};
    Polynomial out(a.size() + b.size() - 1);
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = 0; j < b.size(); ++j)
            mpz_addmul(out[i + j].get_mpz_t(), a[i].get_mpz_t(), b[j].get_mpz_t());
    }
    return trimmed(std::move(out));
}

Polynomial derivative(const Polynomial& p) {
    Polynomial out;
    for (std::size_t i = 1; i < p.size(); ++i)
        out.push_back(p[i] * static_cast<unsigned long>(i));
    return out;
}

Polynomial minus(Polynomial p, const mpz_class& v) {
    if (p.empty()) p.emplace_back(0);
    p[0] -= v;
    return trimmed(std::move(p));
}

mpz_class to_mpz(std::int64_t v) { return mpz_class(static_cast<long>(v)); }

std::array<std::int64_t, 4> power_coefficients(const Curve& c, Axis axis) {
    const auto v = [&](std::size_t i) { return axis == Axis::X ? c.p[i].x : c.p[i].y; }; // below 2^43
    std::array<std::int64_t, 4> k{v(0), v(1) - v(0)};
    if (c.degree == 2) k = {v(0), 2 * (v(1) - v(0)), v(2) - 2 * v(1) + v(0)};
    if (c.degree == 3) k = {v(0), 3 * (v(1) - v(0)), 3 * (v(2) - 2 * v(1) + v(0)), v(3) - 3 * v(2) + 3 * v(1) - v(0)};
    return k;
}

Polynomial power_basis(const Curve& c, Axis axis) {
    const std::array<std::int64_t, 4> k = power_coefficients(c, axis);
    std::size_t size = k.size();
    while (size > 0 && k[size - 1] == 0)
        --size;
    Polynomial out(size);
    for (std::size_t i = 0; i < size; ++i)
        out[i] = static_cast<long>(k[i]);
    return out;
}

namespace {

mpz_class coefficient(const Polynomial& p, std::size_t i) { return i < p.size() ? p[i] : mpz_class(0); }

Polynomial operator*(const mpz_class& factor, Polynomial p) {
    for (mpz_class& c : p)
        c *= factor;
    return trimmed(std::move(p));
}

/// Bezout matrix entries f_i·g_j − f_j·g_i of f(t) = p(t) − X(s) and g(t) = q(t) − Y(s). Only f_0 and g_0 hold s.
struct Bezout {
    Polynomial p, q, x, y; ///< x, y: −f_0, −g_0
    Bezout(const Curve& a, const Curve& b) : p(power_basis(b, Axis::X)), q(power_basis(b, Axis::Y)) {
        x = minus(power_basis(a, Axis::X), coefficient(p, 0));
        y = minus(power_basis(a, Axis::Y), coefficient(q, 0));
    }
    [[nodiscard]] Polynomial with_first(std::size_t i) const { return coefficient(q, i) * x - coefficient(p, i) * y; }
    [[nodiscard]] mpz_class operator()(std::size_t i, std::size_t j) const {
        return coefficient(p, i) * coefficient(q, j) - coefficient(p, j) * coefficient(q, i);
    }
};

} // namespace

Polynomial eliminate(const Curve& a, const Curve& b) {
    const Bezout m(a, b);
    const std::size_t degree = std::max(m.p.size(), m.q.size()) - 1;
    const Polynomial b00 = m.with_first(1);
    if (degree == 1) return b00;
    const Polynomial b01 = m.with_first(2);
    if (degree == 2) return m(2, 1) * b00 - b01 * b01;
    const Polynomial b02 = m.with_first(3), b11 = minus(b02, -m(2, 1));
    const mpz_class b12 = m(3, 1), b22 = m(3, 2);
    return b00 * minus(b22 * b11, b12 * b12) - b01 * (b22 * b01 - b12 * b02) + b02 * (b12 * b01 - b11 * b02);
}

mpq_class evaluate(const Polynomial& p, const mpq_class& t) {
    mpq_class v = 0;
    for (std::size_t i = p.size(); i-- > 0;)
        v = v * t + p[i];
    return v;
}

RationalRange evaluate_over(const Polynomial& p, const RationalRange& t) {
    const mpq_class mid = (t.lo + t.hi) / 2, half = (t.hi - t.lo) / 2;
    mpq_class bound = 0, power = 1;
    const mpq_class reach = std::max(mpq_class(abs(t.lo)), mpq_class(abs(t.hi)));
    for (std::size_t i = 1; i < p.size(); ++i) {
        bound += abs(p[i]) * static_cast<unsigned long>(i) * power;
        power *= reach;
    }
    const mpq_class v = evaluate(p, mid), w = bound * half;
    return {v - w, v + w};
}

Interval to_interval(const RationalRange& v) {
    // get_d truncates towards zero: one unit each way encloses.
    return {widen_down(v.lo.get_d()), widen_up(v.hi.get_d())};
}

} // namespace fetexc
