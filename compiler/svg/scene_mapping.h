// SPDX-License-Identifier: GPL-3.0-or-later
/// From the arrays of the Rust front end to a scene.
#pragma once

#include <vector>

#include "compiler/result.h"
#include "compiler/scene/scene.h"
#include "compiler/scene/scene_builder.h"
#include "compiler/svg/svg_front_end.h"

namespace fetexc::svg {

/// The view must be one that fetexc_svg_load() made. Errors: those of SceneBuilder.
Result<Scene> to_scene(const fetexc_svg_view& view, bool cull, std::vector<Diagnostic>& diagnostics);

/// Contours of a shape, in canvas space.
std::vector<CanvasContour> contours_of(const fetexc_svg_view& view, const fetexc_svg_shape& shape);

} // namespace fetexc::svg
