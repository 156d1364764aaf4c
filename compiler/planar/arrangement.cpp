// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/arrangement.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "compiler/diagnostics.h"
#include "compiler/geometry/precise.h"
#include "compiler/planar/box_pairs.h"
#include "compiler/union_find.h"

namespace fetexc {
namespace {

struct Bounds {
    Interval x, y;
};

/// A common point of two arcs. vertex: an existing one, or kNone for a new one.
struct PairContact {
    std::uint32_t a = 0, b = 0;
    Contact at;
    PointEnclosure point; ///< of a new one
    std::uint32_t vertex = kNone;
};

/// What one chunk of pairs found; chunks are joined in order.
struct ChunkResult {
    std::vector<PairContact> contacts;
    std::vector<SharedSupport> shared;
    std::uint64_t certified = 0, exact = 0, crossings = 0;
};

Bounds bounds_of(const ArcSet& set, const Arc& a) {
    const Vertex &p = set.vertices[a.v0], &q = set.vertices[a.v1];
    return {hull(p.x, q.x), hull(p.y, q.y)};
}

bool within(const Interval& a, const Interval& b) { return b.lo <= a.lo && a.hi <= b.hi; }
bool flat(const Interval& v) { return v.lo == v.hi; }

class PairTest {
  public:
    PairTest(const ArcSet& set, const std::vector<Bounds>& bounds, ChunkResult& out)
        : set_(set), bounds_(bounds), out_(out) {}

    void operator()(std::uint32_t ia, std::uint32_t ib) {
        const Arc &a = set_.arcs[ia], &b = set_.arcs[ib];
        known_.clear(), found_.clear();
        if (!collect_known(ia, ib, a, b)) {
            ++out_.certified;
            return;
        }
        const Stretch sa = set_.stretch_of(a), sb = set_.stretch_of(b);
        if (intersect_certified(sa, sb, known_, found_) == PairOutcome::Certified) {
            ++out_.certified;
        } else if (a.curve == b.curve) {
            ++out_.exact;
            cross_itself(a, b);
        } else {
            ++out_.exact;
            decide_exactly(a, b, sa, sb);
        }
        for (const Contact& c : found_)
            add(ia, ib, c);
    }

  private:
    /// Shared vertices and end points on the other arc. False: the boxes show that there is nothing else.
    bool collect_known(std::uint32_t ia, std::uint32_t ib, const Arc& a, const Arc& b) {
        const Bounds &ba = bounds_[ia], &bb = bounds_[ib];
        const Interval ox(std::max(ba.x.lo, bb.x.lo), std::min(ba.x.hi, bb.x.hi));
        const Interval oy(std::max(ba.y.lo, bb.y.lo), std::min(ba.y.hi, bb.y.hi));
        for (const auto& [va, ta] : {std::pair(a.v0, a.t0), std::pair(a.v1, a.t1)}) {
            for (const auto& [vb, tb] : {std::pair(b.v0, b.t0), std::pair(b.v1, b.t1)}) {
                if (va != vb) continue;
                known_.push_back({ta, tb});
                const Vertex& v = set_.vertices[va];
                // Only the shared vertex has that abscissa (ordinate) on an arc that isn't vertical (horizontal).
                const bool only_x = within(ox, v.x) && !(flat(ba.x) && flat(bb.x));
                const bool only_y = within(oy, v.y) && !(flat(ba.y) && flat(bb.y));
                if (only_x || only_y) return false;
            }
        }
        end_on_other(ia, ib, a, b, true);
        end_on_other(ia, ib, b, a, false);
        return true;
    }

    /// T-junctions: an integral end point of `end` in the interior of `on`.
    void end_on_other(std::uint32_t ia, std::uint32_t ib, const Arc& end, const Arc& on, bool end_is_a) {
        const std::array<std::pair<std::uint32_t, Interval>, 2> ends{{{end.v0, end.t0}, {end.v1, end.t1}}};
        for (const auto& [v, t] : ends) {
            const Vertex& vertex = set_.vertices[v];
            if (!vertex.integral || v == on.v0 || v == on.v1) continue;
            const std::optional<Interval> hit = point_on_stretch(set_.stretch_of(on), vertex.point);
            if (!hit) continue;
            const Contact c = end_is_a ? Contact{t, *hit} : Contact{*hit, t};
            known_.push_back(c);
            out_.contacts.push_back({ia, ib, c, {}, v});
        }
    }

    void decide_exactly(const Arc& a, const Arc& b, const Stretch& sa, const Stretch& sb) {
        SupportMap map;
        if (same_support(set_.curves[a.curve], set_.curves[b.curve], map)) {
            out_.shared.push_back({std::min(a.curve, b.curve), std::max(a.curve, b.curve)});
            return;
        }
        std::vector<ExactHit> hits;
        intersect_exact(sa, sb, hits);
        for (const ExactHit& h : hits) {
            const Contact c{h.s, h.t};
            if (!is_known(c)) found_.push_back(c);
        }
    }

