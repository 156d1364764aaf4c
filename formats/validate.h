// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The full check of a representation: a texture without findings can be sampled at any point, on the CPU and in GLSL,
/// without an access out of range and without an unbounded loop, and decodes the same way on both.
#pragma once

#include <vector>

#include "formats/bilevel.h"
#include "formats/fbt.h"
#include "formats/feature_curves.h"
#include "formats/findings.h"
#include "formats/pinchmap.h"
#include "formats/silmap.h"

namespace fetex {

inline constexpr std::uint32_t kFbtMaxSide = 16384;
inline constexpr std::uint32_t kFbtMaxEntries = 1u << 20; ///< in one band
/// Steps of 2^-15 texel by which a piece may turn back in x or y: rounding its control points gives 1, and as much for
/// each of cutting, monotone splitting and end points moved to shared vertices.
inline constexpr double kFbtMonotoneSlack = 4;

/// Findings, at most `limit`; offsets are bytes from the start of the texels or the records, as the message says.
/// Takes time and memory in proportion to the texture, whatever its content.
std::vector<Finding> validate_fbt(const FbtTexture& texture, std::size_t limit = 64);

/// The traits a texture has; all corners count, and the mip chain.
/// Safe on any content: parts that validate_fbt would refuse are left out.
FbtTraits fbt_traits(const FbtTexture& texture);

inline constexpr std::uint32_t kBilevelMaxSide = 16384; ///< of the texels, and of the image

/// Findings, at most `limit`; offsets are bytes from the start of the header, the texels, the mips or the image, as the
/// message says.
std::vector<Finding> validate_bilevel(const BilevelTexture& texture, std::size_t limit = 64);

inline constexpr std::uint32_t kSilmapMaxSide = 16384;

/// Findings, at most `limit`; offsets are bytes from the start of the samples as the file has them or of the mips, as
/// the message says.
std::vector<Finding> validate_silmap(const SilmapTexture& texture, std::size_t limit = 64);

inline constexpr std::uint32_t kPinchmapMaxSide = 16384; ///< of the signal
inline constexpr std::uint32_t kPinchmapMaxScale = 14;

/// Findings, at most `limit`; offsets are bytes from the start of the header, the map, the signal as the file has it or
/// the mips, as the message says.
std::vector<Finding> validate_pinchmap(const PinchmapTexture& texture, std::size_t limit = 64);
inline constexpr std::uint32_t kFeatureCurvesMaxSide = 16384;

/// Findings, at most `limit`; offsets are bytes from the start of the header, the configurations, the signatures, the
/// distances, the gradients, the base map as the file has it, the profile or the mips, as the message says.
std::vector<Finding> validate_feature_curves(const FeatureCurvesTexture& texture, std::size_t limit = 64);

} // namespace fetex
