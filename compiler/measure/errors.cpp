// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "compiler/measure/boundary.h"
#include "compiler/measure/islands.h"
#include "compiler/measure/pixel_means.h"
#include "compiler/measure/truth_samples.h"
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

double psnr_of(const Subject& subject, const TruthSamples& truth, unsigned intervals) {
    const GridSize n = truth.pixels();
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
            const std::size_t k = truth.index(i, j);
            Rgba mean = subject.picture.at({(i + 0.5) * w, (j + 0.5) * h});
            if (truth.crossed(k) || !is_linear(corners, mean))
                mean = supersampled(subject.picture, {i * w, j * h, w, h}, intervals);
            rows[row] += squared_error(mean, truth.mean(k));
            corners[0] = corners[1], corners[2] = corners[3];
        }
    });
    const double mse = std::accumulate(rows.begin(), rows.end(), 0.0) / (6.0 * static_cast<double>(truth.size()));
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
    FarPoints(const Truth& truth, const TruthSamples& samples, double distance)
        : truth_(truth), samples_(samples), distance_(distance) {}

    template <class Visit> void in_block(std::uint32_t i0, std::uint32_t j0, const Visit& visit) const {
        const GridSize n = samples_.pixels();
        const std::uint32_t i1 = std::min(i0 + kSide, n.width), j1 = std::min(j0 + kSide, n.height);
        const TexturePoint middle{(i0 + 0.5 * kSide) / n.width, (j0 + 0.5 * kSide) / n.height};
        const double radius = samples_.pixel_side() * kSide * 0.7072; // to a corner, and a bit more
        const EdgePoint nearest = truth_.nearest_edge(middle, distance_ + radius);
        if (nearest.edge != kNone && nearest.distance < distance_ - radius) return;
        for (std::uint32_t j = j0; j < j1; ++j) {
            for (std::uint32_t i = i0; i < i1; ++i) {
                const TexturePoint p = samples_.point(i, j);
                if (nearest.edge == kNone || truth_.nearest_edge(p, distance_).edge == kNone)
                    visit(samples_.index(i, j), p);
            }
        }
    }

    static constexpr std::uint32_t kSide = 8; ///< pixels

  private:
    const Truth& truth_;
    const TruthSamples& samples_;
    double distance_;
};

ColorError color_error(const Subject& subject, const TruthSamples& samples) {
    const GridSize n = samples.pixels();
    const FarPoints far(subject.truth, samples, texel_side(subject.truth, subject.picture));
    std::vector<ColorError> rows((n.height + FarPoints::kSide - 1) / FarPoints::kSide);
    parallel_for(rows.size(), subject.threads, [&](std::size_t row) {
        ColorError& out = rows[row];
        for (std::uint32_t i = 0; i < n.width; i += FarPoints::kSide) {
            far.in_block(i, static_cast<std::uint32_t>(row) * FarPoints::kSide, [&](std::size_t k, TexturePoint p) {
                const double error = contrast(subject.picture.at(p), subject.truth.color(samples.result(k), p));
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

/// Of what isn't wanted.
SizeErrors not_measured(const Figures& wanted) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    SizeErrors out;
    if (!wanted.misclassified) out.misclassified_ppm = out.misclassified_error_ppm = kNone;
    if (!wanted.psnr) out.psnr = kNone;
    if (!wanted.boundary) {
        for (Distances* d : {&out.to_truth, &out.to_picture})
            d->mean = d->p95 = d->hausdorff = kNone;
    }
    if (!wanted.away) out.away.max = out.away.mean = kNone;
    if (!wanted.islands) out.islands.largest_ppm = kNone;
    return out;
}

/// Of one picture.
class PictureErrors {
  public:
    PictureErrors(const Truth& truth, const Picture& picture, const MeasureOptions& options)
        : options_(options), reach_(options.reach * texel_side(truth, picture)),
          classifier_(truth, reach_, options.min_contrast),
          subject_{truth, picture, classifier_, reach_, options.min_contrast, options.threads} {}

    [[nodiscard]] SizeErrors at(const TruthSamples& truth) const {
        const Figures& wanted = options_.figures;
        SizeErrors out = not_measured(wanted);
        out.pixels = truth.pixels();
        out.pixels_per_texel = static_cast<double>(out.pixels.width) / subject_.picture.texels().width;
        if (wanted.psnr) out.psnr = psnr_of(subject_, truth, options_.supersample);
        if (wanted.classes()) measure_classes(truth, out);
        if (wanted.away) out.away = color_error(subject_, truth);
        return out;
    }

  private:
    void measure_classes(const TruthSamples& truth, SizeErrors& out) const {
        const SampleGrid grid(subject_, truth);
        if (options_.figures.misclassified) count_misclassified(grid, out);
        if (options_.figures.boundary) {
            const PictureBoundary boundary(subject_, grid);
            out.to_truth = boundary.to_truth();
            out.to_picture = boundary.to_picture();
            out.edges_without_contrast = truth.edges_without_contrast();
        }
        if (options_.figures.islands) out.islands = find_islands(subject_, grid);
    }

    const MeasureOptions& options_;
    double reach_;
    Classifier classifier_;
    Subject subject_;
};

} // namespace

Measurer::Measurer(const Truth& truth, MeasureOptions options) : truth_(&truth), options_(std::move(options)) {}
Measurer::~Measurer() = default;
Measurer::Measurer(Measurer&&) noexcept = default;
Measurer& Measurer::operator=(Measurer&&) noexcept = default;

Result<Measurer> Measurer::of(const Truth& truth, MeasureOptions options) {
    Measurer measurer(truth, std::move(options));
    for (const GridSize pixels : measurer.options_.sizes) {
        Result<TruthSamples> samples = TruthSamples::of(truth, pixels, measurer.options_);
        if (!samples) return samples.error();
        measurer.samples_.push_back(std::move(samples).value());
    }
    return measurer;
}

std::vector<SizeErrors> Measurer::measure(const Picture& picture) const {
    const PictureErrors errors(*truth_, picture, options_);
    std::vector<SizeErrors> all;
    for (const TruthSamples& samples : samples_)
        all.push_back(errors.at(samples));
    return all;
}

Result<std::vector<SizeErrors>> measure(const Truth& truth, const Picture& picture, const MeasureOptions& options) {
    const PictureErrors errors(truth, picture, options);
    std::vector<SizeErrors> all;
    for (const GridSize pixels : options.sizes) {
        const Result<TruthSamples> samples = TruthSamples::of(truth, pixels, options);
        if (!samples) return samples.error();
        all.push_back(errors.at(samples.value()));
    }
    return all;
}

} // namespace fetexc::measure
