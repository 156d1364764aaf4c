// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/bilevel/contour_fit.h"

#include <algorithm>
#include <cmath>

#include "compiler/error_budget.h"

namespace fetexc {
namespace {

using fetex::BilevelRule;

/// Weights of a cell's corners at (u,v).
std::array<double, 4> corner_weights(double u, double v) {
    return {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
}

/// The texels' values as a problem's unknowns, a block each.
class Unknowns {
  public:
    Unknowns(const ThresholdCells& cells, const ValueLevels& levels, const std::vector<std::uint16_t>& stored)
        : cells_(cells), levels_(levels), block_(std::size_t{cells.width()} * cells.height(), kNone) {
        const std::uint32_t n = cells.channels();
        for (std::uint32_t k = 0; k < cells.texels().size(); ++k) {
            const std::uint32_t t = cells.texels()[k];
            block_[t] = k;
            for (std::uint32_t c = 0; c < n; ++c)
                numbers_.push_back(stored[std::size_t{t} * n + c] / static_cast<double>(levels.steps));
        }
    }

    /// Of a texel of the cells'.
    [[nodiscard]] std::uint32_t block(std::uint32_t texel) const { return block_[texel]; }
    [[nodiscard]] bool fitted(std::uint32_t texel) const { return block_[texel] != kNone; }

    /// Within the levels, offsets left out; no residuals yet.
    [[nodiscard]] LeastSquares problem() {
        LeastSquares out;
        out.unknowns = numbers_, out.block_size = cells_.channels();
        out.low = levels_.low(), out.high = levels_.high();
        return out;
    }

    void round_into(std::vector<std::uint16_t>& stored) const {
        const std::uint32_t n = cells_.channels();
        for (const std::uint32_t t : cells_.texels()) {
            for (std::uint32_t c = 0; c < n; ++c)
                stored[std::size_t{t} * n + c] = levels_.nearest(numbers_[std::size_t{block_[t]} * n + c]);
        }
    }

  private:
    const ThresholdCells& cells_;
    const ValueLevels& levels_;
    std::vector<std::uint32_t> block_;
    std::vector<double> numbers_;
};

LeastSquaresOptions fit_options(int steps) {
    return {steps, budget::kFitTrustRadius, budget::kFitLeastDiagonal, budget::kFitTolerance, {}};
}

/// Distances along a cell's scan lines from the texture's crossings to those of the outline, by absolute value: their
/// squares are Huber's loss of them, for what counts is area.
class CrossingResiduals {
  public:
    CrossingResiduals(const ThresholdCells& cells, const ValueLevels& levels, const Cell& cell)
        : rule_(cells.rule()), channels_(cells.channels()), along_rows_(cell.along_rows), low_(cell.low),
          high_(cell.high) {
        std::ranges::transform(cells.corners(cell), offsets_.begin(),
                               [&](std::uint32_t texel) { return static_cast<double>(levels.offset(texel)); });
        for (const CellLine& line : cells.lines(cell)) {
            bool above = line.above_first;
            const double weight = line.crossings > 1 ? std::sqrt(budget::kFitCrowdedWeight) : 1.0;
            for (const float at : cells.crossings(line)) {
                above = !above;
                wanted_.push_back({static_cast<double>(line.across), static_cast<double>(at), weight, above});
            }
        }
    }

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(wanted_.size()); }

    /// As LeastSquares::evaluate; the blocks are the cell's texels.
    void evaluate(const double* const* texels, double* residuals, double** derivatives) const {
        if (derivatives != nullptr) {
            for (std::size_t k = 0; k < 4; ++k) {
                if (derivatives[k] != nullptr) std::fill_n(derivatives[k], wanted_.size() * channels_, 0.0);
            }
        }
        for (std::size_t n = 0; n < wanted_.size(); ++n)
            residuals[n] = evaluate(wanted_[n], texels, n * channels_, derivatives);
    }

  private:
    static constexpr double kFarthest = 0.5; ///< texels: no crossing pulls more

    struct Wanted {
        double across, at, weight;
        bool enters;
    };

    double evaluate(const Wanted& w, double const* const* texels, std::size_t row, double** derivatives) const {
        LineValues v;
        std::array<double, 3> from{}, to{};
        for (std::uint32_t c = 0; c < channels_; ++c) {
            const auto value = [&](std::size_t k) { return texels[k][c] + offsets_[k]; };
            const double from0 = value(0), from1 = value(along_rows_ ? 2 : 1), to0 = value(along_rows_ ? 1 : 2);
            from[c] = from0 + (from1 - from0) * w.across;
            to[c] = to0 + (value(3) - to0) * w.across;
            v.from[c] = static_cast<float>(from[c]), v.to[c] = static_cast<float>(to[c]);
        }
        const auto [channel, at] = responsible(w, v, from, to);
        double slope = to[channel] - from[channel];
        const double least = budget::kFitLeastSlope;
        if ((w.enters ? slope : -slope) < least) slope = w.enters ? least : -least;
        // Where the texture has no such crossing: as if it went on as steeply from here.
        const double missing = 0.5 - (from[channel] + (to[channel] - from[channel]) * at);
        const double distance = std::clamp(at + missing / slope - w.at, -kFarthest, kFarthest);
        const double exact = budget::kFitExactTo, size = std::fabs(distance);
        const double root = size <= exact ? size : std::sqrt(exact * (2 * size - exact));
        if (derivatives != nullptr) {
            const double by_distance = w.weight * (size <= exact ? 1 : exact / root);
            const std::array<double, 4> weight =
                along_rows_ ? corner_weights(at, w.across) : corner_weights(w.across, at);
            for (std::size_t k = 0; k < 4; ++k) {
                if (derivatives[k] != nullptr) derivatives[k][row + channel] = -weight[k] / slope * by_distance;
            }
        }
        return w.weight * std::copysign(root, distance);
    }

    struct Place {
        std::size_t channel;
        double at;
    };
    /// The crossing in the same direction that is nearest; else the channel that decides at the outline's.
    [[nodiscard]] Place responsible(const Wanted& w, const LineValues& v, const std::array<double, 3>& from,
                                    const std::array<double, 3>& to) const {
        const TextureCrossings found = texture_crossings(rule_, v, low_, high_);
        Place best{3, w.at};
        bool above = found.above_first;
        for (std::uint32_t k = 0; k < found.count; ++k) {
            above = !above;
            const double at = static_cast<double>(found.at[k]);
            if (above == w.enters && (best.channel == 3 || std::fabs(at - w.at) < std::fabs(best.at - w.at)))
                best = {found.channel[k], at};
        }
        if (best.channel != 3) return best;
        std::array<std::size_t, 3> order{0, 1, 2};
        const auto value = [&](std::size_t c) { return from[c] + (to[c] - from[c]) * w.at; };
        std::stable_sort(order.begin(), order.begin() + channels_,
                         [&](std::size_t a, std::size_t b) { return value(a) < value(b); });
        const std::size_t deciding = rule_ == BilevelRule::Single || rule_ == BilevelRule::Min ? 0 : 1;
        return {order[deciding], w.at};
    }

    BilevelRule rule_;
    std::uint32_t channels_;
    bool along_rows_;
    float low_, high_;
    std::array<double, 4> offsets_{}; ///< of the corners
    std::vector<Wanted> wanted_;
};

/// Remembers the best rounded values, and ends the fit when they get worse.
class Watch {
  public:
    Watch(const ThresholdCells& cells, const ValueLevels& levels, const Unknowns& unknowns,
          std::vector<std::uint16_t>& best, FitTrace& trace)
        : cells_(cells), levels_(levels), unknowns_(unknowns), best_(best), now_(best), values_(best.size()),
          trace_(trace), least_(wrong_area()) {}

