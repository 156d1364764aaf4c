// SPDX-License-Identifier: GPL-3.0-or-later
/// Exact decisions, for what the floating-point certificates can't decide. Slow (1 µs … 1 ms); callers count the calls.
/// Integers and rationals are GMP's, roots are isolated by Descartes' rule (dyadic_roots.h), multiple ones by
/// CGAL's Algebraic_kernel_d_1, which stays behind this header.
#pragma once

#include <gmpxx.h>

#include <optional>
#include <span>
#include <vector>

#include "compiler/geometry/curve.h"

namespace fetexc {

/// A monotone stretch of a curve: the parameter range is an outer enclosure of [t0,t1].
struct Stretch {
    const Curve* curve = nullptr;
    Interval range;
    bool x_increasing = true, y_increasing = true; ///< with growing t
};

/// Sign of the implicit form of the curve's algebraic curve at an integer point: 0 iff the point lies on it (Bezout
/// determinant).
int implicit_sign(const Curve& c, IntPoint p);

/// A(s) = B(alpha·s + beta) for rationals alpha ≠ 0, beta: the curves run on one algebraic curve with one
/// parametrisation.
struct SupportMap {
    double alpha = 0, beta = 0; ///< rounded; for ordering only
    Interval start, end;        ///< enclosures of B's parameter at A's ends
};
/// Exact; true only for degree ≥ 2 (lines are matched by planar/arcs).
bool same_support(const Curve& a, const Curve& b, SupportMap& map);

/// A common point: enclosures of its parameters on a and b, each containing exactly one.
struct Contact {
    Interval s, t;
};

struct RationalRange {
    mpq_class lo, hi;
};
/// Enclosures of a contact's parameters on a and on b, far narrower than doubles are.
struct NarrowContact {
    RationalRange s, t;
};

struct ExactHit {
    Interval s, t; ///< parameters on a and on b
    NarrowContact narrow;
};

enum class ExactOutcome { Done, CommonComponent, Undecided };

/// Common points of two monotone stretches whose algebraic curves differ, each decided exactly; parameters enclosed to
/// 2·kRefineBits. Those of `known` contacts with an exact parameter (0 or 1) are left out.
ExactOutcome intersect_exact(const Stretch& a, const Stretch& b, std::vector<ExactHit>& hits,
                             std::span<const Contact> known = {});
/// The same with every root from CGAL's algebraic kernel: slow, for tests.
ExactOutcome intersect_by_kernel(const Stretch& a, const Stretch& b, std::vector<ExactHit>& hits);

/// The singular point of a cubic: s + t and s·t of its parameters. They are real and different where the cubic crosses
/// itself, equal at a cusp, complex where the point is isolated.
struct DoublePoint {
    mpq_class sum, product, x, y;
    [[nodiscard]] int discriminant_sign() const { return sgn(sum * sum - 4 * product); }
};
/// None for lines, quadratics, and cubics whose singular point is at infinity.
std::optional<DoublePoint> singular_point(const Curve& c);

/// The parameters s < t in (0,1) with C(s) = C(t), if the cubic crosses itself there (sum and product of s and t are
/// rational; a cusp or an isolated point gives none).
std::optional<ExactHit> double_point(const Curve& c);

/// The common point of two stretches of one support beside their ends: its double point, with one branch on each.
/// reversed: their parameters run against each other (SupportMap::alpha < 0).
std::optional<ExactHit> double_point_between(const Stretch& a, const Stretch& b, bool reversed);

/// The parameter, within the range or just beside it, at which the curve passes an integer point. None when it doesn't.
std::optional<Interval> parameter_of_point(const Curve& c, IntPoint p, const Interval& range);

/// Quadratic whose roots are those two parameters; empty when there is no such point.
std::vector<mpz_class> double_point_polynomial(const Curve& c);

/// Sign of the difference of the two stretches' positions where both pass the level (along level_axis; positions along
/// the other), by bisection in rationals until they separate; 0 when they don't up to kRefineBitsLimit.
int compare_positions_exact(const Stretch& a, const Stretch& b, Axis level_axis, const mpq_class& level);
/// The same against a value.
int compare_position_exact(const Stretch& a, Axis level_axis, const mpq_class& level, const mpq_class& value);

} // namespace fetexc
