// SPDX-License-Identifier: Apache-2.0 OR MIT
/// A mip chain from the colours of level 0. Internal to formats/.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "formats/fbt.h"

namespace fetex {

/// The colours of row j of level 0, one for each of its samples.
using MipRow = std::function<void(std::uint32_t j, std::span<FbtColor> row)>;

/// Levels 1 … n of a level 0 of width×height, RGBA8, as fbt_mip_level places them: each sample the mean of its share of
/// level 0. What exceeds 1 or alpha is clipped. Rows are asked for once each, in order.
std::vector<std::uint32_t> make_mip_chain(std::uint32_t width, std::uint32_t height, const MipRow& colors);

} // namespace fetex