    /// Whether to go on.
    bool operator()(int step) {
        unknowns_.round_into(now_);
        const double area = wrong_area();
        if (step > 0) trace_.push_back(area);
        if (area < least_) {
            least_ = area, best_ = now_, worse_ = 0;
        } else if (step > 0 && ++worse_ >= kPatience) {
            return false;
        }
        return true;
    }

  private:
    static constexpr int kPatience = 3; ///< steps

    double wrong_area() {
        for (std::size_t k = 0; k < values_.size(); ++k)
            values_[k] = levels_.value(k / cells_.channels(), now_[k]);
        return cells_.wrong_area(values_);
    }

    const ThresholdCells& cells_;
    const ValueLevels& levels_;
    const Unknowns& unknowns_;
    std::vector<std::uint16_t>& best_;
    std::vector<std::uint16_t> now_;
    std::vector<float> values_; ///< of now_
    FitTrace& trace_;
    double least_;
    int worse_ = 0;
};

/// Σ factor·value − wanted, over values of one channel.
struct LinearResidual {
    std::array<double, 6> factors{};
    double wanted = 0;

    void evaluate(const double* const* values, double* residual, double** derivatives) const {
        residual[0] = -wanted;
        for (std::size_t k = 0; k < factors.size(); ++k) {
            residual[0] += factors[k] * values[k][0];
            if (derivatives != nullptr && derivatives[k] != nullptr) derivatives[k][0] = factors[k];
        }
    }
};

/// A problem with its residuals, all of one kind, which has `evaluate` as LeastSquares.
template <class Kind> class Problem {
  public:
    explicit Problem(Unknowns& unknowns) : stated_(unknowns.problem()) {}

    void add(Kind kind, std::span<const std::uint32_t> blocks, std::uint32_t values = 1) {
        const auto first = static_cast<std::uint32_t>(blocks_.size()),
                   count = static_cast<std::uint32_t>(blocks.size());
        residuals_.push_back({first, count, values});
        blocks_.insert(blocks_.end(), blocks.begin(), blocks.end());
        kinds_.push_back(std::move(kind));
    }

    void solve(const Solver& solver, const LeastSquaresOptions& options) {
        stated_.blocks = blocks_, stated_.residuals = residuals_;
        stated_.evaluate = [this](std::uint32_t k, const double* const* blocks, double* values, double** derivatives) {
            kinds_[k].evaluate(blocks, values, derivatives);
        };
        solver.least_squares(stated_, options);
    }

  private:
    LeastSquares stated_;
    std::vector<Residual> residuals_;
    std::vector<std::uint32_t> blocks_;
    std::vector<Kind> kinds_;
};

/// The paper's equations, where the outline crosses the lines through the texels' centres along one axis.
class IntersectionsAndAngles {
  public:
    IntersectionsAndAngles(const ThresholdCells& cells, const Unknowns& unknowns, Problem<LinearResidual>& problem)
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
        std::array<std::uint32_t, 6> blocks{};
        std::size_t count = 0;
        for (const std::uint32_t line : {n, before, after}) {
            for (const std::uint32_t place : {k, k + 1}) {
                const std::uint32_t texel = level ? line * width_ + place : place * width_ + line;
                if (!unknowns_.fitted(texel)) return;
                blocks[count++] = unknowns_.block(texel);
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
            std::array<double, 6> f{};
            for (std::size_t m = 0; m < 6; ++m)
                f[m] = weight / slope * (a * g_along[m] + b * g_across[m]);
            return f;
        };
        std::array<double, 6> position{};
        const double weight = std::sqrt(1 - turned + budget::kFitPositionFloor) / slope;
        position[0] = weight * (1 - t), position[1] = weight * t;
        problem_.add({position, weight * 0.5}, blocks);
        const double angle = std::sqrt(turned);
        problem_.add({combined(ta, tc, angle), 0}, blocks);
        const double steep = budget::kFitSteepness;
        problem_.add({combined(sign * tc, -sign * ta, steep), steep}, blocks);
    }

