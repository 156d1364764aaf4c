// SPDX-License-Identifier: GPL-3.0-or-later
/// What the figures at an output size need of the truth alone, however many pictures are measured against it.
#pragma once

#include <vector>

#include "compiler/measure/errors.h"

namespace fetexc::measure {

/// A point of a visible edge.
struct EdgeSample {
    std::uint32_t edge = 0;
    WidthPoint place, normal; ///< normal: of length 1, towards the edge's left
    double length = 0;        ///< of the edge, that it stands for; width units
};

/// Somewhere in the pixel, as a fixed hash of its place says: no edge is in step with the points, so their number on
/// the wrong side varies as for random points, or less.
[[nodiscard]] TexturePoint sample_point(GridSize pixels, std::uint32_t i, std::uint32_t j);

/// One sample point in every pixel.
class TruthSamples {
  public:
    /// Only what the figures wanted take. Errors: as Truth::picture's.
    static Result<TruthSamples> of(const Truth& truth, GridSize pixels, const MeasureOptions& options);

    [[nodiscard]] GridSize pixels() const { return pixels_; }
    [[nodiscard]] std::size_t size() const { return std::size_t{pixels_.width} * pixels_.height; }
    [[nodiscard]] std::size_t index(std::uint32_t i, std::uint32_t j) const {
        return static_cast<std::size_t>(j) * pixels_.width + i;
    }
    [[nodiscard]] TexturePoint point(std::uint32_t i, std::uint32_t j) const { return sample_point(pixels_, i, j); }
    /// Width units: the larger side.
    [[nodiscard]] double pixel_side() const { return pixel_side_; }
    /// Some visible edge may pass through the pixel.
    [[nodiscard]] bool crossed(std::size_t k) const { return crossed_[k] != 0; }
    /// The truth at the sample point.
    [[nodiscard]] ResultId result(std::size_t k) const { return results_[k]; }
    /// Exact mean of the pixel.
    [[nodiscard]] const Rgba& mean(std::size_t k) const { return picture_[k]; }
    /// Points of the edges with contrast, about a pixel apart, in the order of the edges.
    [[nodiscard]] std::span<const EdgeSample> edge_samples() const { return edge_samples_; }
    [[nodiscard]] std::uint64_t edges_without_contrast() const { return edges_without_contrast_; }

  private:
    TruthSamples(const Truth& truth, GridSize pixels);
    void mark_crossed(const Truth& truth);
    void ask_results(const Truth& truth, unsigned threads);
    void walk_edges(const Truth& truth, double min_contrast);

    GridSize pixels_;
    double pixel_side_ = 1;
    std::vector<char> crossed_;
    std::vector<ResultId> results_;
    std::vector<Rgba> picture_;
    std::vector<EdgeSample> edge_samples_;
    std::uint64_t edges_without_contrast_ = 0;
};

} // namespace fetexc::measure
