// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/merged_curves.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "compiler/parallel.h"

namespace fetexc {
namespace {

using Int128 = __int128;

constexpr std::size_t kChunk = 1024;

/// A curve in one of its directions, the one with the lexicographically smaller control polygon.
struct Use {
    int degree = 1;
    std::int32_t winding = 1; ///< the shape's contour runs along (+1) or against (−1)
    std::uint32_t shape = 0;
    std::array<IntPoint, 4> p{}; ///< unused ones are zero

    Use(const Curve& curve, std::uint32_t of) : degree(curve.degree), shape(of), p(curve.p) {
        const auto end = p.begin() + degree + 1;
        if (!std::lexicographical_compare(std::make_reverse_iterator(end), p.rend(), p.begin(), end)) return;
        std::reverse(p.begin(), end);
        winding = -1;
    }
};

/// Right of, above or below the canvas: no winding number on the canvas changes there.
bool irrelevant(const Curve& c, const Grid& grid) {
    std::int64_t x0 = c.p[0].x, y0 = c.p[0].y, y1 = y0;
    for (int i = 1; i <= c.degree; ++i) {
        x0 = std::min(x0, c.p[i].x);
        y0 = std::min(y0, c.p[i].y), y1 = std::max(y1, c.p[i].y);
    }
    return x0 > grid.right() || y0 > grid.bottom() || y1 < 0;
}

/// What one chunk of the segments contributes.
struct Collected {
    std::vector<Use> lines, bent;
    std::uint64_t degree_reduced = 0, segments_null = 0;

    void add(const Segment& segment, std::uint32_t shape, const Grid& grid, const SkipRules& skip) {
        std::array<IntPoint, 4> p{};
        for (int i = 0; i <= segment.degree; ++i)
            p[i] = {segment.p[i].x * grid.kx + grid.ox, segment.p[i].y * grid.ky + grid.oy};
        const Curve curve = make_curve(segment.degree, p);
        if (curve.degree < segment.degree) ++degree_reduced;
        if (curve.degree == 1 && curve.first() == curve.last()) {
            ++segments_null;
            return;
        }
        if (skip.outside && irrelevant(curve, grid)) return;
        (curve.degree == 1 ? lines : bent).emplace_back(curve, shape);
    }
};

/// Direction (reduced) and offset: equal exactly for segments on one line.
struct LineKey {
    std::int64_t dx = 0, dy = 0;
    Int128 offset = 0;
    [[nodiscard]] auto tie() const { return std::tie(dx, dy, offset); }
};

LineKey line_key(const Use& line) {
    const auto& p = line.p;
    const std::int64_t dx = p[1].x - p[0].x, dy = p[1].y - p[0].y, g = std::gcd(dx, dy);
    LineKey k{dx / g, dy / g, 0};
    k.offset = static_cast<Int128>(k.dx) * p[0].y - static_cast<Int128>(k.dy) * p[0].x;
    return k;
}

/// Shapes come in ascending order. Sums of 0 stay.
void append(Windings& sums, std::uint32_t shape, std::int32_t winding) {
    if (!sums.empty() && sums.back().shape == shape) {
        sums.back().winding += winding;
    } else {
        sums.push_back({shape, winding});
    }
}

void drop_zeros(Windings& sums) {
    std::erase_if(sums, [](const Contribution& c) { return c.winding == 0; });
}

class Merger {
  public:
    Merger(const Grid& grid, unsigned threads, const SkipRules& skip, PlanarStats& stats)
        : grid_(grid), threads_(threads), skip_(skip), stats_(stats) {}

    MergedCurves run(const Scene& scene) {
        collect(scene);
        const std::size_t uses = lines_.size() + bent_.size();
        polygons_.reserve(uses), out_.runs.reserve(uses), out_.contributions.reserve(uses);
        merge_lines();
        out_.first_bent = polygons_.size();
        merge_bent();
        make_curves();
        return std::move(out_);
    }

  private:
    void collect(const Scene& scene) {
        std::vector<std::uint32_t> shape_of, segments;
        for (std::uint32_t shape = 0; shape < scene.shapes.size(); ++shape) {
            const Shape& s = scene.shapes[shape];
            shape_of.insert(shape_of.end(), s.count, shape);
            for (std::uint32_t k = s.first; k < s.first + s.count; ++k)
                segments.push_back(k);
        }
        std::vector<Collected> chunks((segments.size() + kChunk - 1) / kChunk);
        parallel_for_chunks(segments.size(), kChunk, threads_, [&](std::size_t first, std::size_t end) {
            for (std::size_t k = first; k < end; ++k)
                chunks[first / kChunk].add(scene.segments[segments[k]], shape_of[k], grid_, skip_);
        });
        stats_.segments += segments.size();
        std::size_t lines = 0, bent = 0;
        for (const Collected& c : chunks)
            lines += c.lines.size(), bent += c.bent.size();
        lines_.reserve(lines), bent_.reserve(bent);
        for (const Collected& c : chunks) {
            lines_.insert(lines_.end(), c.lines.begin(), c.lines.end());
            bent_.insert(bent_.end(), c.bent.begin(), c.bent.end());
            stats_.degree_reduced += c.degree_reduced, stats_.segments_null += c.segments_null;
        }
    }

