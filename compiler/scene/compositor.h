// SPDX-License-Identifier: GPL-3.0-or-later
/// From "which shapes is this point inside" to a visible result. Shared by the planar map (per region) and the ground
/// truth.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "compiler/scene/scene.h"
#include "compiler/skip_rules.h"

namespace fetexc {

/// Identity of a visible result: two regions with equal ids look the same everywhere (same solid colour after rounding
/// to the compositor's steps, or the same reduced paint stack), so an edge between them is invisible. Ids are valid
/// within one Compositor and their order means nothing (they depend on the order of calls).
using ResultId = std::uint32_t;

/// What solid colours are rounded to: steps of a channel in 1.
enum class ColorSteps : std::uint32_t { Rgba8 = 255, Rgba16 = 65535 };

/// Thread-safe.
class Compositor {
  public:
    /// The scene must outlive the compositor.
    explicit Compositor(const Scene& scene, const SkipRules& skip = {}, ColorSteps steps = ColorSteps::Rgba8);
    ~Compositor();
    Compositor(const Compositor&) = delete;
    Compositor& operator=(const Compositor&) = delete;

    /// inside: strictly ascending shape indices whose fill rule says "inside". Drops everything hidden under an opaque
    /// fill, then interns.
    ResultId resolve(std::span<const std::uint32_t> inside);

    /// True when the colour does not depend on the point.
    [[nodiscard]] bool is_solid(ResultId id) const;
    /// Premultiplied sRGB colour of the result at a canvas point (ignored when solid).
    [[nodiscard]] Rgba color(ResultId id, CanvasPoint p) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace fetexc