    /// Two stretches of one cubic: its double point is the only one they can share, beside an end.
    void cross_itself(const Arc& a, const Arc& b) {
        const std::optional<ExactHit> p = double_point(set_.curves[a.curve]);
        if (!p) return;
        const bool a_first = a.t0.mid() < b.t0.mid();
        const Contact c = a_first ? Contact{p->s, p->t} : Contact{p->t, p->s};
        const bool inside = c.s.overlaps({a.t0.lo, a.t1.hi}) && c.t.overlaps({b.t0.lo, b.t1.hi});
        if (inside && !is_known(c)) found_.push_back(c);
    }

    [[nodiscard]] bool is_known(const Contact& c) const {
        return std::any_of(known_.begin(), known_.end(),
                           [&](const Contact& k) { return k.s.overlaps(c.s) && k.t.overlaps(c.t); });
    }

    void add(std::uint32_t ia, std::uint32_t ib, Contact c) {
        ++out_.crossings;
        const PointEnclosure p = contact_point(set_.curves[set_.arcs[ia].curve], set_.curves[set_.arcs[ib].curve], c);
        out_.contacts.push_back({ia, ib, c, p, kNone});
    }

    const ArcSet& set_;
    const std::vector<Bounds>& bounds_;
    ChunkResult& out_;
    std::vector<Contact> known_, found_;
};

/// Boxes of the arcs that reach the canvas.
std::vector<BoxItem> canvas_boxes(const Grid& grid, const std::vector<Bounds>& bounds) {
    std::vector<BoxItem> items;
    const double right = static_cast<double>(grid.right()), bottom = static_cast<double>(grid.bottom());
    for (std::uint32_t i = 0; i < bounds.size(); ++i) {
        const Bounds& b = bounds[i];
        if (b.x.hi < 0 || b.x.lo > right || b.y.hi < 0 || b.y.lo > bottom) continue;
        items.push_back({b.x.lo, b.y.lo, b.x.hi, b.y.hi, i});
    }
    return items;
}

ChunkResult test_pairs(const ArcSet& set, const std::vector<Bounds>& bounds,
                       const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs, unsigned threads) {
    constexpr std::size_t chunk = 1024;
    std::vector<ChunkResult> results((pairs.size() + chunk - 1) / chunk);
    tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads));
    arena.execute([&] {
        tbb::parallel_for(std::size_t{0}, results.size(), [&](std::size_t k) {
            PairTest test(set, bounds, results[k]);
            for (std::size_t i = k * chunk; i < std::min(pairs.size(), (k + 1) * chunk); ++i)
                test(pairs[i].first, pairs[i].second);
        });
    });
    ChunkResult all;
    for (ChunkResult& r : results) {
        all.contacts.insert(all.contacts.end(), r.contacts.begin(), r.contacts.end());
        all.shared.insert(all.shared.end(), r.shared.begin(), r.shared.end());
        all.certified += r.certified, all.exact += r.exact, all.crossings += r.crossings;
    }
    return all;
}

Interval meet(const Interval& a, const Interval& b) {
    const Interval m(std::max(a.lo, b.lo), std::min(a.hi, b.hi));
    return m.lo <= m.hi ? m : hull(a, b);
}

/// One vertex for every crossing.
void add_vertices(ArcSet& set, std::vector<PairContact>& contacts) {
    for (PairContact& c : contacts) {
        if (c.vertex != kNone) continue;
        c.vertex = static_cast<std::uint32_t>(set.vertices.size());
        set.vertices.push_back({c.point.x, c.point.y, false, {}});
    }
}

// --- vertices that can't be told apart
// --------------------------------------------------------------------------------------------

/// Vertices by the unit cells their boxes touch; cells hold few.
std::vector<std::tuple<double, double, std::uint32_t>> cells_of(const std::vector<Vertex>& vertices) {
    std::vector<std::tuple<double, double, std::uint32_t>> cells;
    cells.reserve(vertices.size());
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
        const Vertex& p = vertices[v];
        for (double x = std::floor(p.x.lo); x <= p.x.hi; x += 1) {
            for (double y = std::floor(p.y.lo); y <= p.y.hi; y += 1)
                cells.emplace_back(x, y, v);
        }
    }
    std::sort(cells.begin(), cells.end());
    return cells;
}

