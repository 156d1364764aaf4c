// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/canvas.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace fetexc::cli {
namespace {

/// Samples across a pixel of the ordinary texture: its pixels are as good as a box filter makes them.
constexpr std::uint32_t kBoxSamples = 8;

ErrorClass class_of(fetex::RuntimeErrc code) {
    switch (code) {
    case fetex::RuntimeErrc::BadView:
        return ErrorClass::Usage;
    case fetex::RuntimeErrc::BackendMissing:
    case fetex::RuntimeErrc::GlTooOld:
    case fetex::RuntimeErrc::TextureTooLarge:
        return ErrorClass::Unsupported;
    default:
        return ErrorClass::Runtime;
    }
}

Error to_error(const fetex::RuntimeError& error) {
    return {class_of(error.code), static_cast<int>(error.code), error.message, {}};
}

template <class T> Result<T> to_result(fetex::Outcome<T> outcome) {
    if (!outcome) return to_error(outcome.error());
    return std::move(outcome.value());
}

std::vector<fetex::Backend> backends_for(const std::string& name) {
    if (name == "osmesa") return {fetex::Backend::OSMesa};
    if (name == "egl") return {fetex::Backend::EglSurfaceless, fetex::Backend::EglDevice};
    if (name == "glfw") return {fetex::Backend::Glfw};
    return {};
}

template <class Texture> Result<Bitmap> equal_bitmap(const Texture& texture, std::uint64_t bytes) {
    const double pixels = static_cast<double>(bytes / 4), aspect = static_cast<double>(texture.width) / texture.height;
    const auto side = [](double length) {
        return static_cast<std::uint32_t>(std::clamp(std::floor(length), 1.0, 16384.0));
    };
    Bitmap bitmap;
    bitmap.width = side(std::sqrt(pixels * aspect));
    bitmap.height = side(pixels / bitmap.width);
    auto image = fetex::render_cpu(texture, {}, {bitmap.width, bitmap.height, kBoxSamples});
    if (!image) return to_error(image.error());
    bitmap.rgba = fetex::to_rgba8(image.value());
    return bitmap;
}

} // namespace

const std::vector<std::string>& canvas_names() {
    static const std::vector<std::string> names = {"cpu", "osmesa", "egl", "glfw"};
    return names;
}

Result<Canvas> Canvas::open(const std::string& name) {
    Canvas canvas;
    std::optional<Error> first_error;
    for (const fetex::Backend backend : backends_for(name)) {
        auto renderer = fetex::Renderer::open(backend);
        if (renderer) {
            canvas.gl_ = std::move(renderer.value());
            canvas.description_ = fmt::format("{}: {}", fetex::backend_name(backend), canvas.gl_->description());
            return canvas;
        }
        if (!first_error) first_error = to_error(renderer.error());
    }
    if (first_error) return *first_error;
    return canvas;
}

Result<fetex::Image> Canvas::draw(const fetex::FbtTexture& texture, const fetex::View& view,
                                  const fetex::RenderSize& size) {
    if (!gl_) return to_result(fetex::render_cpu(texture, view, size));
    if (const auto error = gl_->upload(texture)) return to_error(*error);
    return to_result(gl_->render(view, size));
}

Result<fetex::Image> Canvas::draw(const fetex::BilevelTexture& texture, const fetex::View& view,
                                  const fetex::RenderSize& size) {
    if (!gl_) return to_result(fetex::render_cpu(texture, view, size));
    const auto filters = filters_well();
    if (!filters) return filters.error();
    const auto fetch = filters.value() ? fetex::BilevelFetch::Filtered : fetex::BilevelFetch::Interpolated;
    if (const auto error = gl_->upload_bilevel(texture, fetch)) return to_error(*error);
    return to_result(gl_->render_bilevel(view, size));
}

Result<fetex::Image> Canvas::draw(const fetex::SilmapTexture& texture, const fetex::View& view,
                                  const fetex::RenderSize& size, fetex::SilmapFilter filter) {
    if (!gl_) return to_result(fetex::render_cpu(texture, view, size, filter));
    if (const auto error = gl_->upload_silmap(texture, filter)) return to_error(*error);
    return to_result(gl_->render_silmap(view, size));
}

Result<fetex::Image> Canvas::draw(const fetex::PinchmapTexture& texture, const fetex::View& view,
                                  const fetex::RenderSize& size) {
    if (!gl_) return to_result(fetex::render_cpu(texture, view, size));
    const auto filters = filters_well();
    if (!filters) return filters.error();
    const auto fetch = filters.value() ? fetex::PinchmapFetch::Filtered : fetex::PinchmapFetch::Interpolated;
    if (const auto error = gl_->upload_pinchmap(texture, fetch)) return to_error(*error);
    return to_result(gl_->render_pinchmap(view, size));
}

Result<fetex::Image> Canvas::draw(const fetex::FeatureCurvesTexture& texture, const fetex::View& view,
                                  const fetex::RenderSize& size) {
    if (!gl_) return to_result(fetex::render_cpu(texture, view, size));
    if (const auto error = gl_->upload_feature_curves(texture)) return to_error(*error);
    return to_result(gl_->render_feature_curves(view, size));
}

Result<bool> Canvas::filters_well() {
    const auto error = gl_->linear_filter_error();
    if (!error) return to_error(error.error());
    return error.value() <= fetex::kGoodFilterError;
}

Result<fetex::Image> Canvas::draw(const Bitmap& bitmap, const fetex::View& view, const fetex::RenderSize& size) {
    if (!gl_) return to_result(fetex::render_bitmap_cpu(bitmap.rgba, bitmap.width, bitmap.height, view, size));
    if (const auto error = gl_->upload_bitmap(bitmap.rgba, bitmap.width, bitmap.height)) return to_error(*error);
    return to_result(gl_->render_bitmap(view, size));
}

Result<Bitmap> bitmap_of_equal_bytes(const fetex::FbtTexture& texture, std::uint64_t bytes) {
    return equal_bitmap(texture, bytes);
}

Result<Bitmap> bitmap_of_equal_bytes(const fetex::BilevelTexture& texture, std::uint64_t bytes) {
    return equal_bitmap(texture, bytes);
}

Result<Bitmap> bitmap_of_equal_bytes(const fetex::SilmapTexture& texture, std::uint64_t bytes) {
    return equal_bitmap(texture, bytes);
}

Result<Bitmap> bitmap_of_equal_bytes(const fetex::PinchmapTexture& texture, std::uint64_t bytes) {
    return equal_bitmap(texture, bytes);
}

Result<Bitmap> bitmap_of_equal_bytes(const fetex::FeatureCurvesTexture& texture, std::uint64_t bytes) {
    return equal_bitmap(texture, bytes);
}

} // namespace fetexc::cli
