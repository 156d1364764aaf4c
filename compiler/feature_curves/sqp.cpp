// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/sqp.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fetexc::sqp {
namespace {

/// Where a variable is in a step's quadratic problem.
enum class Place : std::uint8_t { Free, Low, High };

/// Relative to the largest entry of the objective's matrix: makes it positive definite.
constexpr double kFirstShift = 1e-8;
/// Relative to the largest entry: what is added across constraints.
constexpr double kAcross = 10;
constexpr int kCurvatureHalvings = 4;
/// Relative to a constraint's derivatives: constraints that depend on each other, or can't be met, don't end the step.
constexpr double kConstraintSlack = 1e-13;
/// How often what the slack leaves of the constraints is solved for.
constexpr int kRefinements = 3;
/// Rounds of choosing active bounds: one after the other beyond the first half, where all at once may go round in a
/// circle.
constexpr int kActiveRounds = 40;
constexpr double kSufficient = 1e-4; ///< Armijo's part of the decrease
constexpr int kHalvings = 20;
constexpr double kMeritRounding = 1e-14; ///< relative

using Factor = Eigen::LLT<Matrix>;

double largest(const Matrix& m) { return m.size() > 0 ? m.cwiseAbs().maxCoeff() : 0; }

/// One step's quadratic problem: least d·b·d/2 + g·d with jacobian·d = −values and bounds of d, b positive definite.
class Step {
  public:
    Step(const Matrix& b, const Vector& g, const Jacobian& jacobian, const Values& values, const Vector& low,
         const Vector& high)
        : b_(b), g_(g), jacobian_(jacobian), values_(values), low_(low), high_(high) {}

    Vector d;
    Values multipliers;

    /// places: the bounds that were active before; those that are now.
    bool solve(std::array<Place, kMostVariables>& places) {
        for (int round = 0; round < kActiveRounds; ++round) {
            if (!solve_free(places)) return false;
            if (!change(places, round >= kActiveRounds / 2)) return true;
        }
        return false;
    }

  private:
    [[nodiscard]] double bound(int k, Place p) const { return p == Place::Low ? low_[k] : high_[k]; }

    /// With the other variables at their bounds.
    bool solve_free(const std::array<Place, kMostVariables>& places) {
        const auto n = static_cast<int>(g_.size());
        d.setZero(n);
        std::array<int, kMostVariables> free{};
        int count = 0;
        for (int k = 0; k < n; ++k) {
            if (places[static_cast<std::size_t>(k)] == Place::Free)
                free[static_cast<std::size_t>(count++)] = k;
            else
                d[k] = bound(k, places[static_cast<std::size_t>(k)]);
        }
        const Vector slope = g_ + b_ * d;
        const Values left = values_ + jacobian_ * d;
        Matrix b(count, count);
        Jacobian a(values_.size(), count);
        Vector g(count);
        for (int r = 0; r < count; ++r) {
            const int k = free[static_cast<std::size_t>(r)];
            g[r] = slope[k], a.col(r) = jacobian_.col(k);
            for (int c = 0; c < count; ++c)
                b(r, c) = b_(k, free[static_cast<std::size_t>(c)]);
        }
        Vector part;
        if (!solve_equalities(b, g, a, left, part)) return false;
        for (int r = 0; r < count; ++r)
            d[free[static_cast<std::size_t>(r)]] = part[r];
        return true;
    }

    bool solve_equalities(const Matrix& b, const Vector& g, const Jacobian& a, const Values& left, Vector& part) {
        const Factor factor(b);
        if (factor.info() != Eigen::Success) return false;
        part = -factor.solve(g);
        multipliers.setZero(left.size());
        if (left.size() == 0) return true;
        using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostConstraints, kMostConstraints>;
        using Tall = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostVariables, kMostConstraints>;
        const Tall back = factor.solve(Tall(a.transpose()));
        Square s = a.lazyProduct(back);
        s.diagonal().array() += kConstraintSlack * (1 + s.cwiseAbs().maxCoeff());
        const Eigen::LLT<Square> outer(s);
        if (outer.info() != Eigen::Success) return false;
        for (int k = 0; k < kRefinements; ++k) {
            const Values more = outer.solve(left + a * part);
            multipliers += more;
            part -= back * more;
        }
        return part.allFinite();
    }

    /// Bounds passed become active, those that hold back nothing are let go. False: nothing to do.
    bool change(std::array<Place, kMostVariables>& places, bool one) const {
        const Vector pull = g_ + b_ * d + jacobian_.transpose() * multipliers;
        bool any = false;
        double worst = 0;
        int at = -1;
        Place worst_to = Place::Free;
        for (int k = 0; k < d.size(); ++k) {
            Place& p = places[static_cast<std::size_t>(k)];
            Place to = p;
            double by = 0;
            if (p == Place::Free) {
                by = std::max(low_[k] - d[k], d[k] - high_[k]);
                if (by > kRounding) to = d[k] < low_[k] ? Place::Low : Place::High;
            } else {
                by = p == Place::Low ? -pull[k] : pull[k];
                if (by > kRounding && low_[k] < high_[k]) to = Place::Free;
            }
            if (to == p) continue;
            any = true;
            if (!one) p = to;
            if (by > worst) worst = by, at = k, worst_to = to;
        }
        if (any && one) places[static_cast<std::size_t>(at)] = worst_to;
        return any;
    }

