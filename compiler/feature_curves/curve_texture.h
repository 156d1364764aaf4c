// SPDX-License-Identifier: GPL-3.0-or-later
/// Signatures in the numbers of a texture.
#pragma once

#include <vector>

#include "compiler/feature_curves/snapping.h"

namespace fetexc {

struct QuadraticTexture {
    fetex::FeatureCurvesTexture texture; ///< distances are the limit
    /// Segments so close to their chords that they are written as straight, by kFeatureFlat or by what the format says
    /// of tangents that hardly differ.
    std::uint64_t flat = 0;
    /// Segments that aren't valid any more with the numbers rounded, and are straight for that.
    std::uint64_t straightened = 0;
    std::uint64_t moved = 0; ///< those of them whose curves were more than kFeatureChord from the chord
    double farthest = 0;     ///< texels: how far at most a straightened segment's curve was from its chord
    std::uint32_t farthest_i = 0, farthest_j = 0; ///< that segment's texel
};

/// Every curved segment of the texture is valid as it is read from it.
QuadraticTexture quadratic_texture(const SnappedCurves& curves, fetex::FeatureNumberFormat format,
                                   float distance_limit);

/// Warning 5144, for what moved because of rounding.
std::vector<Diagnostic> rounding_diagnostics(const QuadraticTexture& written);

} // namespace fetexc
