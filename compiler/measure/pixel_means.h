// SPDX-License-Identifier: GPL-3.0-or-later
/// The anti-aliased picture: box means over pixels.
#pragma once

#include "compiler/measure/picture.h"

namespace fetexc::measure {

/// Corner colours of a pixel: (0,0), (1,0), (0,1), (1,1).
using PixelCorners = std::array<Rgba, 4>;

struct PixelArea {
    double u = 0, v = 0, width = 0, height = 0; ///< texture space
};

/// As many parallel lines through the pixel as `intervals`, in the direction in which it changes most between 3 × 3
/// points, and three times as many where their means bend. On each, the trapezoid rule over the intervals; one whose
/// ends differ is halved again and again, so that a hard edge costs no accuracy. What lies between two neighbouring
/// points of a line unseen is missed.
[[nodiscard]] Rgba supersampled(const Picture& picture, const PixelArea& area, unsigned intervals);

/// The centre alone says what the mean is: the picture is as good as linear in the pixel.
[[nodiscard]] bool is_linear(const PixelCorners& corners, const Rgba& center);

} // namespace fetexc::measure
