// SPDX-License-Identifier: GPL-3.0-or-later
/// The part of each cell of a grid that is above, exactly for the outline's chords.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/bilevel/silhouette.h"

namespace fetexc {

/// 0…1 per cell, row by row, of width×height cells spread over the canvas.
std::vector<double> coverage(const Silhouette& silhouette, std::uint32_t width, std::uint32_t height);

/// All levels of a bi-level texture's mip chain (formats/bilevel.h), bytes.
std::vector<std::uint8_t> coverage_levels(const Silhouette& silhouette, std::uint32_t width, std::uint32_t height,
                                          unsigned threads);

} // namespace fetexc
