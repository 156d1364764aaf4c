// SPDX-License-Identifier: GPL-3.0-or-later
/// Common points of two stretches through resultants. A root s of R_a says that A(s) lies on B's algebraic curve;
/// whether it lies on the stretch, and where, is decided by exclusion: A(s) is one of finitely many places, the points
/// of B at the real roots of R_b and B's isolated point, and all but one of them separate from it at some precision.
/// Most pairs need none of that: no root in the stretches, or roots that pair up to crossings with a certificate.
#include <algorithm>

#include "compiler/geometry/algebraic_kernel.h"
#include "compiler/geometry/dyadic_roots.h"
#include "compiler/geometry/exact.h"
#include "compiler/geometry/precise.h"

namespace fetexc {
namespace {

using Roots = std::vector<RationalRange>;

Roots to_ranges(const std::vector<std::pair<mpq_class, mpq_class>>& roots) {
    Roots out;
    for (const auto& [lo, hi] : roots)
        out.push_back({lo, hi});
    return out;
}

struct PointRange {
    RationalRange x, y;
};

bool overlap(const RationalRange& a, const RationalRange& b) { return a.lo <= b.hi && b.lo <= a.hi; }
bool overlap(const PointRange& a, const PointRange& b) { return overlap(a.x, b.x) && overlap(a.y, b.y); }

/// A curve with its coordinates as polynomials.
struct Coordinates {
    Polynomial x, y;
    explicit Coordinates(const Curve& c) : x(power_basis(c, Axis::X)), y(power_basis(c, Axis::Y)) {}
    [[nodiscard]] PointRange at(const RationalRange& t) const { return {evaluate_over(x, t), evaluate_over(y, t)}; }
};

/// Divides by (t − v), v = 0 or 1, as often as it goes.
Polynomial without_root(Polynomial p, int v) {
    while (p.size() > 1 && evaluate(p, v) == 0) {
        for (std::size_t i = p.size() - 1; v == 1 && i > 1; --i) // synthetic division
            p[i - 1] += p[i];
        p.erase(p.begin());
    }
    return p;
}

std::optional<int> exact_end(const Interval& t) {
    if (t.lo != t.hi || (t.lo != 0 && t.lo != 1)) return {};
    return static_cast<int>(t.lo);
}

/// Rounded outwards.
Interval enclosure(const RootBracket& root) {
    return {widen_down(to_double(root.lo, root.bits)), widen_up(to_double(root.hi, root.bits))};
}

/// A narrowed bracket with one unit more on each side, but within the wide one; rounded inwards.
Interval container(const RootBracket& wide, const RootBracket& fine) {
    const double unit = std::ldexp(1.0, -fine.bits);
    const Interval all(widen_up(to_double(wide.lo, wide.bits)), widen_down(to_double(wide.hi, wide.bits)));
    return {std::max(all.lo, to_double(fine.lo, fine.bits) - unit),
            std::min(all.hi, to_double(fine.hi, fine.bits) + unit)};
}

class ExactIntersection {
  public:
    ExactIntersection(const Stretch& a, const Stretch& b, std::span<const Contact> known)
        : a_(a), b_(b), known_(known), on_a_(*a.curve), on_b_(*b.curve), ra_(eliminate(*a.curve, *b.curve)) {
        for (const Contact& k : known_) {
            if (const auto end = exact_end(k.s)) ra_ = without_root(ra_, *end);
        }
    }

    ExactOutcome run(std::vector<ExactHit>& hits) {
        if (ra_.empty()) return ExactOutcome::CommonComponent;
        const auto near_a = near_roots(ra_, a_);
        if (near_a && near_a->empty()) return ExactOutcome::Done;
        rb_ = eliminate(*b_.curve, *a_.curve);
        const auto near_b = near_roots(rb_, b_);
        if (near_b && near_b->empty()) return ExactOutcome::Done;
        if (near_a && near_b && pair_up(*near_a, *near_b, hits)) return ExactOutcome::Done;
        return exclude(hits);
    }

    ExactOutcome run_by_kernel(std::vector<ExactHit>& hits) {
        if (ra_.empty()) return ExactOutcome::CommonComponent;
        by_kernel_ = true;
        rb_ = eliminate(*b_.curve, *a_.curve);
        return exclude(hits);
    }

  private:
    /// The only root in a range of parameters, and the point there.
    struct NearRoot {
        Interval container; ///< within the range; empty: unknown
        Interval x, y;      ///< encloses the point
    };

    /// None: perhaps not all roots are simple.
    static std::optional<std::vector<NearRoot>> near_roots(const Polynomial& p, const Stretch& stretch) {
        const auto roots =
            bracket_roots(p, mpq_class(stretch.range.lo), mpq_class(stretch.range.hi), budget::kDescartesHalvings);
        if (!roots) return {};
        std::vector<NearRoot> out;
        for (const RootBracket& root : *roots) {
            RootBracket fine = root;
            narrow(fine, p, budget::kNearRootBits);
            const Interval t = enclosure(fine);
            out.push_back({container(root, fine), value_over(*stretch.curve, Axis::X, t),
                           value_over(*stretch.curve, Axis::Y, t)});
        }
        return out;
    }

