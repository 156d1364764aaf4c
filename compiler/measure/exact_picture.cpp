// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/measure/exact_picture.h"

#include <algorithm>

#include "compiler/gauss.h"
#include "compiler/measure/colors.h"
#include "compiler/planar/visible_edges.h"
#include "compiler/planar/trapezoid_area.h"
#include "compiler/planar/trapezoid_sides.h"
#include "compiler/scene/lattice.h"

namespace fetexc::measure {
namespace {

constexpr std::uint32_t kMaxSize = 16384; ///< as for assets

class Integrator {
  public:
    Integrator(const Scene& scene, Compositor& compositor, const PlanarMap& map)
        : scene_(scene), compositor_(compositor), map_(map), grid_(map.grid()),
          area_(static_cast<double>(grid_.px) * static_cast<double>(grid_.py)) {}

    [[nodiscard]] Rgba whole(std::uint32_t i, std::uint32_t j, ResultId result) const {
        if (compositor_.is_solid(result)) return compositor_.color(result, {});
        const TrapezoidSides sides(map_, i, j);
        Rgba sum;
        for (const GaussPoint& v : kGauss)
            add(sum, along_level(result, sides.rows().at(v.at), sides.columns()), v.weight);
        return sum;
    }

    [[nodiscard]] Rgba parts(const TexelMap& texel) const {
        TrapezoidAreas areas(map_, texel);
        const TrapezoidSides sides(map_, texel);
        Rgba sum;
        for (const Trapezoid& t : texel.sweep.trapezoids) {
            const double share = areas.of(t).area / area_;
            if (!(share > 0)) continue;
            const ResultId result = texel.results[t.face];
            add(sum, compositor_.is_solid(result) ? compositor_.color(result, {}) : mean(sides, t, result), share);
        }
        return sum;
    }

  private:
    /// Mean of a paint along a level line.
    [[nodiscard]] Rgba along_level(ResultId result, double y, const Extent1& x) const {
        Rgba sum;
        for (const GaussPoint& u : kGauss)
            add(sum, color_at(result, x.at(u.at), y), u.weight);
        return sum;
    }

    [[nodiscard]] Rgba color_at(ResultId result, double x, double y) const {
        return compositor_.color(
            result, to_canvas(scene_.extent, x / static_cast<double>(grid_.kx), y / static_cast<double>(grid_.ky)));
    }

    /// Three levels, weighted by their lengths, three points on each.
    [[nodiscard]] Rgba mean(const TrapezoidSides& sides, const Trapezoid& t, ResultId result) const {
        const Extent1 y = sides.levels(t);
        Rgba sum;
        double weight = 0;
        for (const GaussPoint& v : kGauss) {
            const double level = y.at(v.at);
            const Extent1 line = sides.at(t, level);
            const double w = v.weight * std::max(line.size(), 0.0);
            if (w == 0) continue;
            add(sum, along_level(result, level, line), w);
            weight += w;
        }
        if (weight == 0) return color_at(result, sides.columns().at(0.5), y.at(0.5));
        return {sum.r / weight, sum.g / weight, sum.b / weight, sum.a / weight};
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
