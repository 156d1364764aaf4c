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

/// Of two corners; each number is rounded as if alone.
using Pair [[gnu::vector_size(16)]] = double;

/// Of a corner.
struct Nearest {
    double squared = 0; ///< distance; up to it is looked
    CanvasPoint point;
    std::uint32_t segment = kNone; ///< of its texel (i,j); kNone: nothing is nearer than the limit
    std::uint32_t i = 0, j = 0;
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

CanvasPoint nearest_on(const TextureSegment& s, CanvasPoint p, double squared_limit) {
    if (!s.middle) return nearest_on_line(s.from, s.to, p);
    const CanvasSegment curve = curve_of(s);
    return bezier::point_at(curve, nearest_below(curve, p.x, p.y, {std::sqrt(squared_limit), 0}).t);
}

/// Of the end that is at the corner.
CanvasPoint tangent_at(const TextureSegment& s, CanvasPoint corner) {
    const bool first = squared_distance(s.from, corner) <= squared_distance(s.to, corner);
    const CanvasPoint a = first ? s.from : s.middle.value_or(s.from), b = first ? s.middle.value_or(s.to) : s.to;
    return {b.x - a.x, b.y - a.y};
}

/// A corner on a curve counts as on the side that the texel's corners between the segment's edges are on, going
/// clockwise from its first to its second, if it is one of them: that side is to the left, and the normal points there.
DistanceGradient normal_at_corner(const TextureSegment& s, const Nearest& at, CanvasPoint corner) {
    // Clockwise from the one after North's point.
    const std::size_t place = corner.y > at.j ? (corner.x > at.i ? 1 : 2) : (corner.x > at.i ? 0 : 3);
    const fetex::FeatureSegment& edges = s.edges;
    const bool left =
        place >= fetex::feature_edge_index(edges.first) && place < fetex::feature_edge_index(edges.second);
    const CanvasPoint t = tangent_at(s, corner);
    const double length = std::sqrt(squared_distance(t, {0, 0})), sign = left ? 1 : -1;
    if (!(length > 0)) return {0, 0};
    return {sign * t.y / length, -sign * t.x / length};
}

std::uint8_t profile_at(const TextureSegments& segments, const Nearest& at) {
    const TextureSegment s = segments.segment(at.i, at.j, at.segment);
    const bool first = squared_distance(at.point, s.from) <= squared_distance(at.point, s.to);
    return segments.profile(at.i, at.j, first ? s.edges.first : s.edges.second);
}

/// A row of corners at a time.
class Rasteriser {
  public:
    Rasteriser(const TextureSegments& segments, DistanceMap& map)
        : segments_(segments), map_(map), nearest_(std::size_t{map.width} + 1) {}

    void row(std::uint32_t j) {
        Nearest none;
        none.squared = map_.limit * map_.limit;
        std::ranges::fill(nearest_, none);
        // Each corner looks at the texels around it, in the order of rows.
        if (j > 0) look_along(j - 1, j);
        if (j < map_.height) look_along(j, j);
        std::uint32_t empty = 0; // rings, from the first one on, around the corner before
        for (std::uint32_t i = 0; i <= map_.width; ++i) {
            empty = look_around(i, j, empty > 0 ? empty - 1 : 0);
            store(i, j);
        }
    }

  private:
    /// Rings up to `empty` have no curves; so have those up to what is returned. Around the next corner one less has
    /// none: there a texel may be one ring nearer.
    std::uint32_t look_around(std::uint32_t i, std::uint32_t j, std::uint32_t empty) {
        const std::uint32_t last = std::max(map_.width, map_.height); // others are outside of the texture
        Nearest& best = nearest_[i];
        bool all_empty = best.segment == kNone;
        // A ring's texels are so far at least.
        for (std::uint32_t ring = empty + 1; ring <= last && ring * ring < best.squared; ++ring) {
            all_empty = look_at_ring(i, j, ring, best) && all_empty;
            if (all_empty) empty = ring;
        }
        return empty;
    }

    static CanvasPoint corner(std::uint32_t i, std::uint32_t j) {
        return {static_cast<double>(i), static_cast<double>(j)};
    }

    static void look_at(const TextureSegment& s, const Nearest& where, CanvasPoint p, Nearest& best) {
        const CanvasPoint point = nearest_on(s, p, best.squared);
        const double squared = squared_distance(point, p);
        if (squared < best.squared) best = where, best.squared = squared, best.point = point;
    }

    /// Both corners in row j of the texels of a row.
    void look_along(std::uint32_t row, std::uint32_t j) {
        segments_.occupied().in_row(row, 0, map_.width - 1, [&](std::uint32_t x) {
            Nearest where{0, {}, 0, x, row};
            segments_.visit_texel(x, row, [&](const TextureSegment& s) {
                if (s.middle) {
                    look_at(s, where, corner(x, j), nearest_[x]);
                    look_at(s, where, corner(x + 1, j), nearest_[x + 1]);
                } else {
                    look_at_line(s.from, s.to, where, corner(x, j), &nearest_[x]);
                }
                ++where.segment;
            });
        });
    }

