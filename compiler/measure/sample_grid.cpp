// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/sample_grid.h"

#include <algorithm>
#include <cmath>

#include "compiler/measure/edge_index.h"
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
    constexpr double slack = 1e-6;
    const auto index = [&](double v) {
        return static_cast<std::uint32_t>(std::clamp(std::floor(v), 0.0, static_cast<double>(n - 1)));
    };
    return {index(std::min(a, b) - slack), index(std::max(a, b) + slack)};
}

} // namespace

TexturePoint SampleGrid::point(std::uint32_t i, std::uint32_t j) const {
    const std::uint64_t bits = hash(static_cast<std::uint64_t>(j) << 32 | i);
    const double x = (static_cast<double>(bits >> 32) + 0.5) * 0x1p-32,
                 y = (static_cast<double>(bits & 0xffffffffu) + 0.5) * 0x1p-32;
    return {(i + x) / pixels_.width, (j + y) / pixels_.height};
}

/// An edge is monotone: between two of its points it stays in their box. Steps of a pixel at most.
void SampleGrid::mark_crossed(const Truth& truth) {
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
SampleGrid::SampleGrid(const Subject& subject, GridSize pixels)
    : pixels_(pixels), pixel_side_(std::max(1.0 / pixels.width, subject.truth.height() / pixels.height)) {
    const std::size_t n = static_cast<std::size_t>(pixels.width) * pixels.height;
    crossed_.assign(n, 0), truth_.resize(n), picture_.resize(n);
    mark_crossed(subject.truth);
    parallel_for(pixels.height, subject.threads, [&](std::size_t row) {
        for (std::uint32_t i = 0; i < pixels.width; ++i) {
            const auto j = static_cast<std::uint32_t>(row);
            const std::size_t k = index(i, j);
            const TexturePoint p = point(i, j);
            const bool same = i > 0 && crossed_[k] == 0 && crossed_[k - 1] == 0;
            truth_[k] = same ? truth_[k - 1] : subject.truth.result_at(p);
            picture_[k] = subject.classifier.classify(p, truth_[k], subject.picture.at(p));
        }
    });
}

} // namespace fetexc::measure
