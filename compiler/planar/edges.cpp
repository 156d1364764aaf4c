// SPDX-License-Identifier: GPL-3.0-or-later
#include "compiler/planar/edges.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "compiler/parallel.h"
#include "compiler/planar/arc_order.h"

namespace fetexc {
namespace {

constexpr std::size_t kChunk = 512; ///< arcs

/// Vertices on each arc: its ends, and its contacts.
class ArcVertices {
  public:
    ArcVertices(const ArcSet& set, std::span<const PairContact> contacts) : set_(set), start_(set.arcs.size() + 1, 0) {
        for (const PairContact& c : contacts)
            ++start_[c.a + 1], ++start_[c.b + 1];
        std::partial_sum(start_.begin(), start_.end(), start_.begin());
        on_arc_.resize(start_.back());
        std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
        for (const PairContact& c : contacts) {
            on_arc_[next[c.a]++] = {c.vertex, c.at.s};
            on_arc_[next[c.b]++] = {c.vertex, c.at.t};
        }
    }

    void of(std::size_t arc, std::vector<OnArc>& out) const {
        const Arc& a = set_.arcs[arc];
        out.assign(on_arc_.begin() + start_[arc], on_arc_.begin() + start_[arc + 1]);
        out.push_back({a.v0, a.t0});
        out.push_back({a.v1, a.t1});
    }

  private:
    const ArcSet& set_;
    std::vector<std::uint32_t> start_;
    std::vector<OnArc> on_arc_;
};

/// Sorts by enclosures; true if they are apart, so that this is the order, between the ends.
bool sort_apart(const Arc& arc, std::vector<OnArc>& entries) {
    std::sort(entries.begin(), entries.end(), [](const OnArc& p, const OnArc& q) { return p.t.lo < q.t.lo; });
    const auto meet = [](const OnArc& p, const OnArc& q) { return p.t.hi >= q.t.lo; };
    return entries.front().vertex == arc.v0 && entries.back().vertex == arc.v1 &&
           std::adjacent_find(entries.begin(), entries.end(), meet) == entries.end();
}

/// Each representative takes the best that is known of its point.
void join_vertices(ArcSet& set, std::span<const std::uint32_t> representative) {
    const auto narrow = [](Interval& a, const Interval& b) {
        if (a.overlaps(b)) a = meet(a, b);
    };
    for (std::uint32_t k = 0; k < set.vertices.size(); ++k) {
        if (representative[k] == k) continue;
        const Vertex& v = set.vertices[k];
        Vertex& r = set.vertices[representative[k]];
        if (r.integral) continue;
        if (v.integral)
            r = v;
        else
            narrow(r.x, v.x), narrow(r.y, v.y);
    }
}

class Cutter {
  public:
    Cutter(Arrangement& arrangement, std::span<const PairContact> contacts, unsigned threads, PlanarStats& stats)
        : out_(arrangement), threads_(threads), contacts_(arrangement.set, contacts), order_(arrangement.set, stats),
          chunks_((arrangement.set.arcs.size() + kChunk - 1) / kChunk) {}

    std::optional<Vertex> run() {
        each_chunk([&](Chunk& chunk, std::size_t first, std::size_t end) { sort(chunk, first, end); });
        for (Chunk& chunk : chunks_)
            sort_close(chunk);
        std::vector<std::uint32_t> representative(out_.set.vertices.size());
        for (std::uint32_t k = 0; k < representative.size(); ++k)
            representative[k] = order_.representative(k);
        std::size_t edges = 0;
        for (Chunk& chunk : chunks_) {
            chunk.first_edge = edges;
            edges += chunk.edges();
        }
        out_.edges.resize(edges);
        each_chunk([&](Chunk& chunk, std::size_t first, std::size_t end) { emit(chunk, first, end, representative); });
        join_vertices(out_.set, representative);
        if (order_.conflict()) return out_.set.vertices[*order_.conflict()];
        for (const Edge& e : out_.edges) {
            if (e.va == e.vb) return out_.set.vertices[e.va];
        }
        return {};
    }

  private:
    struct Chunk {
        std::vector<OnArc> entries;             ///< of all arcs whose enclosures are apart
        std::vector<std::uint32_t> count;       ///< entries of each arc, 0: a close one
        std::vector<std::uint32_t> close;       ///< the other arcs
        std::vector<std::vector<OnArc>> sorted; ///< their entries
        std::size_t first_edge = 0;

        [[nodiscard]] std::size_t edges() const {
            std::size_t n = entries.size() - (count.size() - close.size());
            for (const std::vector<OnArc>& s : sorted)
                n += s.size() - 1;
            return n;
        }
    };

    template <class Body> void each_chunk(const Body& body) {
        parallel_for_chunks(out_.set.arcs.size(), kChunk, threads_,
                            [&](std::size_t first, std::size_t end) { body(chunks_[first / kChunk], first, end); });
    }

    void sort(Chunk& chunk, std::size_t first, std::size_t end) const {
        std::vector<OnArc> on_arc;
        for (std::size_t arc = first; arc < end; ++arc) {
            contacts_.of(arc, on_arc);
            const bool apart = sort_apart(out_.set.arcs[arc], on_arc);
            chunk.count.push_back(apart ? static_cast<std::uint32_t>(on_arc.size()) : 0);
            if (apart)
                chunk.entries.insert(chunk.entries.end(), on_arc.begin(), on_arc.end());
            else
                chunk.close.push_back(static_cast<std::uint32_t>(arc));
        }
    }

    /// One arc after the other: what one has decided spares the next comparisons.
    void sort_close(Chunk& chunk) {
        for (std::uint32_t arc : chunk.close) {
            std::vector<OnArc>& entries = chunk.sorted.emplace_back();
            contacts_.of(arc, entries);
            order_.sort(out_.set.arcs[arc], entries);
        }
    }

    void emit(const Chunk& chunk, std::size_t first, std::size_t end, std::span<const std::uint32_t> representative) {
        std::size_t edge = chunk.first_edge, next = 0, close = 0;
        for (std::size_t arc = first; arc < end; ++arc) {
            std::span<const OnArc> on_arc = std::span(chunk.entries).subspan(next, chunk.count[arc - first]);
            next += on_arc.size();
            if (on_arc.empty()) on_arc = chunk.sorted[close++];
            for (std::size_t k = 0; k + 1 < on_arc.size(); ++k) {
                out_.edges[edge++] = {static_cast<std::uint32_t>(arc), on_arc[k].t, on_arc[k + 1].t,
                                      representative[on_arc[k].vertex], representative[on_arc[k + 1].vertex]};
            }
        }
    }

    Arrangement& out_;
    unsigned threads_;
    ArcVertices contacts_;
    ArcOrder order_;
    std::vector<Chunk> chunks_;
};

} // namespace

std::optional<Vertex> cut_arcs(Arrangement& arrangement, std::span<const PairContact> contacts, unsigned threads,
                               PlanarStats& stats) {
    return Cutter(arrangement, contacts, threads, stats).run();
}

} // namespace fetexc
