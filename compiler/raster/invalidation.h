// SPDX-License-Identifier: GPL-3.0-or-later
/// Which pixels of an image are no point samples, because a feature is near (FBT §4.3).
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/scene/scene.h"

namespace fetexc {

/// Per pixel, row by row: 1 where a feature comes within `distance` (in the infinity norm, pixels, ≥ 0) of the pixel's
/// centre, and possibly where it comes within budget::kInvalidationSlack more. features: of feature_scene, for an image
/// of width×height.
std::vector<std::uint8_t> invalid_pixels(const Scene& features, std::uint32_t width, std::uint32_t height,
                                         double distance);

} // namespace fetexc