    /// What look_at does, for a corner and the one to its right at a time.
    static void look_at_line(CanvasPoint a, CanvasPoint b, const Nearest& where, CanvasPoint p, Nearest* best) {
        const double dx = b.x - a.x, dy = b.y - a.y, length = dx * dx + dy * dy;
        const Pair x{p.x, p.x + 1}, along = ((x - a.x) * dx + (p.y - a.y) * dy) / (length > 0 ? length : 1);
        const Pair t = along < 0 ? Pair{0, 0} : along > 1 ? Pair{1, 1} : along;
        const Pair at_x = t == 1 ? Pair{b.x, b.x} : a.x + t * dx, at_y = t == 1 ? Pair{b.y, b.y} : a.y + t * dy;
        const Pair squared = (at_x - x) * (at_x - x) + (at_y - p.y) * (at_y - p.y);
        for (std::size_t k = 0; k < 2; ++k) {
            if (!(squared[k] < best[k].squared)) continue;
            best[k] = where, best[k].squared = squared[k], best[k].point = {at_x[k], at_y[k]};
        }
    }

    void store(std::uint32_t i, std::uint32_t j) {
        const Nearest& best = nearest_[i];
        const std::size_t at = std::size_t{j} * (std::size_t{map_.width} + 1) + i;
        const bool found = best.segment != kNone;
        const double distance = found ? std::min(std::sqrt(best.squared), map_.limit) : map_.limit;
        map_.distances[at] = distance;
        if (!(distance < map_.limit)) return;
        if (segments_.has_profiles()) map_.profiles[at] = profile_at(segments_, best);
        const CanvasPoint p = corner(i, j);
        map_.gradients[at] = distance > budget::kFeatureOnCurve
                                 ? DistanceGradient{(p.x - best.point.x) / distance, (p.y - best.point.y) / distance}
                                 : normal_at_corner(segments_.segment(best.i, best.j, best.segment), best, p);
    }

    /// Texels that a square of 2·ring + 2 texels around the corner has on its border, but those beyond the distance.
    /// False if one of them has curves, or some weren't looked at.
    bool look_at_ring(std::uint32_t i, std::uint32_t j, std::uint32_t ring, Nearest& best) const {
        const std::uint32_t reach =
            static_cast<std::uint32_t>(std::sqrt(best.squared + budget::kFeatureDistanceRounding - ring * ring));
        bool empty = reach >= ring;
        const auto look = [&](std::uint32_t x, std::uint32_t y) {
            empty = false;
            Nearest where{0, {}, 0, x, y};
            segments_.visit_texel(x, y, [&](const TextureSegment& s) {
                look_at(s, where, corner(i, j), best);
                ++where.segment;
            });
        };
        const OccupiedTexels& occupied = segments_.occupied();
        const std::int64_t left = std::int64_t{i} - 1 - ring, right = std::int64_t{i} + ring,
                           top = std::int64_t{j} - 1 - ring, bottom = std::int64_t{j} + ring;
        const Span columns = span(i, std::min(reach, ring), map_.width);
        for (const std::int64_t y : {top, bottom})
            if (y >= 0 && y < map_.height)
                occupied.in_row(static_cast<std::uint32_t>(y), columns.first, columns.last,
                                [&](std::uint32_t x) { look(x, static_cast<std::uint32_t>(y)); });
        const Span rows = span(j, std::min(reach, ring - 1), map_.height);
        for (const std::int64_t x : {left, right})
            if (x >= 0 && x < map_.width)
                occupied.in_column(static_cast<std::uint32_t>(x), rows.first, rows.last,
                                   [&](std::uint32_t y) { look(static_cast<std::uint32_t>(x), y); });
        return empty;
    }

    struct Span {
        std::uint32_t first = 0, last = 0;
    };
    /// Texels along an axis with up to `reach` texels between a corner and them.
    static Span span(std::uint32_t corner, std::uint32_t reach, std::uint32_t count) {
        return {corner - std::min(corner, reach + 1), std::min(corner + reach, count - 1)};
    }

    const TextureSegments& segments_;
    DistanceMap& map_;
    std::vector<Nearest> nearest_; ///< of a row's corners
};

/// Corners at the limit, beside others.
void spread_profiles(DistanceMap& map) {
    const std::size_t columns = std::size_t{map.width} + 1, rows = std::size_t{map.height} + 1;
    const std::vector<std::uint8_t> known = map.profiles;
    for (std::size_t j = 0; j < rows; ++j) {
        for (std::size_t i = 0; i < columns; ++i) {
            double least = map.limit;
            if (map.distances[j * columns + i] < least) continue;
            for (std::size_t y = j - (j > 0); y <= std::min(j + 1, rows - 1); ++y) {
                for (std::size_t x = i - (i > 0); x <= std::min(i + 1, columns - 1); ++x) {
                    const std::size_t beside = y * columns + x;
                    if (map.distances[beside] < least)
                        least = map.distances[beside], map.profiles[j * columns + i] = known[beside];
                }
            }
        }
    }
}

} // namespace

DistanceMap distance_map(const TextureSegments& segments, double limit, unsigned threads) {
    DistanceMap map{segments.width(), segments.height(), limit, {}, {}, {}};
    const std::size_t columns = std::size_t{map.width} + 1, rows = std::size_t{map.height} + 1;
    map.distances.resize(columns * rows), map.gradients.resize(columns * rows);
    if (segments.has_profiles()) map.profiles.resize(columns * rows);
    parallel_for_chunks(rows, kRows, threads, [&](std::size_t begin, std::size_t end) {
        Rasteriser rasteriser(segments, map);
        for (std::size_t j = begin; j < end; ++j)
            rasteriser.row(static_cast<std::uint32_t>(j));
    });
    if (segments.has_profiles()) spread_profiles(map);
    return map;
}

} // namespace fetexc
