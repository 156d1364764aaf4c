// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/curve_displacement.h"

#include <cmath>

#include "compiler/feature_curves/texture_segments.h"
#include "compiler/measure/distance_samples.h"
#include "compiler/parallel.h"

namespace fetexc::measure {
namespace {

constexpr std::size_t kPoints = 256; ///< for a thread at a time

/// Length of the control polygon: no shorter than the curve.
double length_of(const VisibleEdge& e) {
    double sum = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(e.degree); ++k)
        sum += std::hypot(e.p[k + 1].x - e.p[k].x, e.p[k + 1].y - e.p[k].y);
    return sum;
}

/// Points in the middle of parts, equal in the parameter, no longer than about `step`; those on the canvas.
std::vector<DistanceSample> points_along(std::span<const VisibleEdge> curves, double height, double step) {
    std::vector<DistanceSample> out;
    for (const VisibleEdge& e : curves) {
        const double parts = std::ceil(std::max(length_of(e) / step, 1.0));
        for (double k = 0; k < parts; ++k) {
            const double t = (k + 0.5) / parts;
            const WidthPoint p = point_at(e, t), d = direction_at(e, t);
            if (p.x < 0 || p.x > 1 || p.y < 0 || p.y > height) continue;
            out.push_back({0, std::hypot(d.x, d.y) / parts, false, p});
        }
    }
    return out;
}

template <class Nearest>
Distances distances_to(std::vector<DistanceSample> points, unsigned threads, const Nearest& nearest) {
    parallel_for_chunks(points.size(), kPoints, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const EdgePoint found = nearest(points[k].place);
            points[k].distance = found.distance, points[k].beyond = found.edge == kNone;
        }
    });
    return summary(std::move(points));
}

} // namespace

std::vector<VisibleEdge> curves_of(const fetex::FeatureCurvesTexture& texture, double height) {
    const TextureSegments segments(texture);
    std::vector<VisibleEdge> out;
    const double across = 1.0 / texture.width, down = height / texture.height;
    for (std::uint32_t j = 0; j < texture.height; ++j) {
        segments.occupied().in_row(j, 0, texture.width - 1, [&](std::uint32_t i) {
            segments.visit_texel(i, j, [&](const TextureSegment& s) {
                const CanvasSegment curve = curve_of(s);
                VisibleEdge e;
                e.degree = curve.degree;
                for (std::size_t k = 0; k <= static_cast<std::size_t>(curve.degree); ++k)
                    e.p[k] = {curve.p[k].x * across, curve.p[k].y * down};
                out.push_back(e);
            });
        });
    }
    return out;
}

CurveDistances curve_distances(const CurveTruth& truth, std::span<const VisibleEdge> shown, double step, double reach,
                               unsigned threads) {
    const EdgeIndex index(shown, truth.height());
    return {distances_to(points_along(truth.curves(), truth.height(), step), threads,
                         [&](WidthPoint p) { return index.nearest(p, reach); }),
            distances_to(points_along(shown, truth.height(), step), threads,
                         [&](WidthPoint p) { return truth.nearest(p, reach); })};
}

} // namespace fetexc::measure
