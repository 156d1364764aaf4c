// SPDX-License-Identifier: GPL-3.0-or-later
/// Drawing over a picture.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime_glsl/host/image.h"

namespace fetexc::cli {

/// Pixels from the upper left corner.
struct Pixel {
    double x = 0, y = 0;
};
/// Straight.
struct Ink {
    float r = 0, g = 0, b = 0, a = 1;
};
/// Lines with round ends, and discs, without jags.
class Pen {
  public:
    explicit Pen(fetex::Image& image) : image_(image) {}

    void line(Pixel a, Pixel b, double width, const Ink& ink) {
        const double r = width / 2, dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
        each_pixel(
            {std::min(a.x, b.x) - r, std::min(a.y, b.y) - r}, {std::max(a.x, b.x) + r, std::max(a.y, b.y) + r},
            [&](double x, double y) {
                const double t = length2 > 0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / length2, 0.0, 1.0) : 0;
                return r - std::hypot(x - a.x - t * dx, y - a.y - t * dy);
            },
            ink);
    }

    void dashed(Pixel a, Pixel b, double width, const Ink& ink) {
        constexpr double kDash = 4;
        const auto dashes = static_cast<int>(std::max(1.0, std::hypot(b.x - a.x, b.y - a.y) / (2 * kDash)));
        const auto at = [&](double t) { return Pixel{a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t}; };
        for (int k = 0; k < dashes; ++k)
            line(at((k + 0.25) / dashes), at((k + 0.75) / dashes), width, ink);
    }

    void disc(Pixel at, double radius, const Ink& ink) { line(at, at, 2 * radius, ink); }

  private:
    /// depth: pixels from a pixel's middle to the shape's border, positive inside.
    template <class Depth> void each_pixel(Pixel low, Pixel high, const Depth& depth, const Ink& ink) {
        const auto range = [](double from, double to, std::uint32_t n) {
            return std::array{static_cast<std::int64_t>(std::clamp(std::floor(from - 1), 0.0, double{1} * n)),
                              static_cast<std::int64_t>(std::clamp(std::ceil(to + 1), 0.0, double{1} * n))};
        };
        const auto xs = range(low.x, high.x, image_.width), ys = range(low.y, high.y, image_.height);
        for (std::int64_t y = ys[0]; y < ys[1]; ++y) {
            for (std::int64_t x = xs[0]; x < xs[1]; ++x) {
                const double d = depth(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
                blend(x, y, ink, static_cast<float>(std::clamp(d + 0.5, 0.0, 1.0)));
            }
        }
    }

    void blend(std::int64_t x, std::int64_t y, const Ink& ink, float coverage) {
        float* const p = image_.rgba.data() + 4 * (static_cast<std::size_t>(y) * image_.width + x);
        const float a = ink.a * coverage;
        const std::array over{ink.r * a, ink.g * a, ink.b * a, a};
        for (std::size_t k = 0; k < 4; ++k)
            p[k] = over[k] + p[k] * (1 - a);
    }

    fetex::Image& image_;
};

} // namespace fetexc::cli