    static constexpr double kRounding = 1e-12;
    const Matrix& b_;
    const Vector& g_;
    const Jacobian& jacobian_;
    const Values& values_;
    const Vector &low_, &high_;
};

class Solver {
  public:
    Solver(const Task& task, Vector& x) : task_(task), x_(x) {
        multipliers_.setZero(task.constraints), weights_.setZero(task.constraints);
        evaluate();
    }

    Outcome run(double accuracy, int most_steps) {
        for (int step = 1; step <= most_steps; ++step) {
            const Vector slope = task_.hessian * x_ + task_.gradient, low = task_.low - x_, high = task_.high - x_;
            const Matrix b = convex();
            Step quadratic(b, slope, jacobian_, values_, low, high);
            if (!quadratic.solve(places_)) {
                places_ = {};
                return {false, step};
            }
            const double size = quadratic.d.size() > 0 ? quadratic.d.cwiseAbs().maxCoeff() : 0;
            const bool met = off() <= accuracy;
            if (met && (size <= accuracy || -slope.dot(quadratic.d) <= accuracy)) return {true, step};
            if (!advance(quadratic, slope)) return {met && size <= std::sqrt(accuracy), step};
        }
        return {false, most_steps};
    }

  private:
    void evaluate() { task_.problem.constraints(x_, values_, jacobian_); }
    [[nodiscard]] double off() const { return values_.size() > 0 ? values_.cwiseAbs().maxCoeff() : 0; }
    [[nodiscard]] double objective(const Vector& x) const {
        return x.dot(task_.hessian * x) / 2 + task_.gradient.dot(x);
    }

    /// The Lagrangian's second derivatives if they are convex, at least where constraints and bounds leave room: what
    /// is added across these doesn't change the step. Else with as much of the constraints' part as leaves them convex.
    [[nodiscard]] Matrix convex() const {
        const auto n = x_.size();
        Matrix curvature = Matrix::Zero(n, n);
        task_.problem.add_curvature(multipliers_, curvature);
        const double shift = kFirstShift * std::max(1.0, largest(task_.hessian));
        Matrix b;
        const auto is_convex = [&](double part, double across) {
            b = task_.hessian + part * curvature;
            b.diagonal().array() += shift;
            if (across > 0) {
                b += across * jacobian_.transpose().lazyProduct(jacobian_);
                for (Eigen::Index k = 0; k < n; ++k)
                    if (places_[static_cast<std::size_t>(k)] != Place::Free) b(k, k) += across;
            }
            return Factor(b).info() == Eigen::Success;
        };
        if (is_convex(1, 0)) return b;
        const double across = kAcross * std::max(1.0, largest(curvature));
        for (int k = 0; k < kCurvatureHalvings; ++k)
            if (is_convex(std::ldexp(1.0, -k), across)) return b;
        is_convex(0, 0);
        return b;
    }

    /// Objective and constraints in one number, to get less.
    [[nodiscard]] double merit() const { return objective(x_) + weights_.dot(values_.cwiseAbs()); }

    /// Along the step as far as the merit gets less.
    bool advance(const Step& q, const Vector& slope) {
        const Values size = q.multipliers.cwiseAbs();
        weights_ = size.cwiseMax((weights_ + size) / 2); // Powell's
        const double before = merit(), gain = slope.dot(q.d) - weights_.dot(values_.cwiseAbs());
        const Vector from = x_;
        const Jacobian jacobian = jacobian_;
        double part = 1;
        for (int halving = 0;; ++halving, part /= 2) {
            if (accept(from + part * q.d, before + kSufficient * part * gain)) break;
            if (halving == 0 && accept(corrected(from + q.d, jacobian), before + kSufficient * gain)) break;
            if (halving + 1 < kHalvings) continue;
            x_ = from;
            evaluate();
            return false;
        }
        multipliers_ += part * (q.multipliers - multipliers_);
        return true;
    }

    bool accept(const Vector& x, double most) {
        x_ = x.cwiseMax(task_.low).cwiseMin(task_.high);
        evaluate();
        return merit() <= most + kMeritRounding * (1 + std::abs(most));
    }

    /// Back towards the constraints, which bend away from a step along them.
    [[nodiscard]] Vector corrected(const Vector& x, const Jacobian& jacobian) const {
        using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostConstraints, kMostConstraints>;
        Jacobian a = jacobian;
        for (int k = 0; k < x.size(); ++k)
            if (places_[static_cast<std::size_t>(k)] != Place::Free) a.col(k).setZero();
        Square s = a.lazyProduct(a.transpose());
        s.diagonal().array() += kConstraintSlack * (1 + s.diagonal().sum());
        return x - a.transpose() * s.llt().solve(values_);
    }

    const Task& task_;
    Vector& x_;
    Values values_, multipliers_;
    Jacobian jacobian_;
    std::array<Place, kMostVariables> places_{};
    Values weights_; ///< of constraints in the merit
};

} // namespace

Outcome solve(const Task& task, Vector& x, double accuracy, int most_steps) {
    return Solver(task, x).run(accuracy, most_steps);
}

} // namespace fetexc::sqp