    std::uint32_t width_, height_;
    const Unknowns& unknowns_;
    Problem<LinearResidual>& problem_;
};

std::vector<std::uint16_t> widened(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }
void narrow(const std::vector<std::uint16_t>& stored, std::vector<std::uint8_t>& bytes) {
    std::ranges::transform(stored, bytes.begin(), [](std::uint16_t v) { return static_cast<std::uint8_t>(v); });
}

} // namespace

void fit_intersections_and_angles(const Solver& solver, const ThresholdCells& cells,
                                  std::span<const OutlineSegment> outline, std::vector<std::uint8_t>& values) {
    const ValueLevels bytes;
    std::vector<std::uint16_t> stored = widened(values);
    Unknowns unknowns(cells, bytes, stored);
    Problem<LinearResidual> problem(unknowns);
    IntersectionsAndAngles equations(cells, unknowns, problem);
    equations.add(ScanLines(outline, cells.height(), 1, true), true);
    equations.add(ScanLines(outline, cells.width(), 1, false), false);
    problem.solve(solver, fit_options(budget::kFitPaperSteps));
    unknowns.round_into(stored);
    narrow(stored, values);
}

void fit_contour(const Solver& solver, const ThresholdCells& cells, std::vector<std::uint8_t>& values, int steps,
                 FitTrace& trace) {
    std::vector<std::uint16_t> stored = widened(values);
    fit_contour(solver, cells, {}, stored, steps, trace);
    narrow(stored, values);
}

void fit_contour(const Solver& solver, const ThresholdCells& cells, const ValueLevels& levels,
                 std::vector<std::uint16_t>& stored, int steps, FitTrace& trace) {
    Unknowns unknowns(cells, levels, stored);
    Problem<CrossingResiduals> problem(unknowns);
    for (const Cell& c : cells.cells()) {
        const CellTexels corners = cells.corners(c);
        // At the border two corners are one texel: the same block twice is not allowed, and half cells are flat there.
        if (corners[0] == corners[1] || corners[0] == corners[2]) continue;
        CrossingResiduals residuals(cells, levels, c);
        if (residuals.size() == 0) continue;
        std::array<std::uint32_t, 4> blocks{};
        std::ranges::transform(corners, blocks.begin(), [&](std::uint32_t texel) { return unknowns.block(texel); });
        const std::uint32_t numbers = residuals.size();
        problem.add(std::move(residuals), blocks, numbers);
    }
    Watch watch(cells, levels, unknowns, stored, trace);
    LeastSquaresOptions options = fit_options(steps);
    options.goes_on = [&](int step) { return watch(step); };
    problem.solve(solver, options);
}

} // namespace fetexc
