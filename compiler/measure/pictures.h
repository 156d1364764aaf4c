// SPDX-License-Identifier: GPL-3.0-or-later
/// Pictures to judge: vector textures through the reference samplers, and a bitmap.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "compiler/measure/picture.h"
#include "formats/bilevel.h"
#include "formats/fbt.h"
#include "formats/feature_curves.h"
#include "formats/pinchmap.h"
#include "formats/silmap.h"

namespace fetexc::measure {

class FbtPicture final : public Picture {
  public:
    /// A validated texture that outlives the picture.
    explicit FbtPicture(const fetex::FbtTexture& texture) : texture_(texture) {}
    [[nodiscard]] Rgba at(TexturePoint p) const override;
    [[nodiscard]] GridSize texels() const override { return {texture_.width, texture_.height}; }
    [[nodiscard]] std::uint64_t gpu_bytes() const override;

  private:
    const fetex::FbtTexture& texture_;
};

/// Cut hard.
class BilevelPicture final : public Picture {
  public:
    /// A validated texture that outlives the picture.
    explicit BilevelPicture(const fetex::BilevelTexture& texture) : texture_(texture) {}
    [[nodiscard]] Rgba at(TexturePoint p) const override;
    [[nodiscard]] GridSize texels() const override { return {texture_.width, texture_.height}; }
    [[nodiscard]] std::uint64_t gpu_bytes() const override;

  private:
    const fetex::BilevelTexture& texture_;
};

class SilmapPicture final : public Picture {
  public:
    /// A validated texture that outlives the picture.
    explicit SilmapPicture(const fetex::SilmapTexture& texture,
                           fetex::SilmapFilter filter = fetex::SilmapFilter::Filtered)
        : texture_(texture), filter_(filter) {}
    [[nodiscard]] Rgba at(TexturePoint p) const override;
    [[nodiscard]] GridSize texels() const override { return {texture_.width, texture_.height}; }
    [[nodiscard]] std::uint64_t gpu_bytes() const override;

  private:
    const fetex::SilmapTexture& texture_;
    fetex::SilmapFilter filter_;
};

/// Cut hard.
class PinchmapPicture final : public Picture {
  public:
    /// A validated texture that outlives the picture.
    explicit PinchmapPicture(const fetex::PinchmapTexture& texture) : texture_(texture) {}
    [[nodiscard]] Rgba at(TexturePoint p) const override;
    [[nodiscard]] GridSize texels() const override { return {texture_.width, texture_.height}; }
    [[nodiscard]] std::uint64_t gpu_bytes() const override;

  private:
    const fetex::PinchmapTexture& texture_;
};

/// At points, without regard to pixels.
class FeatureCurvesPicture final : public Picture {
  public:
    /// A validated texture that outlives the picture.
    explicit FeatureCurvesPicture(const fetex::FeatureCurvesTexture& texture) : texture_(texture) {}
    [[nodiscard]] Rgba at(TexturePoint p) const override;
    [[nodiscard]] GridSize texels() const override { return {texture_.width, texture_.height}; }
    [[nodiscard]] std::uint64_t gpu_bytes() const override;

  private:
    const fetex::FeatureCurvesTexture& texture_;
};

/// Of a validated texture that outlives the picture.
inline std::unique_ptr<const Picture> picture_of(const fetex::FbtTexture& t) { return std::make_unique<FbtPicture>(t); }
inline std::unique_ptr<const Picture> picture_of(const fetex::BilevelTexture& t) {
    return std::make_unique<BilevelPicture>(t);
}
inline std::unique_ptr<const Picture> picture_of(const fetex::SilmapTexture& t) {
    return std::make_unique<SilmapPicture>(t);
}
inline std::unique_ptr<const Picture> picture_of(const fetex::PinchmapTexture& t) {
    return std::make_unique<PinchmapPicture>(t);
}
inline std::unique_ptr<const Picture> picture_of(const fetex::FeatureCurvesTexture& t) {
    return std::make_unique<FeatureCurvesPicture>(t);
}

/// Another picture, with its colours changed one by one, as by a light on normals.
class SeenPicture final : public Picture {
  public:
    /// Both outlive it.
    SeenPicture(const Picture& picture, const std::function<Rgba(const Rgba&)>& seen)
        : picture_(picture), seen_(seen) {}
    [[nodiscard]] Rgba at(TexturePoint p) const override { return seen_(picture_.at(p)); }
    [[nodiscard]] GridSize texels() const override { return picture_.texels(); }
    [[nodiscard]] std::uint64_t gpu_bytes() const override { return picture_.gpu_bytes(); }

  private:
    const Picture& picture_;
    const std::function<Rgba(const Rgba&)>& seen_;
};

/// Stretched over the canvas, without mip levels; borders are clamped.
class BitmapPicture final : public Picture {
  public:
    enum class Filter : std::uint8_t { Nearest, Bilinear };
    /// rgba: premultiplied RGBA8, row-major, 4·width·height bytes; sides from 1.
    BitmapPicture(GridSize size, std::vector<std::uint8_t> rgba, Filter filter);
    [[nodiscard]] Rgba at(TexturePoint p) const override;
    [[nodiscard]] GridSize texels() const override { return size_; }
    [[nodiscard]] std::uint64_t gpu_bytes() const override { return rgba_.size(); }

    [[nodiscard]] std::span<const std::uint8_t> rgba() const { return rgba_; }

  private:
    [[nodiscard]] Rgba texel(std::uint32_t i, std::uint32_t j) const;
    GridSize size_;
    std::vector<std::uint8_t> rgba_;
    Filter filter_;
};

} // namespace fetexc::measure
