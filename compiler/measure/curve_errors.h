// SPDX-License-Identifier: GPL-3.0-or-later
/// Errors of a picture against what a network of curves should show (curve_truth.h), and of a texture with feature
/// curves also where its curves are, and what it takes for the distance to them. README.md says how far off each may
/// be.
///
/// *Sample points* are those of errors.h. *Colours* as in differences.h. *Normals*: the angle between both, where the
/// truth is one of normals; the picture's colours are taken for normals with y down. *Curves*, to the picture: from
/// points of the network's curves on the canvas, about a pixel apart and weighted by the length that they stand for, to
/// the nearest point of the texture's; to the truth: the other way. Both up to `reach`. *Distance error*: what the
/// texture's sampler says of the distance against the exact one, at sample points nearer than a texel to one of the
/// network's curves and away from medial axes, ends and corners (budget::kFeaturePlain).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "compiler/measure/curve_truth.h"
#include "compiler/measure/differences.h"
#include "compiler/measure/errors.h"
#include "formats/feature_curves.h"

namespace fetexc::measure {

struct Spread {
    double mean = 0, p99 = 0, max = 0;
    std::uint64_t points = 0; ///< none: the others are 0
    TexturePoint place;       ///< of max
};

/// At one output size.
struct CurveErrors {
    GridSize pixels;
    double pixels_per_texel = 0; ///< along the width
    PictureDifference colors;
    std::optional<Spread> angle; ///< degrees; of normals
    /// Only of textures with feature curves. Width units; texels (the mean of both sides').
    std::optional<Distances> to_picture, to_truth;
    std::optional<Spread> distance;
};

struct CurveMeasureOptions {
    double reach = 1.5;   ///< texels: the larger side
    unsigned threads = 0; ///< never changes the figures
    /// What counts of a colour of either in CurveErrors::colors, as a light on normals; empty: the colour.
    std::function<Rgba(const Rgba&)> seen = {};
};

/// Larger side of the picture's texels, width units.
double texel_side(const CurveTruth& truth, const Picture& picture);

/// Several pictures against one truth, whose colours are found once. Const members are thread-safe.
class CurveMeasurer {
  public:
    /// The truth must outlive it. sizes: output sizes, 1 … 16384 on each side.
    CurveMeasurer(const CurveTruth& truth, const std::vector<GridSize>& sizes, CurveMeasureOptions options);

    /// One entry for each size. texture: what the picture shows, if it is one with feature curves; validated.
    [[nodiscard]] std::vector<CurveErrors> measure(const Picture& picture,
                                                   const fetex::FeatureCurvesTexture* texture) const;

  private:
    [[nodiscard]] CurveErrors at_size(const PictureSamples& truth, const Picture& picture,
                                      const fetex::FeatureCurvesTexture* texture) const;

    const CurveTruth& truth_;
    CurveMeasureOptions options_;
    std::vector<PictureSamples> samples_; ///< of each size; the means as they are seen
};

/// Of one picture at one size.
CurveErrors curve_errors(const CurveTruth& truth, const Picture& picture, const fetex::FeatureCurvesTexture* texture,
                         GridSize pixels, const CurveMeasureOptions& options);

} // namespace fetexc::measure
