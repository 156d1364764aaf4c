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

struct RowDifference {
    std::uint64_t different = 0;
    double max = 0, sum = 0;
    TexturePoint place;
};

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

PictureDifference difference(const Picture& a, const Picture& b, GridSize pixels, unsigned threads, PixelMeans means) {
    std::vector<RowDifference> rows(pixels.height);
    parallel_for(pixels.height, threads, [&](std::size_t j) {
        RowDifference& row = rows[j];
        for (std::uint32_t i = 0; i < pixels.width; ++i) {
            const TexturePoint p = sample_point(pixels, i, static_cast<std::uint32_t>(j));
            const double found = contrast(a.at(p), b.at(p));
            row.sum += found;
            if (found > kOneStep) ++row.different;
            if (found > row.max) row.max = found, row.place = p;
        }
    });
    PictureDifference total;
    total.pixels = pixels;
    const double points = static_cast<double>(pixels.width) * pixels.height;
    std::uint64_t different = 0;
    for (const RowDifference& row : rows) {
        different += row.different;
        total.mean += row.sum / points;
        if (row.max > total.max) total.max = row.max, total.place = row.place;
    }
    total.different_ppm = static_cast<double>(different) * 1e6 / points;
    total.psnr =
        decibels(mean_square_error(box_means(a, pixels, threads, means), box_means(b, pixels, threads, means)));
    return total;
}

} // namespace fetexc::measure
