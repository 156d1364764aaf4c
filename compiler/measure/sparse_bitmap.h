// SPDX-License-Identifier: GPL-3.0-or-later
/// A bilinear RGBA8 bitmap of any size whose memory grows with the length of the visible edges in texels, not with its
/// area: 16384² of it fit where the plain picture would take 8 GiB to make. Only texels that an edge crosses are
/// stored, the rest as runs of one result.
///
/// Each texel is the area mean of its results' colours. Areas come from the edges alone (Green's theorem, as
/// rasterisers of fonts do it), not from the planar map's trapezoids as Truth::picture's do: each checks the other. A
/// result whose colour varies counts with its colour at the texel's centre.
#pragma once

#include <vector>

#include "compiler/measure/picture.h"
#include "compiler/measure/truth.h"

namespace fetexc::measure {

class SparseBitmap final : public Picture {
  public:
    /// The truth must outlive it. Sides from 1; never depends on the number of threads.
    SparseBitmap(const Truth& truth, GridSize size, unsigned threads);
    [[nodiscard]] Rgba at(TexturePoint p) const override;
    [[nodiscard]] GridSize texels() const override { return size_; }
    /// Of the plain bitmap that it stands for.
    [[nodiscard]] std::uint64_t gpu_bytes() const override { return std::uint64_t{size_.width} * size_.height * 4; }
    /// Premultiplied RGBA8 as it would be stored: r in the low byte.
    [[nodiscard]] std::uint32_t texel(std::uint32_t column, std::uint32_t row) const;

    /// One texel, or all up to the next stretch.
    struct Stretch {
        std::uint32_t column = 0;
        bool varies = false;
        std::uint32_t value = 0; ///< RGBA8; if it varies, the result
    };

  private:
    const Truth& truth_;
    GridSize size_;
    std::vector<std::vector<Stretch>> rows_; ///< ascending, the first at column 0
};

} // namespace fetexc::measure
