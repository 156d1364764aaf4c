// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/sqp.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "compiler/error_budget.h"
#include "compiler/feature_curves/small_cholesky.h"

namespace fetexc::sqp {
namespace {

/// Where a variable is in a step's quadratic problem.
enum class Place : std::uint8_t { Free, Low, High };

/// Relative to the largest entry: what is added across constraints.
constexpr double kAcross = 10;
constexpr int kCurvatureHalvings = 4;
/// How often what the slack leaves of the constraints is solved for.
constexpr int kRefinements = 3;
/// Rounds of choosing active bounds: one after the other beyond the first half, where all at once may go round in a
/// circle.
constexpr int kActiveRounds = 40;
constexpr double kSufficient = 1e-4; ///< Armijo's part of the decrease
constexpr int kHalvings = 20;

using Factor = SmallCholesky<kMostVariables>;

double largest(const Matrix& m) { return m.size() > 0 ? m.cwiseAbs().maxCoeff() : 0; }

/// One step's quadratic problem: least d·b·d/2 + g·d with jacobian·d = −values and bounds of d, b positive definite.
class Step {
  public:
    /// whole: the factor of b.
    Step(const Matrix& b, const Factor& whole, const Vector& g, const Jacobian& jacobian, const Values& values,
         const Vector& low, const Vector& high)
        : b_(b), whole_(whole), g_(g), jacobian_(jacobian), values_(values), low_(low), high_(high) {}

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
        const auto n = static_cast<int>(g_.size()), m = static_cast<int>(values_.size());
        d.setZero(n), multipliers.setZero(m);
        count_ = 0;
        for (int k = 0; k < n; ++k) {
            const Place p = places[static_cast<std::size_t>(k)];
            if (p == Place::Free)
                free_[static_cast<std::size_t>(count_++)] = k;
            else
                d[k] = bound(k, p);
        }
        const bool bounded = count_ < n;
        const auto b = [&](int r, int c) { return b_(free(r), free(c)); };
        factor_ = bounded ? &part_ : &whole_;
        if (bounded && !part_.factor(count_, b)) return false;
        std::array<double, kMostVariables> z{}; // L⁻¹·g
        for (int r = 0; r < count_; ++r) {
            double sum = g_[free(r)];
            for (int c = 0; bounded && c < n; ++c)
                sum += b_(free(r), c) * d[c]; // free ones are 0
            z[static_cast<std::size_t>(r)] = sum;
        }
        factor_->forward(z.data());
        if (m > 0 && !solve_multipliers(z)) return false;
        // −L⁻ᵀ·(z + Y·multipliers)
        for (int k = 0; k < m; ++k)
            for (int r = 0; r < count_; ++r)
                z[static_cast<std::size_t>(r)] += y(k)[r] * multipliers[k];
        factor_->backward(z.data());
        bool finite = true;
        for (int r = 0; r < count_; ++r)
            d[free(r)] = -z[static_cast<std::size_t>(r)],
            finite = finite && std::isfinite(z[static_cast<std::size_t>(r)]);
        return finite;
    }

    /// With Y = L⁻¹·jacobianᵀ: YᵀY·multipliers = what is left of the constraints − Yᵀz.
    bool solve_multipliers(const std::array<double, kMostVariables>& z) {
        const auto m = static_cast<int>(values_.size());
        const auto dot = [&](const double* a, const double* b) {
            double sum = 0;
            for (int r = 0; r < count_; ++r)
                sum += a[r] * b[r];
            return sum;
        };
        std::array<double, kMostConstraints> left{};
        for (int k = 0; k < m; ++k) {
            for (int r = 0; r < count_; ++r)
                y(k)[r] = jacobian_(k, free(r));
            factor_->forward(y(k));
            double sum = values_[k];
            for (int c = 0; c < d.size(); ++c)
                sum += jacobian_(k, c) * d[c];
            left[static_cast<std::size_t>(k)] = sum - dot(y(k), z.data());
        }
        Square s;
        double most = 0;
        for (int r = 0; r < m; ++r)
            for (int c = 0; c <= r; ++c)
                s[static_cast<std::size_t>(r * kMostConstraints +
                                           c)] = dot(y(r), y(c)),
                                           most = std::max(
                                               most, std::abs(s[static_cast<std::size_t>(r * kMostConstraints + c)]));
        const auto lower = [&](int r, int c) {
            return s[static_cast<std::size_t>(std::max(r, c) * kMostConstraints + std::min(r, c))];
        };
        const double slack = budget::kFeatureFitSlack * (1 + most);
        if (!outer_.factor(m, [&](int r, int c) { return lower(r, c) + (r == c ? slack : 0); })) return false;
        for (int round = 0; round < kRefinements; ++round) {
            std::array<double, kMostConstraints> more{};
            for (int r = 0; r < m; ++r) {
                double sum = left[static_cast<std::size_t>(r)];
                for (int c = 0; c < m; ++c)
                    sum -= lower(r, c) * multipliers[c];
                more[static_cast<std::size_t>(r)] = sum;
            }
            outer_.solve(more.data());
            for (int r = 0; r < m; ++r)
                multipliers[r] += more[static_cast<std::size_t>(r)];
        }
        return true;
    }

