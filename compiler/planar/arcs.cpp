// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/arcs.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>

#include "compiler/geometry/monotone.h"
#include "compiler/geometry/precise.h"
#include "compiler/parallel.h"
#include "compiler/planar/exact_points.h"

namespace fetexc {
namespace {

using Int128 = __int128;

/// A curve with its net contributions, in the curve's direction.
struct Weighted {
    Curve curve;
    std::vector<Contribution> sums;
};

void add(std::vector<Contribution>& sums, std::uint32_t shape, std::int32_t winding) {
    for (Contribution& c : sums) {
        if (c.shape == shape) {
            c.winding += winding;
            return;
        }
    }
    sums.push_back({shape, winding});
}

void drop_zero(std::vector<Contribution>& sums) {
    std::erase_if(sums, [](const Contribution& c) { return c.winding == 0; });
    std::sort(sums.begin(), sums.end(), [](const Contribution& a, const Contribution& b) { return a.shape < b.shape; });
}

struct Use {
    Curve curve;
    std::uint32_t shape = 0;
    std::int32_t winding = 1; ///< +1 along the curve as stored, −1 against
};

Curve reversed(const Curve& c) {
    std::array<IntPoint, 4> p{};
    for (int i = 0; i <= c.degree; ++i)
        p[i] = c.p[c.degree - i];
    return make_curve(c.degree, p);
}

/// One direction for each curve: the lexicographically smaller control polygon.
void canonicalise(Use& use) {
    const Curve back = reversed(use.curve);
    if (back.p < use.curve.p) {
        use.curve = back;
        use.winding = -use.winding;
    }
}

bool same_polygon(const Curve& a, const Curve& b) { return a.degree == b.degree && a.p == b.p; }

/// Direction (reduced) and offset: equal exactly for segments on one line.
struct LineKey {
    std::int64_t dx = 0, dy = 0;
    Int128 offset = 0;
    [[nodiscard]] auto tie() const { return std::tie(dx, dy, offset); }
    bool operator==(const LineKey& o) const { return tie() == o.tie(); }
    bool operator<(const LineKey& o) const { return tie() < o.tie(); }
};

LineKey line_key(const Curve& c) {
    const std::int64_t dx = c.p[1].x - c.p[0].x, dy = c.p[1].y - c.p[0].y, g = std::gcd(dx, dy);
    LineKey k{dx / g, dy / g, 0};
    k.offset = static_cast<Int128>(k.dx) * c.p[0].y - static_cast<Int128>(k.dy) * c.p[0].x;
    return k;
}

class Preparer {
  public:
    Preparer(const Scene& scene, const Grid& grid, unsigned threads, const SkipRules& skip, PlanarStats& stats)
        : scene_(scene), grid_(grid), threads_(threads), skip_(skip), stats_(stats) {}

    ArcSet run(std::span<const SharedSupport> shared) {
        collect();
        merge_lines();
        const std::size_t first_curve = weighted_.size();
        merge_curves();
        out_.curves.reserve(weighted_.size());
        for (const Weighted& w : weighted_)
            out_.curves.push_back(w.curve);
        emit_all(shared, first_curve);
        stats_.pieces = out_.arcs.size();
        stats_.vertices = out_.vertices.size();
        return std::move(out_);
    }

  private:
    [[nodiscard]] IntPoint planar(LatticePoint p) const { return {p.x * grid_.kx, p.y * grid_.ky}; }

    /// Right of, above or below the canvas: no winding number on the canvas changes there.
    [[nodiscard]] bool irrelevant(const Curve& c) const {
        std::int64_t x0 = c.p[0].x, y0 = c.p[0].y, y1 = y0;
        for (int i = 1; i <= c.degree; ++i) {
            x0 = std::min(x0, c.p[i].x);
            y0 = std::min(y0, c.p[i].y), y1 = std::max(y1, c.p[i].y);
        }
        return x0 > grid_.right() || y0 > grid_.bottom() || y1 < 0;
    }

    void collect() {
        for (std::uint32_t shape = 0; shape < scene_.shapes.size(); ++shape) {
            const Shape& s = scene_.shapes[shape];
            for (std::uint32_t k = s.first; k < s.first + s.count; ++k)
                collect_segment(scene_.segments[k], shape);
        }
    }

