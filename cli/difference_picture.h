// SPDX-License-Identifier: GPL-3.0-or-later
/// The picture of a difference: the truth in pale grey, what is wrong in colours that darken with how wrong it is.
#pragma once

#include <vector>

#include "compiler/compile.h"
#include "runtime_glsl/host/image.h"

namespace fetexc::cli {

/// Box means of all pixels, row-major, premultiplied. A pixel is wrong when a channel differs by more than 1/255; its
/// colour runs from yellow (2/255) over orange, red and purple to black (255/255), by the logarithm of the difference.
/// Readers with any colour vision can tell them apart by lightness alone.
fetex::Image difference_picture(const std::vector<Rgba>& truth, const std::vector<Rgba>& other, GridSize pixels);

} // namespace fetexc::cli
