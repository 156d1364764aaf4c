// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "compiler/measure/boundary.h"
#include "compiler/measure/colors.h"
#include "compiler/measure/islands.h"
#include "compiler/measure/pixel_means.h"
#include "compiler/measure/truth_samples.h"
#include "compiler/parallel.h"

namespace fetexc::measure {
namespace {

constexpr std::size_t kRowsPerTask = 16;

double psnr_of(const Subject& subject, const TruthSamples& truth, unsigned intervals) {
    const GridSize n = truth.pixels();
    std::vector<double> rows(n.height, 0);
    parallel_for_chunks(n.height, kRowsPerTask, subject.threads, [&](std::size_t first, std::size_t end) {
        const double w = 1.0 / n.width, h = 1.0 / n.height;
        const auto line = [&](std::size_t y) {
            std::vector<Rgba> corners;
            for (std::uint32_t i = 0; i <= n.width; ++i)
                corners.push_back(subject.picture.at({i * w, static_cast<double>(y) * h}));
            return corners;
        };
        std::vector<Rgba> above = line(first);
        for (std::size_t row = first; row < end; ++row) {
            std::vector<Rgba> below = line(row + 1);
            const auto j = static_cast<std::uint32_t>(row);
            for (std::uint32_t i = 0; i < n.width; ++i) {
                const std::size_t k = truth.index(i, j);
                Rgba mean = subject.picture.at({(i + 0.5) * w, (j + 0.5) * h});
                if (truth.crossed(k) || !is_linear({above[i], above[i + 1], below[i], below[i + 1]}, mean))
                    mean = supersampled(subject.picture, {i * w, j * h, w, h}, intervals);
                rows[row] += square_error(mean, truth.mean(k));
            }
            above.swap(below);
        }
    });
    return decibels(std::accumulate(rows.begin(), rows.end(), 0.0) / static_cast<double>(truth.size()));
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
                if (nearest.edge == kNone || is_far(samples_.point(i, j), nearest.edge)) visit(i, j);
            }
        }
    }

    static constexpr std::uint32_t kSide = 8; ///< pixels

  private:
    /// likely: an edge that may well be near.
    [[nodiscard]] bool is_far(TexturePoint p, std::uint32_t likely) const {
        return truth_.nearest_on(likely, p, distance_).edge == kNone && !truth_.edge_within(p, distance_);
    }

    const Truth& truth_;
    const TruthSamples& samples_;
    double distance_;
};

ColorError color_error(const Subject& subject, const TruthSamples& samples, std::span<const double> errors) {
    const GridSize n = samples.pixels();
    const FarPoints far(subject.truth, samples, texel_side(subject.truth, subject.picture));
    std::vector<ColorError> rows((n.height + FarPoints::kSide - 1) / FarPoints::kSide);
    parallel_for(rows.size(), subject.threads, [&](std::size_t row) {
        ColorError& out = rows[row];
        for (std::uint32_t i0 = 0; i0 < n.width; i0 += FarPoints::kSide) {
            far.in_block(i0, static_cast<std::uint32_t>(row) * FarPoints::kSide, [&](std::uint32_t i, std::uint32_t j) {
                const double error = errors[samples.index(i, j)];
                out.mean += error, ++out.points;
                if (error > out.max) out.max = error, out.place = samples.point(i, j);
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
        : options_(options), subject_{truth, picture, options.reach * texel_side(truth, picture), options.min_contrast,
                                      options.threads} {
        if (options.figures.samples()) classifier_.emplace(truth, subject_.reach, options.min_contrast);
    }

    [[nodiscard]] SizeErrors at(const TruthSamples& truth) const {
        const Figures& wanted = options_.figures;
        SizeErrors out = not_measured(wanted);
        out.pixels = truth.pixels();
        out.pixels_per_texel = static_cast<double>(out.pixels.width) / subject_.picture.texels().width;
        if (wanted.psnr) out.psnr = psnr_of(subject_, truth, options_.supersample);
        if (wanted.samples()) measure_samples(truth, out);
        return out;
    }

  private:
    void measure_samples(const TruthSamples& truth, SizeErrors& out) const {
        const Figures& wanted = options_.figures;
        const SampleGrid grid(subject_, *classifier_, truth);
        if (wanted.misclassified) count_misclassified(grid, out);
        if (wanted.boundary) {
            const PictureBoundary boundary(subject_, grid);
            out.to_truth = boundary.to_truth();
            out.to_picture = boundary.to_picture();
            out.edges_without_contrast = truth.edges_without_contrast();
        }
        if (wanted.away) out.away = color_error(subject_, truth, grid.color_errors());
        if (wanted.islands) out.islands = find_islands(subject_, grid);
    }

    const MeasureOptions& options_;
    Subject subject_;
    std::optional<Classifier> classifier_; ///< if anything takes one
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
