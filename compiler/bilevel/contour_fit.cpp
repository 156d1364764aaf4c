// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/bilevel/contour_fit.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <ceres/ceres.h>

#include "compiler/error_budget.h"

namespace fetexc {
namespace {

using fetex::BilevelRule;

/// Weights of a cell's corners at (u,v).
std::array<double, 4> corner_weights(double u, double v) {
    return {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
}

/// The texels' values as Ceres' parameter blocks, a texel each.
class Unknowns {
  public:
    Unknowns(const ThresholdCells& cells, const std::vector<std::uint8_t>& values)
        : cells_(cells), block_(std::size_t{cells.width()} * cells.height(), kNone) {
        const std::uint32_t n = cells.channels();
        for (const std::uint32_t t : cells.texels()) {
            block_[t] = static_cast<std::uint32_t>(numbers_.size());
            for (std::uint32_t c = 0; c < n; ++c)
                numbers_.push_back(values[std::size_t{t} * n + c] / 255.0);
        }
    }

    /// Of a texel of the cells'.
    [[nodiscard]] double* block(std::uint32_t texel) { return numbers_.data() + block_[texel]; }
    [[nodiscard]] bool fitted(std::uint32_t texel) const { return block_[texel] != kNone; }

    void bound(ceres::Problem& problem) {
        for (const std::uint32_t t : cells_.texels()) {
            double* b = block(t);
            if (!problem.HasParameterBlock(b)) continue;
            for (std::uint32_t c = 0; c < cells_.channels(); ++c) {
                problem.SetParameterLowerBound(b, static_cast<int>(c), 0.0);
                problem.SetParameterUpperBound(b, static_cast<int>(c), 1.0);
            }
        }
    }

    void round_into(std::vector<std::uint8_t>& values) const {
        const std::uint32_t n = cells_.channels();
        for (const std::uint32_t t : cells_.texels()) {
            for (std::uint32_t c = 0; c < n; ++c)
                values[std::size_t{t} * n + c] =
                    static_cast<std::uint8_t>(std::lround(std::clamp(numbers_[block_[t] + c], 0.0, 1.0) * 255));
        }
    }

  private:
    const ThresholdCells& cells_;
    std::vector<std::uint32_t> block_;
    std::vector<double> numbers_;
};

ceres::Solver::Options solver_options(int steps) {
    ceres::Solver::Options o;
    o.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    o.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE; // no BLAS: the same numbers on every machine
    o.num_threads = 1;
    o.max_num_iterations = steps;
    o.logging_type = ceres::SILENT;
    // Values that the outline says little about stay near where they are.
    o.jacobi_scaling = false;
    o.initial_trust_region_radius = o.max_trust_region_radius = budget::kFitTrustRadius;
    o.min_lm_diagonal = budget::kFitLeastDiagonal;
    o.function_tolerance = budget::kFitTolerance;
    return o;
}

/// Distance along a scan line from the texture's crossing to one of the outline.
class CrossingResidual final : public ceres::CostFunction {
  public:
    CrossingResidual(BilevelRule rule, const Cell& cell, double across, double at, bool enters)
        : rule_(rule), channels_(fetex::bilevel_channels(rule)), along_rows_(cell.along_rows), low_(cell.low),
          high_(cell.high), across_(across), at_(at), enters_(enters) {
        set_num_residuals(1);
        for (int k = 0; k < 4; ++k)
            mutable_parameter_block_sizes()->push_back(static_cast<int>(channels_));
    }

    bool Evaluate(double const* const* texels, double* residual, double** derivatives) const override {
        LineValues v;
        std::array<double, 3> from{}, to{};
        for (std::uint32_t c = 0; c < channels_; ++c) {
            const double v10 = texels[1][c], v01 = texels[2][c];
            const double from1 = along_rows_ ? v01 : v10, to0 = along_rows_ ? v10 : v01;
            from[c] = texels[0][c] + (from1 - texels[0][c]) * across_;
            to[c] = to0 + (texels[3][c] - to0) * across_;
            v.from[c] = static_cast<float>(from[c]), v.to[c] = static_cast<float>(to[c]);
        }
        const auto [channel, at] = responsible(v, from, to);
        double slope = to[channel] - from[channel];
        const double least = budget::kFitLeastSlope;
        if ((enters_ ? slope : -slope) < least) slope = enters_ ? least : -least;
        // Where the texture has no such crossing: as if it went on as steeply from here.
        const double missing = 0.5 - (from[channel] + (to[channel] - from[channel]) * at);
        residual[0] = std::clamp(at + missing / slope - at_, -kFarthest, kFarthest);
        if (derivatives == nullptr) return true;
        const std::array<double, 4> weight = along_rows_ ? corner_weights(at, across_) : corner_weights(across_, at);
        for (std::size_t k = 0; k < 4; ++k) {
            if (derivatives[k] == nullptr) continue;
            std::fill_n(derivatives[k], channels_, 0.0);
            derivatives[k][channel] = -weight[k] / slope;
        }
        return true;
    }

  private:
    static constexpr double kFarthest = 0.5; ///< texels: no crossing pulls more

    struct Place {
        std::size_t channel;
        double at;
    };
    /// The crossing in the same direction that is nearest; else the channel that decides at the outline's.
    [[nodiscard]] Place responsible(const LineValues& v, const std::array<double, 3>& from,
                                    const std::array<double, 3>& to) const {
        const TextureCrossings found = texture_crossings(rule_, v, low_, high_);
        Place best{3, at_};
        bool above = found.above_first;
        for (std::uint32_t k = 0; k < found.count; ++k) {
            above = !above;
            const double at = static_cast<double>(found.at[k]);
            if (above == enters_ && (best.channel == 3 || std::fabs(at - at_) < std::fabs(best.at - at_)))
                best = {found.channel[k], at};
        }
        if (best.channel != 3) return best;
        std::array<std::size_t, 3> order{0, 1, 2};
        const auto value = [&](std::size_t c) { return from[c] + (to[c] - from[c]) * at_; };
        std::stable_sort(order.begin(), order.begin() + channels_,
                         [&](std::size_t a, std::size_t b) { return value(a) < value(b); });
        const std::size_t deciding = rule_ == BilevelRule::Single || rule_ == BilevelRule::Min ? 0 : 1;
        return {order[deciding], at_};
    }

    BilevelRule rule_;
    std::uint32_t channels_;
    bool along_rows_;
    float low_, high_;
    double across_, at_;
    bool enters_;
};

/// Remembers the best rounded values, and ends the fit when they get worse.
class Watch final : public ceres::IterationCallback {
  public:
    Watch(const ThresholdCells& cells, const Unknowns& unknowns, std::vector<std::uint8_t>& best, FitTrace& trace)
        : cells_(cells), unknowns_(unknowns), best_(best), now_(best), trace_(trace), least_(cells.wrong_area(best)) {}

    ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
        unknowns_.round_into(now_);
        const double area = cells_.wrong_area(now_);
        if (step.iteration > 0) trace_.push_back(area);
        if (area < least_) {
            least_ = area, best_ = now_, worse_ = 0;
        } else if (step.iteration > 0 && ++worse_ >= kPatience) {
            return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
        }
        return ceres::SOLVER_CONTINUE;
    }

  private:
    static constexpr int kPatience = 3; ///< steps

    const ThresholdCells& cells_;
    const Unknowns& unknowns_;
    std::vector<std::uint8_t>& best_;
    std::vector<std::uint8_t> now_;
    FitTrace& trace_;
    double least_;
    int worse_ = 0;
};

} // namespace

namespace {

/// Σ factor·value − wanted, over values of one channel.
class LinearResidual final : public ceres::CostFunction {
  public:
    LinearResidual(std::vector<double> factors, double wanted) : factors_(std::move(factors)), wanted_(wanted) {
        set_num_residuals(1);
        mutable_parameter_block_sizes()->assign(factors_.size(), 1);
    }
    bool Evaluate(double const* const* values, double* residual, double** derivatives) const override {
        residual[0] = -wanted_;
        for (std::size_t k = 0; k < factors_.size(); ++k) {
            residual[0] += factors_[k] * values[k][0];
            if (derivatives != nullptr && derivatives[k] != nullptr) derivatives[k][0] = factors_[k];
        }
        return true;
    }

