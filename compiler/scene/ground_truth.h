// SPDX-License-Identifier: GPL-3.0-or-later
/// `color_at`: the plain ground truth of every error figure (DESIGN §4, §9).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "compiler/scene/compositor.h"
#include "compiler/scene/scene.h"

namespace fetexc {

/// Point queries on the scene itself. Points are in lattice space (doubles, so any sub-step position).
/// The scene must outlive this. Const members are thread-safe. Each query tests every curve whose y-range holds the
/// point (a y-bucket index is the only acceleration).
class GroundTruth {
  public:
    explicit GroundTruth(const Scene& scene);
    ~GroundTruth();

    /// Shapes (ascending) whose fill rule holds the point.
    [[nodiscard]] std::vector<std::uint32_t> inside(double x, double y) const;
    /// Visible result, interned in the given compositor of the same scene.
    [[nodiscard]] ResultId result_at(Compositor& compositor, double x, double y) const;
    /// Premultiplied sRGB.
    [[nodiscard]] Rgba color_at(double x, double y) const;
    /// Euclidean distance, in lattice steps, to the nearest curve of any shape (visible or not), accurate to
    /// budget::kDistanceAccuracy. Infinity when the scene has no curve.
    [[nodiscard]] double distance_to_curves(double x, double y) const;
    /// The same if it is below `radius` (lattice steps), else infinity. Much faster for a small radius.
    [[nodiscard]] double distance_to_curves_within(double x, double y, double radius) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace fetexc
