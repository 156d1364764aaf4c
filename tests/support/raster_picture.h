// SPDX-License-Identifier: GPL-3.0-or-later
/// Images from formulas and features from points, for tests.
#pragma once

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "compiler/compile.h"
#include "compiler/raster/feature_scene.h"

namespace fetexc::test {

/// color(x, y): premultiplied, at the pixels' centres.
template <class Color> RasterImage image_of(std::uint32_t width, std::uint32_t height, const Color& color) {
    RasterImage image{width, height, {}};
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const Rgba c = color(x + 0.5, y + 0.5);
            for (const double v : {c.r, c.g, c.b, c.a})
                image.rgba.push_back(static_cast<float>(std::lround(v * 65535)));
        }
    }
    return image;
}

inline Rgba grey(double v) { return {v, v, v, 1}; }

/// Lines from point to point.
inline CanvasContour polyline(const std::vector<CanvasPoint>& points) {
    CanvasContour run;
    for (std::size_t k = 0; k + 1 < points.size(); ++k)
        run.push_back({1, {points[k], points[k + 1]}});
    return run;
}

/// runs: in pixels of the image.
inline FeaturedImage featured(RasterImage image, std::vector<CanvasContour> runs, double invalidate = 1) {
    const FeatureCurves curves{static_cast<double>(image.width), static_cast<double>(image.height), std::move(runs)};
    Result<Scene> scene = feature_scene(curves, image.width, image.height);
    if (!scene) throw std::runtime_error(scene.error().message);
    return {std::move(image), std::move(scene).value(), invalidate};
}

} // namespace fetexc::test
