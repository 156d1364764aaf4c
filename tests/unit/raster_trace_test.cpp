// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/raster/trace.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/raster_picture.h"

namespace fetexc {
namespace {

using test::grey;
using test::image_of;

CanvasPoint point_of(const CanvasSegment& s, double t) {
    const double u = 1 - t;
    if (s.degree == 1) return {u * s.p[0].x + t * s.p[1].x, u * s.p[0].y + t * s.p[1].y};
    const double w[4] = {u * u * u, 3 * u * u * t, 3 * u * t * t, t * t * t};
    CanvasPoint q;
    for (std::size_t k = 0; k < 4; ++k)
        q.x += w[k] * s.p[k].x, q.y += w[k] * s.p[k].y;
    return q;
}

double length_of(const FeatureCurves& features) {
    double length = 0;
    for (const CanvasContour& run : features.runs) {
        for (const CanvasSegment& s : run) {
            for (int k = 0; k < 16; ++k) {
                const CanvasPoint a = point_of(s, k / 16.0), b = point_of(s, (k + 1) / 16.0);
                length += std::hypot(b.x - a.x, b.y - a.y);
            }
        }
    }
    return length;
}

FeatureCurves traced(const RasterImage& image, const TraceOptions& options = {}) {
    auto features = trace_features(image, options);
    if (!features.ok()) throw std::runtime_error(features.error().message);
    return std::move(features).value();
}

RasterImage blurred_disc(double radius, double inside, double outside) {
    return image_of(48, 40, [&](double x, double y) {
        const double t = std::clamp(0.5 + 0.7 * (std::hypot(x - 24.3, y - 19.6) - radius), 0.0, 1.0);
        return grey((1 - t) * inside + t * outside);
    });
}

TEST(Trace, findsAnOutlineBetweenPixels) {
    for (const double radius : {6.2, 12.7}) {
        for (const auto& [inside, outside] : {std::pair(0.8, 0.3), {0.2, 0.6}}) {
            const FeatureCurves features = traced(blurred_disc(radius, inside, outside));
            const double around = 2 * 3.14159265 * radius;
            EXPECT_NEAR(length_of(features), around, 0.05 * around);
            for (const CanvasContour& run : features.runs) {
                for (const CanvasSegment& s : run) {
                    for (const double t : {0.0, 0.25, 0.5, 0.75}) {
                        const CanvasPoint p = point_of(s, t);
                        EXPECT_NEAR(std::hypot(p.x - 24.3, p.y - 19.6), radius, 0.3);
                    }
                }
            }
        }
    }
}

TEST(Trace, leavesWhatIsSmoothOrFaintAlone) {
    EXPECT_TRUE(traced(image_of(50, 50, [](double x, double y) { return grey(0.008 * x + 0.01 * y); })).runs.empty());
    EXPECT_TRUE(traced(blurred_disc(10, 0.5, 0.56)).runs.empty());
    EXPECT_FALSE(traced(blurred_disc(10, 0.5, 0.56), {.contrast = 0.03}).runs.empty());
}

TEST(Trace, leavesSpecksOut) {
    const RasterImage image = blurred_disc(1.4, 0.9, 0.1);
    EXPECT_FALSE(traced(image, {.speck = 2}).runs.empty());
    EXPECT_TRUE(traced(image, {.speck = 20}).runs.empty());
}

/// An edge across the image ends at its border, not before, and the border itself is none.
TEST(Trace, reachesTheBorder) {
    const RasterImage image = image_of(
        40, 30, [](double x, double y) { return grey(0.2 + 0.6 * std::clamp(0.5 + x - 17.4 - 0.2 * y, 0.0, 1.0)); });
    const FeatureCurves features = traced(image);
    double top = 1e9, bottom = -1e9;
    for (const CanvasContour& run : features.runs) {
        for (const CanvasSegment& s : run) {
            for (const CanvasPoint p : {s.p[0], s.p[static_cast<std::size_t>(s.degree)]}) {
                EXPECT_NEAR(p.x, 17.4 + 0.2 * std::clamp(p.y, 0.0, 30.0), 0.5) << p.y;
                top = std::min(top, p.y), bottom = std::max(bottom, p.y);
            }
        }
    }
    EXPECT_LE(top, 0);
    EXPECT_GE(bottom, 30);
}

/// Left half: an edge; in the right half it fades.
TEST(Trace, endsWhereTheEdgeFades) {
    const RasterImage image = image_of(60, 30, [](double x, double y) {
        const double fade = std::clamp((40 - x) / 20, 0.0, 1.0);
        return grey(0.5 + (y < 15.2 ? -0.3 : 0.3) * fade);
    });
    double last = 0;
    for (const CanvasContour& run : traced(image).runs) {
        for (const CanvasSegment& s : run)
            last = std::max(last, s.p[static_cast<std::size_t>(s.degree)].x);
    }
    EXPECT_GT(last, 34);
    EXPECT_LT(last, 42);
}

} // namespace
} // namespace fetexc
