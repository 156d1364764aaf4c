// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/arcs.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "compiler/flat_index.h"
#include "compiler/geometry/monotone.h"
#include "compiler/geometry/precise.h"
#include "compiler/parallel.h"
#include "compiler/planar/exact_points.h"

namespace fetexc {
namespace {

/// End of an arc.
struct End {
    Interval t;
    std::uint32_t vertex;
};

/// Cuts curves at their extrema. Knows the set's curves and vertices, but adds none to it: its own vertices are
/// numbered from the number of the set's on, until they are joined.
class ArcCutter {
  public:
    ArcCutter(const ArcSet& set, std::size_t first_bent)
        : set_(set), first_bent_(first_bent), known_(static_cast<std::uint32_t>(set.vertices.size())) {}

    void cut(std::uint32_t curve, End from, const End& to, ContributionRun run) {
        if (curve >= first_bent_) {
            for (Interval t : extrema(set_.curves[curve], &near_cusps_)) {
                if (t.lo <= from.t.hi || t.hi >= to.t.lo) continue; // a shared support cut in its extremum
                const std::uint32_t vertex = vertex_on(curve, t);   // narrows t
                const End end{t, vertex};
                add_arc(curve, from, end, run);
                from = end;
            }
        }
        add_arc(curve, from, to, run);
    }

    [[nodiscard]] std::size_t arcs() const { return arcs_.size(); }

    void join(ArcSet& set, PlanarStats& stats) {
        const std::uint32_t shift = static_cast<std::uint32_t>(set.vertices.size()) - known_;
        const auto renumbered = [&](std::uint32_t v) { return v < known_ ? v : v + shift; };
        std::move(vertices_.begin(), vertices_.end(), std::back_inserter(set.vertices));
        for (Arc& arc : arcs_) {
            arc.v0 = renumbered(arc.v0), arc.v1 = renumbered(arc.v1);
            set.arcs.push_back(arc);
        }
        if (undecided_ != kNone && set.undecided == kNone) set.undecided = renumbered(undecided_);
        stats.near_cusps += near_cusps_;
    }

  private:
    [[nodiscard]] const Vertex& vertex(std::uint32_t v) const {
        return v < known_ ? set_.vertices[v] : vertices_[v - known_];
    }

    std::uint32_t vertex_on(std::uint32_t curve, Interval& t) {
        const PointEnclosure p = extremum_point(set_.curves[curve], t);
        Vertex v;
        v.x = p.x, v.y = p.y, v.a = curve, v.s = t;
        vertices_.push_back(v);
        return known_ + static_cast<std::uint32_t>(vertices_.size() - 1);
    }

    void add_arc(std::uint32_t curve, const End& a, const End& b, ContributionRun run) {
        const Vertex &va = vertex(a.vertex), &vb = vertex(b.vertex);
        Arc arc;
        arc.curve = curve, arc.t0 = a.t, arc.t1 = b.t, arc.v0 = a.vertex, arc.v1 = b.vertex;
        const std::optional<int> x = compare_coordinates(set_, va, vb, Axis::X),
                                 y_order = compare_coordinates(set_, va, vb, Axis::Y);
        if ((!x || !y_order) && undecided_ == kNone) undecided_ = a.vertex;
        arc.x_increasing = x.value_or(0) <= 0;
        // A level arc counts as falling slightly to the right.
        const int y = y_order.value_or(0);
        arc.y_increasing = y == 0 ? arc.x_increasing : y < 0;
        arc.first_contribution = run.first, arc.contributions = run.count;
        arcs_.push_back(arc);
    }

    const ArcSet& set_;
    std::size_t first_bent_;
    std::uint32_t known_;
    std::vector<Vertex> vertices_;
    std::vector<Arc> arcs_;
    std::uint32_t undecided_ = kNone;
    std::uint64_t near_cusps_ = 0;
};

class Preparer {
  public:
    Preparer(MergedCurves merged, unsigned threads, PlanarStats& stats)
        : first_bent_(merged.first_bent), runs_(std::move(merged.runs)), threads_(threads), stats_(stats) {
        out_.curves = std::move(merged.curves);
        out_.contributions = std::move(merged.contributions);
        out_.too_many_contributions = merged.too_many;
    }

