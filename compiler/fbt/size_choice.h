// SPDX-License-Identifier: GPL-3.0-or-later
/// The size of the grid, chosen (FBT §4.1: more texels make lookups cheaper, fewer make the texture smaller).
#pragma once

#include <functional>

#include "compiler/compile.h"

namespace fetexc {

/// Makes the texture at a size.
using BuildAtSize = std::function<Result<FbtBuild>(GridSize)>;

/// The largest size of at most `largest` texels on the longer side, the other by aspect, with at most max_bytes on the
/// GPU. Bytes fall with the size while texels hold much (bands repeat what they share), then they grow; so powers of
/// two, and between the best of them and the next halves, down to a 64th of it. Small ups and downs in between are left
/// to chance. A size that can't be built, for whatever reason, out of memory too, ends the search: then the best found,
/// or if there is none the error. Error kFbtBudget: no size fits.
Result<FbtBuild> largest_within(const Extent& extent, std::uint32_t largest, std::uint64_t max_bytes,
                                const BuildAtSize& build);

/// From `smallest` texels on the longer side on, doubled while that makes lookups cheaper by a quarter, up to
/// `largest`. As above where a size can't be built.
Result<FbtBuild> cheapest_lookup(const Extent& extent, std::uint32_t smallest, std::uint32_t largest,
                                 const BuildAtSize& build);

/// What a lookup costs on average over the texture, in reads: the texel, steps over bands, runs, and pieces considered
/// (FBT §6.3). Measured at 64 × 64 evenly spread points.
double lookup_cost(const fetex::FbtTexture& texture);

} // namespace fetexc
