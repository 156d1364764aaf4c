// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "compiler/measure/boundary.h"
#include "compiler/measure/exact_picture.h"
#include "compiler/measure/islands.h"
#include "compiler/measure/pixel_means.h"
#include "compiler/parallel.h"

namespace fetexc::measure {
namespace {

/// Colours are compared over black and over white.
double squared_error(const Rgba& a, const Rgba& b) {
    double sum = 0;
    const double alpha = a.a - b.a;
    for (const double d : {a.r - b.r, a.g - b.g, a.b - b.b})
        sum += d * d + (d - alpha) * (d - alpha);
    return sum;
}

Result<double> psnr_of(const Subject& subject, const SampleGrid& grid, unsigned intervals) {
    const GridSize n = grid.pixels();
    const Result<std::vector<Rgba>> exact = subject.truth.picture(n, subject.threads);
    if (!exact) return exact.error();
    std::vector<double> rows(n.height, 0);
    parallel_for(n.height, subject.threads, [&](std::size_t row) {
        const auto j = static_cast<std::uint32_t>(row);
        const double w = 1.0 / n.width, h = 1.0 / n.height;
        const auto corner = [&](std::uint32_t i, std::uint32_t below) {
            return subject.picture.at({i * w, (j + below) * h});
        };
        PixelCorners corners{corner(0, 0), {}, corner(0, 1), {}};
        for (std::uint32_t i = 0; i < n.width; ++i) {
            corners[1] = corner(i + 1, 0), corners[3] = corner(i + 1, 1);
            const std::size_t k = grid.index(i, j);
            Rgba mean = subject.picture.at({(i + 0.5) * w, (j + 0.5) * h});
            if (grid.crossed(k) || !is_linear(corners, mean))
                mean = supersampled(subject.picture, {i * w, j * h, w, h}, intervals);
            rows[row] += squared_error(mean, exact.value()[k]);
            corners[0] = corners[1], corners[2] = corners[3];
        }
    });
    const double mse = std::accumulate(rows.begin(), rows.end(), 0.0) / (6.0 * static_cast<double>(grid.size()));
    return mse > 0 ? -10 * std::log10(mse) : std::numeric_limits<double>::infinity();
}

void count_misclassified(const SampleGrid& grid, SizeErrors& out) {
    std::uint64_t wrong = 0;
    for (std::size_t k = 0; k < grid.size(); ++k) {
        if (grid.truth(k) == grid.picture(k)) continue;
        if (wrong++ == 0) out.misclassified_place = grid.point(k);
    }
    const double ppm = 1e6 / static_cast<double>(grid.size());
    out.misclassified_ppm = static_cast<double>(wrong) * ppm;
    out.misclassified_error_ppm = std::sqrt(static_cast<double>(std::max<std::uint64_t>(wrong, 1))) * ppm;
}

/// Whether points are far from edges, block by block: one question for most of them.
class FarPoints {
  public:
    FarPoints(const Truth& truth, const SampleGrid& grid, double distance)
        : truth_(truth), grid_(grid), distance_(distance) {}

    template <class Visit> void in_block(std::uint32_t i0, std::uint32_t j0, const Visit& visit) const {
        const GridSize n = grid_.pixels();
        const std::uint32_t i1 = std::min(i0 + kSide, n.width), j1 = std::min(j0 + kSide, n.height);
        const TexturePoint middle{(i0 + 0.5 * kSide) / n.width, (j0 + 0.5 * kSide) / n.height};
        const double radius = grid_.pixel_side() * kSide * 0.7072; // to a corner, and a bit more
        const EdgePoint nearest = truth_.nearest_edge(middle, distance_ + radius);
        if (nearest.edge != kNone && nearest.distance < distance_ - radius) return;
        for (std::uint32_t j = j0; j < j1; ++j) {
            for (std::uint32_t i = i0; i < i1; ++i) {
                const TexturePoint p = grid_.point(i, j);
                if (nearest.edge == kNone || truth_.nearest_edge(p, distance_).edge == kNone)
                    visit(grid_.index(i, j), p);
            }
        }
    }

    static constexpr std::uint32_t kSide = 8; ///< pixels

  private:
    const Truth& truth_;
    const SampleGrid& grid_;
    double distance_;
};

ColorError color_error(const Subject& subject, const SampleGrid& grid) {
    const GridSize n = grid.pixels();
    const FarPoints far(subject.truth, grid, texel_side(subject.truth, subject.picture));
    std::vector<ColorError> rows((n.height + FarPoints::kSide - 1) / FarPoints::kSide);
    parallel_for(rows.size(), subject.threads, [&](std::size_t row) {
        ColorError& out = rows[row];
        for (std::uint32_t i = 0; i < n.width; i += FarPoints::kSide) {
            far.in_block(i, static_cast<std::uint32_t>(row) * FarPoints::kSide, [&](std::size_t k, TexturePoint p) {
                const double error = contrast(subject.picture.at(p), subject.truth.color(grid.truth(k), p));
                out.mean += error, ++out.points;
                if (error > out.max) out.max = error, out.place = p;
            });
        }
    });
    ColorError total;
    for (const ColorError& row : rows) {
        total.mean += row.mean, total.points += row.points;
        if (row.max > total.max) total.max = row.max, total.place = row.place;
    }
    if (total.points > 0) total.mean /= static_cast<double>(total.points);
    return total;
}

} // namespace

Result<std::vector<SizeErrors>> measure(const Truth& truth, const Picture& picture, const MeasureOptions& options) {
    const double reach = options.reach * texel_side(truth, picture);
    const Classifier classifier(truth, reach, options.min_contrast);
    const Subject subject{truth, picture, classifier, reach, options.min_contrast, options.threads};
    std::vector<SizeErrors> all;
    for (const GridSize pixels : options.sizes) {
        if (Status fits = check_size(pixels); !fits) return fits.error();
        const SampleGrid grid(subject, pixels);
        const Result<double> psnr = psnr_of(subject, grid, options.supersample);
        if (!psnr) return psnr.error();
        SizeErrors out;
        out.pixels = pixels;
        out.pixels_per_texel = static_cast<double>(pixels.width) / picture.texels().width;
        out.psnr = psnr.value();
        count_misclassified(grid, out);
        const PictureBoundary boundary(subject, grid);
        out.to_truth = boundary.to_truth();
        out.to_picture = boundary.to_picture(out.edges_without_contrast);
        out.away = color_error(subject, grid);
        out.islands = find_islands(subject, grid);
        all.push_back(out);
    }
    return all;
}

} // namespace fetexc::measure
