// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/fbt/corner_fit.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "compiler/error_budget.h"
#include "compiler/parallel.h"
#include "compiler/release.h"
#include "compiler/union_find.h"

namespace fetexc {
namespace {

constexpr std::size_t kChunk = 4096;

/// Index of (a,b), a ≤ b, in the upper half of a 4×4 matrix.
constexpr std::size_t upper(std::size_t a, std::size_t b) { return a * 4 - a * (a + 1) / 2 + b; }

/// Adds weight·c·cᵀ.
void add_square(std::array<double, 10>& m, const std::array<double, 4>& c, double weight) {
    for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = a; b < 4; ++b)
            m[upper(a, b)] += weight * c[a] * c[b];
    }
}

/// Per channel Σ a·b, added up in an order of its own.
Channels dot(const std::vector<Channels>& a, const std::vector<Channels>& b, unsigned threads) {
    std::vector<Channels> part((a.size() + kChunk - 1) / kChunk, Channels{});
    parallel_for_chunks(a.size(), kChunk, threads, [&](std::size_t first, std::size_t end) {
        Channels& sum = part[first / kChunk];
        for (std::size_t k = first; k < end; ++k) {
            for (std::size_t c = 0; c < 4; ++c)
                sum[c] += a[k][c] * b[k][c];
        }
    });
    Channels sum{};
    for (const Channels& p : part) {
        for (std::size_t c = 0; c < 4; ++c)
            sum[c] += p[c];
    }
    return sum;
}

} // namespace

/// Finds equal matrices, bit by bit, as long as that saves memory.
class CornerFit::MatrixTable {
  public:
    explicit MatrixTable(std::size_t regions) : regions_(regions) {}

    std::uint32_t find_or_add(const Matrix& m, std::vector<Matrix>& matrices) {
        const auto next = static_cast<std::uint32_t>(matrices.size());
        if (worth_it_) {
            const auto [place, added] = known_.try_emplace(m, next);
            if (!added) return place->second;
            if (known_.size() > regions_ / 8) give_up(matrices);
        }
        matrices.push_back(m);
        return next;
    }

  private:
    struct Hash {
        std::size_t operator()(const Matrix& m) const {
            return std::hash<std::string_view>()({reinterpret_cast<const char*>(m.data()), sizeof m});
        }
    };
    struct Same {
        bool operator()(const Matrix& a, const Matrix& b) const {
            return std::memcmp(a.data(), b.data(), sizeof a) == 0;
        }
    };
    void give_up(std::vector<Matrix>& matrices) {
        worth_it_ = false;
        decltype(known_)().swap(known_);
        matrices.reserve(regions_);
    }

    std::size_t regions_;
    bool worth_it_ = true;
    std::unordered_map<Matrix, std::uint32_t, Hash, Same> known_;
};

CornerFit::CornerFit(const ReachabilityGraph& graph, std::uint32_t rows, double bending)
    : graph_(graph), rows_(rows), bending_(bending), unknown_(4 * graph.vertices()) {
    unite_across_links();
    right_.assign(count_, Channels{});
    matrix_of_.reserve(graph.vertices());
    table_ = std::make_unique<MatrixTable>(graph.vertices());
    for (std::uint32_t j = 0; j <= rows_; ++j) {
        const ReachLink first{graph.row_start(j), 0};
        first_link_.push_back(static_cast<std::size_t>(
            std::lower_bound(graph.links().begin(), graph.links().end(), first) - graph.links().begin()));
    }
}

CornerFit::~CornerFit() = default;

void CornerFit::begin_row(std::uint32_t row) {
    end_row();
    row_ = row;
    Matrix empty{};
    add_differences(empty);
    row_matrix_.assign(graph_.row_start(row + 1) - graph_.row_start(row), empty);
}

void CornerFit::end_row() {
    for (const Matrix& m : row_matrix_)
        matrix_of_.push_back(table_->find_or_add(m, matrix_));
}

void CornerFit::finish() {
    end_row();
    release(row_matrix_);
    table_.reset();
}

