// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fetexc::cli {
namespace {

struct Pixel {
    double x = 0, y = 0;
};
/// Straight.
struct Ink {
    float r = 0, g = 0, b = 0, a = 1;
};
constexpr Ink kHalo{1, 1, 1, 0.7F}, kBoundary{0.85F, 0, 0.45F, 1}, kLink{0.1F, 0.35F, 0.9F, 0.6F},
    kSide{0.45F, 0.45F, 0.45F, 0.5F}, kPoint{1, 0.85F, 0, 1}, kRim{0.1F, 0.1F, 0.1F, 1};
/// Pixels a cell from which its sides and other links are drawn, and the texels' colours.
constexpr double kRoomForSides = 12, kRoomForTexels = 28;

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

class SilmapOverlay {
  public:
    SilmapOverlay(const fetex::SilmapTexture& texture, const fetex::View& view, fetex::Image& image)
        : texture_(texture), view_(view), pen_(image), scale_x_(image.width / (view.w * texture.width)),
          scale_y_(image.height / (view.h * texture.height)), room_(std::min(scale_x_, scale_y_)) {}

    void draw() {
        if (room_ >= kRoomForSides) {
            each_cell([&](std::uint32_t i, std::uint32_t j) { draw_sides(i, j); });
            each_cell([&](std::uint32_t i, std::uint32_t j) { draw_links(i, j, false); });
        }
        if (room_ >= kRoomForTexels) each_cell([&](std::uint32_t i, std::uint32_t j) { draw_texel(i, j); });
        each_cell([&](std::uint32_t i, std::uint32_t j) { draw_links(i, j, true); });
        each_cell([&](std::uint32_t i, std::uint32_t j) { draw_point(i, j); });
    }

  private:
    [[nodiscard]] Pixel at(double x, double y) const {
        return {(x - view_.x * texture_.width) * scale_x_, (y - view_.y * texture_.height) * scale_y_};
    }
    /// A local place of a cell.
    [[nodiscard]] Pixel at(std::uint32_t i, std::uint32_t j, fetex::SilmapPoint p) const {
        return at(i - 0.5 + p.x, j - 0.5 + p.y);
    }
    [[nodiscard]] double thickness() const { return std::clamp(room_ / 10, 1.0, 4.0); }

    /// Those that show, and those beside them, whose links reach in.
    template <class Visit> void each_cell(const Visit& visit) const {
        const auto range = [](double from, double extent, std::uint32_t size) {
            const auto bound = [&](double v) {
                return static_cast<std::uint32_t>(std::clamp(std::floor(v), 0.0, double{1} * size));
            };
            return std::array{bound(from * size - 0.5), bound((from + extent) * size + 1.5)};
        };
        const auto is = range(view_.x, view_.w, texture_.width), js = range(view_.y, view_.h, texture_.height);
        for (std::uint32_t j = js[0]; j <= js[1]; ++j) {
            for (std::uint32_t i = is[0]; i <= is[1]; ++i)
                visit(i, j);
        }
    }

    void draw_sides(std::uint32_t i, std::uint32_t j) {
        pen_.dashed(at(i, j, {0, 0}), at(i, j, {1, 0}), 1, kSide);
        pen_.dashed(at(i, j, {0, 0}), at(i, j, {0, 1}), 1, kSide);
    }

    /// To the east and south: the others are those of the neighbours.
    void draw_links(std::uint32_t i, std::uint32_t j, bool boundaries) {
        const fetex::SilmapShape shape = fetex::silmap_shape(texture_, i, j);
        for (const std::uint32_t link : {fetex::kSilmapEast, fetex::kSilmapSouth}) {
            const bool boundary = (shape.boundaries >> link & 1) != 0;
            if (boundary != boundaries || (!boundary && shape.boundaries == 0 && !has_boundaries(i, j, link))) continue;
            const Pixel from = at(i, j, shape.point), to = at(i, j, shape.across[link]);
            if (boundary) pen_.line(from, to, 2 * thickness(), kHalo);
            pen_.line(from, to, boundary ? thickness() : 1, boundary ? kBoundary : kLink);
        }
    }

    /// The neighbour.
    [[nodiscard]] bool has_boundaries(std::uint32_t i, std::uint32_t j, std::uint32_t link) const {
        const bool east = link == fetex::kSilmapEast;
        return fetex::silmap_shape(texture_, east ? i + 1 : i, east ? j : j + 1).boundaries != 0;
    }

    void draw_point(std::uint32_t i, std::uint32_t j) {
        const fetex::SilmapShape shape = fetex::silmap_shape(texture_, i, j);
        if (shape.boundaries == 0 || room_ < kRoomForSides) return;
        pen_.disc(at(i, j, shape.point), thickness() + 1, kRim);
        pen_.disc(at(i, j, shape.point), thickness(), kPoint);
    }

    /// The texel below and to the right of a cell's corner.
    void draw_texel(std::uint32_t i, std::uint32_t j) {
        if (i >= texture_.width || j >= texture_.height) return;
        const fetex::FbtColor c = fetex::silmap_sample(texture_, i + 0.5, j + 0.5, fetex::SilmapFilter::Nearest);
        const auto straight = [&](double v) { return static_cast<float>(c.a > 0 ? std::min(v / c.a, 1.0) : 0); };
        const double radius = std::min(room_ / 8, 6.0);
        pen_.disc(at(i + 0.5, j + 0.5), radius + 1.5, kRim);
        pen_.disc(at(i + 0.5, j + 0.5), radius + 0.5, kHalo);
        pen_.disc(at(i + 0.5, j + 0.5), radius, {straight(c.r), straight(c.g), straight(c.b), static_cast<float>(c.a)});
    }

    const fetex::SilmapTexture& texture_;
    const fetex::View& view_;
    Pen pen_;
    double scale_x_, scale_y_; ///< pixels a texel
    double room_;
};

} // namespace

void draw_overlay(const fetex::SilmapTexture& texture, const fetex::View& view, fetex::Image& image) {
    SilmapOverlay(texture, view, image).draw();
}

} // namespace fetexc::cli
