// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/exact_picture.h"

#include <algorithm>

#include "compiler/measure/colors.h"
#include "compiler/measure/visible_edges.h"
#include "compiler/planar/trapezoid_area.h"
#include "compiler/scene/lattice.h"

namespace fetexc::measure {
namespace {

constexpr std::uint32_t kMaxSize = 16384; ///< as for assets

struct GaussPoint {
    double at, weight;
};
constexpr double kGaussReach = 0.38729833462074170; ///< √15 / 10: three points are exact for degree 5
constexpr std::array<GaussPoint, 3> kGauss{
    {{0.5 - kGaussReach, 5.0 / 18}, {0.5, 8.0 / 18}, {0.5 + kGaussReach, 5.0 / 18}}};

/// Sides and ends of a trapezoid in planar space.
struct Span {
    double lo = 0, hi = 0;
};

class Integrator {
  public:
    Integrator(const Scene& scene, Compositor& compositor, const PlanarMap& map)
        : scene_(scene), compositor_(compositor), map_(map), grid_(map.grid()),
          area_(static_cast<double>(grid_.px) * static_cast<double>(grid_.py)) {}

    [[nodiscard]] Rgba whole(std::uint32_t i, std::uint32_t j, ResultId result) const {
        if (compositor_.is_solid(result)) return compositor_.color(result, {});
        const Span x = side(i, grid_.px), y = side(j, grid_.py);
        Rgba sum;
        for (const GaussPoint& v : kGauss)
            add(sum, along_level(result, lerp(y, v.at), x), v.weight);
        return sum;
    }

    [[nodiscard]] Rgba parts(const TexelMap& texel) const {
        TrapezoidAreas areas(map_, texel);
        Rgba sum;
        for (const Trapezoid& t : texel.sweep.trapezoids) {
            const double share = areas.of(t).area / area_;
            if (!(share > 0)) continue;
            const ResultId result = texel.results[t.face];
            add(sum, compositor_.is_solid(result) ? compositor_.color(result, {}) : mean(texel, t, result), share);
        }
        return sum;
    }

  private:
    static double lerp(const Span& s, double t) { return s.lo + t * (s.hi - s.lo); }
    static Span side(std::uint32_t index, std::int64_t pitch) {
        return {static_cast<double>(index * pitch), static_cast<double>((index + 1) * pitch)};
    }

    /// Mean of a paint along a level line.
    [[nodiscard]] Rgba along_level(ResultId result, double y, const Span& x) const {
        Rgba sum;
        for (const GaussPoint& u : kGauss)
            add(sum, color_at(result, lerp(x, u.at), y), u.weight);
        return sum;
    }

    [[nodiscard]] Rgba color_at(ResultId result, double x, double y) const {
        return compositor_.color(
            result, to_canvas(scene_.extent, x / static_cast<double>(grid_.kx), y / static_cast<double>(grid_.ky)));
    }

    /// Three levels, weighted by their lengths, three points on each.
    [[nodiscard]] Rgba mean(const TexelMap& texel, const Trapezoid& t, ResultId result) const {
        const Span x = side(texel.i, grid_.px);
        Span y = side(texel.j, grid_.py);
        if (t.top_node != kNone) y.lo = map_.node(texel.graph.nodes[t.top_node]).y;
        if (t.bottom_node != kNone) y.hi = map_.node(texel.graph.nodes[t.bottom_node]).y;
        Rgba sum;
        double weight = 0;
        for (const GaussPoint& v : kGauss) {
            const double level = lerp(y, v.at);
            const Span line{x_on(texel, t.left, level, x.lo), x_on(texel, t.right, level, x.hi)};
            const double w = v.weight * std::max(line.hi - line.lo, 0.0);
            if (w == 0) continue;
            add(sum, along_level(result, level, line), w);
            weight += w;
        }
        if (weight == 0) return color_at(result, lerp(x, 0.5), lerp(y, 0.5));
        return {sum.r / weight, sum.g / weight, sum.b / weight, sum.a / weight};
    }

    [[nodiscard]] double x_on(const TexelMap& texel, std::uint32_t edge, double y, double side) const {
        if (edge == kNone) return side;
        const Stretch s = map_.stretch_of(texel.sub_edges[texel.graph.edges[edge].sub]);
        return value_double(*s.curve, Axis::X, parameter_at(*s.curve, Axis::Y, s.range, s.y_increasing, y).mid());
    }

    const Scene& scene_;
    Compositor& compositor_;
    const PlanarMap& map_;
    const Grid& grid_;
    double area_; ///< of a pixel
};

} // namespace

Status check_size(GridSize pixels) {
    if (pixels.width >= 1 && pixels.height >= 1 && pixels.width <= kMaxSize && pixels.height <= kMaxSize) return {};
    return Error{ErrorClass::Usage, diag::kSizeOutOfRange, "the size must be 1 to 16384 pixels on each side", ""};
}

Result<std::vector<Rgba>> exact_picture(const Scene& scene, Compositor& compositor, GridSize pixels, unsigned threads) {
    if (Status fits = check_size(pixels); !fits) return fits.error();
    PlanarStats stats;
    const Grid grid = make_grid(scene.extent, pixels.width, pixels.height);
    const Result<PlanarMap> map = PlanarMap::build(scene, grid, threads, stats);
    if (!map) return map.error();
    const Integrator integrator(scene, compositor, map.value());
    std::vector<Rgba> out(static_cast<std::size_t>(pixels.width) * pixels.height);
    const auto pixel = [&](std::uint32_t i, std::uint32_t j) -> Rgba& {
        return out[static_cast<std::size_t>(j) * pixels.width + i];
    };
    const bool good = for_each_texel(
        map.value(), scene, compositor, threads,
        [&](std::uint32_t i, std::uint32_t j, ResultId result) { pixel(i, j) = integrator.whole(i, j, result); },
        [&](const TexelMap& texel) { pixel(texel.i, texel.j) = integrator.parts(texel); });
    if (!good) return inconsistent_map();
    return out;
}

} // namespace fetexc::measure
