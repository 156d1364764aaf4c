// SPDX-License-Identifier: GPL-3.0-or-later
/// Distances between the truth's visible edges and the boundaries of the picture's classes, both ways.
#pragma once

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
    struct Sample {
        double distance = 0, weight = 1;
        bool beyond = false;
        WidthPoint place;
    };
    static Distances summary(std::vector<Sample> all);
    [[nodiscard]] bool on_canvas(WidthPoint p) const;
    [[nodiscard]] double change_between(std::size_t a, std::size_t b) const;
    [[nodiscard]] bool takes_for_first(const WidthPoint& p, ResultId first, ResultId second) const;
    [[nodiscard]] std::size_t changes_around(std::uint32_t i, std::uint32_t j, std::array<WidthPoint, 4>& out) const;
    [[nodiscard]] WidthPoint between(std::size_t a, std::size_t b, double t) const;
    [[nodiscard]] double distance_in_square(std::uint32_t i, std::uint32_t j, WidthPoint p) const;
    [[nodiscard]] double distance_to_changes(WidthPoint p, double best) const;
    [[nodiscard]] double distance_along_normal(const EdgeSample& s) const;
    [[nodiscard]] Sample measure_at(const EdgeSample& s) const;

    const Subject& subject_;
    const SampleGrid& grid_;
    /// Part of the way from a sample point to the one right of it or below it; negative: no change.
    std::vector<double> right_, down_;
};

} // namespace fetexc::measure