    void collect_segment(const Segment& segment, std::uint32_t shape) {
        ++stats_.segments;
        std::array<IntPoint, 4> p{};
        for (int i = 0; i <= segment.degree; ++i)
            p[i] = planar(segment.p[i]);
        Use use{make_curve(segment.degree, p), shape, 1};
        if (use.curve.degree < segment.degree) ++stats_.degree_reduced;
        if (use.curve.degree == 1 && use.curve.first() == use.curve.last()) {
            ++stats_.segments_null;
            return;
        }
        if (skip_.outside && irrelevant(use.curve)) return;
        canonicalise(use);
        (use.curve.degree == 1 ? lines_ : bent_).push_back(std::move(use));
    }

    /// Collinear segments, cut at each other's ends; what runs back and forth cancels.
    void merge_lines() {
        std::vector<std::pair<LineKey, std::uint32_t>> order;
        order.reserve(lines_.size());
        for (std::uint32_t k = 0; k < lines_.size(); ++k)
            order.emplace_back(line_key(lines_[k].curve), k);
        std::sort(order.begin(), order.end());
        for (std::size_t i = 0; i < order.size();) {
            std::size_t end = i + 1;
            while (end < order.size() && order[end].first == order[i].first)
                ++end;
            merge_collinear({order.data() + i, end - i});
            i = end;
        }
    }

    void merge_collinear(std::span<const std::pair<LineKey, std::uint32_t>> group) {
        struct Event {
            IntPoint at;
            std::uint32_t shape;
            std::int32_t winding;
        };
        std::vector<Event> events;
        for (const auto& [key, k] : group) {
            const Use& u = lines_[k]; // canonical: first() < last()
            events.push_back({u.curve.first(), u.shape, u.winding});
            events.push_back({u.curve.last(), u.shape, -u.winding});
        }
        std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.at < b.at; });
        std::vector<Contribution> active;
        for (std::size_t i = 0; i < events.size();) {
            const IntPoint at = events[i].at;
            for (; i < events.size() && events[i].at == at; ++i)
                add(active, events[i].shape, events[i].winding);
            drop_zero(active);
            if (i == events.size() || active.empty()) continue;
            weighted_.push_back({make_curve(1, {at, events[i].at, IntPoint{}, IntPoint{}}), active});
        }
        if (group.size() > 1) stats_.pieces_shared += group.size() - 1;
    }

    void merge_curves() {
        std::sort(bent_.begin(), bent_.end(), [](const Use& a, const Use& b) {
            return std::tie(a.curve.degree, a.curve.p, a.shape, a.winding) <
                   std::tie(b.curve.degree, b.curve.p, b.shape, b.winding);
        });
        for (std::size_t i = 0; i < bent_.size();) {
            Weighted w{bent_[i].curve, {}};
            const std::size_t begin = i;
            for (; i < bent_.size() && same_polygon(bent_[i].curve, w.curve); ++i)
                add(w.sums, bent_[i].shape, bent_[i].winding);
            stats_.pieces_shared += i - begin - 1;
            drop_zero(w.sums);
            if (!w.sums.empty()) weighted_.push_back(std::move(w));
        }
    }

    // --- emission
    // ------------------------------------------------------------------------------------------------------------

    std::uint32_t vertex_at(IntPoint p) {
        const auto [it, fresh] = ends_.try_emplace(p, static_cast<std::uint32_t>(out_.vertices.size()));
        if (fresh) {
            Vertex v;
            v.x = static_cast<double>(p.x), v.y = static_cast<double>(p.y);
            v.integral = true, v.point = p;
            out_.vertices.push_back(v);
        }
        return it->second;
    }

    std::uint32_t vertex_on(std::uint32_t curve, Interval& t) {
        const PointEnclosure p = extremum_point(out_.curves[curve], t);
        Vertex v;
        v.x = p.x, v.y = p.y, v.a = curve, v.s = t;
        out_.vertices.push_back(v);
        return static_cast<std::uint32_t>(out_.vertices.size() - 1);
    }

    struct End {
        Interval t;
        std::uint32_t vertex;
    };

