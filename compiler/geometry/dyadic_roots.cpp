// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/geometry/dyadic_roots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace fetexc {
namespace {

void shift_left(mpz_class& v, std::size_t bits) { mpz_mul_2exp(v.get_mpz_t(), v.get_mpz_t(), bits); }

/// Near the parameter: exact at its leading bits, because close roots leave nothing of a slope in doubles.
double slope_at(const Polynomial& slope, const mpz_class& t, int bits) {
    constexpr int enough = 64;
    const int less = std::max(0, bits - enough);
    mpz_class rounded;
    mpz_fdiv_q_2exp(rounded.get_mpz_t(), t.get_mpz_t(), static_cast<mp_bitcnt_t>(less));
    const std::size_t scale = slope.size() - 1;
    return to_double(evaluate_dyadic(slope, rounded, bits - less, scale), (bits - less) * static_cast<int>(scale));
}

/// Number of changes in the sequence of signs without zeros.
int sign_changes(const std::vector<mpz_class>& values) {
    int changes = 0, last = 0;
    for (const mpz_class& v : values) {
        const int s = sgn(v);
        if (s == 0) continue;
        changes += last != 0 && s != last;
        last = s;
    }
    return changes;
}

/// lo, hi as integers over 2^bits.
struct DyadicRange {
    mpz_class lo, hi;
    int bits = 0;
};

std::optional<DyadicRange> dyadic_range(const mpq_class& lo, const mpq_class& hi) {
    DyadicRange out;
    for (const mpq_class* v : {&lo, &hi}) {
        if (mpz_popcount(v->get_den_mpz_t()) != 1) return {};
        out.bits = std::max(out.bits, static_cast<int>(mpz_scan1(v->get_den_mpz_t(), 0)));
    }
    const auto scaled = [&](const mpq_class& v) {
        mpz_class n = v.get_num();
        shift_left(n, static_cast<std::size_t>(out.bits) - mpz_scan1(v.get_den_mpz_t(), 0));
        return n;
    };
    out.lo = scaled(lo), out.hi = scaled(hi);
    return out;
}

/// p over a range as coefficients of the Bernstein basis, times a positive constant: b[0] and b[n] have the signs at
/// the ends.
std::vector<mpz_class> bernstein(const Polynomial& p, const DyadicRange& range) {
    std::vector<mpz_class> q = p;
    const std::size_t n = p.size() - 1;
    for (std::size_t i = 0; i < n; ++i) // to x/2^bits
        shift_left(q[i], static_cast<std::size_t>(range.bits) * (n - i));
    for (std::size_t i = 0; i < n; ++i) { // to lo + x
        for (std::size_t k = n; k-- > i;)
            q[k] += range.lo * q[k + 1];
    }
    mpz_class power = 1;
    for (std::size_t i = 1; i <= n; ++i) // to lo + (hi − lo)·x
        q[i] *= (power *= range.hi - range.lo);
    // b[j] = Σ C(j,i)/C(n,i)·q[i] = Σ j!/(j−i)!·(n−i)!/n!·q[i]; times n!.
    mpz_class factorial;
    for (std::size_t i = 0; i <= n; ++i)
        q[i] *= (mpz_fac_ui(factorial.get_mpz_t(), n - i), factorial);
    std::vector<mpz_class> b(n + 1);
    for (std::size_t j = 0; j <= n; ++j) {
        unsigned long falling = 1;
        for (std::size_t i = 0; i <= j; ++i) {
            b[j] += q[i] * falling;
            falling *= j - i;
        }
    }
    return b;
}

/// The part of the range in which roots are looked for: [lo, lo + width] in units of 2^-bits.
struct Piece {
    std::vector<mpz_class> b;
    mpz_class lo;
    int bits = 0;
};

/// De Casteljau at 1/2, without fractions.
void halve(const Piece& in, const mpz_class& width, Piece& left, Piece& right) {
    const std::size_t n = in.b.size() - 1;
    std::vector<mpz_class> q = in.b;
    left.b.resize(n + 1), right.b.resize(n + 1);
    for (std::size_t r = 0; r <= n; ++r) {
        mpz_mul_2exp(left.b[r].get_mpz_t(), q[0].get_mpz_t(), n - r);
        mpz_mul_2exp(right.b[n - r].get_mpz_t(), q[n - r].get_mpz_t(), n - r);
        for (std::size_t i = 0; i + r < n; ++i)
            q[i] += q[i + 1];
    }
    left.bits = right.bits = in.bits + 1;
    left.lo = 2 * in.lo, right.lo = left.lo + width;
}

int first_sign(const std::vector<mpz_class>& b) {
    const auto it = std::find_if(b.begin(), b.end(), [](const mpz_class& v) { return v != 0; });
    return it == b.end() ? 0 : sgn(*it);
}

} // namespace

