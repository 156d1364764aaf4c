// SPDX-License-Identifier: GPL-3.0-or-later
/// One way to draw for `render`, whether on the CPU or through a GL back end.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/result.h"
#include "runtime_glsl/host/renderer.h"

namespace fetexc::cli {

/// An ordinary texture: premultiplied RGBA8, drawn with bilinear interpolation.
struct Bitmap {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
};

/// Names that --backend takes.
const std::vector<std::string>& canvas_names();

class Canvas {
  public:
    /// "cpu", "osmesa", "egl" (surfaceless, else device), "glfw". Errors of class Unsupported (the back end isn't here)
    /// or Runtime.
    static Result<Canvas> open(const std::string& name);

    /// What draws: the back end's name, GL version and renderer.
    [[nodiscard]] const std::string& description() const { return description_; }

    Result<fetex::Image> draw(const fetex::FbtTexture& texture, const fetex::View& view, const fetex::RenderSize& size);
    /// By the hardware's filter where a probe finds that good enough.
    Result<fetex::Image> draw(const fetex::BilevelTexture& texture, const fetex::View& view,
                              const fetex::RenderSize& size);
    Result<fetex::Image> draw(const fetex::SilmapTexture& texture, const fetex::View& view,
                              const fetex::RenderSize& size,
                              fetex::SilmapFilter filter = fetex::SilmapFilter::Filtered);
    /// By the hardware's filter where a probe finds that good enough.
    Result<fetex::Image> draw(const fetex::PinchmapTexture& texture, const fetex::View& view,
                              const fetex::RenderSize& size);
    Result<fetex::Image> draw(const fetex::FeatureCurvesTexture& texture, const fetex::View& view,
                              const fetex::RenderSize& size);
    Result<fetex::Image> draw(const Bitmap& bitmap, const fetex::View& view, const fetex::RenderSize& size);

  private:
    [[nodiscard]] Result<bool> filters_well();

    std::optional<fetex::Renderer> gl_; ///< empty: the CPU reference
    std::string description_ = "cpu";
};

/// Largest RGBA8 bitmap of the texture's aspect with at most `bytes` bytes, box-filtered from the texture itself.
Result<Bitmap> bitmap_of_equal_bytes(const fetex::FbtTexture& texture, std::uint64_t bytes);
Result<Bitmap> bitmap_of_equal_bytes(const fetex::BilevelTexture& texture, std::uint64_t bytes);
Result<Bitmap> bitmap_of_equal_bytes(const fetex::SilmapTexture& texture, std::uint64_t bytes);
Result<Bitmap> bitmap_of_equal_bytes(const fetex::PinchmapTexture& texture, std::uint64_t bytes);
Result<Bitmap> bitmap_of_equal_bytes(const fetex::FeatureCurvesTexture& texture, std::uint64_t bytes);

} // namespace fetexc::cli
