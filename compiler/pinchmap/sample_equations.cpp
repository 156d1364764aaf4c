// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/sample_equations.h"

#include <algorithm>
#include <cmath>

#include "compiler/error_budget.h"
#include "compiler/parallel.h"

namespace fetexc {
namespace {

/// Of conjugate gradients, at most.
constexpr int kRounds = 400;
constexpr int kSpreads = 64;

using Colors = std::array<double, 4>;

} // namespace

SampleEquations::SampleEquations(std::uint32_t width, std::uint32_t first, std::uint32_t end)
    : width_(width), first_(first), rows_(std::size_t{width} * (end - first)) {}

void SampleEquations::add(double x, double y, const Colors& color, double weight) {
    const double last_x = width_ - 1.0, at_x = std::clamp(x - 0.5, 0.0, last_x), at_y = std::max(y - 0.5, 0.0);
    const auto a = static_cast<std::uint32_t>(std::min(at_x, std::max(last_x - 1, 0.0)));
    const auto lowest = std::max(end(), first_ + 2) - 2; // of the upper of two rows
    const auto b = std::min(static_cast<std::uint32_t>(at_y), lowest);
    const double u = at_x - a, v = std::min(at_y - b, 1.0);
    const std::size_t nw = std::size_t{b - first_} * width_ + a;
    const bool right = width_ > 1, below = b + 1 < end();
    const double n = below ? 1 - v : 1, s = below ? v : 0, w = right ? 1 - u : 1, e = right ? u : 0;
    const auto take = [&](std::size_t at, double part) {
        Row& row = rows_[at];
        row.weights[0] += weight * part * part;
        for (std::size_t c = 0; c < 4; ++c)
            row.colors[c] += weight * part * color[c];
    };
    take(nw, n * w);
    if (right) take(nw + 1, n * e), rows_[nw].weights[1] += weight * n * w * n * e;
    if (!below) return;
    take(nw + width_, s * w), rows_[nw].weights[3] += weight * n * w * s * w;
    if (!right) return;
    take(nw + width_ + 1, s * e);
    rows_[nw + width_].weights[1] += weight * s * w * s * e;
    rows_[nw + 1].weights[3] += weight * n * e * s * e;
    rows_[nw + 1].weights[2] += weight * n * e * s * w;
    rows_[nw].weights[4] += weight * n * w * s * e;
}

void SampleEquations::add(const SampleEquations& other) {
    Row* to = &rows_[std::size_t{other.first_ - first_} * width_];
    for (const Row& from : other.rows_) {
        for (std::size_t k = 0; k < from.weights.size(); ++k)
            to->weights[k] += from.weights[k];
        for (std::size_t k = 0; k < from.colors.size(); ++k)
            to->colors[k] += from.colors[k];
        ++to;
    }
}

/// All samples' equations, with what draws neighbours together.
class SampleSolver {
  public:
    SampleSolver(const SampleEquations& equations, const std::function<int(std::uint32_t, std::uint32_t)>& side)
        : width_(equations.width_), height_(equations.end()), rows_(equations.rows_) {
        double sum = 0;
        for (const auto& row : rows_)
            sum += row.weights[0];
        mean_ = sum / static_cast<double>(rows_.size());
        seen_.resize(rows_.size());
        for (std::size_t k = 0; k < rows_.size(); ++k)
            seen_[k] = rows_[k].weights[0] > budget::kSignalUnseen * mean_ ? 1 : 0;
        sides_.resize(rows_.size());
        for (std::uint32_t b = 0; b < height_; ++b) {
            for (std::uint32_t a = 0; a < width_; ++a)
                sides_[index(a, b)] = static_cast<signed char>(side(a, b));
        }
        first_guess();
        top_up();
        each_pair([&](std::size_t k, std::size_t other, std::size_t which) {
            if (sides_[k] != sides_[other]) return;
            const double together = budget::kSignalTogether * mean_;
            rows_[k].weights[0] += together, rows_[other].weights[0] += together;
            rows_[k].weights[which] -= together;
        });
    }

    SolvedSamples solve(unsigned threads) {
        SolvedSamples out;
        std::array<std::uint64_t, 4> rounds{};
        parallel_for(4, threads, [&](std::size_t c) { rounds[c] = solve_channel(c); });
        out.rounds = *std::ranges::max_element(rounds);
        out.unseen = static_cast<std::uint64_t>(std::ranges::count(seen_, 0));
        out.colors = std::move(guess_);
        return out;
    }

  private:
    [[nodiscard]] std::size_t index(std::uint32_t a, std::uint32_t b) const { return std::size_t{b} * width_ + a; }

    /// visit(sample, the one right of it or below, its place among the weights).
    template <class Visit> void each_pair(const Visit& visit) const {
        for (std::uint32_t b = 0; b < height_; ++b) {
            for (std::uint32_t a = 0; a < width_; ++a) {
                if (a + 1 < width_) visit(index(a, b), index(a + 1, b), 1);
                if (b + 1 < height_) visit(index(a, b), index(a, b + 1), 3);
            }
        }
    }

