// SPDX-License-Identifier: GPL-3.0-or-later
/// Bi-level textures of given bytes.
#pragma once

#include <cstdint>
#include <optional>

#include "compiler/bilevel/bilevel_builder.h"

namespace fetexc::cli {

/// The largest grid of the aspect (height / width) of which level 0, of so many channels, and the mip levels, if they
/// are wanted, take at most `bytes`. Empty: even the one of width 1 takes more.
std::optional<GridSize> bilevel_grid_of_bytes(double aspect, std::uint64_t bytes, std::uint32_t channels, bool mips);

/// The texture with at most `bytes` bytes that has the least area wrong: each number of channels (options.channels, or
/// all) at the largest size that it can have. options.size and .sizes are ignored. The fits of all are in the
/// statistics, the chosen one first. Errors: those of compile_bilevel; kFbtBudget if nothing fits.
Result<BilevelBuild> compile_bilevel_within(const Silhouette& silhouette, const BilevelOptions& options,
                                            std::uint64_t bytes, const ProgressSink& progress = {});

} // namespace fetexc::cli