  private:
    std::vector<double> factors_;
    double wanted_;
};

/// The paper's equations, where the outline crosses the lines through the texels' centres along one axis.
class IntersectionsAndAngles {
  public:
    IntersectionsAndAngles(const ThresholdCells& cells, Unknowns& unknowns, ceres::Problem& problem)
        : width_(cells.width()), height_(cells.height()), unknowns_(unknowns), problem_(problem) {}

    void add(const ScanLines& lines, bool level) {
        const std::uint32_t along = level ? width_ : height_;
        for (std::uint32_t n = 0; n < lines.size(); ++n) {
            for (const Crossing& c : lines.crossings(n)) {
                const double place = std::floor(c.at - 0.5);
                if (place < 0 || place + 1 >= along) continue;
                add(static_cast<std::uint32_t>(place), n, c.at - 0.5 - place, c, level);
            }
        }
    }

  private:
    void add(std::uint32_t k, std::uint32_t n, double t, const Crossing& c, bool level) {
        const std::uint32_t across = level ? height_ : width_;
        const std::uint32_t before = n == 0 ? n : n - 1, after = n + 1 == across ? n : n + 1;
        if (before == n || after == n) return;
        std::vector<double*> blocks;
        for (const std::uint32_t line : {n, before, after}) {
            for (const std::uint32_t place : {k, k + 1}) {
                const std::uint32_t texel = level ? line * width_ + place : place * width_ + line;
                if (!unknowns_.fitted(texel)) return;
                blocks.push_back(unknowns_.block(texel));
            }
        }
        // The gradient: along the line the difference of its two, across it half of that of the lines beside it.
        const std::array<double, 6> g_along{-1, 1, 0, 0, 0, 0};
        const std::array<double, 6> g_across{0, 0, -(1 - t) / 2, -t / 2, (1 - t) / 2, t / 2};
        const double norm = std::hypot(c.lean, 1.0), ta = c.lean / norm, tc = 1 / norm; // the outline's direction
        const double sign = c.enters ? 1 : -1;
        const double turned = 4 * ta * ta * tc * tc; // 0: level or upright, 1: halfway
        const double slope = 0.5 / budget::kSeedReach;
        const auto combined = [&](double a, double b, double weight) {
            std::vector<double> f(6);
            for (std::size_t m = 0; m < 6; ++m)
                f[m] = weight / slope * (a * g_along[m] + b * g_across[m]);
            return f;
        };
        std::vector<double> position(6, 0.0);
        const double weight = std::sqrt(1 - turned + budget::kFitPositionFloor) / slope;
        position[0] = weight * (1 - t), position[1] = weight * t;
        problem_.AddResidualBlock(new LinearResidual(position, weight * 0.5), nullptr, blocks);
        const double angle = std::sqrt(turned);
        problem_.AddResidualBlock(new LinearResidual(combined(ta, tc, angle), 0), nullptr, blocks);
        const double steep = budget::kFitSteepness;
        problem_.AddResidualBlock(new LinearResidual(combined(sign * tc, -sign * ta, steep), steep), nullptr, blocks);
    }

