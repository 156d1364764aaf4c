// SPDX-License-Identifier: GPL-3.0-or-later
/// What a texture shows at a distance, and far from curves: its profile and its base map.
#pragma once

#include "compiler/feature_curves/feature_curves_builder.h"

namespace fetexc {

/// The profile as a table up to the texture's limit. scale: texels a user unit.
void add_profile(const FeatureProfile& profile, double scale, fetex::FeatureCurvesTexture& texture);

/// Of the options' image, or one sample: their colour, a normal straight up, the middle of the heights. After
/// add_profile: heights without an image are around it.
void add_base(const FeatureCurvesOptions& options, double scale, fetex::FeatureCurvesTexture& texture);

} // namespace fetexc
