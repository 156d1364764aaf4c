// SPDX-License-Identifier: GPL-3.0-or-later
/// Turns double-precision paths of a front end into a Scene: guard-box clipping, lattice snapping, vertex merging,
/// culling.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "compiler/result.h"
#include "compiler/scene/scene.h"

namespace fetexc {

/// One Bezier segment in canvas space, degree 1…3.
struct CanvasSegment {
    int degree = 1;
    std::array<CanvasPoint, 4> p{};
};

/// A closed contour: consecutive segments share end points; if the last end differs from the first start, a line closes
/// it.
using CanvasContour = std::vector<CanvasSegment>;

/// A shape as the front end gave it: canvas space, not yet snapped.
struct RawShape {
    std::vector<CanvasContour> contours;
    FillRule rule = FillRule::NonZero;
    std::uint32_t element = kNone;
};

struct SceneBuilderOptions {
    bool cull = true; ///< false keeps every layer (tests and `--no-skip`); what is seen stays the same
};

/// Usage: construct with the extent, add shapes/paints/clips/masks/nodes in any order that keeps indices valid, then
/// finish().
class SceneBuilder {
  public:
    /// width, height > 0 and finite, in user units.
    SceneBuilder(double width, double height);

    /// Returns the shape index. Geometry far outside the canvas (beyond one larger side in any direction) is clipped to
    /// that guard box without changing any winding number inside it. NaN/inf coordinates make finish() fail.
    std::uint32_t add_shape(std::vector<CanvasContour> contours, FillRule rule, std::uint32_t element);
    std::uint32_t add_element(std::string name);
    [[nodiscard]] std::uint32_t shape_count() const { return static_cast<std::uint32_t>(raw_.size()); }

    /// Direct access for everything that needs no processing.
    Scene& scene() { return scene_; }

    /// Snaps all control points to the lattice, merges end points closer than 2^-20 of the extent (interior control
    /// points move with their end point), drops null segments, culls layers that are empty, outside, fully transparent
    /// or hidden under opaque ones (their nodes are removed, indices renumbered), pushes pure clip groups down to their
    /// leaves and flattens groups without effect. Sets root_end and the statistics. Mask contents may lie anywhere
    /// among the nodes; the picture is every node outside of them. Leaves the builder empty. Errors: diag 3001 … 3005.
    Result<Scene> finish(const SceneBuilderOptions& options = {});

  private:
    Scene scene_;
    std::vector<RawShape> raw_;
};

} // namespace fetexc
