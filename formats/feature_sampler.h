// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The CPU reference sampler of textures with feature curves, in double: the truth for GLSL. Normative text:
/// formats/SPEC.md, section 9. Points are in texel space; outside the drawing they count as the nearest one of it.
#pragma once

#include <array>

#include "formats/feature_curves.h"

namespace fetex {

/// What there is at a point, before the profile.
struct FeatureAt {
    double distance = 0;    ///< texels, 0 … limit, exactly 0 on curves
    FeatureVector gradient; ///< of the distance
    FbtColor base;          ///< of the base map
    FbtColor across;        ///< likewise, across the segments of its texel, the nearer counting more; else base
    std::array<double, kFeatureProfilesMost> profiles = {1}; ///< how much each counts: they add up to 1
};
FeatureAt feature_at(const FeatureCurvesTexture& t, double x, double y);
/// For a point given as texel (i,j) of the texture plus local offset in [0,1] (deep zoom).
FeatureAt feature_at_local(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j, double fx, double fy);

/// Edges of a texel, 1 << feature_edge_index, on which a segment of the texel across ends and none of its own.
std::uint32_t feature_open_edges(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j);

/// The profile's products at entries, linear between them; and their means over distances.
struct FeatureProducts {
    double slope = 0;      ///< (1 − b)·h'
    double base_slope = 0; ///< b·h'
    double blend = 1;      ///< b
    double across = 0;     ///< of it, what distances below 0 add
    double height = 0;     ///< (1 − b)·h
    FbtColor color;        ///< (1 − b)·colour
};
/// Mean over distance − reach … distance + reach of a profile on both sides of a curve: distances below 0 are across
/// it, where slope has the opposite sign. reach 0: the products at the distance.
FeatureProducts feature_profile_mean(const FeatureCurvesTexture& t, double distance, double reach,
                                     std::uint32_t profile = 0);

/// What is shown, as a colour by the texture's kind. reach: half of what a pixel sees, texels.
FbtColor feature_shown(const FeatureCurvesTexture& t, const FeatureAt& at, double reach = 0);

/// The sides of a pixel along x and y, in texels.
struct FeaturePixel {
    double width = 0, height = 0;
};
/// The reach of a pixel, sides of at most 1: a box of the variance that the pixel has across a curve.
double feature_reach(FeaturePixel pixel);

/// What is shown at a point.
FbtColor feature_sample(const FeatureCurvesTexture& t, double x, double y);
FbtColor feature_sample_local(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j, double fx, double fy);

/// What a pixel around a point shows: the profile's mean, with the base maps on both sides of the nearest segment; as
/// if that were straight, and alone, in the pixel.
FbtColor feature_sample_area(const FeatureCurvesTexture& t, double x, double y, FeaturePixel pixel);
FbtColor feature_sample_area_local(const FeatureCurvesTexture& t, std::uint32_t i, std::uint32_t j, double fx,
                                   double fy, FeaturePixel pixel);

/// What a pixel of any size shows. Trilinear: the levels between whose scales (fbt_mip_scale) the longer side lies,
/// mixed by its logarithm, as fbt_sample_mip does. Level 0 is feature_sample_area. Continuous in the sides.
/// Precondition: the texture has mips.
FbtColor feature_sample_mip(const FeatureCurvesTexture& t, double x, double y, FeaturePixel pixel);

/// The mip chain of what is shown: each texel the mean of kFeatureMipPoints² pixels in it, each sample of a level the
/// mean of its share of the texels. Packed as FeatureCurvesTexture::mips, which aren't looked at.
inline constexpr std::uint32_t kFeatureMipPoints = 4;
std::vector<std::uint32_t> feature_make_mips(const FeatureCurvesTexture& t);

} // namespace fetex