    void find_extrema(std::size_t first_curve) {
        constexpr std::size_t chunk = 256;
        const std::size_t curves = out_.curves.size();
        extrema_.resize(curves);
        parallel_for((curves - first_curve + chunk - 1) / chunk, threads_, [&](std::size_t c) {
            const std::size_t first = first_curve + c * chunk;
            for (std::size_t k = first; k < std::min(curves, first + chunk); ++k)
                extrema_[k] = extrema(out_.curves[k]);
        });
    }

    void emit_all(std::span<const SharedSupport> shared, std::size_t first_curve) {
        find_extrema(first_curve);
        ends_.reserve(2 * weighted_.size());
        std::map<std::uint32_t, std::vector<std::uint32_t>> groups = support_groups(shared);
        std::vector<bool> grouped(weighted_.size(), false);
        for (const auto& [root, members] : groups) {
            for (std::uint32_t m : members)
                grouped[m] = true;
        }
        for (std::uint32_t k = 0; k < weighted_.size(); ++k) {
            if (grouped[k]) continue;
            const Curve& c = out_.curves[k];
            const End a{Interval(0), vertex_at(c.first())}, b{Interval(1), vertex_at(c.last())};
            emit_monotone(k, a, b, weighted_[k].sums, k >= first_curve);
        }
        for (const auto& [root, members] : groups)
            emit_support(root, members);
    }

    void emit_monotone(std::uint32_t curve, End from, const End& to, const std::vector<Contribution>& sums, bool bent) {
        const std::uint32_t first = static_cast<std::uint32_t>(out_.contributions.size());
        out_.contributions.insert(out_.contributions.end(), sums.begin(), sums.end());
        if (bent) {
            for (Interval t : extrema_[curve]) {
                if (t.lo <= from.t.hi || t.hi >= to.t.lo) continue; // a shared support cut in its extremum
                const std::uint32_t vertex = vertex_on(curve, t);   // narrows t
                const End cut{t, vertex};
                emit_arc(curve, from, cut, first, sums.size());
                from = cut;
            }
        }
        emit_arc(curve, from, to, first, sums.size());
    }

    void emit_arc(std::uint32_t curve, const End& a, const End& b, std::uint32_t first, std::size_t count) {
        const Vertex &va = out_.vertices[a.vertex], &vb = out_.vertices[b.vertex];
        Arc arc;
        arc.curve = curve, arc.t0 = a.t, arc.t1 = b.t, arc.v0 = a.vertex, arc.v1 = b.vertex;
        const std::optional<int> x = compare_coordinates(out_, va, vb, Axis::X),
                                 y_order = compare_coordinates(out_, va, vb, Axis::Y);
        if ((!x || !y_order) && out_.undecided == kNone) out_.undecided = a.vertex;
        arc.x_increasing = x.value_or(0) <= 0;
        // A level arc counts as falling slightly to the right.
        const int y = y_order.value_or(0);
        arc.y_increasing = y == 0 ? arc.x_increasing : y < 0;
        arc.first_contribution = first, arc.contributions = static_cast<std::uint32_t>(count);
        out_.arcs.push_back(arc);
    }

    // --- curves that share their algebraic curve
    // ---------------------------------------------------------------------------------

    std::map<std::uint32_t, std::vector<std::uint32_t>> support_groups(std::span<const SharedSupport> shared) {
        std::map<std::uint32_t, std::uint32_t> parent;
        const auto find = [&](std::uint32_t k) {
            while (parent.contains(k) && parent[k] != k)
                k = parent[k];
            return k;
        };
        for (const SharedSupport& s : shared) {
            parent.try_emplace(s.a, s.a);
            parent.try_emplace(s.b, s.b);
            const std::uint32_t a = find(s.a), b = find(s.b);
            parent[std::max(a, b)] = std::min(a, b);
        }
        std::map<std::uint32_t, std::vector<std::uint32_t>> groups;
        for (const auto& [k, p] : parent)
            groups[find(k)].push_back(k);
        return groups;
    }

    /// Where a member ends, on the root. A loop starts and ends in one vertex, and so may parts of a curve that crosses
    /// itself: parameter and vertex together say which end it is.
    struct SupportCut {
        Interval t;
        std::uint32_t vertex = 0;
        [[nodiscard]] bool is(const SupportCut& o) const { return vertex == o.vertex && t.overlaps(o.t); }
    };

