// SPDX-License-Identifier: GPL-3.0-or-later
/// Our own drawings (tests/art) as scenes.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "compiler/bilevel/silhouette.h"
#include "compiler/svg/svg.h"

namespace fetexc::test {

/// Six of two colours, in tests/art/alternatives.
inline constexpr const char* kShapes[] = {"gear_logo", "glyph_g", "icon", "serif_letter", "star", "yin_yang"};

inline Scene scene_of_svg(const std::string& text) {
    std::vector<Diagnostic> said;
    auto scene = load_svg({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, {}, said);
    if (!scene) throw std::runtime_error(scene.error().message);
    return std::move(scene).value();
}

/// name: below tests/art, without ".svg".
inline Scene art(const std::string& name) {
    const std::filesystem::path path = std::filesystem::path(FETEXC_ART_DIR) / (name + ".svg");
    std::ifstream in(path, std::ios::binary);
    if (!in) throw std::runtime_error("no " + path.string());
    return scene_of_svg({std::istreambuf_iterator<char>(in), {}});
}

inline Scene shape(const std::string& name) { return art("alternatives/" + name); }

inline Silhouette silhouette_of_shape(const std::string& name) {
    auto made = silhouette_of(shape(name), {}, 1);
    if (!made) throw std::runtime_error(made.error().message);
    return std::move(made).value();
}

} // namespace fetexc::test
