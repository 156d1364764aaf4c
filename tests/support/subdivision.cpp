// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/subdivision.h"

#include <algorithm>
#include <cmath>

#include "compiler/union_find.h"

namespace fetexc::test {
namespace {

bool close(CanvasPoint a, CanvasPoint b, double tolerance) {
    return std::fabs(a.x - b.x) <= tolerance && std::fabs(a.y - b.y) <= tolerance;
}

/// Edges at each vertex; a loop is listed twice.
std::vector<std::vector<std::uint32_t>> edges_at_vertices(const Subdivision& s) {
    std::vector<std::vector<std::uint32_t>> at(s.vertices.size());
    for (std::uint32_t e = 0; e < s.edges.size(); ++e) {
        at[s.edges[e].first].push_back(e);
        at[s.edges[e].second].push_back(e);
    }
    return at;
}

std::vector<CanvasPoint> segment_ends(std::span<const Path> paths) {
    std::vector<CanvasPoint> ends;
    for (const Path& path : paths) {
        for (const auto& segment : path) {
            for (const LatticePoint& p : {segment.front(), segment.back()})
                ends.push_back({static_cast<double>(p.x), static_cast<double>(p.y)});
        }
    }
    return ends;
}

/// For each of our vertices the one of theirs at the same place; kNone where there is none or more than one.
std::vector<std::uint32_t> matched(const Subdivision& ours, const Subdivision& theirs, double tolerance) {
    std::vector<std::uint32_t> match(ours.vertices.size(), kNone);
    for (std::size_t i = 0; i < match.size(); ++i) {
        std::uint32_t found = 0;
        for (std::uint32_t k = 0; k < theirs.vertices.size(); ++k) {
            if (!close(ours.vertices[i], theirs.vertices[k], tolerance)) continue;
            match[i] = k;
            ++found;
        }
        if (found != 1) match[i] = kNone;
    }
    return match;
}

using EdgeList = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

EdgeList sorted(EdgeList edges) {
    for (auto& [a, b] : edges)
        if (a > b) std::swap(a, b);
    std::sort(edges.begin(), edges.end());
    return edges;
}

std::string place(CanvasPoint p) { return " (" + std::to_string(p.x) + ", " + std::to_string(p.y) + ")"; }

} // namespace

Subdivision subdivision_of(const Arrangement& arrangement, double unit) {
    Subdivision out;
    std::vector<std::uint32_t> index(arrangement.set.vertices.size(), kNone);
    const auto used = [&](std::uint32_t v) {
        if (index[v] == kNone) {
            index[v] = static_cast<std::uint32_t>(out.vertices.size());
            const Vertex& vertex = arrangement.set.vertices[v];
            out.vertices.push_back({vertex.x.mid() / unit, vertex.y.mid() / unit});
        }
        return index[v];
    };
    for (const Edge& e : arrangement.edges) {
        const std::uint32_t a = used(e.va), b = used(e.vb);
        out.edges.emplace_back(a, b);
    }
    out.faces = faces_by_euler(out);
    return out;
}

std::size_t faces_by_euler(const Subdivision& s) {
    UnionFind parts(s.vertices.size());
    for (const auto& [a, b] : s.edges)
        parts.unite(a, b);
    std::size_t components = 0;
    for (std::uint32_t v = 0; v < s.vertices.size(); ++v)
        components += parts.find(v) == v ? 1 : 0;
    return 1 + components + s.edges.size() - s.vertices.size();
}

Subdivision without_splits(const Subdivision& s, std::span<const Path> paths) {
    constexpr double exact_place = 1e-9; // ends are integers
    const std::vector<CanvasPoint> ends = segment_ends(paths);
    const auto at = edges_at_vertices(s);
    Subdivision out;
    out.faces = s.faces;
    std::vector<std::uint32_t> index(s.vertices.size(), kNone);
    for (std::uint32_t v = 0; v < s.vertices.size(); ++v) {
        const auto is_end = [&](CanvasPoint p) { return close(p, s.vertices[v], exact_place); };
        if (at[v].size() == 2 && std::none_of(ends.begin(), ends.end(), is_end)) continue;
        index[v] = static_cast<std::uint32_t>(out.vertices.size());
        out.vertices.push_back(s.vertices[v]);
    }
    std::vector<bool> walked(s.edges.size(), false);
    for (std::uint32_t v = 0; v < s.vertices.size(); ++v) {
        if (index[v] == kNone) continue;
        for (std::uint32_t first : at[v]) {
            std::uint32_t e = first, to = v;
            if (walked[e]) continue;
            for (;;) {
                walked[e] = true;
                to = s.edges[e].first == to ? s.edges[e].second : s.edges[e].first;
                if (index[to] != kNone) break;
                e = at[to][0] == e ? at[to][1] : at[to][0];
            }
            out.edges.emplace_back(index[v], index[to]);
        }
    }
    return out;
}

std::string difference(const Subdivision& ours, const Subdivision& theirs, double tolerance) {
    const auto count = [](const char* what, std::size_t a, std::size_t b) {
        return a == b ? "" : std::string(what) + " " + std::to_string(a) + ", theirs " + std::to_string(b) + "; ";
    };
    std::string counts = count("vertices", ours.vertices.size(), theirs.vertices.size()) +
                         count("edges", ours.edges.size(), theirs.edges.size()) +
                         count("faces", ours.faces, theirs.faces);
    const std::vector<std::uint32_t> match = matched(ours, theirs, tolerance), back = matched(theirs, ours, tolerance);
    for (std::size_t i = 0; i < match.size(); ++i)
        if (match[i] == kNone) counts += "no single vertex of theirs at" + place(ours.vertices[i]) + "; ";
    for (std::size_t i = 0; i < back.size(); ++i)
        if (back[i] == kNone) counts += "no single vertex of ours at" + place(theirs.vertices[i]) + "; ";
    if (!counts.empty()) return counts;
    EdgeList edges = ours.edges;
    for (auto& [a, b] : edges)
        a = match[a], b = match[b];
    return sorted(edges) == sorted(theirs.edges) ? "" : "other vertices are joined";
}

std::vector<double> packed(const Subdivision& s) {
    std::vector<double> out{static_cast<double>(s.faces), static_cast<double>(s.vertices.size())};
    for (const CanvasPoint& p : s.vertices)
        out.insert(out.end(), {p.x, p.y});
    for (const auto& [a, b] : s.edges)
        out.insert(out.end(), {static_cast<double>(a), static_cast<double>(b)});
    return out;
}

Subdivision unpacked(const std::vector<double>& values) {
    Subdivision s;
    s.faces = static_cast<std::size_t>(values[0]);
    const std::size_t edges = 2 + 2 * static_cast<std::size_t>(values[1]);
    for (std::size_t i = 2; i < edges; i += 2)
        s.vertices.push_back({values[i], values[i + 1]});
    for (std::size_t i = edges; i < values.size(); i += 2)
        s.edges.emplace_back(static_cast<std::uint32_t>(values[i]), static_cast<std::uint32_t>(values[i + 1]));
    return s;
}

} // namespace fetexc::test