    /// The means of what is read around the samples; those that nothing reads get their neighbours', step by step.
    void first_guess() {
        guess_.resize(rows_.size());
        std::vector<double> weight(rows_.size(), 0);
        for (std::size_t k = 0; k < rows_.size(); ++k)
            weight[k] += rows_[k].weights[0];
        each_shared([&](std::size_t k, std::size_t other, double w) { weight[k] += w, weight[other] += w; });
        std::vector<std::uint8_t> known = seen_;
        for (std::size_t k = 0; k < rows_.size(); ++k) {
            if (known[k] == 0) continue;
            for (std::size_t c = 0; c < 4; ++c)
                guess_[k][c] = rows_[k].colors[c] / weight[k];
        }
        for (int round = 0; round < kSpreads && std::ranges::find(known, 0) != known.end(); ++round)
            spread(known);
    }
    void spread(std::vector<std::uint8_t>& known) {
        std::vector<Colors> sums(rows_.size(), Colors{});
        std::vector<int> counts(rows_.size(), 0);
        each_pair([&](std::size_t k, std::size_t other, std::size_t) {
            if (sides_[k] != sides_[other]) return;
            for (const auto& [from, to] : {std::pair{k, other}, {other, k}}) {
                if (known[from] == 0 || known[to] != 0) continue;
                for (std::size_t c = 0; c < 4; ++c)
                    sums[to][c] += guess_[from][c];
                ++counts[to];
            }
        });
        for (std::size_t k = 0; k < counts.size(); ++k) {
            if (counts[k] == 0) continue;
            for (std::size_t c = 0; c < 4; ++c)
                guess_[k][c] = sums[k][c] / counts[k];
            known[k] = 1;
        }
    }

    /// A sample that points read little of would swing to wherever it evens out what the samples beside it can't hold:
    /// what its weight lacks is given to the mean of what is read of it.
    void top_up() {
        for (std::size_t k = 0; k < rows_.size(); ++k) {
            const double lack = budget::kSignalFew * mean_ - rows_[k].weights[0];
            if (!(lack > 0)) continue;
            rows_[k].weights[0] += lack;
            for (std::size_t c = 0; c < 4; ++c)
                rows_[k].colors[c] += lack * guess_[k][c];
        }
    }

    /// visit(sample, one after it, the weight that they share).
    template <class Visit> void each_shared(const Visit& visit) const {
        for (std::uint32_t b = 0; b < height_; ++b) {
            for (std::uint32_t a = 0; a < width_; ++a) {
                const std::size_t k = index(a, b);
                const auto& w = rows_[k].weights;
                if (a + 1 < width_) visit(k, k + 1, w[1]);
                if (b + 1 == height_) continue;
                if (a > 0) visit(k, k + width_ - 1, w[2]);
                visit(k, k + width_, w[3]);
                if (a + 1 < width_) visit(k, k + width_ + 1, w[4]);
            }
        }
    }

    [[nodiscard]] std::vector<double> times(const std::vector<double>& v) const {
        std::vector<double> out(v.size());
        for (std::size_t k = 0; k < v.size(); ++k)
            out[k] = rows_[k].weights[0] * v[k];
        each_shared(
            [&](std::size_t k, std::size_t other, double w) { out[k] += w * v[other], out[other] += w * v[k]; });
        return out;
    }

    /// Preconditioned by the diagonal.
    std::uint64_t solve_channel(std::size_t c) {
        const std::size_t n = rows_.size();
        std::vector<double> x(n), r(n), p(n);
        for (std::size_t k = 0; k < n; ++k)
            x[k] = guess_[k][c];
        const std::vector<double> at_first = times(x);
        // What draws together is no equation of the samples' colours: where it says all, nothing is left over.
        for (std::size_t k = 0; k < n; ++k)
            r[k] = rows_[k].colors[c] - at_first[k];
        const auto scaled = [&](std::size_t k) {
            return r[k] / std::max(rows_[k].weights[0], budget::kSignalUnseen * budget::kSignalTogether * mean_);
        };
        double dot = 0;
        for (std::size_t k = 0; k < n; ++k)
            p[k] = scaled(k), dot += r[k] * p[k];
        std::uint64_t round = 0;
        for (; round < kRounds; ++round) {
            double largest = 0;
            for (const double v : r)
                largest = std::max(largest, std::abs(v));
            if (largest <= budget::kSignalResidual * mean_) break;
            const std::vector<double> ap = times(p);
            double pap = 0;
            for (std::size_t k = 0; k < n; ++k)
                pap += p[k] * ap[k];
            if (!(pap > 0)) break;
            const double step = dot / pap;
            double next = 0;
            for (std::size_t k = 0; k < n; ++k)
                x[k] += step * p[k], r[k] -= step * ap[k], next += r[k] * scaled(k);
            for (std::size_t k = 0; k < n; ++k)
                p[k] = scaled(k) + next / dot * p[k];
            dot = next;
        }
        for (std::size_t k = 0; k < n; ++k)
            guess_[k][c] = std::clamp(x[k], 0.0, 1.0);
        return round;
    }

    std::uint32_t width_, height_;
    std::vector<SampleEquations::Row> rows_;
    std::vector<signed char> sides_;
    std::vector<std::uint8_t> seen_;
    std::vector<Colors> guess_;
    double mean_ = 0;
};

SolvedSamples SampleEquations::solve(const std::function<int(std::uint32_t, std::uint32_t)>& side,
                                     unsigned threads) const {
    return SampleSolver(*this, side).solve(threads);
}

} // namespace fetexc
