// SPDX-License-Identifier: GPL-3.0-or-later
/// Valid random textures with feature curves: every one passes validate_feature_curves, and no two seeds are alike. Any
/// configuration may stand beside any other, so many curves end on texels' boundaries; curves that share an end may
/// cross elsewhere too.
#pragma once

#include <cstdint>

#include "formats/feature_curves.h"

namespace fetexc::test {

struct RandomFeaturesOptions {
    std::uint32_t width = 8, height = 8;
    fetex::FeatureNumberFormat format = fetex::FeatureNumberFormat::Float;
    bool linear = false;
    fetex::FeatureKind kind = fetex::FeatureKind::Normal;
    fetex::FeatureSampleFormat base_format = fetex::FeatureSampleFormat::Rgba8;
    bool base_map = true;       ///< else one sample
    bool gradients = true;      ///< ignored with normals, which have them
    std::uint32_t entries = 17; ///< of a profile
    std::uint32_t profiles = 1;
    double coverage = 0.7; ///< how many texels have segments
    bool mips = false;     ///< random ones
};

fetex::FeatureCurvesTexture random_features(std::uint64_t seed, const RandomFeaturesOptions& options = {});

inline constexpr fetex::FeatureNumberFormat kFeatureNumberFormats[] = {
    fetex::FeatureNumberFormat::Float, fetex::FeatureNumberFormat::Half, fetex::FeatureNumberFormat::Bits16};
inline constexpr fetex::FeatureKind kFeatureKinds[] = {fetex::FeatureKind::Color, fetex::FeatureKind::Normal,
                                                       fetex::FeatureKind::Height};

} // namespace fetexc::test
