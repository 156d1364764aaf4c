// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/geometry/dyadic_roots.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace fetexc {
namespace {

void shift_left(mpz_class& v, std::size_t bits) { mpz_mul_2exp(v.get_mpz_t(), v.get_mpz_t(), bits); }

/// Of the longest coefficient.
std::size_t size_in_bits(const Polynomial& p) {
    std::size_t size = 0;
    for (const mpz_class& c : p)
        size = std::max(size, mpz_sizeinbase(c.get_mpz_t(), 2));
    return size;
}

/// Near the parameter: exact at its leading bits, because close roots leave nothing of a slope in doubles.
double slope_at(const Polynomial& slope, const mpz_class& t, int bits) {
    constexpr int enough = 64;
    const int less = std::max(0, bits - enough);
    mpz_class rounded;
    mpz_fdiv_q_2exp(rounded.get_mpz_t(), t.get_mpz_t(), static_cast<mp_bitcnt_t>(less));
    const std::size_t scale = slope.size() - 1;
    return to_double(evaluate_dyadic(slope, rounded, bits - less, scale), (bits - less) * static_cast<int>(scale));
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
            mpz_addmul(q[k].get_mpz_t(), range.lo.get_mpz_t(), q[k + 1].get_mpz_t());
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
            mpz_addmul_ui(b[j].get_mpz_t(), q[i].get_mpz_t(), falling);
            falling *= j - i;
        }
    }
    return b;
}

using Exact = std::vector<mpz_class>;

std::optional<int> sign_of(const Exact& b, std::size_t i) { return sgn(b[i]); }
std::size_t degree(const Exact& b) { return b.size() - 1; }

/// De Casteljau at 1/2, without fractions.
void halve(Exact q, Exact& left, Exact& right) {
    const std::size_t n = degree(q);
    left.resize(n + 1), right.resize(n + 1);
    for (std::size_t r = 0; r <= n; ++r) {
        mpz_mul_2exp(left[r].get_mpz_t(), q[0].get_mpz_t(), n - r);
        mpz_mul_2exp(right[n - r].get_mpz_t(), q[n - r].get_mpz_t(), n - r);
        for (std::size_t i = 0; i + r < n; ++i)
            q[i] += q[i + 1];
    }
}

/// The same times some power of two, each within the error.
struct Rounded {
    std::vector<double> b;
    double error = 0;
};

std::optional<int> sign_of(const Rounded& r, std::size_t i) {
    return std::fabs(r.b[i]) > r.error ? std::optional(r.b[i] > 0 ? 1 : -1) : std::nullopt;
}
std::size_t degree(const Rounded& r) { return r.b.size() - 1; }

Rounded rounded(const Exact& exact) {
    std::vector<std::pair<double, long>> parts;
    long largest = std::numeric_limits<long>::min();
    for (const mpz_class& v : exact) {
        long exponent = 0;
        const double mantissa = mpz_get_d_2exp(&exponent, v.get_mpz_t());
        parts.emplace_back(mantissa, exponent);
        if (mantissa != 0) largest = std::max(largest, exponent);
    }
    Rounded out{{}, 2 * budget::kUnitRoundoff}; // of values below 1, truncated
    for (const auto& [mantissa, exponent] : parts)
        out.b.push_back(mantissa == 0 ? 0 : std::ldexp(mantissa, static_cast<int>(exponent - largest)));
    return out;
}

/// Each level averages, so errors add: one rounding a level, doubled.
void halve(Rounded q, Rounded& left, Rounded& right) {
    const std::size_t n = degree(q);
    double size = 0;
    for (const double v : q.b)
        size = std::max(size, std::fabs(v));
    left.error = right.error = q.error + 2 * static_cast<double>(n) * budget::kUnitRoundoff * size;
    left.b.resize(n + 1), right.b.resize(n + 1);
    for (std::size_t r = 0; r <= n; ++r) {
        left.b[r] = q.b[0], right.b[n - r] = q.b[n - r];
        for (std::size_t i = 0; i + r < n; ++i)
            q.b[i] = (q.b[i] + q.b[i + 1]) / 2;
    }
}

/// Changes in the sequence of signs without zeros. From two on it may be fewer than there are; none: unknown.
template <class Coefficients> std::optional<int> sign_changes(const Coefficients& b) {
    int changes = 0, last = 0;
    bool certain = true;
    for (std::size_t i = 0; i <= degree(b); ++i) {
        const std::optional<int> s = sign_of(b, i);
        certain = certain && s;
        if (s.value_or(0) == 0) continue;
        changes += last != 0 && *s != last;
        last = *s;
    }
    return certain || changes > 1 ? std::optional(changes) : std::nullopt;
}

template <class Coefficients> int first_sign(const Coefficients& b) {
    for (std::size_t i = 0; i <= degree(b); ++i) {
        if (const int s = sign_of(b, i).value_or(0); s != 0) return s;
    }
    return 0;
}

/// The part of the range in which roots are looked for: [lo, lo + width] in units of 2^-bits.
template <class Coefficients> struct Piece {
    std::optional<Coefficients> b; ///< none: an end between two pieces, which is a root
    mpz_class lo;
    int bits = 0;
};

RootBracket bracket_of(const Piece<Exact>& piece, const mpz_class& width, int /*bits*/) {
    return {piece.lo, piece.lo + width, piece.bits, first_sign(*piece.b)};
}

