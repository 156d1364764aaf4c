// SPDX-License-Identifier: GPL-3.0-or-later
/// Pictures of normals as a lit surface, whatever representation they come from.
#pragma once

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "compiler/scene/scene.h"
#include "runtime_glsl/host/image.h"

namespace fetexc::cli {

/// Towards the light: x right, y down, z out of the picture; of length 1.
struct LightDirection {
    double x = 0, y = 0, z = 1;
};

/// "x,y,z", not all 0.
std::optional<LightDirection> parse_light(const std::string& text);

/// Colours are taken for normals, (n + 1) / 2, and become grey: ambient, diffuse (Lambert) and specular light (Blinn
/// and Phong), looked at from above. y_up: green is up, as glTF and OpenGL have it. Alpha stays.
void light_normals(fetex::Image& image, const LightDirection& light, bool y_up);

/// The same for one premultiplied colour.
Rgba lit_normal(const Rgba& color, const LightDirection& light, bool y_up);

/// --light; the value must outlive the parsing.
void add_light_option(CLI::App& app, std::optional<LightDirection>& light);

} // namespace fetexc::cli
