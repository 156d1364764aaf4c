// SPDX-License-Identifier: GPL-3.0-or-later
/// The texel grid in planar space.
///
/// Planar space is lattice space times (kx, ky), the smallest integers that put every grid line on an integer: texel
/// (i,j) covers [i·px,(i+1)·px)×[j·py,(j+1)·py). Coordinates stay below 2^43: kLatticeLimit (2^28) times at most 2^14
/// texels, and some slack.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>

#include "compiler/scene/scene.h"

namespace fetexc {

struct Grid {
    std::uint32_t width = 0, height = 0; ///< texels
    std::int64_t kx = 1, ky = 1;         ///< planar = lattice · k
    std::int64_t px = 1, py = 1;         ///< planar units per texel

    /// Texel that holds a point (of the canvas: the nearest), for messages.
    [[nodiscard]] std::string texel_name(double x, double y) const {
        const auto index = [](double v, std::int64_t pitch, std::uint32_t n) {
            return static_cast<std::uint32_t>(std::clamp(v / static_cast<double>(pitch), 0.0, n - 1.0));
        };
        return "texel (" + std::to_string(index(x, px, width)) + ", " + std::to_string(index(y, py, height)) + ")";
    }

    [[nodiscard]] std::int64_t right() const { return px * width; }
    [[nodiscard]] std::int64_t bottom() const { return py * height; }
};

inline Grid make_grid(const Extent& extent, std::uint32_t width, std::uint32_t height) {
    const auto factor = [](std::int64_t lattice, std::uint32_t n) {
        return n / std::gcd(lattice, static_cast<std::int64_t>(n));
    };
    Grid g;
    g.width = width, g.height = height;
    g.kx = factor(extent.lattice_w, width), g.ky = factor(extent.lattice_h, height);
    g.px = extent.lattice_w * g.kx / width, g.py = extent.lattice_h * g.ky / height;
    return g;
}

} // namespace fetexc
