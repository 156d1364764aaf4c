// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/region_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "compiler/error_budget.h"
#include "compiler/scene/curve_distance.h"
#include "compiler/scene/ground_truth.h"
#include "tests/support/random.h"

namespace fetexc::test {
namespace {

bool colors_agree(const fetex::FbtColor& a, const Rgba& b) {
    constexpr double tolerance = 1.0 / 255 + 1e-9; // rounding to RGBA8 is half of it
    return std::fabs(a.r - b.r) <= tolerance && std::fabs(a.g - b.g) <= tolerance &&
           std::fabs(a.b - b.b) <= tolerance && std::fabs(a.a - b.a) <= tolerance;
}

/// Distance in texels, each axis in its own texel side, to the nearest curve of any shape. Only wrong points ask.
double texel_distance(const Scene& scene, double sx, double sy, double x, double y) {
    constexpr double units = 1024; // per texel, so that the accuracy of distance_below() is far below the tolerance
    double best = std::numeric_limits<double>::infinity();
    for (const Segment& segment : scene.segments) {
        CanvasSegment c;
        c.degree = segment.degree;
        for (int i = 0; i <= segment.degree; ++i) {
            c.p[i] = {static_cast<double>(segment.p[i].x) / sx * units,
                      static_cast<double>(segment.p[i].y) / sy * units};
        }
        best = distance_below(c, x * units, y * units, best);
    }
    return best / units;
}

} // namespace

RegionCheck check_regions(const Scene& scene, const FbtBuild& build, const FbtRegions& regions, std::uint64_t points,
                          std::uint64_t seed) {
    const GroundTruth truth(scene);
    const fetex::FbtTexture& t = build.texture;
    const double sx = static_cast<double>(scene.extent.lattice_w) / t.width,
                 sy = static_cast<double>(scene.extent.lattice_h) / t.height;
    RegionCheck out;
    Random random(seed);
    for (; out.points < points; ++out.points) {
        const double x = random.between(0, t.width), y = random.between(0, t.height);
        const fetex::FbtRegion region = fetex::fbt_locate(t, x, y);
        const ResultId got = regions.result_of(region, t.width),
                       expected = truth.result_at(*regions.compositor, x * sx, y * sy);
        if (got == expected) {
            if (regions.compositor->is_solid(got) &&
                !colors_agree(fetex::fbt_sample(t, x, y), regions.compositor->color(got, {})))
                ++out.color_off;
            continue;
        }
        ++out.wrong;
        const double distance = texel_distance(scene, sx, sy, x, y);
        if (distance > budget::kRegionTolerance) ++out.wrong_far;
        if (distance >= out.worst_distance) {
            std::ostringstream where;
            where.precision(17);
            where << "texel-space (" << x << ", " << y << ") result " << got << " instead of " << expected << ", "
                  << distance << " texels from the nearest curve";
            out.worst_distance = distance, out.worst = where.str();
        }
    }
    return out;
}

} // namespace fetexc::test
