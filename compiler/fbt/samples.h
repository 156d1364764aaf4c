// SPDX-License-Identifier: GPL-3.0-or-later
/// How the regions of texels are coloured (FBT §4.6; models: formats/fbt.h).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "compiler/fbt/features.h"
#include "formats/fbt_samples.h"

namespace fetexc {

struct RegionSample {
    std::uint32_t model = 0; ///< fetex::kFbtModel…
    std::uint32_t rgba = 0;  ///< solid: premultiplied RGBA8, R low
    /// Samples at the corners (0,0), (1,0), (0,1), (1,1) of the texel, as many words as the format takes; of a solid
    /// colour four equal ones.
    std::array<std::uint32_t, 8> patch{};
};

/// Colours may not exceed alpha: what does is clipped.
std::uint32_t pack_rgba8(const Rgba& premultiplied);

/// The visible result at every texel's corner, (width+1)×(height+1).
class CornerResults {
  public:
    CornerResults(const PlanarMap& map, const Scene& scene, Compositor& compositor, unsigned threads);
    [[nodiscard]] ResultId at(std::uint32_t i, std::uint32_t j) const {
        return results_[static_cast<std::size_t>(j) * (width_ + 1) + i];
    }
    [[nodiscard]] Rgba color(std::uint32_t i, std::uint32_t j) const;
    /// All four corners of a texel show this result.
    [[nodiscard]] bool surround(std::uint32_t i, std::uint32_t j, ResultId result) const {
        return at(i, j) == result && at(i + 1, j) == result && at(i, j + 1) == result && at(i + 1, j + 1) == result;
    }
    /// Stored once, the corners take fewer bytes than patches in all texels that they surround with one gradient.
    [[nodiscard]] bool worth_storing() const { return worth_storing_; }

  private:
    [[nodiscard]] std::uint64_t texels_surrounded() const;

    const PlanarMap& map_;
    const Scene& scene_;
    Compositor& compositor_;
    std::uint32_t width_ = 0;
    std::vector<ResultId> results_;
    bool worth_storing_ = false;
};

CanvasPoint to_canvas(const Scene& scene, const Grid& grid, double x, double y);

/// Gives the samples of all regions: of a drawing's paints (RegionSampler), or of an image (ImageSamples). Thread-safe.
class SampleSource {
  public:
    SampleSource() = default;
    SampleSource(const SampleSource&) = delete;
    SampleSource& operator=(const SampleSource&) = delete;
    virtual ~SampleSource() = default;
    /// Region of a texel without visible edges.
    [[nodiscard]] virtual RegionSample whole(std::uint32_t i, std::uint32_t j) const = 0;
    /// Region r of a texel.
    [[nodiscard]] virtual RegionSample region(const TexelMap& texel, const TexelFeatures& features,
                                              std::uint32_t r) const = 0;
    /// Of the corner (i,j) of texel (i,j), for the model corners; premultiplied.
    [[nodiscard]] virtual Rgba corner(std::uint32_t i, std::uint32_t j) const = 0;
};

/// A sample of the model solid; a patch if 8 bits don't hold the colour as well as the format would.
RegionSample solid_sample(const Rgba& premultiplied, fetex::FbtSampleFormat format);
/// Of the model patch; four equal corners are a colour.
RegionSample patch_sample(const std::array<Rgba, 4>& premultiplied, fetex::FbtSampleFormat format);

class RegionSampler final : public SampleSource {
  public:
    RegionSampler(const PlanarMap& map, const Scene& scene, Compositor& compositor, const CornerResults& corners,
                  fetex::FbtSampleFormat format)
        : map_(map), scene_(scene), compositor_(compositor), corners_(corners), format_(format) {}

    /// Region of an empty texel.
    [[nodiscard]] RegionSample whole(std::uint32_t i, std::uint32_t j) const override;
    /// Region r of a texel. A gradient goes on beyond the region to the texel's corners, so that it has no steps from
    /// texel to texel; where that is more than a step of 8 bits off inside the region (the paint bends, or ends,
    /// between it and a corner), the patch that fits best in the least-squares sense.
    [[nodiscard]] RegionSample region(const TexelMap& texel, const TexelFeatures& features,
                                      std::uint32_t r) const override;
    [[nodiscard]] Rgba corner(std::uint32_t i, std::uint32_t j) const override { return corners_.color(i, j); }

  private:
    [[nodiscard]] Rgba paint_at(ResultId result, double x, double y) const;
    [[nodiscard]] std::array<Rgba, 4> corner_paints(std::uint32_t i, std::uint32_t j, ResultId result) const;

    const PlanarMap& map_;
    const Scene& scene_;
    Compositor& compositor_;
    const CornerResults& corners_;
    fetex::FbtSampleFormat format_;
};

} // namespace fetexc
