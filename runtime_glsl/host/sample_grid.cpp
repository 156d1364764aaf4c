// SPDX-License-Identifier: Apache-2.0 OR MIT
#include "runtime_glsl/host/sample_grid.h"

#include <algorithm>
#include <cmath>

namespace fetex {
namespace {

bool within(double v) { return std::abs(v) <= kMaxView; } // false for NaN

} // namespace

AxisGrid axis_grid(double view_start, double view_extent, std::uint32_t size, std::uint32_t pixels,
                   std::uint32_t supersample, std::uint32_t first_pixel, double shift) {
    const double samples = static_cast<double>(pixels) * supersample;
    const double step = view_extent * size / samples;
    const double first = static_cast<double>(first_pixel) * supersample + 0.5;
    const double origin = view_start * size + first * step - shift;
    AxisGrid grid;
    grid.origin = std::llround(std::ldexp(origin, 32));
    grid.step = std::llround(std::ldexp(step, 32));
    return grid;
}

ImageAxis::ImageAxis(double view_start, double view_extent, std::uint32_t size, std::uint32_t pixels,
                     std::uint32_t supersample, double shift)
    : supersample_(supersample) {
    for (std::uint32_t first = 0; first < pixels; first += kTileSide)
        tiles_.push_back(axis_grid(view_start, view_extent, size, pixels, supersample, first, shift));
}

BaseAndLocal base_and_local(std::int64_t position, std::uint32_t size) {
    const std::int64_t whole = position >> 32;
    if (whole < 0) return {0, 0.0};
    if (whole >= size) return {size - 1, kFbtFarBorder};
    const auto fraction = static_cast<std::uint32_t>(position);
    return {static_cast<std::uint32_t>(whole), static_cast<double>(fraction >> 8) * 0x1p-24};
}

PixelSides pixel_sides(const View& view, const RenderSize& size, std::uint32_t width, std::uint32_t height) {
    return {view.w * width / size.width, view.h * height / size.height};
}

bool wants_mips(const View& view, const RenderSize& size, std::uint32_t width, std::uint32_t height) {
    const PixelSides sides = pixel_sides(view, size, width, height);
    return size.minification == Minification::Mips && std::max(sides.x, sides.y) > 1;
}

RuntimeStatus check_view(const View& view, const RenderSize& size) {
    const bool good_view =
        within(view.x) && within(view.y) && within(view.w) && within(view.h) && view.w > 0 && view.h > 0;
    const bool good_size = size.width >= 1 && size.width <= kMaxImageSide && size.height >= 1 &&
                           size.height <= kMaxImageSide && size.supersample >= 1 && size.supersample <= kMaxSupersample;
    if (!good_view) return RuntimeError{RuntimeErrc::BadView, "the view isn't finite, empty, or too far out"};
    if (!good_size)
        return RuntimeError{RuntimeErrc::BadView, "image side beyond 1 … " + std::to_string(kMaxImageSide) +
                                                      " or supersampling beyond 1 … " +
                                                      std::to_string(kMaxSupersample)};
    if (std::uint64_t{size.width} * size.height > kMaxImagePixels)
        return RuntimeError{RuntimeErrc::BadView, "more than " + std::to_string(kMaxImagePixels) + " pixels"};
    return std::nullopt;
}

} // namespace fetex
