// SPDX-License-Identifier: GPL-3.0-or-later
/// What a texture shows at a distance, and far from curves: its profiles and its base map.
#pragma once

#include "compiler/feature_curves/feature_curves_builder.h"

namespace fetexc {

/// Profiles as tables up to the texture's limit, of kFeatureProfileEntries; if some are narrower than others, so many
/// times as many, so that the narrowest has as many where it is. scale: texels a user unit.
void add_profiles(const std::vector<FeatureProfile>& profiles, double scale, fetex::FeatureCurvesTexture& texture);
/// Entries of each, 2 … kFeatureProfileMost.
std::uint32_t profile_entries(const std::vector<FeatureProfile>& profiles);

/// Of the options' image, or one sample: their colour, a normal straight up, the middle of the heights. After
/// add_profiles: heights without an image are around it.
void add_base(const FeatureCurvesOptions& options, double scale, fetex::FeatureCurvesTexture& texture);

} // namespace fetexc
