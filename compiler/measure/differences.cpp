// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/differences.h"

#include <cassert>

#include "compiler/error_budget.h"
#include "compiler/measure/colors.h"
#include "compiler/measure/errors.h"
#include "compiler/measure/pixel_means.h"
#include "compiler/measure/truth_samples.h"
#include "compiler/parallel.h"

namespace fetexc::measure {
namespace {

constexpr double kOneStep = 1.0 / 255 + budget::kColorNoise; ///< of eight bits

constexpr unsigned kPoints = 4; ///< along a side

Rgba point_mean(const Picture& picture, const PixelArea& area) {
    Rgba sum{0, 0, 0, 0};
    for (unsigned k = 0; k < kPoints * kPoints; ++k)
        add(sum,
            picture.at({area.u + (k % kPoints + 0.5) / kPoints * area.width,
                        area.v + (k / kPoints + 0.5) / kPoints * area.height}),
            1.0 / (kPoints * kPoints));
    return sum;
}

} // namespace

std::vector<Rgba> box_means(const Picture& picture, GridSize pixels, unsigned threads, PixelMeans how) {
    std::vector<Rgba> means(std::size_t{pixels.width} * pixels.height);
    const double w = 1.0 / pixels.width, h = 1.0 / pixels.height;
    parallel_for(pixels.height, threads, [&](std::size_t row) {
        const auto y = static_cast<double>(row);
        PixelCorners corners{picture.at({0, y * h}), {}, picture.at({0, (y + 1) * h}), {}};
        for (std::uint32_t i = 0; i < pixels.width; ++i) {
            corners[1] = picture.at({(i + 1) * w, y * h}), corners[3] = picture.at({(i + 1) * w, (y + 1) * h});
            Rgba& mean = means[row * pixels.width + i];
            mean = picture.at({(i + 0.5) * w, (y + 0.5) * h});
            if (!is_linear(corners, mean)) {
                const PixelArea area{i * w, y * h, w, h};
                mean = how == PixelMeans::Smooth ? point_mean(picture, area)
                                                 : supersampled(picture, area, MeasureOptions{}.supersample);
            }
            corners[0] = corners[1], corners[2] = corners[3];
        }
    });
    return means;
}

double mean_square_error(const std::vector<Rgba>& a, const std::vector<Rgba>& b) {
    assert(a.size() == b.size());
    double sum = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
        sum += square_error(a[k], b[k]);
    return a.empty() ? 0 : sum / static_cast<double>(a.size());
}

PictureSamples samples_of(const Picture& picture, GridSize pixels, unsigned threads, PixelMeans means) {
    PictureSamples out{pixels, std::vector<Rgba>(std::size_t{pixels.width} * pixels.height), {}};
    parallel_for(pixels.height, threads, [&](std::size_t j) {
        for (std::uint32_t i = 0; i < pixels.width; ++i)
            out.points[j * pixels.width + i] = picture.at(sample_point(pixels, i, static_cast<std::uint32_t>(j)));
    });
    out.means = box_means(picture, pixels, threads, means);
    return out;
}

PictureDifference difference(const PictureSamples& a, const PictureSamples& b) {
    assert(a.points.size() == b.points.size());
    const GridSize pixels = a.pixels;
    PictureDifference total;
    total.pixels = pixels;
    const auto points = static_cast<double>(a.points.size());
    std::uint64_t different = 0;
    for (std::uint32_t j = 0; j < pixels.height; ++j) {
        double sum = 0;
        for (std::uint32_t i = 0; i < pixels.width; ++i) {
            const std::size_t k = std::size_t{j} * pixels.width + i;
            const double found = contrast(a.points[k], b.points[k]);
            sum += found, different += found > kOneStep;
            if (found > total.max) total.max = found, total.place = sample_point(pixels, i, j);
        }
        total.mean += sum / points;
    }
    total.different_ppm = static_cast<double>(different) * 1e6 / points;
    total.psnr = decibels(mean_square_error(a.means, b.means));
    return total;
}

PictureDifference difference(const Picture& a, const Picture& b, GridSize pixels, unsigned threads, PixelMeans means) {
    return difference(samples_of(a, pixels, threads, means), samples_of(b, pixels, threads, means));
}

} // namespace fetexc::measure