/// Representative of each vertex: itself, or the vertex its enclosure overlaps. Integral vertices win.
std::vector<std::uint32_t> identify_vertices(std::vector<Vertex>& vertices) {
    UnionFind same(vertices.size());
    const auto cells = cells_of(vertices);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto& [x, y, v] = cells[i];
        for (std::size_t k = i + 1; k < cells.size() && std::get<0>(cells[k]) == x && std::get<1>(cells[k]) == y; ++k) {
            const Vertex &a = vertices[v], &b = vertices[std::get<2>(cells[k])];
            if (a.x.overlaps(b.x) && a.y.overlaps(b.y)) same.unite(v, std::get<2>(cells[k]));
        }
    }
    std::vector<std::uint32_t> representative(vertices.size());
    for (std::uint32_t v = 0; v < vertices.size(); ++v) {
        const std::uint32_t r = representative[v] = same.find(v);
        if (r == v || vertices[r].integral) continue;
        if (vertices[v].integral)
            vertices[r] = vertices[v];
        else
            vertices[r] = {meet(vertices[r].x, vertices[v].x), meet(vertices[r].y, vertices[v].y), false, {}};
    }
    return representative;
}

/// Parameter of a vertex (representative) on an arc.
struct Cut {
    Interval t;
    std::uint32_t vertex = 0;
};

/// The arc's interior vertices in order. It passes each once: contacts that are one vertex have one parameter, where
/// their enclosures agree.
void order_cuts(std::vector<Cut>& cuts, std::uint32_t first, std::uint32_t last) {
    std::erase_if(cuts, [&](const Cut& c) { return c.vertex == first || c.vertex == last; });
    std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) {
        return std::tuple(a.vertex, a.t.lo, a.t.hi) < std::tuple(b.vertex, b.t.lo, b.t.hi);
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < cuts.size(); ++i) {
        if (kept > 0 && cuts[kept - 1].vertex == cuts[i].vertex)
            cuts[kept - 1].t = meet(cuts[kept - 1].t, cuts[i].t);
        else
            cuts[kept++] = cuts[i];
    }
    cuts.resize(kept);
    std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) {
        return std::pair(a.t.mid(), a.vertex) < std::pair(b.t.mid(), b.vertex);
    });
}

void emit_edges(Arrangement& out, std::uint32_t arc, std::vector<Cut>& cuts, const std::vector<std::uint32_t>& rep) {
    const Arc& a = out.set.arcs[arc];
    Interval t = a.t0;
    std::uint32_t v = rep[a.v0];
    const std::uint32_t last = rep[a.v1];
    order_cuts(cuts, v, last);
    for (const Cut& c : cuts) {
        out.edges.push_back({arc, t, c.t, v, c.vertex});
        t = c.t, v = c.vertex;
    }
    if (v != last) out.edges.push_back({arc, t, a.t1, v, last});
}

void cut_arcs(Arrangement& out, const std::vector<PairContact>& contacts, const std::vector<std::uint32_t>& rep) {
    std::vector<std::uint32_t> start(out.set.arcs.size() + 1, 0); // contacts by arc
    for (const PairContact& c : contacts)
        ++start[c.a + 1], ++start[c.b + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<Cut> all(start.back());
    std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
    for (const PairContact& c : contacts) {
        all[next[c.a]++] = {c.at.s, rep[c.vertex]};
        all[next[c.b]++] = {c.at.t, rep[c.vertex]};
    }
    std::vector<Cut> cuts;
    for (std::uint32_t arc = 0; arc < out.set.arcs.size(); ++arc) {
        cuts.assign(all.begin() + start[arc], all.begin() + start[arc + 1]);
        emit_edges(out, arc, cuts, rep);
    }
}

} // namespace

Result<Arrangement> arrange(const Scene& scene, const Grid& grid, unsigned threads, PlanarStats& stats) {
    std::vector<SharedSupport> shared;
    // A pass that finds partial overlaps starts again with them joined; each pass adds at least one pair, real art
    // needs none or one.
    for (;;) {
        PlanarStats pass = {};
        Arrangement out;
        out.set = prepare_arcs(scene, grid, shared, pass);
        std::vector<Bounds> bounds;
        bounds.reserve(out.set.arcs.size());
        for (const Arc& a : out.set.arcs)
            bounds.push_back(bounds_of(out.set, a));
        const auto pairs = overlapping_pairs(canvas_boxes(grid, bounds));
        ChunkResult found = test_pairs(out.set, bounds, pairs, threads);
        std::sort(found.shared.begin(), found.shared.end());
        found.shared.erase(std::unique(found.shared.begin(), found.shared.end()), found.shared.end());
        const std::size_t known = shared.size();
        for (const SharedSupport& s : found.shared) {
            if (std::find(shared.begin(), shared.end(), s) == shared.end()) shared.push_back(s);
        }
        if (shared.size() > known) continue;

        add_vertices(out.set, found.contacts);
        const std::vector<std::uint32_t> representative = identify_vertices(out.set.vertices);
        cut_arcs(out, found.contacts, representative);
        pass.box_pairs = pairs.size(), pass.pairs_certified = found.certified, pass.pairs_exact = found.exact;
        pass.overlaps = shared.size(), pass.crossings = found.crossings;
        pass.vertices = out.set.vertices.size(), pass.edges = out.edges.size();
        stats = pass;
        return out;
    }
}

} // namespace fetexc
