// SPDX-License-Identifier: GPL-3.0-or-later
/// The exactly integrated picture (measure/truth.h states what it promises).
#pragma once

#include <vector>

#include "compiler/compile.h"
#include "compiler/scene/compositor.h"

namespace fetexc::measure {

/// 1 … 16384 pixels on each side.
Status check_size(GridSize pixels);

Result<std::vector<Rgba>> exact_picture(const Scene& scene, Compositor& compositor, GridSize pixels, unsigned threads);

} // namespace fetexc::measure
