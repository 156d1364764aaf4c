// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/pinchmap/soft_edges.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace fetexc {
namespace {

constexpr double kHardPixels = 3, kSoftPixels = 6; ///< of the way from one side to the other
constexpr double kWindow = 0.75;                   ///< clusters around a texel
constexpr int kReach = 6;                          ///< pixels across the outline that say what its sides are,
constexpr int kOff = 2;                            ///< and how far beside it colours may change fastest

using Channels = std::array<double, 4>;

/// Bilinear between pixels' centres; beyond the border they repeat.
class PixelColors {
  public:
    explicit PixelColors(const RasterImage& image) : image_(image) {}

    [[nodiscard]] Channels at(double x, double y) const {
        const auto [i, i1, u] = around(x, image_.width);
        const auto [j, j1, v] = around(y, image_.height);
        const Channels a = pixel(i, j), b = pixel(i1, j), c = pixel(i, j1), d = pixel(i1, j1);
        Channels out;
        for (std::size_t k = 0; k < 4; ++k)
            out[k] = (a[k] * (1 - u) + b[k] * u) * (1 - v) + (c[k] * (1 - u) + d[k] * u) * v;
        return out;
    }

  private:
    struct Around {
        std::uint32_t first, second;
        double part;
    };
    static Around around(double v, std::uint32_t size) {
        const double at = std::clamp(v - 0.5, 0.0, size - 1.0);
        const auto first = static_cast<std::uint32_t>(at);
        return {first, std::min(first + 1, size - 1), at - first};
    }
    [[nodiscard]] Channels pixel(std::uint32_t x, std::uint32_t y) const {
        const Rgba c = image_.at(x, y);
        return {c.r, c.g, c.b, c.a};
    }

    const RasterImage& image_;
};

/// Of colours across the outline.
struct Transition {
    double range = 0, slope = 0; ///< by how much they change; at most, a pixel
};

/// Along the normal (nx, ny) through (x, y), pixels.
Transition transition_at(const PixelColors& colors, double x, double y, double nx, double ny) {
    constexpr int kCount = 2 * (kReach + kOff) + 1, kMiddle = kCount / 2;
    std::array<Channels, kCount> line;
    for (int n = 0; n < kCount; ++n)
        line[static_cast<std::size_t>(n)] = colors.at(x + (n - kMiddle) * nx, y + (n - kMiddle) * ny);
    const auto between = [&](int from, int to, std::size_t c) {
        return line[static_cast<std::size_t>(to)][c] - line[static_cast<std::size_t>(from)][c];
    };
    int at = kMiddle;
    Channels step{};
    double most = 0;
    for (int n = kMiddle - kOff; n <= kMiddle + kOff; ++n) {
        Channels d;
        double square = 0;
        for (std::size_t c = 0; c < 4; ++c)
            d[c] = between(n - 1, n + 1, c) / 2, square += d[c] * d[c];
        if (square > most) most = square, step = d, at = n;
    }
    if (most == 0) return {};
    const double slope = std::sqrt(most);
    double ahead = 0, behind = 0;
    for (int n = 1; n <= kReach; ++n) {
        double a = 0, b = 0;
        for (std::size_t c = 0; c < 4; ++c)
            a += between(at, at + n, c) * step[c], b += between(at - n, at, c) * step[c];
        ahead = std::max(ahead, a / slope), behind = std::max(behind, b / slope);
    }
    return {ahead + behind, slope};
}

/// Transitions times lengths of outline, summed over all pixels above and to the left.
class Sums {
  public:
    Sums(const RasterImage& image, const Silhouette& silhouette)
        : width_(image.width), height_(image.height),
          ranges_((std::size_t{width_} + 1) * (std::size_t{height_} + 1), 0), slopes_(ranges_.size(), 0) {
        const PixelColors colors(image);
        for (const OutlineSegment& s : outline_in_texels(silhouette, width_, height_))
            add(colors, s);
        add_up(ranges_), add_up(slopes_);
    }

    /// Pixels across the transition in a rectangle of pixels; 0: nothing changes.
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
        const double slope = in(slopes_);
        return slope > kNoChange ? in(ranges_) / slope : 0;
    }

  private:
    /// Less than a step of 16 bits along a pixel of outline.
    static constexpr double kNoChange = 0x1p-16;

    [[nodiscard]] std::size_t index(std::uint32_t x, std::uint32_t y) const {
        return std::size_t{y} * (std::size_t{width_} + 1) + x;
    }
    /// In pieces of a pixel.
    void add(const PixelColors& colors, const OutlineSegment& s) {
        const double dx = s.x1 - s.x0, dy = s.y1 - s.y0, length = std::hypot(dx, dy);
        if (!(length > 0)) return;
        const auto pieces = static_cast<std::uint32_t>(std::ceil(length));
        for (std::uint32_t n = 0; n < pieces; ++n) {
            const double t = (n + 0.5) / pieces, x = s.x0 + dx * t, y = s.y0 + dy * t;
            if (!(x >= 0 && x < width_ && y >= 0 && y < height_)) continue;
            const Transition across = transition_at(colors, x, y, -dy / length, dx / length);
            const std::size_t k = index(static_cast<std::uint32_t>(x) + 1, static_cast<std::uint32_t>(y) + 1);
            ranges_[k] += across.range * length / pieces, slopes_[k] += across.slope * length / pieces;
        }
    }
    void add_up(std::vector<double>& v) const {
        for (std::uint32_t y = 1; y <= height_; ++y) {
            double row = 0;
            for (std::uint32_t x = 1; x <= width_; ++x)
                row += v[index(x, y)], v[index(x, y)] = row + v[index(x, y - 1)];
        }
    }

    std::uint32_t width_, height_;
    std::vector<double> ranges_, slopes_;
};

} // namespace

SoftEdges soften(const RasterImage& image, const Silhouette& silhouette, std::uint32_t width, std::uint32_t height,
                 std::vector<fetex::PinchmapTexel>& map) {
    const Sums sums(image, silhouette);
    const double sx = static_cast<double>(image.width) / width, sy = static_cast<double>(image.height) / height;
    SoftEdges out;
    for (std::uint32_t j = 0; j <= height; ++j) {
        for (std::uint32_t i = 0; i <= width; ++i) {
            fetex::PinchmapTexel& texel = map[std::size_t{j} * (width + 1) + i];
            if (texel.k != 0) continue;
            const double pixels =
                sums.width_in((i - kWindow) * sx, (j - kWindow) * sy, (i + kWindow) * sx, (j + kWindow) * sy);
            const double strength = std::clamp((kSoftPixels - pixels) / (kSoftPixels - kHardPixels), 0.0, 1.0);
            if (strength == 1) continue;
            texel.du *= strength, texel.dv *= strength, ++out.texels;
            if (!(pixels > out.widest)) continue;
            out.widest = pixels, out.u = static_cast<double>(i) / width, out.v = static_cast<double>(j) / height;
        }
    }
    return out;
}

} // namespace fetexc
