// SPDX-License-Identifier: GPL-3.0-or-later
/// The texel grid in planar space.
///
/// Planar space is lattice space times (kx, ky), the smallest integers that put every grid line on an integer, plus
/// (ox, oy): texel (i,j) covers [i·px,(i+1)·px)×[j·py,(j+1)·py). Coordinates stay below 2^43: kLatticeLimit (2^28)
/// times at most 2^14 texels, and some slack.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>

#include "compiler/scene/scene.h"

namespace fetexc {

struct Grid {
    std::uint32_t width = 0, height = 0; ///< texels
    std::int64_t kx = 1, ky = 1;         ///< planar = lattice · k + o
    std::int64_t ox = 0, oy = 0;         ///< where the canvas begins
    std::int64_t px = 1, py = 1;         ///< planar units per texel

    /// Texel that holds a point (of the canvas: the nearest), for messages.
    [[nodiscard]] std::string texel_name(double x, double y) const {
        const auto index = [](double v, std::int64_t pitch, std::uint32_t n) {
            return static_cast<std::uint32_t>(std::clamp(v / static_cast<double>(pitch), 0.0, n - 1.0));
        };
        return "texel (" + std::to_string(index(x, px, width)) + ", " + std::to_string(index(y, py, height)) + ")";
    }

    /// Of the grid.
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

/// The grid of cells between the middles of width × height texels, width + 1 by height + 1 of them: cell (i,j) reaches
/// from the middle of texel (i-1,j-1) to that of (i,j). The outermost half of the border cells lies outside the canvas.
/// Coordinates: k is at most twice the texels, where their number is odd, 2^15 - 2.
inline Grid make_cell_grid(const Extent& extent, std::uint32_t width, std::uint32_t height) {
    Grid g = make_grid(extent, width, height);
    const auto halve = [](std::int64_t& k, std::int64_t& pitch) {
        if (pitch % 2 != 0) k *= 2, pitch *= 2;
        return pitch / 2;
    };
    g.ox = halve(g.kx, g.px), g.oy = halve(g.ky, g.py);
    ++g.width, ++g.height;
    return g;
}

} // namespace fetexc