    /// Collinear segments, cut at each other's ends; what runs back and forth cancels.
    void merge_lines() {
        struct Line {
            LineKey key;
            std::uint32_t use;
            [[nodiscard]] auto tie() const { return std::tuple(key.dx, key.dy, key.offset, use); }
        };
        std::vector<Line> order(lines_.size());
        parallel_for_chunks(lines_.size(), kChunk, threads_, [&](std::size_t first, std::size_t end) {
            for (std::size_t k = first; k < end; ++k)
                order[k] = {line_key(lines_[k]), static_cast<std::uint32_t>(k)};
        });
        parallel_sort(order, threads_, [](const Line& a, const Line& b) { return a.tie() < b.tie(); });
        std::vector<std::uint32_t> group;
        for (std::size_t i = 0; i < order.size();) {
            group.clear();
            const LineKey key = order[i].key;
            for (; i < order.size() && order[i].key.tie() == key.tie(); ++i)
                group.push_back(order[i].use);
            merge_collinear(group);
        }
    }

    void merge_collinear(const std::vector<std::uint32_t>& group) {
        if (group.size() == 1) {
            const Use& u = lines_[group[0]];
            sums_.assign(1, {u.shape, u.winding});
            return emit({u.degree, u.p});
        }
        struct Event {
            IntPoint at;
            std::uint32_t shape;
            std::int32_t winding;
        };
        std::vector<Event> events;
        for (std::uint32_t k : group) {
            const Use& u = lines_[k]; // p[0] < p[1]
            events.push_back({u.p[0], u.shape, u.winding});
            events.push_back({u.p[1], u.shape, -u.winding});
        }
        std::sort(events.begin(), events.end(),
                  [](const Event& a, const Event& b) { return std::tie(a.at, a.shape) < std::tie(b.at, b.shape); });
        sums_.clear();
        Windings changes;
        for (std::size_t i = 0; i < events.size();) {
            const IntPoint at = events[i].at;
            changes.clear();
            for (; i < events.size() && events[i].at == at; ++i)
                append(changes, events[i].shape, events[i].winding);
            drop_zeros(changes);
            add_windings(sums_, changes, 1);
            if (i < events.size() && !sums_.empty()) emit({1, {at, events[i].at}});
        }
        stats_.pieces_shared += group.size() - 1;
    }

    void merge_bent() {
        std::vector<std::uint32_t> order(bent_.size());
        std::iota(order.begin(), order.end(), 0);
        const auto polygon = [&](std::uint32_t k) { return std::tie(bent_[k].degree, bent_[k].p); };
        parallel_sort(order, threads_, [&](const std::uint32_t& a, const std::uint32_t& b) {
            return std::tuple_cat(polygon(a), std::tie(a)) < std::tuple_cat(polygon(b), std::tie(b));
        });
        for (std::size_t i = 0; i < order.size();) {
            const std::size_t begin = i;
            sums_.clear();
            for (; i < order.size() && polygon(order[i]) == polygon(order[begin]); ++i)
                append(sums_, bent_[order[i]].shape, bent_[order[i]].winding);
            stats_.pieces_shared += i - begin - 1;
            drop_zeros(sums_);
            if (!sums_.empty()) emit({bent_[order[begin]].degree, bent_[order[begin]].p});
        }
    }

    struct Polygon {
        int degree = 1;
        std::array<IntPoint, 4> p{};
    };

    void emit(const Polygon& polygon) {
        out_.too_many = out_.too_many || out_.contributions.size() + sums_.size() > kMaxContributions;
        if (out_.too_many) return;
        polygons_.push_back(polygon);
        out_.runs.push_back(
            {static_cast<std::uint32_t>(out_.contributions.size()), static_cast<std::uint32_t>(sums_.size())});
        out_.contributions.insert(out_.contributions.end(), sums_.begin(), sums_.end());
    }

    void make_curves() {
        out_.curves.resize(polygons_.size());
        parallel_for_chunks(polygons_.size(), kChunk, threads_, [&](std::size_t first, std::size_t end) {
            for (std::size_t k = first; k < end; ++k)
                out_.curves[k] = make_curve(polygons_[k].degree, polygons_[k].p);
        });
    }

    const Grid& grid_;
    unsigned threads_;
    const SkipRules& skip_;
    PlanarStats& stats_;
    std::vector<Use> lines_, bent_;
    std::vector<Polygon> polygons_; ///< of the merged curves
    Windings sums_;
    MergedCurves out_;
};

} // namespace

MergedCurves merge_curves(const Scene& scene, const Grid& grid, PlanarStats& stats, unsigned threads,
                          const SkipRules& skip) {
    return Merger(grid, threads, skip, stats).run(scene);
}

} // namespace fetexc
