// SPDX-License-Identifier: GPL-3.0-or-later
/// Colours at the corners of regions, so that interpolating them gives an image's samples (FBT §4.6, without its
/// steps).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "compiler/planar/reachability.h"

namespace fetexc {

using Channels = std::array<double, 4>;

/// Every region of every texel has a value at each of its texel's four corners, whether or not it holds the corner.
/// Regions linked across a side share both values there: one unknown. So colours go on without a step wherever nothing
/// separates, and nothing is mixed across a feature. The unknowns minimise
///   Σ weight·(interpolated − sample)²  +  bending·Σ (second differences)²  +  kImageStretching·Σ (differences)²
/// over the samples given, the differences being those between neighbouring unknowns of a region, or of two linked
/// ones. Solved by conjugate gradients; the same for any number of threads.
class CornerFit {
  public:
    /// The graph must outlive the fit; Separation::Edges. bending: the weight of second differences.
    CornerFit(const ReachabilityGraph& graph, std::uint32_t rows, double bending);
    ~CornerFit();

    /// Corners 0 … 3 of a region: (0,0), (1,0), (0,1), (1,1) of its texel.
    [[nodiscard]] std::uint32_t unknown(std::uint32_t region, std::uint32_t corner) const {
        return unknown_[4 * std::size_t{region} + corner];
    }
    [[nodiscard]] std::size_t unknowns() const { return count_; }

    /// Samples come row of texels by row, and after the last row finish(). So the matrices of a row are known before
    /// the next is begun, and those that regions have in common are kept once: where pixels and texels are in a simple
    /// ratio, nearly all.
    void begin_row(std::uint32_t row);
    void finish();

    /// The value at (x,y) of the region's texel, 0…1, is wanted. The texel is in the row begun last.
    void add_sample(std::uint32_t region, double x, double y, double weight, const Channels& value);

    /// Changes `values` (of each unknown, a first guess) into the solution, until a Jacobi step is at most `step`.
    /// Returns the steps taken. Once: afterwards only the numbers of the unknowns are left.
    std::uint64_t solve(std::vector<Channels>& values, double step, unsigned threads);

  private:
    /// Of a symmetric 4×4 matrix, the upper half by rows.
    using Matrix = std::array<double, 10>;
    struct State;
    class MatrixTable;
    void unite_across_links();
    void add_differences(Matrix& m) const;
    void end_row();
    void apply(const std::vector<Channels>& in, std::vector<Channels>& out, unsigned threads) const;
    void apply_row(std::uint32_t row, const std::vector<Channels>& in, std::vector<Channels>& out) const;
    [[nodiscard]] std::vector<double> diagonal() const;
    template <class Visit> void each_second_difference(std::uint32_t row, const Visit& visit) const;
    [[nodiscard]] const Matrix& matrix(std::uint32_t region) const { return matrix_[matrix_of_[region]]; }

    const ReachabilityGraph& graph_;
    std::uint32_t rows_;
    std::size_t count_ = 0; ///< of unknowns
    double bending_;
    std::vector<std::uint32_t> unknown_;  ///< four of each region
    std::vector<std::size_t> first_link_; ///< of each row, in the graph's links
    std::vector<Matrix> matrix_;
    std::vector<std::uint32_t> matrix_of_; ///< each region
    std::vector<Channels> right_;          ///< of each unknown
    std::vector<Matrix> row_matrix_;       ///< of the row begun last
    std::uint32_t row_ = 0;
    std::unique_ptr<MatrixTable> table_; ///< while samples come
};

} // namespace fetexc
