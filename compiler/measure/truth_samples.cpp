// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/truth_samples.h"

#include <algorithm>
#include <cmath>

#include "compiler/error_budget.h"
#include "compiler/measure/colors.h"
#include "compiler/measure/edge_index.h"
#include "compiler/measure/exact_picture.h"
#include "compiler/parallel.h"

namespace fetexc::measure {
namespace {

/// SplitMix64 (Steele, Lea, Flood 2014): every bit of the argument changes every bit of the value.
std::uint64_t hash(std::uint64_t v) {
    v += 0x9e3779b97f4a7c15u;
    v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
    v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
    return v ^ (v >> 31);
}

struct PixelPoint {
    double x = 0, y = 0;
};

struct PixelRange {
    std::uint32_t first = 0, last = 0;
};

/// Pixels that the stretch between two coordinates meets, rounding included.
PixelRange range_of(double a, double b, std::uint32_t n) {
    const auto index = [&](double v) {
        return static_cast<std::uint32_t>(std::clamp(std::floor(v), 0.0, static_cast<double>(n - 1)));
    };
    return {index(std::min(a, b) - budget::kCrossedSlack), index(std::max(a, b) + budget::kCrossedSlack)};
}

} // namespace

TexturePoint sample_point(GridSize pixels, std::uint32_t i, std::uint32_t j) {
    const std::uint64_t bits = hash(static_cast<std::uint64_t>(j) << 32 | i);
    const double x = (static_cast<double>(bits >> 32) + 0.5) * 0x1p-32,
                 y = (static_cast<double>(bits & 0xffffffffu) + 0.5) * 0x1p-32;
    return {(i + x) / pixels.width, (j + y) / pixels.height};
}

TruthSamples::TruthSamples(const Truth& truth, GridSize pixels)
    : pixels_(pixels), pixel_side_(std::max(1.0 / pixels.width, truth.height() / pixels.height)) {}

Result<TruthSamples> TruthSamples::of(const Truth& truth, GridSize pixels, const MeasureOptions& options) {
    if (Status fits = check_size(pixels); !fits) return fits.error();
    TruthSamples samples(truth, pixels);
    const Figures& wanted = options.figures;
    if (wanted.psnr) {
        Result<std::vector<Rgba>> picture = truth.picture(pixels, options.threads);
        if (!picture) return picture.error();
        samples.picture_ = std::move(picture).value();
    }
    if (wanted.psnr || wanted.samples()) samples.mark_crossed(truth);
    if (wanted.samples()) samples.ask_results(truth, options.threads);
    if (wanted.boundary) samples.walk_edges(truth, options.min_contrast);
    return samples;
}

/// An edge is monotone: between two of its points it stays in their box. Steps of about a pixel.
void TruthSamples::mark_crossed(const Truth& truth) {
    crossed_.assign(size(), 0);
    const auto to_pixels = [&](WidthPoint p) {
        return PixelPoint{p.x * pixels_.width, p.y / truth.height() * pixels_.height};
    };
    for (const VisibleEdge& e : truth.edges()) {
        PixelPoint from = to_pixels(e.p[0]);
        const PixelPoint end = to_pixels(e.p[static_cast<std::size_t>(e.degree)]);
        const int steps = 1 + static_cast<int>(std::max(std::fabs(end.x - from.x), std::fabs(end.y - from.y)));
        for (int k = 1; k <= steps; ++k) {
            const PixelPoint to = k == steps ? end : to_pixels(point_at(e, static_cast<double>(k) / steps));
            const PixelRange x = range_of(from.x, to.x, pixels_.width), y = range_of(from.y, to.y, pixels_.height);
            for (std::uint32_t j = y.first; j <= y.last; ++j)
                std::fill(crossed_.begin() + static_cast<std::ptrdiff_t>(index(x.first, j)),
                          crossed_.begin() + static_cast<std::ptrdiff_t>(index(x.last, j)) + 1, 1);
            from = to;
        }
    }
}

/// Between the points of two neighbouring pixels that no visible edge crosses, the result doesn't change: the truth is
/// asked at the row's start and wherever one of the two is crossed.
void TruthSamples::ask_results(const Truth& truth, unsigned threads) {
    results_.resize(size());
    parallel_for(pixels_.height, threads, [&](std::size_t row) {
        const auto j = static_cast<std::uint32_t>(row);
        for (std::uint32_t i = 0; i < pixels_.width; ++i) {
            const std::size_t k = index(i, j);
            const bool same = i > 0 && !crossed(k) && !crossed(k - 1);
            results_[k] = same ? results_[k - 1] : truth.result_at(point(i, j));
        }
    });
}

/// A point for every pixel's length.
void TruthSamples::walk_edges(const Truth& truth, double min_contrast) {
    const std::span<const VisibleEdge> edges = truth.edges();
    for (std::uint32_t k = 0; k < edges.size(); ++k) {
        const VisibleEdge& e = edges[k];
        const TexturePoint middle = truth.to_texture(point_at(e, 0.5));
        if (contrast(truth.color(e.left, middle), truth.color(e.right, middle)) < min_contrast) {
            ++edges_without_contrast_;
            continue;
        }
        const WidthPoint end = e.p[static_cast<std::size_t>(e.degree)];
        const double length = std::hypot(e.p[0].x - end.x, e.p[0].y - end.y);
        const int n = std::max(1, static_cast<int>(std::ceil(length / pixel_side_)));
        for (int step = 0; step < n; ++step) {
            const double t = (step + 0.5) / n;
            const WidthPoint d = direction_at(e, t);
            const double speed = std::hypot(d.x, d.y);
            if (speed != 0) edge_samples_.push_back({k, point_at(e, t), {d.y / speed, -d.x / speed}, length / n});
        }
    }
}

} // namespace fetexc::measure