/// Links run to the texel on the right, in the same row, or to the one below.
void CornerFit::unite_across_links() {
    UnionFind sets(unknown_.size());
    const auto at = [](std::uint32_t region, std::uint32_t corner) { return 4 * region + corner; };
    for (std::uint32_t j = 0; j < rows_; ++j) {
        const std::uint32_t row_end = graph_.row_start(j + 1);
        auto link = std::lower_bound(graph_.links().begin(), graph_.links().end(), ReachLink{graph_.row_start(j), 0});
        for (; link != graph_.links().end() && link->a < row_end; ++link) {
            const bool right = link->b < row_end;
            sets.unite(at(link->a, right ? 1 : 2), at(link->b, 0));
            sets.unite(at(link->a, 3), at(link->b, right ? 2 : 1));
        }
    }
    std::uint32_t count = 0;
    for (std::uint32_t k = 0; k < unknown_.size(); ++k) {
        const std::uint32_t root = sets.find(k); // ≤ k
        unknown_[k] = root == k ? count++ : unknown_[root];
    }
    count_ = count;
}

/// Inside a region: the sides' differences, and the twist.
void CornerFit::add_differences(Matrix& m) const {
    for (const std::array<double, 4>& side :
         {std::array<double, 4>{-1, 1, 0, 0}, {0, 0, -1, 1}, {-1, 0, 1, 0}, {0, -1, 0, 1}})
        add_square(m, side, budget::kImageStretching);
    add_square(m, {1, -1, -1, 1}, bending_);
}