mpz_class to_dyadic(double t, int bits) {
    mpz_class v;
    mpz_set_d(v.get_mpz_t(), std::ldexp(t, bits));
    return v;
}

double to_double(const mpz_class& v, int bits) {
    long exponent = 0;
    const double mantissa = mpz_get_d_2exp(&exponent, v.get_mpz_t());
    return std::ldexp(mantissa, static_cast<int>(exponent) - bits);
}

mpz_class evaluate_dyadic(const Polynomial& p, const mpz_class& value, int bits, std::size_t scale) {
    mpz_class sum = 0, term;
    for (std::size_t i = p.size(); i-- > 0;) {
        sum *= value;
        mpz_mul_2exp(term.get_mpz_t(), p[i].get_mpz_t(), static_cast<mp_bitcnt_t>(bits) * (p.size() - 1 - i));
        sum += term;
    }
    const std::size_t missing = p.empty() ? 0 : scale + 1 - p.size();
    mpz_mul_2exp(sum.get_mpz_t(), sum.get_mpz_t(), static_cast<mp_bitcnt_t>(bits) * missing);
    return sum;
}

RationalRange rational_range(const RootBracket& root) {
    RationalRange out{root.lo, root.hi};
    for (mpq_class* v : {&out.lo, &out.hi})
        mpq_div_2exp(v->get_mpq_t(), v->get_mpq_t(), static_cast<mp_bitcnt_t>(root.bits));
    return out;
}

void narrow(RootBracket& root, const Polynomial& p, int bits) {
    if (bits > budget::kRefineBits && bits / 2 > root.bits) narrow(root, p, bits / 2); // with integers half as long
    if (root.lo == root.hi) return;
    if (bits > root.bits) {
        shift_left(root.lo, static_cast<std::size_t>(bits - root.bits));
        shift_left(root.hi, static_cast<std::size_t>(bits - root.bits));
        root.bits = bits;
    }
    const std::size_t scale = p.size() - 1;
    const Polynomial slope = derivative(p);
    mpz_class mid = (root.lo + root.hi) / 2, width = root.hi - root.lo, expected = width, allowed = 1;
    shift_left(allowed, static_cast<std::size_t>(root.bits - bits));
    int side = 0;
    for (int k = 1; width > allowed; ++k) {
        const mpz_class value = evaluate_dyadic(p, mid, root.bits, scale);
        if (value == 0) {
            root.lo = root.hi = mid;
            return;
        }
        const int before = std::exchange(side, sgn(value));
        (side == root.sign_before ? root.lo : root.hi) = mid;
        width = root.hi - root.lo;
        if (k % 3 != 0 || width < expected) {
            // A Newton step that goes slightly too far, so that the bracket closes from both sides; twice as far when
            // the last one fell short.
            const double step = to_double(value, root.bits * static_cast<int>(scale)) / slope_at(slope, mid, root.bits);
            const double overshoot = side == before ? 1 : budget::kNewtonOvershoot;
            if (k % 3 == 0) expected = width / 2;
            if (std::fabs(step) <= 1) {
                mid -= to_dyadic(step * (1 + overshoot), root.bits) + (step > 0 ? 1 : -1);
                if (root.lo < mid && mid < root.hi) continue;
            }
        }
        mid = (root.lo + root.hi) / 2;
    }
}