/// Halving on costs next to nothing here, as long as signs are known.
RootBracket bracket_of(const Piece<Rounded>& piece, const mpz_class& width, int bits) {
    RootBracket root{piece.lo, 0, piece.bits, first_sign(*piece.b)};
    Rounded b = *piece.b, left, right;
    for (; root.bits < bits; ++root.bits) {
        halve(b, left, right);
        const int middle = sign_of(right, 0).value_or(0);
        if (middle == 0) break;
        root.lo *= 2;
        if (middle == root.sign_before) root.lo += width;
        std::swap(b, middle == root.sign_before ? right : left);
    }
    root.hi = root.lo + width;
    return root;
}

/// Without the range's ends. None: an unknown sign, or too many halvings.
template <class Coefficients>
std::optional<std::vector<RootBracket>> brackets_within(Coefficients b, const DyadicRange& range, int halvings) {
    std::vector<RootBracket> roots;
    const mpz_class width = range.hi - range.lo;
    std::vector<Piece<Coefficients>> stack{{std::move(b), range.lo, range.bits}};
    while (!stack.empty()) { // from left to right; each piece is open, its ends have been looked at
        const Piece<Coefficients> piece = std::move(stack.back());
        stack.pop_back();
        if (!piece.b) {
            roots.push_back({piece.lo, piece.lo, piece.bits, 0});
            continue;
        }
        const std::optional<int> changes = sign_changes(*piece.b);
        if (!changes) return {};
        if (*changes == 1) roots.push_back(bracket_of(piece, width, range.bits + halvings));
        if (*changes < 2) continue;
        if (piece.bits - range.bits >= halvings) return {};
        Coefficients left, right;
        halve(*piece.b, left, right);
        const std::optional<int> between = sign_of(right, 0);
        if (!between) return {};
        const mpz_class mid = 2 * piece.lo + width;
        stack.push_back({std::move(right), mid, piece.bits + 1});
        if (*between == 0) stack.push_back({{}, mid, piece.bits + 1});
        stack.push_back({std::move(left), 2 * piece.lo, piece.bits + 1});
    }
    return roots;
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
    mpz_class sum, term;
    if (p.empty()) return sum;
    const auto unit = static_cast<mp_bitcnt_t>(bits);
    const std::size_t longest = (std::max(mpz_sizeinbase(value.get_mpz_t(), 2), unit) + 1) * p.size() + size_in_bits(p);
    for (mpz_class* v : {&sum, &term}) // growing step by step is most of the work otherwise
        mpz_realloc2(v->get_mpz_t(), longest + unit * (scale + 1 - p.size()));
    sum = p.back();
    for (std::size_t i = p.size() - 1; i-- > 0;) {
        sum *= value;
        mpz_mul_2exp(term.get_mpz_t(), p[i].get_mpz_t(), unit * (p.size() - 1 - i));
        sum += term;
    }
    shift_left(sum, unit * (scale + 1 - p.size()));
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
    if (p.size() < 2 || range->lo > range->hi) return std::vector<RootBracket>{};
    const Exact b = bernstein(p, *range);
    std::optional<std::vector<RootBracket>> roots;
    if (range->lo < range->hi) {
        roots = brackets_within(rounded(b), *range, halvings);
        if (!roots) roots = brackets_within(b, *range, halvings);
        if (!roots) return {};
        if (b.back() == 0) roots->push_back({range->hi, range->hi, range->bits, 0});
    } else {
        roots.emplace();
    }
    if (b.front() == 0) roots->insert(roots->begin(), {range->lo, range->lo, range->bits, 0});
    return roots;
}

/// Cauchy: below 1 + max |p[i]/p[n]|.
mpz_class root_bound(const Polynomial& p) {
    mpz_class bound = 1;
    shift_left(bound, size_in_bits(p) - mpz_sizeinbase(p.back().get_mpz_t(), 2) + 2);
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

Residues residues(const Polynomial& p) {
    Residues out;
    for (const mpz_class& c : p)
        out.push_back(mpz_fdiv_ui(c.get_mpz_t(), kPrime));
    return out;
}

/// A common factor would be one modulo any prime that doesn't divide both leading coefficients.
bool certainly_coprime(const Polynomial& p, const Polynomial& q) {
    Residues a = residues(p), b = residues(q);
    if (a.empty() || b.empty() || a.back() == 0 || b.back() == 0) return false;
    while (b.size() > 1) {
        reduce(a, b);
        std::swap(a, b);
    }
    return !b.empty();
}

void divide_by_content(Polynomial& p) {
    mpz_class content = 0;
    for (const mpz_class& c : p)
        content = gcd(content, c);
    for (mpz_class& c : p)
        mpz_divexact(c.get_mpz_t(), c.get_mpz_t(), content.get_mpz_t());
}

} // namespace

bool certainly_square_free(const Polynomial& p) { return certainly_coprime(p, derivative(p)); }

/// Euclid's algorithm, each remainder times whatever keeps it integral.
Polynomial common_factor(const Polynomial& p, const Polynomial& q) {
    if (certainly_coprime(p, q)) return {1};
    Polynomial a = p, b = q;
    while (!b.empty()) {
        divide_by_content(b);
        while (a.size() >= b.size()) {
            const mpz_class lead = a.back();
            const std::size_t shift = a.size() - b.size();
            for (mpz_class& c : a)
                c *= b.back();
            for (std::size_t i = 0; i < b.size(); ++i)
                a[i + shift] -= lead * b[i];
            a = trimmed(std::move(a));
        }
        std::swap(a, b);
    }
    return a;
}

} // namespace fetexc
