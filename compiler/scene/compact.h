// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "compiler/scene/scene.h"

namespace fetexc {

/// Removes shapes (with their segments), paints, clips and masks that the picture doesn't reach, and renumbers. The
/// order of what stays is kept. Needs a rebuilt tree (tree.h).
void remove_unreferenced(Scene& scene);

} // namespace fetexc