std::optional<std::vector<RootBracket>> bracket_roots(const Polynomial& p, const mpq_class& lo, const mpq_class& hi,
                                                      int halvings) {
    const std::optional<DyadicRange> range = dyadic_range(lo, hi);
    if (!range) return {};
    std::vector<RootBracket> roots;
    if (p.size() < 2 || range->lo > range->hi) return roots;
    const auto exact = [&](const mpz_class& at, int bits) { roots.push_back({at, at, bits, 0}); };
    const mpz_class width = range->hi - range->lo;
    std::vector<Piece> stack{{bernstein(p, *range), range->lo, range->bits}};
    if (stack.back().b.front() == 0) exact(range->lo, range->bits);
    if (width == 0) return roots;
    const bool ends_in_root = stack.back().b.back() == 0;
    while (!stack.empty()) { // from left to right; each piece is open, its ends have been looked at
        const Piece piece = std::move(stack.back());
        stack.pop_back();
        if (piece.b.empty()) { // an end between two pieces
            exact(piece.lo, piece.bits);
            continue;
        }
        const int changes = sign_changes(piece.b);
        if (changes == 0) continue;
        if (changes == 1) {
            roots.push_back({piece.lo, piece.lo + width, piece.bits, first_sign(piece.b)});
            continue;
        }
        if (piece.bits - range->bits >= halvings) return {};
        Piece left, right;
        halve(piece, width, left, right);
        const bool between = right.b.front() == 0;
        Piece middle{{}, right.lo, right.bits};
        stack.push_back(std::move(right));
        if (between) stack.push_back(std::move(middle));
        stack.push_back(std::move(left));
    }
    if (ends_in_root) exact(range->hi, range->bits);
    return roots;
}

/// Cauchy: below 1 + max |p[i]/p[n]|.
mpz_class root_bound(const Polynomial& p) {
    std::size_t largest = 0;
    for (const mpz_class& c : p)
        largest = std::max(largest, mpz_sizeinbase(c.get_mpz_t(), 2));
    mpz_class bound = 1;
    shift_left(bound, largest - mpz_sizeinbase(p.back().get_mpz_t(), 2) + 2);
    return bound;
}

namespace {

constexpr std::uint64_t kPrime = (std::uint64_t{1} << 61) - 1;

std::uint64_t times(std::uint64_t a, std::uint64_t b) {
    return static_cast<std::uint64_t>(static_cast<unsigned __int128>(a) * b % kPrime);
}

std::uint64_t inverse(std::uint64_t a) {
    std::uint64_t result = 1;
    for (std::uint64_t e = kPrime - 2; e > 0; e >>= 1, a = times(a, a))
        if (e & 1) result = times(result, a);
    return result;
}

using Residues = std::vector<std::uint64_t>;

void trim(Residues& p) {
    while (!p.empty() && p.back() == 0)
        p.pop_back();
}

/// a modulo b, b ≠ 0.
void reduce(Residues& a, const Residues& b) {
    const std::uint64_t lead = inverse(b.back());
    while (a.size() >= b.size()) {
        const std::uint64_t factor = kPrime - times(a.back(), lead);
        const std::size_t shift = a.size() - b.size();
        for (std::size_t i = 0; i < b.size(); ++i)
            a[i + shift] = (a[i + shift] + times(factor, b[i])) % kPrime;
        trim(a);
    }
}

} // namespace

/// A common factor of p and its derivative would be one modulo any prime that doesn't divide p's leading coefficient.
bool certainly_square_free(const Polynomial& p) {
    Residues a, b;
    for (const mpz_class& c : p)
        a.push_back(mpz_fdiv_ui(c.get_mpz_t(), kPrime));
    for (std::size_t i = 1; i < a.size(); ++i)
        b.push_back(times(a[i], i));
    if (b.empty() || a.back() == 0 || b.back() == 0) return false;
    while (b.size() > 1) {
        reduce(a, b);
        std::swap(a, b);
    }
    return !b.empty();
}

} // namespace fetexc