    using Square = std::array<double, std::size_t{kMostConstraints} * kMostConstraints>;
    [[nodiscard]] int free(int r) const { return free_[static_cast<std::size_t>(r)]; }
    double* y(int constraint) { return y_.data() + static_cast<std::ptrdiff_t>(constraint) * kMostVariables; }

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
                if (by > budget::kFeatureFitBound) to = d[k] < low_[k] ? Place::Low : Place::High;
            } else {
                by = p == Place::Low ? -pull[k] : pull[k];
                if (by > budget::kFeatureFitBound && low_[k] < high_[k]) to = Place::Free;
            }
            if (to == p) continue;
            any = true;
            if (!one) p = to;
            if (by > worst) worst = by, at = k, worst_to = to;
        }
        if (any && one) places[static_cast<std::size_t>(at)] = worst_to;
        return any;
    }

    const Matrix& b_;
    const Factor& whole_;
    const Vector& g_;
    const Jacobian& jacobian_;
    const Values& values_;
    const Vector &low_, &high_;
    int count_ = 0;
    std::array<int, kMostVariables> free_;
    Factor part_; ///< of the free variables' part
    const Factor* factor_ = nullptr;
    SmallCholesky<kMostConstraints> outer_;
    std::array<double, std::size_t{kMostConstraints} * kMostVariables> y_;
};

class Solver {
  public:
    Solver(const Task& task, Vector& x) : task_(task), x_(x) {
        multipliers_.setZero(task.constraints), weights_.setZero(task.constraints);
        shift_ = budget::kFeatureFitShift * std::max(1.0, largest(task.hessian));
        evaluate();
    }

    Outcome run(double accuracy, int most_steps) {
        for (int step = 1; step <= most_steps; ++step) {
            const Vector slope = task_.hessian * x_ + task_.gradient, low = task_.low - x_, high = task_.high - x_;
            const Matrix b = convex();
            Step quadratic(b, factor_, slope, jacobian_, values_, low, high);
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
        double sum = 0;
        for (Eigen::Index c = 0; c < x.size(); ++c) {
            double column = 0;
            for (Eigen::Index r = 0; r < x.size(); ++r)
                column += task_.hessian(r, c) * x[r];
            sum += x[c] * (column / 2 + task_.gradient[c]);
        }
        return sum;
    }

    /// The Lagrangian's second derivatives if they are convex, at least where constraints and bounds leave room: what
    /// is added across these doesn't change the step. Else with as much of the constraints' part as leaves them convex.
    [[nodiscard]] Matrix convex() {
        const auto n = x_.size();
        Matrix curvature = Matrix::Zero(n, n);
        task_.problem.add_curvature(multipliers_, curvature);
        Matrix b;
        const auto is_convex = [&](double part, double across) {
            b = task_.hessian + part * curvature;
            b.diagonal().array() += shift_;
            if (across > 0) {
                b += across * jacobian_.transpose().lazyProduct(jacobian_);
                for (Eigen::Index k = 0; k < n; ++k)
                    if (places_[static_cast<std::size_t>(k)] != Place::Free) b(k, k) += across;
            }
            return factor_.factor(static_cast<int>(n), b);
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
        return merit() <= most + budget::kFeatureFitRounding * (1 + std::abs(most));
    }

    /// Back towards the constraints, which bend away from a step along them.
    [[nodiscard]] Vector corrected(const Vector& x, const Jacobian& jacobian) const {
        using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostConstraints, kMostConstraints>;
        Jacobian a = jacobian;
        for (int k = 0; k < x.size(); ++k)
            if (places_[static_cast<std::size_t>(k)] != Place::Free) a.col(k).setZero();
        Square s = a.lazyProduct(a.transpose());
        s.diagonal().array() += budget::kFeatureFitSlack * (1 + s.diagonal().sum());
        return x - a.transpose() * s.llt().solve(values_);
    }

    const Task& task_;
    Vector& x_;
    Values values_, multipliers_;
    Jacobian jacobian_;
    std::array<Place, kMostVariables> places_{};
    Values weights_; ///< of constraints in the merit
    double shift_ = 0;
    Factor factor_; ///< of what convex() has returned
};

} // namespace

Outcome solve(const Task& task, Vector& x, double accuracy, int most_steps) {
    return Solver(task, x).run(accuracy, most_steps);
}

} // namespace fetexc::sqp
