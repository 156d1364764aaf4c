// SPDX-License-Identifier: GPL-3.0-or-later
/// The one channel in which edges are looked for.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/raster/image.h"

namespace fetexc {

/// A number a pixel.
class EdgeChannel {
  public:
    /// The mixture of R, G, B, A (a unit vector of them) in which neighbouring pixels differ most: the principal axis
    /// of their differences.
    explicit EdgeChannel(const RasterImage& image);

    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }
    [[nodiscard]] double operator()(std::uint32_t x, std::uint32_t y) const {
        return values_[std::size_t{y} * width_ + x];
    }
    /// Cubic between pixel centres (Catmull and Rom), the border's beyond it; x, y in pixels.
    [[nodiscard]] double at(double x, double y) const;
    /// The mean around each pixel, weighted as a Gaussian of the smaller sigma (pixels), minus that of the larger.
    [[nodiscard]] EdgeChannel band_pass(double smaller, double larger) const;

  private:
    EdgeChannel(std::uint32_t width, std::uint32_t height)
        : width_(width), height_(height), values_(std::size_t{width} * height) {}
    [[nodiscard]] EdgeChannel blurred(double sigma) const;

    std::uint32_t width_, height_;
    std::vector<double> values_;
};

} // namespace fetexc
