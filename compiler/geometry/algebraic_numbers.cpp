// SPDX-License-Identifier: GPL-3.0-or-later
/// Roots of integer polynomials: by brackets in integer arithmetic, and by CGAL's algebraic kernel what those leave
/// open.
#include "compiler/geometry/algebraic_kernel.h"
#include "compiler/geometry/dyadic_roots.h"

namespace fetexc {
namespace {

/// Each closed range holds its root only.
std::pair<mpq_class, mpq_class> isolating_range(RootBracket root, const Polynomial& p, int bits) {
    narrow(root, p, bits);
    const std::size_t scale = p.size() - 1;
    const auto ends_in_root = [&] {
        return evaluate_dyadic(p, root.lo, root.bits, scale) == 0 || evaluate_dyadic(p, root.hi, root.bits, scale) == 0;
    };
    while (root.lo != root.hi && ends_in_root()) // at another one
        narrow(root, p, root.bits + budget::kRefineBits);
    const RationalRange range = rational_range(root);
    return {range.lo, range.hi};
}

/// The root of a linear polynomial.
mpq_class rational_root(const Polynomial& p) {
    mpq_class r(-p[0], p[1]);
    r.canonicalize();
    return r;
}

/// An algebraic number narrowed step by step.
class NarrowNumber {
  public:
    explicit NarrowNumber(const AlgebraicNumber& a) : polynomial_(a.polynomial) {
        if (polynomial_.size() == 2) {
            range_.lo = range_.hi = rational_root(polynomial_);
            return;
        }
        const auto roots = bracket_roots(polynomial_, a.lo, a.hi, budget::kDescartesHalvings);
        known_ = roots && roots->size() == 1;
        if (known_) bracket_ = roots->front(), range_ = rational_range(bracket_);
    }

    [[nodiscard]] bool known() const { return known_; }
    [[nodiscard]] const RationalRange& range() const { return range_; }
    [[nodiscard]] bool exact() const { return range_.lo == range_.hi; }
    void narrow(int bits) {
        if (exact()) return;
        fetexc::narrow(bracket_, polynomial_, bits);
        range_ = rational_range(bracket_);
    }

  private:
    const Polynomial& polynomial_;
    RootBracket bracket_;
    RationalRange range_;
    bool known_ = true;
};

/// A root of both within the range.
bool common_root(const Polynomial& p, const Polynomial& q, const RationalRange& range) {
    if (range.lo == range.hi) return evaluate(p, range.lo) == 0 && evaluate(q, range.lo) == 0;
    const Polynomial factor = common_factor(p, q);
    if (factor.size() < 2) return false;
    const auto roots = bracket_roots(factor, range.lo, range.hi, budget::kDescartesHalvings);
    return roots && !roots->empty();
}

} // namespace

std::vector<std::pair<mpq_class, mpq_class>> isolate_roots(const Polynomial& p, const mpq_class& lo,
                                                           const mpq_class& hi, int bits) {
    if (p.size() < 2) return {};
    Polynomial q = p;
    std::optional<std::vector<RootBracket>> brackets = bracket_roots(q, lo, hi, budget::kDescartesHalvings);
    if (!brackets) {
        if (!certainly_square_free(q)) q = kernel::square_free_part(q);
        brackets = bracket_roots(q, lo, hi, budget::kRefineBitsLimit);
    }
    if (!brackets) return kernel::isolate_roots(p, lo, hi, bits);
    std::vector<std::pair<mpq_class, mpq_class>> out;
    for (const RootBracket& root : *brackets)
        out.push_back(isolating_range(root, q, bits));
    return out;
}

std::vector<std::pair<mpq_class, mpq_class>> isolate_roots(const Polynomial& p, int bits) {
    if (p.size() < 2) return {};
    const mpz_class bound = root_bound(p);
    return isolate_roots(p, -bound, bound, bits);
}

std::optional<int> compare_numbers(const AlgebraicNumber& a, const AlgebraicNumber& b) {
    if (a.polynomial.size() < 2 || b.polynomial.size() < 2) return {};
    NarrowNumber p(a), q(b);
    if (!p.known() || !q.known()) return kernel::compare_numbers(a, b);
    for (const int bits : {0, budget::kRefineBits, 4 * budget::kRefineBits}) {
        p.narrow(bits), q.narrow(bits);
        if (p.range().hi < q.range().lo) return -1;
        if (q.range().hi < p.range().lo) return 1;
        if (p.exact() && q.exact()) return 0;
        const RationalRange both{std::max(p.range().lo, q.range().lo), std::min(p.range().hi, q.range().hi)};
        if (bits == budget::kRefineBits && common_root(a.polynomial, b.polynomial, both)) return 0;
    }
    return kernel::compare_numbers(a, b);
}

std::optional<int> sign_at(const Polynomial& q, const AlgebraicNumber& a) {
    if (q.empty()) return 0;
    if (a.polynomial.size() < 2) return {};
    NarrowNumber p(a);
    if (!p.known()) return kernel::sign_at(q, a);
    for (const int bits : {0, budget::kRefineBits, 4 * budget::kRefineBits}) {
        p.narrow(bits);
        if (p.exact()) return sgn(evaluate(q, p.range().lo));
        const RationalRange value = evaluate_over(q, p.range());
        if (value.lo > 0) return 1;
        if (value.hi < 0) return -1;
        if (bits == budget::kRefineBits && common_root(a.polynomial, q, p.range())) return 0;
    }
    return kernel::sign_at(q, a);
}

} // namespace fetexc