    struct Member {
        std::uint32_t curve;
        SupportMap map; ///< to the root's parameter
        SupportCut lo, hi;
    };

    /// Elementary stretches between all members' ends, each emitted once, on a member that covers it.
    void emit_support(std::uint32_t root, const std::vector<std::uint32_t>& curves) {
        std::vector<Member> members;
        std::vector<SupportCut> cuts;
        for (std::uint32_t k : curves) {
            Member m{k, {1, 0, Interval(0), Interval(1)}, {}, {}};
            if (k != root && !same_support(out_.curves[k], out_.curves[root], m.map)) continue;
            m.lo = {m.map.start, vertex_at(out_.curves[k].first())};
            m.hi = {m.map.end, vertex_at(out_.curves[k].last())};
            if (m.map.alpha < 0) std::swap(m.lo, m.hi);
            cuts.push_back(m.lo), cuts.push_back(m.hi);
            members.push_back(m);
        }
        std::sort(cuts.begin(), cuts.end(), [](const SupportCut& a, const SupportCut& b) {
            return std::pair(a.t.mid(), a.vertex) < std::pair(b.t.mid(), b.vertex);
        });
        cuts.erase(
            std::unique(cuts.begin(), cuts.end(), [](const SupportCut& a, const SupportCut& b) { return a.is(b); }),
            cuts.end());
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
            emit_elementary(members, cuts[i], cuts[i + 1]);
    }

    void emit_elementary(const std::vector<Member>& members, const SupportCut& from, const SupportCut& to) {
        std::vector<Contribution> sums;
        const Member* carrier = nullptr;
        for (const Member& m : members) {
            if (m.lo.t.mid() > from.t.mid() || m.hi.t.mid() < to.t.mid()) continue;
            if (carrier == nullptr) carrier = &m;
            for (const Contribution& c : weighted_[m.curve].sums) {
                add(sums, c.shape, (m.map.alpha < 0) == (carrier->map.alpha < 0) ? c.winding : -c.winding);
            }
        }
        drop_zero(sums);
        if (carrier == nullptr || sums.empty()) return;
        End a = on_carrier(*carrier, from), b = on_carrier(*carrier, to);
        if (carrier->map.alpha < 0) std::swap(a, b);
        ++stats_.pieces_shared;
        emit_monotone(carrier->curve, a, b, sums, true);
    }

    /// Parameter of a cut on the carrier: inverse of its map, exact 0 and 1 at its own ends.
    static End on_carrier(const Member& m, const SupportCut& cut) {
        const bool back = m.map.alpha < 0;
        if (cut.is(m.lo)) return {Interval(back ? 1 : 0), cut.vertex};
        if (cut.is(m.hi)) return {Interval(back ? 0 : 1), cut.vertex};
        const Interval alpha = m.map.end - m.map.start;
        const Interval t = (cut.t - m.map.start) / alpha;
        return {{std::max(0.0, t.lo), std::min(1.0, t.hi)}, cut.vertex};
    }

    const Scene& scene_;
    const Grid& grid_;
    unsigned threads_;
    const SkipRules& skip_;
    PlanarStats& stats_;
    std::vector<Use> lines_, bent_;
    std::vector<Weighted> weighted_;
    std::vector<std::vector<Interval>> extrema_; ///< per curve
    ArcSet out_;
    struct PointHash {
        std::size_t operator()(const IntPoint& p) const {
            return static_cast<std::size_t>(p.x) * 0x9E3779B97F4A7C15ull ^
                   (static_cast<std::size_t>(p.y) + 0x7F4A7C15ull) * 0xC2B2AE3D27D4EB4Full;
        }
    };
    std::unordered_map<IntPoint, std::uint32_t, PointHash> ends_;
};

} // namespace

ArcSet prepare_arcs(const Scene& scene, const Grid& grid, std::span<const SharedSupport> shared, PlanarStats& stats,
                    unsigned threads, const SkipRules& skip) {
    return Preparer(scene, grid, threads, skip, stats).run(shared);
}

} // namespace fetexc
