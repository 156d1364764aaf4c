// SPDX-License-Identifier: GPL-3.0-or-later
/// Distances between the truth's visible edges and the boundaries of the picture's classes, both ways.
#pragma once

#include "compiler/measure/distance_samples.h"
#include "compiler/measure/edge_index.h"
#include "compiler/measure/errors.h"
#include "compiler/measure/sample_grid.h"

namespace fetexc::measure {

/// Where the picture's class changes between neighbouring sample points.
class PictureBoundary {
  public:
    PictureBoundary(const Subject& subject, const SampleGrid& grid);

    /// From every change to the nearest visible edge.
    [[nodiscard]] Distances to_truth() const;
    /// From points of the visible edges to the nearest change.
    [[nodiscard]] Distances to_picture() const;

  private:
    /// Of sample points (i,j) … (i+1,j+1).
    struct Square {
        std::uint32_t i = 0, j = 0;
    };
    /// Neighbouring squares with changes on their sides: squares_[first] … squares_[end − 1].
    struct Block {
        WidthBox box;
        std::size_t first = 0, end = 0;
    };
    class Pair;
    [[nodiscard]] bool on_canvas(WidthPoint p) const;
    [[nodiscard]] double change_between(std::size_t a, std::size_t b) const;
    void find_blocks();
    [[nodiscard]] bool has_changes(Square s) const;
    [[nodiscard]] std::size_t changes_around(Square s, std::array<WidthPoint, 4>& out) const;
    [[nodiscard]] WidthPoint between(std::size_t a, std::size_t b, double t) const;
    [[nodiscard]] double distance_in_square(Square s, WidthPoint p) const;
    [[nodiscard]] double distance_in_blocks(WidthPoint p, double best) const;
    [[nodiscard]] double distance_to_changes(WidthPoint p, double best) const;
    [[nodiscard]] double distance_along_normal(const EdgeSample& s) const;
    [[nodiscard]] DistanceSample measure_at(const EdgeSample& s) const;

    const Subject& subject_;
    const SampleGrid& grid_;
    /// Part of the way from a sample point to the one right of it or below it; negative: no change.
    std::vector<double> right_, down_;
    std::vector<Square> squares_;
    std::vector<Block> blocks_;
};

} // namespace fetexc::measure
