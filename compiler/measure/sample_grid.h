// SPDX-License-Identifier: GPL-3.0-or-later
/// The sample points of a size, with the truth's result and the picture's class at each.
#pragma once

#include <vector>

#include "compiler/measure/classifier.h"
#include "compiler/measure/truth_samples.h"

namespace fetexc::measure {

/// What the parts of a measurement share; all of it outlives them.
struct Subject {
    const Truth& truth;
    const Picture& picture;
    const Classifier& classifier;
    double reach; ///< width units
    double min_contrast;
    unsigned threads;
};

class SampleGrid {
  public:
    SampleGrid(const Subject& subject, const TruthSamples& truth);

    [[nodiscard]] const TruthSamples& truth_samples() const { return truth_; }
    [[nodiscard]] GridSize pixels() const { return truth_.pixels(); }
    [[nodiscard]] std::size_t size() const { return truth_.size(); }
    [[nodiscard]] std::size_t index(std::uint32_t i, std::uint32_t j) const { return truth_.index(i, j); }
    [[nodiscard]] TexturePoint point(std::uint32_t i, std::uint32_t j) const { return truth_.point(i, j); }
    [[nodiscard]] TexturePoint point(std::size_t k) const {
        const std::uint32_t width = pixels().width;
        return point(static_cast<std::uint32_t>(k % width), static_cast<std::uint32_t>(k / width));
    }
    [[nodiscard]] ResultId truth(std::size_t k) const { return truth_.result(k); }
    [[nodiscard]] ResultId picture(std::size_t k) const { return picture_[k]; }
    /// Width units: the larger side.
    [[nodiscard]] double pixel_side() const { return truth_.pixel_side(); }

  private:
    const TruthSamples& truth_;
    std::vector<ResultId> picture_;
};

} // namespace fetexc::measure
