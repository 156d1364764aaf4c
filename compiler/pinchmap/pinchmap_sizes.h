// SPDX-License-Identifier: GPL-3.0-or-later
/// Sizes that a pinchmap is given by its bytes or its wrong area.
#pragma once

#include <cstdint>
#include <functional>

#include "compiler/pinchmap/pinchmap_builder.h"

namespace fetexc {

/// As of compile_pinchmap_at_chosen_size.
struct PinchmapLimits {
    std::uint64_t max_bytes = 0;
    double max_wrong_area = 0;
};

/// Of the map, the signal and its levels; they follow from the options alone.
std::uint64_t pinchmap_bytes(const PinchmapOptions& options);

/// build: at options.size.
Result<PinchmapBuild> choose_pinchmap_size(const PinchmapOptions& options, const Extent& extent, PinchmapLimits limits,
                                           const std::function<Result<PinchmapBuild>(const PinchmapOptions&)>& build);

} // namespace fetexc
