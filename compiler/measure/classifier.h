// SPDX-License-Identifier: GPL-3.0-or-later
/// Which result a sampled colour is taken for (measure/errors.h defines it).
#pragma once

#include <vector>

#include "compiler/measure/colors.h"
#include "compiler/measure/picture.h"
#include "compiler/measure/truth.h"

namespace fetexc::measure {

/// Larger side of a texel in width units.
[[nodiscard]] double texel_side(const Truth& truth, const Picture& picture);

/// Const members are thread-safe.
class Classifier {
  public:
    /// reach: width units.
    Classifier(const Truth& truth, double reach, double min_contrast);
    struct Class {
        ResultId result = 0;
        double color_error = 0; ///< contrast of the sampled colour and the expected result's
    };
    /// expected: the truth's result at the point.
    [[nodiscard]] Class classify(TexturePoint p, ResultId expected, const Rgba& sampled) const;

  private:
    /// A result beside edges that may be within reach of a cell.
    struct Candidate {
        ResultId result = 0;
        std::vector<std::uint32_t> edges;
    };
    using Cell = std::vector<Candidate>; ///< in the order of their first edges
    [[nodiscard]] std::size_t index_of(double v, std::size_t cells) const;
    [[nodiscard]] bool within_reach(const Candidate& candidate, TexturePoint p) const;

    const Truth& truth_;
    double reach_, min_contrast_, side_ = 1;
    std::size_t columns_ = 1, rows_ = 1;
    std::vector<Cell> cells_;
};

} // namespace fetexc::measure
