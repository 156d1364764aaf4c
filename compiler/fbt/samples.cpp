// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/fbt/samples.h"

#include <algorithm>
#include <cmath>

#include "compiler/parallel.h"

namespace fetexc {
namespace {

std::uint32_t pack_channel(double v) {
    return static_cast<std::uint32_t>(std::floor(std::clamp(v, 0.0, 1.0) * 255 + 0.5));
}

std::array<double, 4> channels(const Rgba& c) { return {c.r, c.g, c.b, c.a}; }

/// A point of a region and the area it stands for; texel-local for weights, planar for the paint.
struct QuadraturePoint {
    double x, y, weight;
};

} // namespace

std::uint32_t pack_rgba8(const Rgba& c) {
    return pack_channel(c.r) | (pack_channel(c.g) << 8) | (pack_channel(c.b) << 16) | (pack_channel(c.a) << 24);
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
}

Rgba CornerResults::color(std::uint32_t i, std::uint32_t j) const {
    const Grid& g = map_.grid();
    return compositor_.color(at(i, j),
                             to_canvas(scene_, g, static_cast<double>(g.px * i), static_cast<double>(g.py * j)));
}

std::uint32_t CornerResults::rgba(std::uint32_t i, std::uint32_t j) const { return pack_rgba8(color(i, j)); }

/// FBT §4.6: which sample stands at each corner; a corner out of reach takes the closest one that isn't (Fig. 6).
std::uint32_t RegionSampler::mask_for(std::uint32_t i, std::uint32_t j, ResultId result) const {
    if (compositor_.is_solid(result)) return 0;
    // A neighbour's representative sample can be used when it shows the same result: it is then a value of the same
    // paint, and every region reachable without crossing a visible edge (§4.4) does.
    const bool right = corners_.at(i + 1, j) == result, up = corners_.at(i, j + 1) == result,
               diagonal = corners_.at(i + 1, j + 1) == result;
    const std::uint32_t c1 = right ? 1 : 0;
    const std::uint32_t c2 = up ? 2 : 0;
    const std::uint32_t c3 = diagonal ? 3 : right ? 1 : up ? 2 : 0;
    return (c1 << 2) | (c2 << 4) | (c3 << 6);
}

RegionSample RegionSampler::whole(std::uint32_t i, std::uint32_t j) const {
    return {corners_.rgba(i, j), mask_for(i, j, corners_.at(i, j))};
}

RegionSample RegionSampler::region(const TexelMap& texel, const TexelFeatures& features, std::uint32_t r) const {
    const ResultId result = features.region_result[r];
    if (compositor_.is_solid(result)) return {pack_rgba8(compositor_.color(result, {})), 0};
    if (r == features.corner_region) return whole(texel.i, texel.j);
    const std::uint32_t mask = mask_for(texel.i, texel.j, result);
    return {pack_rgba8(fit(texel, features, r, mask)), mask};
}

namespace {

double x_on(const PlanarMap& map, const TexelMap& texel, std::uint32_t edge, double y, double side) {
    if (edge == kNone) return side;
    const Stretch s = map.stretch_of(texel.sub_edges[texel.graph.edges[edge].sub]);
    return value_double(*s.curve, Axis::X, parameter_at(*s.curve, Axis::Y, s.range, s.y_increasing, y).mid());
}

/// Two levels of three points in every trapezoid of the region, weighted by area.
std::vector<QuadraturePoint> quadrature(const PlanarMap& map, const TexelMap& texel, const TexelFeatures& features,
                                        std::uint32_t r) {
    const Grid& g = map.grid();
    const double left = static_cast<double>(g.px * texel.i), top = static_cast<double>(g.py * texel.j);
    const double right = left + static_cast<double>(g.px), bottom = top + static_cast<double>(g.py);
    std::vector<QuadraturePoint> points;
    for (const Trapezoid& t : texel.sweep.trapezoids) {
        if (features.region_of_face[t.face] != r) continue;
        const double y0 = t.top_node == kNone ? top : map.node(texel.graph.nodes[t.top_node]).y;
        const double y1 = t.bottom_node == kNone ? bottom : map.node(texel.graph.nodes[t.bottom_node]).y;
        if (!(y1 > y0)) continue;
        for (const double v : {0.25, 0.75}) {
            const double y = y0 + v * (y1 - y0);
            const double x0 = x_on(map, texel, t.left, y, left), x1 = x_on(map, texel, t.right, y, right);
            if (!(x1 > x0)) continue;
            for (const double u : {1.0 / 6, 0.5, 5.0 / 6})
                points.push_back({x0 + u * (x1 - x0), y, (x1 - x0) * (y1 - y0)});
        }
    }
    return points;
}

} // namespace

/// Minimises Σ weight·(interpolated − paint)² over the own sample, channel by channel: it enters with the sum of the
/// bilinear weights of the corners it stands at.
Rgba RegionSampler::fit(const TexelMap& texel, const TexelFeatures& features, std::uint32_t r,
                        std::uint32_t mask) const {
    const Grid& g = map_.grid();
    const ResultId result = features.region_result[r];
    const std::array<std::array<double, 4>, 4> sample{
        std::array<double, 4>{}, channels(corners_.color(texel.i + 1, texel.j)),
        channels(corners_.color(texel.i, texel.j + 1)), channels(corners_.color(texel.i + 1, texel.j + 1))};
    std::array<double, 4> numerator{};
    double denominator = 0;
    for (const QuadraturePoint& q : quadrature(map_, texel, features, r)) {
        const double fx = q.x / static_cast<double>(g.px) - texel.i, fy = q.y / static_cast<double>(g.py) - texel.j;
        const std::array<double, 4> weight{(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy};
        const std::array<double, 4> paint = channels(compositor_.color(result, to_canvas(scene_, g, q.x, q.y)));
        double own = 0;
        std::array<double, 4> others{};
        for (std::uint32_t k = 0; k < 4; ++k) {
            const std::uint32_t which = (mask >> (2 * k)) & 3;
            if (which == 0) own += weight[k];
            for (int c = 0; c < 4 && which != 0; ++c)
                others[c] += weight[k] * sample[which][c];
        }
        denominator += q.weight * own * own;
        for (int c = 0; c < 4; ++c)
            numerator[c] += q.weight * own * (paint[c] - others[c]);
    }
    if (!(denominator > 0)) {
        return compositor_.color(result, to_canvas(scene_, g, static_cast<double>(g.px) * (texel.i + 0.5),
                                                   static_cast<double>(g.py) * (texel.j + 0.5)));
    }
    const auto value = [&](int c) { return numerator[c] / denominator; };
    const double a = std::clamp(value(3), 0.0, 1.0);
    const auto color = [&](int c) { return std::clamp(value(c), 0.0, a); };
    return {color(0), color(1), color(2), a};
}

} // namespace fetexc
