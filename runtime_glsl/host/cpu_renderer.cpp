// SPDX-License-Identifier: Apache-2.0 OR MIT
/// The reference renderer: the grid of the GPU, the sampler in double.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <thread>

#include "formats/fbt_mip.h"
#include "formats/feature_sampler.h"
#include "runtime_glsl/host/renderer.h"
#include "runtime_glsl/host/sample_grid.h"

namespace fetex {
namespace {

using Rgba = std::array<double, 4>;

/// Calls work(row) for every row, from several threads; rows don't depend on each other.
template <class Work> void for_each_row(std::uint32_t rows, unsigned threads, const Work& work) {
    if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
    std::atomic<std::uint32_t> next{0};
    const auto run = [&] {
        for (std::uint32_t row = next++; row < rows; row = next++)
            work(row);
    };
    std::vector<std::thread> helpers;
    for (unsigned k = 1; k < std::min(threads, rows); ++k)
        helpers.emplace_back(run);
    run();
    for (std::thread& helper : helpers)
        helper.join();
}

/// The image of a function of a fixed-point position, averaged over the samples of each pixel.
template <class Sample>
Image render_samples(const ImageAxis& columns, const ImageAxis& rows, const RenderSize& size, unsigned threads,
                     const Sample& sample) {
    Image image{size.width, size.height, std::vector<float>(std::size_t{size.width} * size.height * 4)};
    const double weight = 1.0 / (static_cast<double>(size.supersample) * size.supersample);
    for_each_row(size.height, threads, [&](std::uint32_t py) {
        for (std::uint32_t px = 0; px < size.width; ++px) {
            Rgba sum{};
            for (std::uint32_t sy = 0; sy < size.supersample; ++sy) {
                for (std::uint32_t sx = 0; sx < size.supersample; ++sx) {
                    const Rgba color = sample(columns.position(px, sx), rows.position(py, sy));
                    for (std::size_t c = 0; c < 4; ++c)
                        sum[c] += color[c];
                }
            }
            for (std::size_t c = 0; c < 4; ++c)
                image.rgba[(std::size_t{py} * size.width + px) * 4 + c] = static_cast<float>(sum[c] * weight);
        }
    });
    return image;
}

/// The part of a pixel around a sample, as fbt_sample_area takes it.
FbtPixel area_of_sample(const ImageAxis& columns, const ImageAxis& rows) {
    const auto half = [](const ImageAxis& axis) {
        return std::min(0.5 * std::ldexp(static_cast<double>(axis.step()), -32), 0.5);
    };
    return {half(columns), half(rows)};
}

/// The same as bilevel_sample_area takes it.
BilevelPixel sides_of_sample(const ImageAxis& columns, const ImageAxis& rows) {
    const auto side = [](const ImageAxis& axis) { return std::ldexp(static_cast<double>(axis.step()), -32); };
    return {side(columns), side(rows)};
}

} // namespace

std::vector<std::uint8_t> to_rgba8(const Image& image) {
    std::vector<std::uint8_t> bytes(image.rgba.size());
    std::transform(image.rgba.begin(), image.rgba.end(), bytes.begin(),
                   [](float v) { return static_cast<std::uint8_t>(v > 0 ? std::min(v, 1.0f) * 255.0f + 0.5f : 0.0f); });
    return bytes;
}

namespace {

Image render_mips(const FbtTexture& texture, const View& view, RenderSize size, unsigned threads) {
    size.supersample = 1;
    const PixelSides sides = pixel_sides(view, size, texture.width, texture.height);
    const ImageAxis columns(view.x, view.w, texture.width, size.width, 1);
    const ImageAxis rows(view.y, view.h, texture.height, size.height, 1);
    return render_samples(columns, rows, size, threads, [&](std::int64_t x, std::int64_t y) -> Rgba {
        const BaseAndLocal column = base_and_local(x, texture.width), row = base_and_local(y, texture.height);
        const FbtColor c = fbt_sample_mip_aniso(texture, column.base + column.local, row.base + row.local, {sides.x, 0},
                                                {0, sides.y}, size.filter != Filter::Area);
        return {c.r, c.g, c.b, c.a};
    });
}

} // namespace

Outcome<Image> render_cpu(const FbtTexture& texture, const View& view, const RenderSize& size, unsigned threads) {
    if (auto bad = check_view(view, size)) return *bad;
    if (!texture.mips.empty() && wants_mips(view, size, texture.width, texture.height))
        return render_mips(texture, view, size, threads);
    const ImageAxis columns(view.x, view.w, texture.width, size.width, size.supersample);
    const ImageAxis rows(view.y, view.h, texture.height, size.height, size.supersample);
    FbtPixel pixel = area_of_sample(columns, rows);
    pixel.exact = size.filter == Filter::ExactArea;
    return render_samples(columns, rows, size, threads, [&](std::int64_t x, std::int64_t y) -> Rgba {
        const BaseAndLocal column = base_and_local(x, texture.width), row = base_and_local(y, texture.height);
        const FbtColor c = size.filter != Filter::Point
                               ? fbt_sample_area_local(texture, column.base, row.base, column.local, row.local, pixel)
                               : fbt_sample_local(texture, column.base, row.base, column.local, row.local);
        return {c.r, c.g, c.b, c.a};
    });
}

Outcome<Image> render_cpu(const BilevelTexture& texture, const View& view, const RenderSize& size, unsigned threads) {
    if (auto bad = check_view(view, size)) return *bad;
    const bool mips = !texture.mips.empty() && wants_mips(view, size, texture.width, texture.height);
    const std::uint32_t supersample = mips ? 1 : size.supersample;
    const ImageAxis columns(view.x, view.w, texture.width, size.width, supersample);
    const ImageAxis rows(view.y, view.h, texture.height, size.height, supersample);
    const PixelSides sides = pixel_sides(view, size, texture.width, texture.height);
    const BilevelPixel pixel = mips                           ? BilevelPixel{sides.x, sides.y}
                               : size.filter == Filter::Point ? BilevelPixel{}
                                                              : sides_of_sample(columns, rows);
    const RenderSize drawn{size.width, size.height, supersample};
    return render_samples(columns, rows, drawn, threads, [&](std::int64_t x, std::int64_t y) -> Rgba {
        const BaseAndLocal column = base_and_local(x, texture.width), row = base_and_local(y, texture.height);
        const FbtColor c =
            mips ? bilevel_sample_mip(texture, column.base + column.local, row.base + row.local, pixel)
                 : bilevel_sample_area_local(texture, column.base, row.base, column.local, row.local, pixel);
        return {c.r, c.g, c.b, c.a};
    });
}

Outcome<Image> render_cpu(const SilmapTexture& texture, const View& view, const RenderSize& size, SilmapFilter filter,
                          unsigned threads) {
    if (auto bad = check_view(view, size)) return *bad;
    const bool mips = !texture.mips.empty() && wants_mips(view, size, texture.width, texture.height);
    const std::uint32_t supersample = mips ? 1 : size.supersample;
    const ImageAxis columns(view.x, view.w, texture.width, size.width, supersample);
    const ImageAxis rows(view.y, view.h, texture.height, size.height, supersample);
    const PixelSides sides = pixel_sides(view, size, texture.width, texture.height);
    const auto [width, height] = sides_of_sample(columns, rows);
    const SilmapPixel sample{width, height}, pixel{sides.x, sides.y};
    const RenderSize drawn{size.width, size.height, supersample};
    return render_samples(columns, rows, drawn, threads, [&](std::int64_t x, std::int64_t y) -> Rgba {
        const auto [i, fx] = base_and_local(x, texture.width);
        const auto [j, fy] = base_and_local(y, texture.height);
        const FbtColor c = mips ? silmap_sample_mip(texture, i + fx, j + fy, pixel, filter)
                           : size.filter == Filter::Point
                               ? silmap_sample_local(texture, i, j, fx, fy, filter)
                               : silmap_sample_area_local(texture, i, j, fx, fy, sample, filter);
        return {c.r, c.g, c.b, c.a};
    });
}

Outcome<Image> render_cpu(const PinchmapTexture& texture, const View& view, const RenderSize& size, unsigned threads) {
    if (auto bad = check_view(view, size)) return *bad;
    const bool mips = !texture.mips.empty() &&
                      wants_mips(view, size, pinchmap_signal_width(texture), pinchmap_signal_height(texture));
    const std::uint32_t supersample = mips ? 1 : size.supersample;
    const ImageAxis columns(view.x, view.w, texture.width, size.width, supersample);
    const ImageAxis rows(view.y, view.h, texture.height, size.height, supersample);
    const PixelSides sides = pixel_sides(view, size, texture.width, texture.height);
    const auto [width, height] = sides_of_sample(columns, rows);
    const PinchmapPixel sample = size.filter == Filter::Point ? PinchmapPixel{} : PinchmapPixel{width, height};
    const RenderSize drawn{size.width, size.height, supersample};
    return render_samples(columns, rows, drawn, threads, [&](std::int64_t x, std::int64_t y) -> Rgba {
        const auto [i, fx] = base_and_local(x, texture.width);
        const auto [j, fy] = base_and_local(y, texture.height);
        const FbtColor c = mips ? pinchmap_sample_mip(texture, i + fx, j + fy, {sides.x, sides.y})
                                : pinchmap_sample_area_local(texture, i, j, fx, fy, sample);
        return {c.r, c.g, c.b, c.a};
    });
}

Outcome<Image> render_cpu(const FeatureCurvesTexture& texture, const View& view, const RenderSize& size,
                          unsigned threads) {
    if (auto bad = check_view(view, size)) return *bad;
    const bool mips = !texture.mips.empty() && wants_mips(view, size, texture.width, texture.height);
    const std::uint32_t supersample = mips ? 1 : size.supersample;
    const ImageAxis columns(view.x, view.w, texture.width, size.width, supersample);
    const ImageAxis rows(view.y, view.h, texture.height, size.height, supersample);
    const PixelSides sides = pixel_sides(view, size, texture.width, texture.height);
    const auto [width, height] = sides_of_sample(columns, rows);
    const FeaturePixel sample = size.filter == Filter::Point ? FeaturePixel{} : FeaturePixel{width, height};
    const RenderSize drawn{size.width, size.height, supersample};
    return render_samples(columns, rows, drawn, threads, [&](std::int64_t x, std::int64_t y) -> Rgba {
        const auto [i, fx] = base_and_local(x, texture.width);
        const auto [j, fy] = base_and_local(y, texture.height);
        const FbtColor c = mips ? feature_sample_mip(texture, i + fx, j + fy, {sides.x, sides.y})
                                : feature_sample_area_local(texture, i, j, fx, fy, sample);
        return {c.r, c.g, c.b, c.a};
    });
}

Outcome<Image> render_bitmap_cpu(std::span<const std::uint8_t> rgba8, std::uint32_t bitmap_width,
                                 std::uint32_t bitmap_height, const View& view, const RenderSize& size) {
    if (auto bad = check_view(view, size)) return *bad;
    if (bitmap_width == 0 || bitmap_height == 0 || rgba8.size() != std::size_t{bitmap_width} * bitmap_height * 4)
        return RuntimeError{RuntimeErrc::NothingUploaded, "the bitmap is empty or not of the stated size"};
    const ImageAxis columns(view.x, view.w, bitmap_width, size.width, size.supersample, 0.5);
    const ImageAxis rows(view.y, view.h, bitmap_height, size.height, size.supersample, 0.5);
    const auto clamped = [](std::int64_t at, std::uint32_t count) {
        return static_cast<std::size_t>(std::clamp<std::int64_t>(at, 0, count - 1));
    };
    return render_samples(columns, rows, size, 0, [&](std::int64_t x, std::int64_t y) -> Rgba {
        const double fx = static_cast<double>(static_cast<std::uint32_t>(x) >> 8) * 0x1p-24;
        const double fy = static_cast<double>(static_cast<std::uint32_t>(y) >> 8) * 0x1p-24;
        Rgba sum{};
        for (int corner = 0; corner < 4; ++corner) {
            const int right = corner & 1, below = corner >> 1;
            const std::size_t i = clamped((x >> 32) + right, bitmap_width),
                              j = clamped((y >> 32) + below, bitmap_height);
            const double weight = (right ? fx : 1 - fx) * (below ? fy : 1 - fy) / 255;
            for (std::size_t c = 0; c < 4; ++c)
                sum[c] += weight * rgba8[(j * bitmap_width + i) * 4 + c];
        }
        return sum;
    });
}

} // namespace fetex