    ArcSet run(std::span<const SharedSupport> shared) {
        add_ends();
        const std::map<std::uint32_t, std::vector<std::uint32_t>> groups = support_groups(shared);
        std::vector<bool> grouped(out_.curves.size(), false);
        for (const auto& [root, members] : groups) {
            for (std::uint32_t m : members)
                grouped[m] = true;
        }
        cut_curves(grouped);
        for (const auto& [root, members] : groups)
            emit_support(root, members);
        stats_.pieces = out_.arcs.size();
        stats_.vertices = out_.vertices.size();
        return std::move(out_);
    }

  private:
    void add_ends() {
        struct PointHash {
            std::size_t operator()(const IntPoint& p) const {
                return mixed_bits(static_cast<std::uint64_t>(p.x) * 0x9E3779B97F4A7C15u +
                                  static_cast<std::uint64_t>(p.y));
            }
        };
        FlatIndex<IntPoint, PointHash> known(out_.curves.size()); // contours are closed: about as many ends as curves
        const auto vertex_at = [&](IntPoint p) {
            const auto [number, fresh] = known.try_emplace(p, static_cast<std::uint32_t>(out_.vertices.size()));
            if (fresh) {
                Vertex v;
                v.x = static_cast<double>(p.x), v.y = static_cast<double>(p.y);
                v.integral = true, v.point = p;
                out_.vertices.push_back(v);
            }
            return number;
        };
        ends_.reserve(out_.curves.size());
        out_.vertices.reserve(2 * out_.curves.size());
        for (const Curve& c : out_.curves) {
            const std::uint32_t first = vertex_at(c.first());
            ends_.emplace_back(first, vertex_at(c.last()));
        }
    }

    void cut_curves(const std::vector<bool>& grouped) {
        constexpr std::size_t chunk = 256;
        const std::size_t curves = out_.curves.size();
        std::vector<ArcCutter> cutters((curves + chunk - 1) / chunk, ArcCutter(out_, first_bent_));
        parallel_for_chunks(curves, chunk, threads_, [&](std::size_t first, std::size_t end) {
            for (std::size_t k = first; k < end; ++k) {
                const auto [v0, v1] = ends_[k];
                if (!grouped[k])
                    cutters[first / chunk].cut(static_cast<std::uint32_t>(k), {Interval(0), v0}, {Interval(1), v1},
                                               runs_[k]);
            }
        });
        std::size_t arcs = 0;
        for (const ArcCutter& c : cutters)
            arcs += c.arcs();
        out_.arcs.reserve(arcs);
        for (ArcCutter& c : cutters)
            c.join(out_, stats_);
    }

    // --- curves that share their algebraic curve ---

    static std::map<std::uint32_t, std::vector<std::uint32_t>> support_groups(std::span<const SharedSupport> shared) {
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
            m.lo = {m.map.start, ends_[k].first};
            m.hi = {m.map.end, ends_[k].second};
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
        Windings sums;
        const Member* carrier = nullptr;
        for (const Member& m : members) {
            if (m.lo.t.mid() > from.t.mid() || m.hi.t.mid() < to.t.mid()) continue;
            if (carrier == nullptr) carrier = &m;
            const int sign = (m.map.alpha < 0) == (carrier->map.alpha < 0) ? 1 : -1;
            const ContributionRun run = runs_[m.curve];
            add_windings(sums, std::span(out_.contributions).subspan(run.first, run.count), sign);
        }
        if (carrier == nullptr || sums.empty()) return;
        out_.too_many_contributions =
            out_.too_many_contributions || out_.contributions.size() + sums.size() > kMaxContributions;
        if (out_.too_many_contributions) return;
        End a = on_carrier(*carrier, from), b = on_carrier(*carrier, to);
        if (carrier->map.alpha < 0) std::swap(a, b);
        ++stats_.pieces_shared;
        const ContributionRun run{static_cast<std::uint32_t>(out_.contributions.size()),
                                  static_cast<std::uint32_t>(sums.size())};
        out_.contributions.insert(out_.contributions.end(), sums.begin(), sums.end());
        ArcCutter cutter(out_, first_bent_);
        cutter.cut(carrier->curve, a, b, run);
        cutter.join(out_, stats_);
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

    std::size_t first_bent_;
    std::vector<ContributionRun> runs_; ///< per curve
    unsigned threads_;
    PlanarStats& stats_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ends_; ///< vertices at the ends of each curve
    ArcSet out_;
};

} // namespace

ArcSet prepare_arcs(const Scene& scene, const Grid& grid, std::span<const SharedSupport> shared, PlanarStats& stats,
                    unsigned threads, const SkipRules& skip) {
    return Preparer(merge_curves(scene, grid, stats, threads, skip), threads, stats).run(shared);
}

} // namespace fetexc
