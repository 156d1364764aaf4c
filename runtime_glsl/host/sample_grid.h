// SPDX-License-Identifier: Apache-2.0 OR MIT
/// Where the samples of a view lie, in 32.32 fixed point: an integer base texel and a fraction of 2^-32. The shader
/// does the same integer arithmetic, so every renderer samples at exactly the same points, and no float ever holds a
/// coordinate larger than 1.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/fbt.h"
#include "runtime_glsl/host/image.h"

namespace fetex {

/// Images are drawn in tiles of this side; each tile's origin is computed afresh in double. Over the 8192 steps of a
/// tile with 16×16 samples a step rounded to 2^-32 drifts by at most 2^-20 texel.
inline constexpr std::uint32_t kTileSide = 512;

/// One axis of a tile: sample q lies at origin + q·step, both in 2^-32 texel.
struct AxisGrid {
    std::int64_t origin = 0;
    std::int64_t step = 0;
    [[nodiscard]] std::int64_t at(std::uint32_t q) const { return origin + step * q; }
};

/// A texel-space coordinate as the samplers take it.
struct BaseAndLocal {
    std::uint32_t base = 0; ///< 0 … size−1
    double local = 0;       ///< multiple of 2^-24 in [0,1), exact in float; kFbtFarBorder at and beyond the far border
};

/// The axis of the tile whose first pixel is first_pixel. view_start and view_extent in texture space, size in texels,
/// shift in texels is subtracted (bitmaps: 1/2, their texel centres).
AxisGrid axis_grid(double view_start, double view_extent, std::uint32_t size, std::uint32_t pixels,
                   std::uint32_t supersample, std::uint32_t first_pixel, double shift = 0);

/// A whole image axis, tile by tile.
class ImageAxis {
  public:
    ImageAxis(double view_start, double view_extent, std::uint32_t size, std::uint32_t pixels,
              std::uint32_t supersample, double shift = 0);
    /// Of sample 0 … supersample−1 of a pixel, in 2^-32 texel.
    [[nodiscard]] std::int64_t position(std::uint32_t pixel, std::uint32_t sample) const {
        return tiles_[pixel / kTileSide].at(pixel % kTileSide * supersample_ + sample);
    }

    /// Between samples, in 2^-32 texel.
    [[nodiscard]] std::int64_t step() const { return tiles_.front().step; }

  private:
    std::uint32_t supersample_;
    std::vector<AxisGrid> tiles_;
};

/// Clamped to the texture.
BaseAndLocal base_and_local(std::int64_t position, std::uint32_t size);

/// Sides of a pixel, in texels of a texture of width×height.
struct PixelSides {
    double x = 0, y = 0;
};
PixelSides pixel_sides(const View& view, const RenderSize& size, std::uint32_t width, std::uint32_t height);

/// A mip chain draws this, if there is one: it is wanted, and a pixel is longer than a texel.
bool wants_mips(const View& view, const RenderSize& size, std::uint32_t width, std::uint32_t height);

/// Error E7001 if a limit of image.h is broken.
RuntimeStatus check_view(const View& view, const RenderSize& size);

} // namespace fetex
