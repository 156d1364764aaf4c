// SPDX-License-Identifier: GPL-3.0-or-later
/// Samples and availability masks of texel regions (FBT §4.6).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "compiler/fbt/features.h"

namespace fetexc {

struct RegionSample {
    std::uint32_t rgba = 0; ///< premultiplied RGBA8, R low
    std::uint32_t mask = 0;
};

std::uint32_t pack_rgba8(const Rgba& premultiplied);

/// The visible result at every texel's corner, (width+1)×(height+1): the texels' representative samples and the apron.
class CornerResults {
  public:
    CornerResults(const PlanarMap& map, const Scene& scene, Compositor& compositor, unsigned threads);
    [[nodiscard]] ResultId at(std::uint32_t i, std::uint32_t j) const {
        return results_[static_cast<std::size_t>(j) * (width_ + 1) + i];
    }
    /// Representative sample: the colour at the corner itself.
    [[nodiscard]] std::uint32_t rgba(std::uint32_t i, std::uint32_t j) const;
    [[nodiscard]] Rgba color(std::uint32_t i, std::uint32_t j) const;

  private:
    const PlanarMap& map_;
    const Scene& scene_;
    Compositor& compositor_;
    std::uint32_t width_ = 0;
    std::vector<ResultId> results_;
};

CanvasPoint to_canvas(const Scene& scene, const Grid& grid, double x, double y);

class RegionSampler {
  public:
    RegionSampler(const PlanarMap& map, const Scene& scene, Compositor& compositor, const CornerResults& corners)
        : map_(map), scene_(scene), compositor_(compositor), corners_(corners) {}

    /// Region of an empty texel.
    [[nodiscard]] RegionSample whole(std::uint32_t i, std::uint32_t j) const;
    /// Region r of a texel. The region that holds the corner (i,j) takes the point sample there; any other the sample
    /// that fits its paint best in the least-squares sense over the region, given which neighbours it may use.
    [[nodiscard]] RegionSample region(const TexelMap& texel, const TexelFeatures& features, std::uint32_t r) const;

  private:
    [[nodiscard]] std::uint32_t mask_for(std::uint32_t i, std::uint32_t j, ResultId result) const;
    [[nodiscard]] Rgba fit(const TexelMap& texel, const TexelFeatures& features, std::uint32_t r,
                           std::uint32_t mask) const;

    const PlanarMap& map_;
    const Scene& scene_;
    Compositor& compositor_;
    const CornerResults& corners_;
};

} // namespace fetexc
