// SPDX-License-Identifier: GPL-3.0-or-later
/// One sample point in every pixel, with the truth's result and the picture's class there.
#pragma once

#include <vector>

#include "compiler/measure/classifier.h"

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
    SampleGrid(const Subject& subject, GridSize pixels);

    [[nodiscard]] GridSize pixels() const { return pixels_; }
    [[nodiscard]] std::size_t size() const { return truth_.size(); }
    [[nodiscard]] std::size_t index(std::uint32_t i, std::uint32_t j) const {
        return static_cast<std::size_t>(j) * pixels_.width + i;
    }
    /// Somewhere in the pixel, as a fixed hash of its place says: no edge is in step with the points, so their number
    /// on the wrong side varies as for random points, or less.
    [[nodiscard]] TexturePoint point(std::uint32_t i, std::uint32_t j) const;
    [[nodiscard]] TexturePoint point(std::size_t k) const {
        return point(static_cast<std::uint32_t>(k % pixels_.width), static_cast<std::uint32_t>(k / pixels_.width));
    }
    [[nodiscard]] ResultId truth(std::size_t k) const { return truth_[k]; }
    [[nodiscard]] ResultId picture(std::size_t k) const { return picture_[k]; }
    /// Some visible edge may pass through the pixel.
    [[nodiscard]] bool crossed(std::size_t k) const { return crossed_[k] != 0; }
    /// Width units: the larger side.
    [[nodiscard]] double pixel_side() const { return pixel_side_; }

  private:
    void mark_crossed(const Truth& truth);

    GridSize pixels_;
    double pixel_side_ = 1;
    std::vector<char> crossed_;
    std::vector<ResultId> truth_, picture_;
};

} // namespace fetexc::measure
