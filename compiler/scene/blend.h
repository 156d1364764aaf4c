// SPDX-License-Identifier: GPL-3.0-or-later
/// W3C Compositing and Blending 1 on premultiplied, sRGB-encoded colours.
#pragma once

#include "compiler/scene/scene.h"

namespace fetexc {

/// Source over backdrop with a blend mode (§5, §9.1: co = cs·(1−αb) + cb·(1−αs) + αs·αb·B(Cb,Cs)). All premultiplied.
[[nodiscard]] Rgba blend_over(const Rgba& backdrop, const Rgba& source, Blend mode);

/// blend_over with Blend::Normal.
[[nodiscard]] Rgba over(const Rgba& backdrop, const Rgba& source);

/// All channels times a factor.
[[nodiscard]] Rgba scaled(const Rgba& c, double factor);

/// Straight to premultiplied; channels clamped to 0…1.
[[nodiscard]] Rgba premultiplied(const Rgba& straight);

} // namespace fetexc
