// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/feature_curves/distance_map.h"

#include <algorithm>
#include <cmath>

#include "compiler/error_budget.h"
#include "compiler/parallel.h"
#include "compiler/scene/bezier.h"
#include "compiler/scene/curve_distance.h"

namespace fetexc {
namespace {

constexpr std::size_t kRows = 8; ///< of corners, for a thread at a time

struct Nearest {
    double squared = 0; ///< distance; up to it is looked
    CanvasPoint point;
    bool found = false;
    TextureSegment segment;     ///< if found
    std::uint32_t i = 0, j = 0; ///< its texel
};

CanvasPoint nearest_on_line(CanvasPoint a, CanvasPoint b, CanvasPoint p) {
    const double dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy;
    if (!(length > 0)) return a;
    const double t = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length, 0.0, 1.0);
    return t == 1 ? b : CanvasPoint{a.x + t * dx, a.y + t * dy};
}

double squared_distance(CanvasPoint a, CanvasPoint b) {
    const double dx = a.x - b.x, dy = a.y - b.y;
    return dx * dx + dy * dy;
}

/// Whether it is nearer.
bool look_at(const TextureSegment& s, CanvasPoint p, Nearest& best) {
    CanvasPoint point;
    if (!s.middle) {
        point = nearest_on_line(s.from, s.to, p);
    } else {
        const CanvasSegment curve = curve_of(s);
        point = bezier::point_at(curve, nearest_below(curve, p.x, p.y, {std::sqrt(best.squared), 0}).t);
    }
    const double squared = squared_distance(point, p);
    if (!(squared < best.squared)) return false;
    best.squared = squared, best.point = point, best.found = true, best.segment = s;
    return true;
}

/// Of the end that is at the corner.
CanvasPoint tangent_at(const TextureSegment& s, CanvasPoint corner) {
    const bool first = squared_distance(s.from, corner) <= squared_distance(s.to, corner);
    const CanvasPoint a = first ? s.from : s.middle.value_or(s.from), b = first ? s.middle.value_or(s.to) : s.to;
    return {b.x - a.x, b.y - a.y};
}

/// A corner on a curve counts as on the side that the texel's corners between the segment's edges are on, going
/// clockwise from its first to its second, if it is one of them: that side is to the left, and the normal points there.
DistanceGradient normal_at_corner(const Nearest& at, CanvasPoint corner) {
    // Clockwise from the one after North's point.
    const std::size_t place = corner.y > at.j ? (corner.x > at.i ? 1 : 2) : (corner.x > at.i ? 0 : 3);
    const fetex::FeatureSegment& edges = at.segment.edges;
    const bool left =
        place >= fetex::feature_edge_index(edges.first) && place < fetex::feature_edge_index(edges.second);
    const CanvasPoint t = tangent_at(at.segment, corner);
    const double length = std::sqrt(squared_distance(t, {0, 0})), sign = left ? 1 : -1;
    if (!(length > 0)) return {0, 0};
    return {sign * t.y / length, -sign * t.x / length};
}

class Rasteriser {
  public:
    Rasteriser(const TextureSegments& segments, DistanceMap& map) : segments_(segments), map_(map) {}

    void corner(std::uint32_t i, std::uint32_t j) {
        const CanvasPoint p{static_cast<double>(i), static_cast<double>(j)};
        Nearest best;
        best.squared = map_.limit * map_.limit;
        for (std::uint32_t ring = 0; ring * ring < best.squared; ++ring) // a ring's texels are so far at least
            look_at_ring(i, j, ring, p, best);
        const std::size_t at = std::size_t{j} * (std::size_t{map_.width} + 1) + i;
        const double distance = best.found ? std::min(std::sqrt(best.squared), map_.limit) : map_.limit;
        map_.distances[at] = distance;
        if (!(distance < map_.limit)) return;
        map_.gradients[at] = distance > budget::kFeatureOnCurve
                                 ? DistanceGradient{(p.x - best.point.x) / distance, (p.y - best.point.y) / distance}
                                 : normal_at_corner(best, p);
    }

  private:
    /// Texels that a square of 2·ring + 2 texels around the corner has on its border.
    void look_at_ring(std::uint32_t i, std::uint32_t j, std::uint32_t ring, CanvasPoint p, Nearest& best) const {
        const std::int64_t left = std::int64_t{i} - 1 - ring, right = std::int64_t{i} + ring,
                           top = std::int64_t{j} - 1 - ring, bottom = std::int64_t{j} + ring;
        const auto first = [](std::int64_t from) {
            return static_cast<std::uint32_t>(std::max<std::int64_t>(from, 0));
        };
        const auto last = [](std::int64_t to, std::uint32_t count) {
            return static_cast<std::uint32_t>(std::min<std::int64_t>(to, std::int64_t{count} - 1));
        };
        const auto look = [&](std::uint32_t x, std::uint32_t y) {
            segments_.visit_texel(x, y, [&](const TextureSegment& s) {
                if (look_at(s, p, best)) best.i = x, best.j = y;
            });
        };
        const OccupiedTexels& occupied = segments_.occupied();
        for (const std::int64_t y : {top, bottom})
            if (y >= 0 && y < map_.height)
                occupied.in_row(static_cast<std::uint32_t>(y), first(left), last(right, map_.width),
                                [&](std::uint32_t x) { look(x, static_cast<std::uint32_t>(y)); });
        if (top + 1 >= bottom) return;
        for (const std::int64_t x : {left, right})
            if (x >= 0 && x < map_.width)
                occupied.in_column(static_cast<std::uint32_t>(x), first(top + 1), last(bottom - 1, map_.height),
                                   [&](std::uint32_t y) { look(static_cast<std::uint32_t>(x), y); });
    }

    const TextureSegments& segments_;
    DistanceMap& map_;
};

} // namespace

DistanceMap distance_map(const TextureSegments& segments, double limit, unsigned threads) {
    DistanceMap map{segments.width(), segments.height(), limit, {}, {}};
    const std::size_t columns = std::size_t{map.width} + 1, rows = std::size_t{map.height} + 1;
    map.distances.resize(columns * rows), map.gradients.resize(columns * rows);
    Rasteriser rasteriser(segments, map);
    parallel_for_chunks(rows, kRows, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t j = begin; j < end; ++j)
            for (std::size_t i = 0; i < columns; ++i)
                rasteriser.corner(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j));
    });
    return map;
}

} // namespace fetexc
