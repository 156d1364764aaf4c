// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "compiler/measure/errors.h"
#include "compiler/measure/sample_grid.h"

namespace fetexc::measure {

/// Lost and false islands (measure/errors.h defines them).
[[nodiscard]] Islands find_islands(const Subject& subject, const SampleGrid& grid);

} // namespace fetexc::measure