void CornerFit::add_sample(std::uint32_t region, double x, double y, double weight, const Channels& value) {
    const std::array<double, 4> share{(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
    add_square(row_matrix_[region - graph_.row_start(row_)], share, weight);
    for (std::uint32_t k = 0; k < 4; ++k) {
        Channels& right = right_[unknown(region, k)];
        for (std::size_t c = 0; c < 4; ++c)
            right[c] += weight * share[k] * value[c];
    }
}

/// Over the links from a row of texels: visit(u, v, w), three unknowns in a line, along both sides that are parallel to
/// the link.
template <class Visit> void CornerFit::each_second_difference(std::uint32_t row, const Visit& visit) const {
    const std::uint32_t row_end = graph_.row_start(row + 1);
    for (std::size_t k = first_link_[row]; k < first_link_[row + 1]; ++k) {
        const ReachLink& link = graph_.links()[k];
        const bool right = link.b < row_end;
        const std::uint32_t *a = unknown_.data() + 4 * std::size_t{link.a},
                            *b = unknown_.data() + 4 * std::size_t{link.b};
        visit(a[0], a[right ? 1 : 2], b[right ? 1 : 2]);
        visit(a[right ? 2 : 1], a[3], b[3]);
    }
}

void CornerFit::apply_row(std::uint32_t row, const std::vector<Channels>& in, std::vector<Channels>& out) const {
    for (std::uint32_t region = graph_.row_start(row); region < graph_.row_start(row + 1); ++region) {
        const Matrix& m = matrix(region);
        const std::uint32_t* u = unknown_.data() + 4 * std::size_t{region};
        for (std::size_t a = 0; a < 4; ++a) {
            Channels sum{};
            for (std::size_t b = 0; b < 4; ++b) {
                const double weight = m[a <= b ? upper(a, b) : upper(b, a)];
                for (std::size_t c = 0; c < 4; ++c)
                    sum[c] += weight * in[u[b]][c];
            }
            for (std::size_t c = 0; c < 4; ++c)
                out[u[a]][c] += sum[c];
        }
    }
    each_second_difference(row, [&](std::uint32_t u, std::uint32_t v, std::uint32_t w) {
        for (std::size_t c = 0; c < 4; ++c) {
            const double d = bending_ * (in[u][c] - 2 * in[v][c] + in[w][c]);
            out[u][c] += d, out[v][c] -= 2 * d, out[w][c] += d;
        }
    });
}

/// A row of texels touches three rows of corners at most, so every third can be done at a time.
void CornerFit::apply(const std::vector<Channels>& in, std::vector<Channels>& out, unsigned threads) const {
    out.assign(in.size(), Channels{});
    for (std::uint32_t phase = 0; phase < std::min(3u, rows_); ++phase) {
        parallel_for((rows_ - phase + 2) / 3, threads,
                     [&](std::size_t k) { apply_row(phase + 3 * static_cast<std::uint32_t>(k), in, out); });
    }
}

std::vector<double> CornerFit::diagonal() const {
    std::vector<double> out(unknowns(), 0);
    for (std::uint32_t region = 0; region < graph_.vertices(); ++region) {
        for (std::uint32_t k = 0; k < 4; ++k)
            out[unknown(region, k)] += matrix(region)[upper(k, k)];
    }
    for (std::uint32_t row = 0; row < rows_; ++row) {
        each_second_difference(row, [&](std::uint32_t u, std::uint32_t v, std::uint32_t w) {
            out[u] += bending_, out[v] += 4 * bending_, out[w] += bending_;
        });
    }
    return out;
}

/// Residual, direction, and the direction's image. The preconditioned residual, r / diagonal, is never stored.
struct CornerFit::State {
    std::vector<Channels> r, p, q;
    std::vector<double> diagonal;
    Channels rz{};      ///< per channel, of the residual and the preconditioned one
    double largest = 0; ///< of the preconditioned one

    /// Added up chunk by chunk: the same for any number of threads.
    void measure(unsigned threads) {
        std::vector<std::pair<Channels, double>> part((r.size() + kChunk - 1) / kChunk);
        parallel_for_chunks(r.size(), kChunk, threads, [&](std::size_t first, std::size_t end) {
            auto& [sum, most] = part[first / kChunk];
            for (std::size_t k = first; k < end; ++k) {
                for (std::size_t c = 0; c < 4; ++c) {
                    const double z = r[k][c] / diagonal[k];
                    sum[c] += r[k][c] * z, most = std::max(most, std::fabs(z));
                }
            }
        });
        rz = {}, largest = 0;
        for (const auto& [sum, most] : part) {
            for (std::size_t c = 0; c < 4; ++c)
                rz[c] += sum[c];
            largest = std::max(largest, most);
        }
    }
};

std::uint64_t CornerFit::solve(std::vector<Channels>& values, double step, unsigned threads) {
    const auto each = [&](const auto& body) {
        parallel_for_chunks(values.size(), kChunk, threads, [&](std::size_t first, std::size_t end) {
            for (std::size_t k = first; k < end; ++k) {
                for (std::size_t c = 0; c < 4; ++c)
                    body(k, c);
            }
        });
    };
    State s;
    s.diagonal = diagonal();
    s.r = std::move(right_);
    apply(values, s.q, threads);
    s.p.resize(values.size());
    each([&](std::size_t k, std::size_t c) {
        s.r[k][c] -= s.q[k][c];
        s.p[k][c] = s.r[k][c] / s.diagonal[k];
    });
    s.measure(threads);
    std::uint64_t steps = 0;
    for (; steps < budget::kImageFitSteps && s.largest > step; ++steps) {
        apply(s.p, s.q, threads);
        const Channels pq = dot(s.p, s.q, threads), rz = s.rz;
        Channels alpha{}, beta{};
        for (std::size_t c = 0; c < 4; ++c)
            alpha[c] = pq[c] > 0 ? rz[c] / pq[c] : 0;
        each([&](std::size_t k, std::size_t c) {
            values[k][c] += alpha[c] * s.p[k][c];
            s.r[k][c] -= alpha[c] * s.q[k][c];
        });
        s.measure(threads);
        for (std::size_t c = 0; c < 4; ++c)
            beta[c] = rz[c] > 0 ? s.rz[c] / rz[c] : 0;
        each([&](std::size_t k, std::size_t c) { s.p[k][c] = s.r[k][c] / s.diagonal[k] + beta[c] * s.p[k][c]; });
    }
    release(matrix_), release(matrix_of_), release(first_link_);
    return steps;
}

} // namespace fetexc
