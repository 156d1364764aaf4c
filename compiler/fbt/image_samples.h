// SPDX-License-Identifier: GPL-3.0-or-later
/// The samples of regions over an image: valid pixels merged, holes filled, corners fitted (FBT §4.3, §4.4, §4.6).
#pragma once

#include <vector>

#include "compiler/fbt/corner_fit.h"
#include "compiler/fbt/image_regions.h"
#include "compiler/fbt/samples.h"

namespace fetexc {

/// One colour for each region.
struct RegionColors {
    enum class Origin : std::uint8_t {
        Pixels,     ///< the mean of its valid pixels
        Copied,     ///< a hole: of the closest region with valid pixels that it reaches
        Prefiltered ///< nothing valid is reachable: of its own invalid pixels, or the one around a point of it
    };
    std::vector<Channels> color; ///< premultiplied sRGB
    std::vector<Origin> origin;
    std::uint64_t holes = 0;           ///< Copied ones
    std::uint64_t parts_unsampled = 0; ///< connected parts whose regions are Prefiltered
    TexelPoint first_unsampled;        ///< a point of the first of them
};

/// Merges and fills. valid: per pixel. On return it is also 1 for the pixels that Prefiltered regions took.
/// Closest: the fewest links, then the nearest in the plane, then the smallest number.
RegionColors region_colors(const RasterImage& image, const ImageRegions& regions, std::vector<std::uint8_t>& valid,
                           const Grid& grid);

/// Regions by texel, coloured by the fit.
class ImageSamples final : public SampleSource {
  public:
    /// values: of the fit's unknowns. All must outlive this.
    ImageSamples(const ReachabilityGraph& graph, const CornerFit& fit, const std::vector<Channels>& values,
                 const Grid& grid, fetex::FbtSampleFormat format);

    [[nodiscard]] RegionSample whole(std::uint32_t i, std::uint32_t j) const override;
    [[nodiscard]] RegionSample region(const TexelMap& texel, const TexelFeatures& features,
                                      std::uint32_t r) const override;
    [[nodiscard]] Rgba corner(std::uint32_t i, std::uint32_t j) const override;

  private:
    void choose_corners();
    [[nodiscard]] std::uint32_t any_unknown(std::size_t corner) const;
    [[nodiscard]] RegionSample sample_of(std::uint32_t region, std::uint32_t i, std::uint32_t j) const;
    [[nodiscard]] Rgba color(std::uint32_t unknown) const;

    const ReachabilityGraph& graph_;
    const CornerFit& fit_;
    const std::vector<Channels>& values_;
    std::uint32_t width_, height_;
    fetex::FbtSampleFormat format_;
    std::vector<std::uint32_t> corners_; ///< the unknown that the corner's common colour shows; empty: none are stored
};

} // namespace fetexc