    std::uint32_t width_, height_;
    Unknowns& unknowns_;
    ceres::Problem& problem_;
};

} // namespace

void fit_intersections_and_angles(const ThresholdCells& cells, std::span<const OutlineSegment> outline,
                                  std::vector<std::uint8_t>& values) {
    Unknowns unknowns(cells, values);
    ceres::Problem::Options ownership;
    ownership.disable_all_safety_checks = true;
    ceres::Problem problem(ownership);
    IntersectionsAndAngles equations(cells, unknowns, problem);
    equations.add(ScanLines(outline, cells.height(), 1, true), true);
    equations.add(ScanLines(outline, cells.width(), 1, false), false);
    if (problem.NumResidualBlocks() == 0) return;
    unknowns.bound(problem);
    ceres::Solver::Summary summary;
    ceres::Solve(solver_options(budget::kFitPaperSteps), &problem, &summary);
    unknowns.round_into(values);
}

void fit_contour(const ThresholdCells& cells, std::vector<std::uint8_t>& values, int steps, FitTrace& trace) {
    Unknowns unknowns(cells, values);
    ceres::Problem::Options ownership;
    ownership.disable_all_safety_checks = true;
    ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    // Absolute values beyond the corner of the loss: what counts is area, not its square.
    ceres::HuberLoss single(budget::kFitExactTo);
    ceres::ScaledLoss crowded(&single, budget::kFitCrowdedWeight, ceres::DO_NOT_TAKE_OWNERSHIP);
    ceres::Problem problem(ownership);
    for (const Cell& c : cells.cells()) {
        const CellTexels corners = cells.corners(c);
        // At the border two corners are one texel: the same block twice is not allowed, and half cells are flat there.
        if (corners[0] == corners[1] || corners[0] == corners[2]) continue;
        for (const CellLine& line : cells.lines(c)) {
            bool above = line.above_first;
            for (const float at : cells.crossings(line)) {
                above = !above;
                problem.AddResidualBlock(new CrossingResidual(cells.rule(), c, static_cast<double>(line.across),
                                                              static_cast<double>(at), above),
                                         line.crossings > 1 ? static_cast<ceres::LossFunction*>(&crowded) : &single,
                                         unknowns.block(corners[0]), unknowns.block(corners[1]),
                                         unknowns.block(corners[2]), unknowns.block(corners[3]));
            }
        }
    }
    if (problem.NumResidualBlocks() == 0) return;
    unknowns.bound(problem);
    Watch watch(cells, unknowns, values, trace);
    ceres::Solver::Options options = solver_options(steps);
    options.callbacks.push_back(&watch);
    options.update_state_every_iteration = true;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
}

} // namespace fetexc