    /// Crossings with a certificate, and pairs of roots that are apart. False: something else remains.
    bool pair_up(const std::vector<NearRoot>& on_a, const std::vector<NearRoot>& on_b,
                 std::vector<ExactHit>& hits) const {
        std::vector<ExactHit> found;
        for (const NearRoot& p : on_a) {
            for (const NearRoot& q : on_b) {
                if (!p.x.overlaps(q.x) || !p.y.overlaps(q.y)) continue;
                if (!(p.container.lo < p.container.hi && q.container.lo < q.container.hi)) return false;
                const auto narrow = narrow_contact(*a_.curve, *b_.curve, {p.container, q.container});
                if (!narrow) return false;
                found.push_back({to_interval(narrow->s), to_interval(narrow->t), *narrow});
            }
        }
        hits.insert(hits.end(), found.begin(), found.end());
        return true;
    }

    /// Each place at which a root of R_a may be, but one, separates from it.
    ExactOutcome exclude(std::vector<ExactHit>& hits) {
        int bits = 2 * budget::kRefineBits;
        Roots s = roots_on_a(bits);
        singular_ = singular_point(*b_.curve);
        Roots t = roots_on_b(bits);
        for (std::size_t k = 0; k < s.size(); ++k) {
            while (!place(s[k], t, hits)) {
                bits *= 2;
                if (bits > budget::kRefineBitsLimit) return ExactOutcome::Undecided;
                s = roots_on_a(bits), t = roots_on_b(bits);
            }
        }
        return ExactOutcome::Done;
    }

    [[nodiscard]] Roots roots_on_a(int bits) const {
        return roots_of(ra_, mpq_class(a_.range.lo), mpq_class(a_.range.hi), bits);
    }

    /// All real ones.
    [[nodiscard]] Roots roots_on_b(int bits) const {
        const mpz_class bound = root_bound(rb_);
        return roots_of(rb_, -bound, bound, bits);
    }

    [[nodiscard]] Roots roots_of(const Polynomial& p, const mpq_class& lo, const mpq_class& hi, int bits) const {
        return to_ranges(by_kernel_ ? kernel::isolate_roots(p, lo, hi, bits) : isolate_roots(p, lo, hi, bits));
    }

    /// False: more than one place is left.
    bool place(const RationalRange& s, const Roots& t, std::vector<ExactHit>& hits) const {
        const PointRange p = on_a_.at(s);
        const bool isolated = singular_ && singular_->discriminant_sign() < 0 &&
                              overlap(p, {{singular_->x, singular_->x}, {singular_->y, singular_->y}});
        std::vector<const RationalRange*> places;
        for (const RationalRange& range : t) {
            if (overlap(p, on_b_.at(range))) places.push_back(&range);
        }
        if (isolated && !places.empty()) return false;
        if (places.size() > 2 || (places.size() == 2 && !at_double_point(*places[0], *places[1]))) return false;
        const RationalRange stretch{mpq_class(b_.range.lo), mpq_class(b_.range.hi)};
        for (const RationalRange* range : places) {
            if (overlap(*range, stretch) && !is_known(*range))
                hits.push_back({to_interval(s), to_interval(*range), {s, *range}});
        }
        return true;
    }

    /// Both parameters give the point where B crosses itself, so they are one place.
    [[nodiscard]] bool at_double_point(const RationalRange& t, const RationalRange& u) const {
        if (!singular_ || singular_->discriminant_sign() <= 0) return false;
        const auto passes = [&](const RationalRange& r) {
            const auto on = [&](const Polynomial& p, const mpq_class& v) {
                Polynomial q;
                for (const mpz_class& c : p)
                    q.push_back(c * v.get_den());
                const auto sign = by_kernel_ ? kernel::sign_at : sign_at;
                return sign(minus(q, v.get_num()), {rb_, r.lo, r.hi}) == 0;
            };
            return on(on_b_.x, singular_->x) && on(on_b_.y, singular_->y);
        };
        return passes(t) && passes(u);
    }

    /// The only root in the range is a known contact's exact parameter.
    [[nodiscard]] bool is_known(const RationalRange& t) const {
        return std::any_of(known_.begin(), known_.end(), [&](const Contact& k) {
            const auto end = exact_end(k.t);
            return end && t.lo <= *end && *end <= t.hi && evaluate(rb_, *end) == 0;
        });
    }

    const Stretch &a_, &b_;
    std::span<const Contact> known_;
    Coordinates on_a_, on_b_;
    Polynomial ra_, rb_;
    bool by_kernel_ = false;
    std::optional<DoublePoint> singular_; ///< of b
};

} // namespace

ExactOutcome intersect_exact(const Stretch& a, const Stretch& b, std::vector<ExactHit>& hits,
                             std::span<const Contact> known) {
    return ExactIntersection(a, b, known).run(hits);
}

ExactOutcome intersect_by_kernel(const Stretch& a, const Stretch& b, std::vector<ExactHit>& hits) {
    return ExactIntersection(a, b, {}).run_by_kernel(hits);
}

} // namespace fetexc
