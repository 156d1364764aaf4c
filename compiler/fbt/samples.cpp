// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/fbt/samples.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "compiler/error_budget.h"
#include "compiler/parallel.h"
#include "compiler/planar/trapezoid_sides.h"
#include "formats/validate.h"

namespace fetexc {
namespace {

std::array<double, 4> channels(const Rgba& c) { return {c.r, c.g, c.b, c.a}; }

/// A point of a region, texel-local, the area it stands for, and the paint there.
struct QuadraturePoint {
    double x, y, area;
    Rgba paint;
};

std::array<double, 4> corner_weights(double x, double y) {
    return {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
}

} // namespace

std::uint32_t pack_rgba8(const Rgba& c) {
    return fetex::fbt_pack_sample({c.r, c.g, c.b, c.a}, fetex::FbtSampleFormat::Rgba8)[0];
}

CanvasPoint to_canvas(const Scene& scene, const Grid& grid, double x, double y) {
    return {x / static_cast<double>(grid.right()) * scene.extent.width,
            y / static_cast<double>(grid.bottom()) * scene.extent.height};
}

CornerResults::CornerResults(const PlanarMap& map, const Scene& scene, Compositor& compositor, unsigned threads)
    : map_(map), scene_(scene), compositor_(compositor), width_(map.grid().width) {
    const std::size_t columns = std::size_t{width_} + 1, rows = std::size_t{map.grid().height} + 1;
    results_.resize(columns * rows);
    parallel_for(rows, threads, [&](std::size_t j) {
        ResultLookup lookup(scene, compositor);
        map.along_row(static_cast<std::uint32_t>(j),
                      [&](std::uint32_t i, const Windings& w) { results_[j * columns + i] = lookup(w); });
    });
    constexpr std::uint64_t corners_of_a_patch = 4;
    worth_storing_ =
        std::max(columns, rows) <= fetex::kFbtMaxSide && corners_of_a_patch * texels_surrounded() > columns * rows;
}

std::uint64_t CornerResults::texels_surrounded() const {
    std::uint64_t n = 0;
    for (std::uint32_t j = 0; j < map_.grid().height; ++j) {
        for (std::uint32_t i = 0; i < width_; ++i)
            n += !compositor_.is_solid(at(i, j)) && surround(i, j, at(i, j)) ? 1 : 0;
    }
    return n;
}

Rgba CornerResults::color(std::uint32_t i, std::uint32_t j) const {
    const Grid& g = map_.grid();
    return compositor_.color(at(i, j),
                             to_canvas(scene_, g, static_cast<double>(g.px * i), static_cast<double>(g.py * j)));
}

Rgba RegionSampler::paint_at(ResultId result, double x, double y) const {
    return compositor_.color(result, to_canvas(scene_, map_.grid(), x, y));
}

std::array<Rgba, 4> RegionSampler::corner_paints(std::uint32_t i, std::uint32_t j, ResultId result) const {
    const Grid& g = map_.grid();
    const auto x0 = static_cast<double>(g.px * i), y0 = static_cast<double>(g.py * j);
    const double x1 = x0 + static_cast<double>(g.px), y1 = y0 + static_cast<double>(g.py);
    return {paint_at(result, x0, y0), paint_at(result, x1, y0), paint_at(result, x0, y1), paint_at(result, x1, y1)};
}

namespace {

/// RGBA8 is as near to the colour as the format's own rounding may be.
bool eight_bits_hold(const Rgba& c, std::uint32_t rgba8, fetex::FbtSampleFormat format) {
    const std::array<double, 4> held = fetex::fbt_sample_channels(&rgba8, fetex::FbtSampleFormat::Rgba8),
                                wanted = channels(c);
    for (std::size_t k = 0; k < 4; ++k) {
        if (std::fabs(held[k] / 255 - wanted[k]) > fetex::fbt_sample_rounding(wanted[k], format)) return false;
    }
    return true;
}

std::array<std::uint32_t, 8> pack_patch(const std::array<Rgba, 4>& corners, fetex::FbtSampleFormat format) {
    std::array<std::uint32_t, 8> patch{};
    auto at = patch.begin();
    for (const Rgba& c : corners) {
        const auto packed = fetex::fbt_pack_sample({c.r, c.g, c.b, c.a}, format);
        at = std::copy_n(packed.begin(), fetex::fbt_sample_words(format), at);
    }
    return patch;
}

} // namespace

RegionSample solid_sample(const Rgba& c, fetex::FbtSampleFormat format) {
    RegionSample s{fetex::kFbtModelSolid, pack_rgba8(c), {}};
    if (format == fetex::FbtSampleFormat::Rgba8) { // most texels: packed once
        std::fill_n(s.patch.begin(), 4, s.rgba);
        return s;
    }
    if (!eight_bits_hold(c, s.rgba, format)) s.model = fetex::kFbtModelPatch;
    s.patch = pack_patch({c, c, c, c}, format);
    return s;
}

RegionSample patch_sample(const std::array<Rgba, 4>& c, fetex::FbtSampleFormat format) {
    const RegionSample s{fetex::kFbtModelPatch, 0, pack_patch(c, format)};
    const std::uint32_t words = fetex::fbt_sample_words(format);
    const bool equal = std::equal(s.patch.begin() + words, s.patch.begin() + 4 * words, s.patch.begin());
    return equal ? solid_sample(c[0], format) : s;
}

RegionSample RegionSampler::whole(std::uint32_t i, std::uint32_t j) const {
    const ResultId result = corners_.at(i, j);
    if (compositor_.is_solid(result)) return solid_sample(compositor_.color(result, {}), format_);
    if (corners_.worth_storing() && corners_.surround(i, j, result)) return {fetex::kFbtModelCorners, 0, {}};
    return patch_sample(corner_paints(i, j, result), format_);
}

namespace {

/// A trapezoid of a region and its levels.
struct Slab {
    const Trapezoid* trapezoid;
    Extent1 y;
};

std::vector<Slab> slabs_of(const TrapezoidSides& sides, const TexelMap& texel, const TexelFeatures& features,
                           std::uint32_t r) {
    std::vector<Slab> slabs;
    for (const Trapezoid& t : texel.sweep.trapezoids) {
        if (features.region_of_face[t.face] != r) continue;
        const Extent1 y = sides.levels(t);
        if (y.size() > 0) slabs.push_back({&t, y});
    }
    return slabs;
}

/// Three points in every stretch that the region has on each of kLevels levels, evenly spread over its height. Where
/// edges without a visible result cut it makes no difference: what touches is one stretch.
std::vector<QuadraturePoint> quadrature(const PlanarMap& map, const TexelMap& texel, const TexelFeatures& features,
                                        std::uint32_t r) {
    constexpr int kLevels = 8;
    const Grid& g = map.grid();
    const auto px = static_cast<double>(g.px), py = static_cast<double>(g.py);
    const TrapezoidSides sides(map, texel);
    const std::vector<Slab> slabs = slabs_of(sides, texel, features, r);
    double top = INFINITY, bottom = -INFINITY;
    for (const Slab& s : slabs)
        top = std::min(top, s.y.low), bottom = std::max(bottom, s.y.high);
    std::vector<QuadraturePoint> points;
    std::vector<std::pair<double, double>> stretches;
    for (int k = 0; k < kLevels; ++k) {
        const double y = top + (k + 0.5) / kLevels * (bottom - top);
        stretches.clear();
        for (const Slab& s : slabs) {
            if (!(s.y.low <= y && y < s.y.high)) continue;
            const Extent1 x = sides.at(*s.trapezoid, y);
            stretches.emplace_back(x.low, x.high);
        }
        std::sort(stretches.begin(), stretches.end());
        for (std::size_t n = 0; n < stretches.size();) {
            const double x0 = stretches[n].first;
            double x1 = stretches[n].second;
            while (++n < stretches.size() && stretches[n].first <= x1)
                x1 = std::max(x1, stretches[n].second);
            if (!(x1 > x0)) continue;
            for (const double u : {1.0 / 6, 0.5, 5.0 / 6}) {
                const double area = (x1 - x0) * (bottom - top) / (px * py * kLevels);
                points.push_back({(x0 + u * (x1 - x0)) / px - texel.i, y / py - texel.j, area, Rgba{}});
            }
        }
    }
    return points;
}

/// The interpolated colour is within a step of 8 bits of the paint at all points.
bool fits(const std::array<Rgba, 4>& corners, const std::vector<QuadraturePoint>& points) {
    return std::ranges::all_of(points, [&](const QuadraturePoint& q) {
        const std::array<double, 4> weight = corner_weights(q.x, q.y), paint = channels(q.paint);
        for (std::size_t c = 0; c < 4; ++c) {
            double sum = -paint[c];
            for (std::size_t k = 0; k < 4; ++k)
                sum += weight[k] * channels(corners[k])[c];
            if (std::fabs(sum) > budget::kPatchTolerance) return false;
        }
        return true;
    });
}

/// Solves the symmetric positive definite 4×4 system for four right sides at once (Gauss, diagonal pivots).
std::array<std::array<double, 4>, 4> solve(std::array<std::array<double, 4>, 4> a,
                                           std::array<std::array<double, 4>, 4> b) {
    for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t i = 0; i < 4; ++i) {
            if (i == k) continue;
            const double f = a[i][k] / a[k][k];
            for (std::size_t c = 0; c < 4; ++c)
                a[i][c] -= f * a[k][c], b[i][c] -= f * b[k][c];
        }
    }
    for (std::size_t k = 0; k < 4; ++k) {
        for (double& v : b[k])
            v /= a[k][k];
    }
    return b;
}

/// Minimises Σ area·(interpolated − paint)² and, for corners of which the region says little, their distance from the
/// mean, with a weight of kPatchRidge.
std::array<Rgba, 4> least_squares(const std::vector<QuadraturePoint>& points) {
    std::array<std::array<double, 4>, 4> a{}, b{};
    std::array<double, 4> mean{};
    double area = 0;
    for (const QuadraturePoint& q : points) {
        const std::array<double, 4> weight = corner_weights(q.x, q.y), paint = channels(q.paint);
        for (std::size_t k = 0; k < 4; ++k) {
            for (std::size_t n = 0; n < 4; ++n) {
                a[k][n] += q.area * weight[k] * weight[n];
                b[k][n] += q.area * weight[k] * paint[n];
            }
            mean[k] += q.area * paint[k];
        }
        area += q.area;
    }
    for (std::size_t k = 0; k < 4; ++k) {
        a[k][k] += budget::kPatchRidge * area;
        for (std::size_t c = 0; c < 4; ++c)
            b[k][c] += budget::kPatchRidge * mean[c];
    }
    const auto corner = solve(a, b);
    std::array<Rgba, 4> out;
    for (std::size_t k = 0; k < 4; ++k) {
        const double alpha = std::clamp(corner[k][3], 0.0, 1.0);
        const auto color = [&](std::size_t c) { return std::clamp(corner[k][c], 0.0, alpha); };
        out[k] = {color(0), color(1), color(2), alpha};
    }
    return out;
}

} // namespace

RegionSample RegionSampler::region(const TexelMap& texel, const TexelFeatures& features, std::uint32_t r) const {
    const ResultId result = features.region_result[r];
    if (compositor_.is_solid(result)) return solid_sample(compositor_.color(result, {}), format_);
    if (corners_.worth_storing() && corners_.surround(texel.i, texel.j, result))
        return {fetex::kFbtModelCorners, 0, {}};
    const std::array<Rgba, 4> paints = corner_paints(texel.i, texel.j, result);
    std::vector<QuadraturePoint> points = quadrature(map_, texel, features, r);
    for (QuadraturePoint& q : points) {
        q.paint = paint_at(result, static_cast<double>(map_.grid().px) * (texel.i + q.x),
                           static_cast<double>(map_.grid().py) * (texel.j + q.y));
    }
    return patch_sample(fits(paints, points) ? paints : least_squares(points), format_);
}

} // namespace fetexc
