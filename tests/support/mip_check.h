// SPDX-License-Identifier: GPL-3.0-or-later
/// Minified pictures of an FBT against the exactly integrated picture of its drawing. Header only, for the tests and
/// the corpus runner.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

#include "compiler/measure/colors.h"
#include "compiler/measure/exact_picture.h"
#include "formats/fbt_mip.h"

namespace fetexc::test {

/// The drawing as width×height pixels show it: means over exact pictures fine enough for their quadrature of gradients
/// and bitmaps not to matter.
inline std::vector<Rgba> area_means(const Scene& scene, GridSize size, unsigned threads = 1) {
    constexpr std::uint32_t kFine = 256;
    const auto times = [](std::uint32_t n) { return std::max(1u, (kFine + n - 1) / n); };
    const std::uint32_t columns = times(size.width), rows = times(size.height), fine_width = size.width * columns;
    Compositor compositor(scene);
    const auto fine = measure::exact_picture(scene, compositor, {fine_width, size.height * rows}, threads);
    if (!fine) throw std::runtime_error(fine.error().message);
    std::vector<Rgba> means(std::size_t{size.width} * size.height);
    for (std::size_t k = 0; k < fine.value().size(); ++k) {
        const std::size_t i = k % fine_width / columns, j = k / fine_width / rows;
        measure::add(means[j * size.width + i], fine.value()[k], 1.0 / columns / rows);
    }
    return means;
}

/// Of a picture of size.width×size.height pixels over the whole texture, dB; sample: texel position to colour.
inline double psnr_of(const std::vector<Rgba>& truth, GridSize size, const fetex::FbtTexture& texture,
                      const std::function<fetex::FbtColor(double x, double y)>& sample) {
    double sum = 0;
    for (std::uint32_t j = 0; j < size.height; ++j) {
        for (std::uint32_t i = 0; i < size.width; ++i) {
            const fetex::FbtColor c =
                sample((i + 0.5) / size.width * texture.width, (j + 0.5) / size.height * texture.height);
            sum += measure::square_error(truth[std::size_t{j} * size.width + i], {c.r, c.g, c.b, c.a});
        }
    }
    return measure::decibels(sum / (static_cast<double>(size.width) * size.height));
}

/// At 1/2, 1/4, 1/8, 1/16 pixels a texel (as nearly as whole pixels allow: the sizes of levels 1 … 4), the whole
/// texture.
inline std::array<double, 4> minified_psnr(const Scene& scene, const fetex::FbtTexture& texture, unsigned threads = 1) {
    std::array<double, 4> out{};
    for (std::uint32_t k = 1; k <= 4; ++k) {
        const GridSize size{std::max(texture.width >> k, 1u), std::max(texture.height >> k, 1u)};
        const double texels_per_pixel = fetex::fbt_mip_scale(texture.width, texture.height, k);
        out[k - 1] = psnr_of(area_means(scene, size, threads), size, texture, [&](double x, double y) {
            return fetex::fbt_sample_mip(texture, x, y, texels_per_pixel);
        });
    }
    return out;
}

} // namespace fetexc::test
