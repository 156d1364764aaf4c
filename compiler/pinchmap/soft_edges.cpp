// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/soft_edges.h"

#include <algorithm>
#include <cmath>

namespace fetexc {
namespace {

constexpr double kHardPixels = 3, kSoftPixels = 6; ///< of the way from one side to the other
constexpr double kLow = 0.15, kHigh = 0.85;        ///< alpha between these is neither side
constexpr double kWindow = 0.75;                   ///< clusters around a texel

/// Pixels that are neither side, and lengths of outline, summed over all pixels above and to the left.
class Sums {
  public:
    Sums(const RasterImage& image, const Silhouette& silhouette)
        : width_(image.width), height_(image.height),
          between_((std::size_t{width_} + 1) * (std::size_t{height_} + 1), 0), lengths_(between_.size(), 0) {
        for (std::uint32_t y = 0; y < height_; ++y) {
            for (std::uint32_t x = 0; x < width_; ++x) {
                const double a = image.at(x, y).a;
                between_[index(x + 1, y + 1)] = a > kLow && a < kHigh ? 1 : 0;
            }
        }
        for (const VisibleEdge& e : silhouette.edges) {
            const WidthPoint a = e.p[0], b = e.p[static_cast<std::size_t>(e.degree)];
            const auto pixel = [&](double v, std::uint32_t size) {
                return static_cast<std::uint32_t>(std::clamp(v / 2 * width_, 0.0, size - 1.0));
            };
            lengths_[index(pixel(a.x + b.x, width_) + 1, pixel(a.y + b.y, height_) + 1)] +=
                std::hypot(b.x - a.x, b.y - a.y) * width_;
        }
        add_up(between_), add_up(lengths_);
    }

    /// Pixels across the transition in a rectangle of pixels; 0: there is no outline.
    [[nodiscard]] double width_in(double x0, double y0, double x1, double y1) const {
        const auto at = [](double v, std::uint32_t size) {
            return static_cast<std::uint32_t>(std::lround(std::clamp<double>(v, 0, size)));
        };
        const std::uint32_t left = at(x0, width_), right = at(x1, width_), top = at(y0, height_),
                            bottom = at(y1, height_);
        const auto in = [&](const std::vector<double>& sums) {
            return sums[index(right, bottom)] - sums[index(left, bottom)] - sums[index(right, top)] +
                   sums[index(left, top)];
        };
        const double length = in(lengths_);
        return length > 1 ? in(between_) / length / (kHigh - kLow) : 0;
    }

  private:
    [[nodiscard]] std::size_t index(std::uint32_t x, std::uint32_t y) const {
        return std::size_t{y} * (std::size_t{width_} + 1) + x;
    }
    void add_up(std::vector<double>& v) const {
        for (std::uint32_t y = 1; y <= height_; ++y) {
            double row = 0;
            for (std::uint32_t x = 1; x <= width_; ++x)
                row += v[index(x, y)], v[index(x, y)] = row + v[index(x, y - 1)];
        }
    }

    std::uint32_t width_, height_;
    std::vector<double> between_, lengths_;
};

bool alpha_varies(const RasterImage& image) {
    for (std::size_t k = 3; k < image.rgba.size(); k += 4) {
        if (image.rgba[k] != image.rgba[3]) return true;
    }
    return false;
}

} // namespace

std::uint64_t soften(const RasterImage& image, const Silhouette& silhouette, std::uint32_t width, std::uint32_t height,
                     std::vector<fetex::PinchmapTexel>& map) {
    if (!alpha_varies(image)) return 0;
    const Sums sums(image, silhouette);
    const double sx = static_cast<double>(image.width) / width, sy = static_cast<double>(image.height) / height;
    std::uint64_t count = 0;
    for (std::uint32_t j = 0; j <= height; ++j) {
        for (std::uint32_t i = 0; i <= width; ++i) {
            fetex::PinchmapTexel& texel = map[std::size_t{j} * (width + 1) + i];
            if (texel.k != 0) continue;
            const double pixels =
                sums.width_in((i - kWindow) * sx, (j - kWindow) * sy, (i + kWindow) * sx, (j + kWindow) * sy);
            const double strength = std::clamp((kSoftPixels - pixels) / (kSoftPixels - kHardPixels), 0.0, 1.0);
            if (strength == 1) continue;
            texel.du *= strength, texel.dv *= strength, ++count;
        }
    }
    return count;
}

} // namespace fetexc
