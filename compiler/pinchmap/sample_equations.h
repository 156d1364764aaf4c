// SPDX-License-Identifier: GPL-3.0-or-later
/// Samples of a bitmap from colours at points between them: least squares of its bilinear interpolation.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace fetexc {

struct SolvedSamples {
    std::vector<std::array<double, 4>> colors; ///< row by row
    std::uint64_t rounds = 0, unseen = 0;
};

/// The normal equations of some rows of samples. Sample (a,b) stands at (a + 1/2, b + 1/2); beyond the border they
/// repeat.
class SampleEquations {
  public:
    /// Rows first … end − 1.
    SampleEquations(std::uint32_t width, std::uint32_t first, std::uint32_t end);

    /// What is read at (x,y) should be the color. Precondition: the samples around are in the rows.
    void add(double x, double y, const std::array<double, 4>& color, double weight);
    /// Those of other rows, which must be among these.
    void add(const SampleEquations& other);

    /// By conjugate gradients, channel by channel. Samples that points read little of are drawn to the mean of what is
    /// read of them, the more the less that is. Samples on one side that are neighbours are drawn together a little: it
    /// decides where nothing else does. side: of a sample.
    [[nodiscard]] SolvedSamples solve(const std::function<int(std::uint32_t a, std::uint32_t b)>& side,
                                      unsigned threads) const;

  private:
    /// A sample's own weight, those that it shares with the samples right, below on the left, below, and below on the
    /// right of it, and its colours.
    struct Row {
        std::array<double, 5> weights{};
        std::array<double, 4> colors{};
    };
    friend class SampleSolver;

    [[nodiscard]] std::uint32_t end() const {
        return first_ + static_cast<std::uint32_t>(rows_.size() / std::max<std::size_t>(width_, 1));
    }

    std::uint32_t width_, first_;
    std::vector<Row> rows_;
};

} // namespace fetexc
