// SPDX-License-Identifier: GPL-3.0-or-later
/// Common points of two stretches through resultants. A root s of R_a says that A(s) lies on B's algebraic curve;
/// whether it lies on the stretch, and where, is decided by exclusion: A(s) is one of finitely many places, the points
/// of B at the real roots of R_b and B's isolated point, and all but one of them separate from it at some precision.
/// Most pairs need none of that: no root in the stretches, or roots that pair up to crossings with a certificate.
#include <algorithm>
#include <cmath>

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

/// Coarser, so that numbers are short, and wider, so that a root at an end has room for a certificate.
RationalRange outer_range(const Stretch& s) {
    const double scale = std::ldexp(1.0, budget::kOuterRangeBits);
    return {mpq_class((std::floor(s.range.lo * scale) - 1) / scale),
            mpq_class((std::ceil(s.range.hi * scale) + 1) / scale)};
}

RationalRange range_of(const Stretch& s) { return {mpq_class(s.range.lo), mpq_class(s.range.hi)}; }

class ExactIntersection {
  public:
    ExactIntersection(const Stretch& a, const Stretch& b, std::span<const Contact> known)
        : a_(a), b_(b), known_(known), on_a_(*a.curve), on_b_(*b.curve), ra_(eliminate(*a.curve, *b.curve)) {
        ra_ = without_known(std::move(ra_), &Contact::s);
    }

    ExactOutcome run(std::vector<ExactHit>& hits) {
        if (ra_.empty()) return ExactOutcome::CommonComponent;
        const RationalRange near_a = unknown_range(a_, &Contact::s), near_b = unknown_range(b_, &Contact::t);
        auto on_a = bracket_roots(ra_, near_a.lo, near_a.hi, budget::kDescartesHalvings);
        if (on_a && on_a->empty()) return ExactOutcome::Done;
        rb_ = eliminate(*b_.curve, *a_.curve);
        const Polynomial unknown = without_known(rb_, &Contact::t);
        auto on_b = bracket_roots(unknown, near_b.lo, near_b.hi, budget::kDescartesHalvings);
        if (on_b && on_b->empty()) return ExactOutcome::Done;
        if (!on_a || !on_b) return exclude(hits); // perhaps not all roots are simple
        for (const int bits : budget::kNearRootBits) {
            for (RootBracket& root : *on_a)
                narrow(root, ra_, bits);
            for (RootBracket& root : *on_b)
                narrow(root, unknown, bits);
            if (pair_up(near_roots(*on_a, near_a, *a_.curve), near_roots(*on_b, near_b, *b_.curve), hits))
                return ExactOutcome::Done;
        }
        return exclude(hits);
    }

    ExactOutcome run_by_kernel(std::vector<ExactHit>& hits) {
        if (ra_.empty()) return ExactOutcome::CommonComponent;
        by_kernel_ = true;
        rb_ = eliminate(*b_.curve, *a_.curve);
        return exclude(hits);
    }

  private:
    /// Without the exact parameters of known contacts.
    [[nodiscard]] Polynomial without_known(Polynomial p, Interval Contact::*parameter) const {
        for (const Contact& k : known_) {
            if (const auto end = exact_end(k.*parameter)) p = without_root(std::move(p), *end);
        }
        return p;
    }

    /// The outer range, but no farther than known contacts.
    [[nodiscard]] RationalRange unknown_range(const Stretch& stretch, Interval Contact::*parameter) const {
        RationalRange range = outer_range(stretch);
        for (const Contact& k : known_) {
            if (const auto end = exact_end(k.*parameter)) (*end == 0 ? range.lo : range.hi) = *end;
        }
        return range;
    }

    /// A root in the middle of a range of parameters that holds no other, and the point there.
    struct NearRoot {
        Interval container; ///< open
        Interval x, y;      ///< encloses the point
    };

    static std::vector<NearRoot> near_roots(const std::vector<RootBracket>& roots, const RationalRange& range,
                                            const Curve& c) {
        std::vector<Interval> t; // exact
        for (const RootBracket& root : roots)
            t.emplace_back(to_double(root.lo, root.bits), to_double(root.hi, root.bits));
        std::vector<NearRoot> out;
        for (std::size_t i = 0; i < t.size(); ++i) {
            const double from = i > 0 ? t[i - 1].hi : range.lo.get_d(),
                         to = i + 1 < t.size() ? t[i + 1].lo : range.hi.get_d();
            const double mid = t[i].mid(), radius = std::min(mid - from, to - mid);
            out.push_back({{mid - radius, mid + radius}, value_over(c, Axis::X, t[i]), value_over(c, Axis::Y, t[i])});
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
                const auto narrow = narrow_contact(*a_.curve, *b_.curve, {p.container, q.container});
                if (!narrow) return false;
                if (!overlap(narrow->s, range_of(a_)) || !overlap(narrow->t, range_of(b_))) continue;
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
        const RationalRange range = outer_range(a_);
        return roots_of(ra_, range.lo, range.hi, bits);
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
        if (!overlap(s, range_of(a_))) return true;
        const PointRange p = on_a_.at(s);
        const bool isolated = singular_ && singular_->discriminant_sign() < 0 &&
                              overlap(p, {{singular_->x, singular_->x}, {singular_->y, singular_->y}});
        std::vector<const RationalRange*> places;
        for (const RationalRange& range : t) {
            if (overlap(p, on_b_.at(range))) places.push_back(&range);
        }
        if (isolated && !places.empty()) return false;
        if (places.size() > 2 || (places.size() == 2 && !at_double_point(*places[0], *places[1]))) return false;
        for (const RationalRange* range : places) {
            if (overlap(*range, range_of(b_)) && !is_known(*range))
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
